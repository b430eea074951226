#include "sim/contact/surface/surface_solver.h"

#include "sim/contact/surface/surface_step.h"

namespace hooke {

SurfaceSolver::SurfaceSolver(double relative_margin) : relative_margin_(relative_margin) {}
SurfaceSolver::~SurfaceSolver() = default;
SurfaceSolver::SurfaceSolver(SurfaceSolver&& other) noexcept = default;
SurfaceSolver& SurfaceSolver::operator=(SurfaceSolver&& other) noexcept = default;

void SurfaceSolver::begin_frame() {
  if (step_) step_->begin_frame();
}

void SurfaceSolver::begin_substep(const Plan& plan, double velocity_lag, bool kicks_last, const Field* unlimited, const Motion& motion) {
  if (!step_) step_ = std::make_unique<SurfaceStep>(relative_margin_);
  step_->begin_substep(plan, velocity_lag, kicks_last, unlimited, motion);
}

bool SurfaceSolver::resolve(const Plan& plan, std::span<const Obstacle> obstacles, std::span<const PointPair> near, const Field& x0,
                            const Field& v0, double h, Motion& motion) {
  return step_->resolve(plan, obstacles, near, x0, v0, h, motion);
}

bool SurfaceSolver::has_failed() const { return step_ && step_->has_failed(); }
long SurfaceSolver::searches() const { return step_ ? step_->searches() : 0; }
long SurfaceSolver::impacts() const { return step_ ? step_->impacts() : 0; }
long SurfaceSolver::candidates() const { return step_ ? step_->candidates() : 0; }

}  // namespace hooke
