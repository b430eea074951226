// Contact between faces and springs during a frame.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/closest_kernel.h"
#include "sim/contact/obstacle.h"
#include "sim/contact/surface/surface_response.h"
#include "sim/contact/surface/surface_tree.h"
#include "sim/motion.h"

namespace hooke {

// Impulses act at the start of a substep.
inline constexpr int surface_contact_order = 1;

// Corrects a step of any method, after all else that moves points in it: their path within it is taken to be straight. Impulses keep what
// comes closer than the thickness from approaching (surface_response.h). What would pass through each other nevertheless has an inelastic
// impact, found by continuous collision detection on the paths that result, again until there is none; after some passes, what hits each
// other moves together. Hence nothing that is apart at the start of a step meets within it, unless nailed or held points force it to.
// Positions are not changed after that.
//
// Pairs of features that come close enough to matter are found once for many substeps, for points that move on as they do, with a margin
// for what they deviate by from that. What a substep does depends neither on the margin nor on those before it in the frame.
class SurfaceSolver {
 public:
  // [1], of the length of the edges. Results do not depend on it.
  explicit SurfaceSolver(double relative_margin = 0.25) : relative_margin_(relative_margin) {}

  // Points may have been edited. What passes through each other now is left alone until the next frame.
  void begin_frame() { tree_.clear(); }

  // Before other contacts: remembers where the method leads.
  void begin_substep(const Plan& plan, const Motion& motion);
  // Corrects the step of h that led from (x0, v0) to the motion. Returns whether anything touched.
  bool resolve(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h, Motion& motion);
  // Whether the last call gave up: there are more than PairSolver::max_pairs pairs.
  bool has_failed() const { return has_failed_; }

  // In this frame, for tests and measurements.
  long searches() const { return searches_; }  // of pairs
  long impacts() const { return impacts_; }    // found by continuous collision detection
  long candidates() const { return static_cast<long>(pairs_.size()); }

 private:
  // A pair at the start of the substep.
  struct Near {
    Index pair = 0, evaluated = 0;  // of pairs_ and evaluated_
    double distance = 0.0;          // [m]
  };

  bool correct(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h, Motion& motion);
  bool load(const Plan& plan, const Field& x0, double h, const Motion& motion);
  void start_frame(const Plan& plan);
  double max_speed(std::span<const Vec3> velocity) const;
  bool is_covered(double reach) const;
  bool find_pairs(const Plan& plan, double reach, double approach, double h);
  bool find_near(const Plan& plan, double reach, double approach, double h);
  void evaluate(FeaturePair kind, double reach);
  void make_contacts(const Plan& plan, double reach, double h);
  void add_obstacles(const Plan& plan, std::span<const Obstacle> obstacles, double reach, double h, const Motion& motion);
  void note_pressed(const Plan& plan, double h);
  bool separate(double h);
  bool prevent_crossings(const Plan& plan, double h);
  bool handle_impact(const Near& near, double part, double h, bool joins);
  bool join(const std::array<Index, 4>& points);
  void write(const Plan& plan, const Field& v0, double h, Motion& motion);
  FourPoints four(std::span<const Vec3> field, const std::array<Index, 4>& points) const {
    return {field[points[0]], field[points[1]], field[points[2]], field[points[3]]};
  }

  double relative_margin_;
  SurfaceTree tree_;
  std::vector<char> is_pierced_;      // per point, whether it is on an edge or face of a crossing at the start of the frame
  std::vector<double> inverse_mass_;  // [1/kg], per point of the surface, as all of the following

  std::vector<Vec3> x_, end_;        // at the start of the substep, and at its end without this contact
  std::vector<Vec3> free_velocity_;  // [m/s], at its end without any contact
  // [m/s], displacement over h: without this contact, with its impulses, with what separates, and without impacts
  std::vector<Vec3> free_u_, u_, separated_, path_;
  std::vector<Vec3> velocity_;  // [m/s], at the end

  std::vector<SurfacePair> pairs_;
  std::vector<double> keys_;           // [m], of the pairs: their distance is at least that less travel_
  std::vector<Vec3> found_at_, last_;  // positions at which they were found, and in the substep before
  double found_reach_ = 0.0;           // [m]; 0: not found in this frame
  std::vector<Vec3> drift_;            // [m/s], with which points were assumed to move on
  std::vector<Vec3> displacement_;     // [m], by which, relative to the mean of all
  double horizon_ = 0.0;               // [s], how long
  double elapsed_ = 0.0;               // [s], since they were found
  double travel_ = 0.0;                // [m], bound on the change of the distance of any pair since they were found
  std::vector<Index> woken_;           // pairs that may be near
  std::vector<Closest> evaluated_;     // of those; only the distance if they are not near
  std::array<FeatureBlock, 2> block_;  // of those of each kind that are not evaluated yet
  std::array<std::array<Index, FeatureBlock::capacity>, 2> place_{};  // of woken_
  std::vector<Near> near_;
  double near_reach_ = 0.0;  // [m]: contains all pairs that are closer
  SurfaceContacts contacts_;
  std::vector<char> is_marked_;
  std::vector<Index> zone_;  // per point: the first of those that move together
  bool has_failed_ = false;
  long searches_ = 0, impacts_ = 0;
  long tests_ = 0, impulses_ = 0;  // of the substep, for Motion
};

}  // namespace hooke
