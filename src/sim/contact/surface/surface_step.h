// A substep of contact between faces and springs: what SurfaceSolver does.
#pragma once

#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "sim/contact/contact_work.h"
#include "sim/contact/obstacle.h"
#include "sim/contact/pair_search.h"
#include "sim/contact/surface/surface_response.h"
#include "sim/contact/surface/surface_search.h"
#include "sim/forces/motion.h"

namespace hooke {

// Of a point of the scene, from a field of the motion.
inline Vec3 point_in(const Plan& plan, const Field& field, Index i) {
  const auto n = static_cast<std::size_t>(plan.points);
  return {field[i], field[n + i], plan.dimensions == 3 ? field[2 * n + i] : 0.0};
}

inline Vec3 weighted(std::span<const Vec3> field, const std::array<Index, 4>& points, const std::array<double, 4>& weight) {
  return weight[0] * field[points[0]] + weight[1] * field[points[1]] + weight[2] * field[points[2]] + weight[3] * field[points[3]];
}

class SurfaceStep {
 public:
  explicit SurfaceStep(double relative_margin) : search_(relative_margin) {}

  void begin_frame() {
    search_.clear();
    decay_step_ = 0.0;
  }
  void begin_substep(const Plan& plan, double velocity_lag, bool kicks_last, const Field* unlimited, const Motion& motion);
  bool resolve(const Plan& plan, std::span<const Obstacle> obstacles, std::span<const PointPair> near, const Field& x0, const Field& v0,
               double h, Motion& motion);
  bool has_failed() const { return has_failed_; }
  long searches() const { return search_.searches(); }
  long impacts() const { return impacts_; }
  long candidates() const { return search_.candidates(); }

 private:
  bool correct(const Plan& plan, std::span<const Obstacle> obstacles, std::span<const PointPair> near, const Field& x0, const Field& v0,
               double h, Motion& motion);
  bool load(const Plan& plan, const Field& x0, double h, const Motion& motion);
  void start_frame(const Plan& plan);
  double max_speed(std::span<const Vec3> velocity) const;
  void make_contacts(const Plan& plan, double h);
  void add_points(const Plan& plan, std::span<const PointPair> near, double h);
  void add_contact(FeaturePair kind, const std::array<Index, 4>& points, const Closest& closest, double gap, double h);
  void add_obstacles(const Plan& plan, std::span<const Obstacle> obstacles, double h, const Motion& motion);
  void note_impacts(const Plan& plan, const Field& v0, double h, const Motion& motion);
  void note_pressed(const Plan& plan, double h);
  bool separate(const Plan& plan, const Field& v0, double h);
  bool prevent_crossings(const Plan& plan, double h);
  bool handle_impact(const SurfacePair& pair, double part, double h, bool joins);
  bool join(const std::array<Index, 4>& points);
  void move_contacts();
  void repeat_last_kick(const Plan& plan, double h, Motion& motion);
  void remove_torques(const Plan& plan, double h, const Motion& motion);
  void write(const Plan& plan, const Field& v0, double h, Motion& motion);
  SuppliedWork supplied_work(const Plan& plan, const Motion& motion) const;
  void rebound(const Plan& plan);
  void note_collisions(const Plan& plan, std::span<const Obstacle> obstacles, double h, const Motion& motion);
  // Whether dashpots transmit what contact changes. Where points touch each other, too, they do not.
  static bool transmits(const Plan& plan) { return plan.has_dashpots() && !plan.pairs.on; }
  void transmit_through_dashpots(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, bool touches, double h,
                                 Motion& motion);
  FourPoints four(std::span<const Vec3> field, const std::array<Index, 4>& points) const {
    return {field[points[0]], field[points[1]], field[points[2]], field[points[3]]};
  }

  SurfaceSearch search_;
  std::vector<double> inverse_mass_;  // [1/kg], per point of the surface, as all of the following

  std::vector<Vec3> x_, end_;        // at the start of the substep, and at its end, first without this contact
  std::vector<Vec3> free_velocity_;  // [m/s], at its end without any contact and strain limit
  double velocity_lag_ = 0.0;        // [1], of the method (integrator.h)
  bool is_limited_ = false;          // whether the strain limit acted in the substep
  bool kicks_last_ = false;          // whether the method ends a substep by accelerating points
  // [m/s], displacement over h: without this contact, with its impulses, with what separates, and without impacts
  std::vector<Vec3> free_u_, u_, separated_, path_;
  std::vector<Vec3> shift_;               // [m/s], that separates, over h
  std::vector<Vec3> velocity_, at_rest_;  // [m/s], at the end, and without rebounds
  std::vector<Vec3> last_kick_;           // [m/s], the part of it by forces at the end, if the method kicks last

  SurfaceContacts contacts_;
  struct Hit {
    std::array<Index, 4> points;
    std::array<double, 4> weight;
    Vec3 push;  // [N s], on the first feature
  };
  std::vector<Hit> hits_;                   // impacts in the substep
  std::vector<Vec3> arm_, separating_arm_;  // [m], of the torques of impulses
  // Of all points of the scene: velocities and places at the end without contact, by what contact changes the former, and whether obstacles
  // did; places at the end, the acceleration without contact, and by what that with it changes the velocity.
  Field all_free_velocity_, all_free_end_, change_;
  Field all_end_, free_acceleration_, kick_;
  std::vector<char> has_collided_;
  std::vector<double> decay_;
  double decay_step_ = 0.0;  // [s]: of which `decay_` is; 0: of none

  Index held_ = no_index;  // the held point
  std::vector<char> is_marked_;
  DisjointSets chains_;       // points that may touch each other
  std::vector<Index> local_;  // per point of the scene: of the surface; no_index: not on it
  std::vector<Index> zone_;   // per point: the first of those that move together
  bool has_failed_ = false;
  double held_impulse_ = 0.0;  // [N s], a bound on the impulses of impacts on the held point in the substep
  long impacts_ = 0;
  long distances_ = 0;  // on paths, in the substep
  long excess_ = 0;     // of work of earlier substeps of the frame, beyond what is usual
};

}  // namespace hooke
