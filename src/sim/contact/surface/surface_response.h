// Impulses between faces and springs that touch, and what they rest on.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/contact/closest.h"

namespace hooke {

// The sum of what sweeps have added and taken back [N s].
struct ContactImpulse {
  double normal = 0.0;  // not negative
  Vec3 friction{0.0};   // across the normal, at most the coefficient times the above
};

// Two features that touch or may do so within the substep. Velocities are relative: of the first as seen from the second.
struct SurfaceContact {
  FeaturePair kind = FeaturePair::PointFace;
  std::array<Index, 4> points{};
  std::array<double, 4> weight{};
  Vec3 normal{0.0};         // from the second to the first
  double gap = 0.0;         // [m], distance less thickness
  double response = 0.0;    // [1/kg], relative velocity per impulse
  double max_change = 0.0;  // [1/kg], of the velocity of one of its points, per impulse
  double target = 0.0;      // [m/s], the least relative velocity along the normal
  ContactImpulse impulse;
  double pressing = 0.0;    // [N s], along the normal, of the first half of the substep
  double separating = 0.0;  // [N s], along the normal, that separates
  // Of what may rebound: along the normal where the path touches, and by which velocities of positions are ahead of those of the method.
  double approach = 0.0, ahead = 0.0;  // [m/s]
  double rebound = 0.0;                // [m/s], the least relative velocity after an impact; 0: there is none
  double before_rebound = 0.0;         // [N s], the impulse at the end without it
  bool is_pressed = false;             // whether there was one within the substep
  bool is_driven = false;              // whether one of its points is held

  // Where the features are now: the weights and the normal of their closest points, and what follows from them.
  void move_to(const Closest& closest, std::span<const double> inverse_mass);
};

// Where a contact is close to a nail, it moves the other end of the spring, or the rest of the face, like a lever: by up to this multiple
// of what the hand moves, or of the displacement by which features separate.
inline constexpr double max_leverage = 8.0;

// The impulse [N s] that is left of `impulse` when it moves no point of a feature faster in its direction than max_leverage times the speed
// of the held point or of the approach [m/s]. Without the hand, impulses remove kinetic energy, which is limit enough.
double limited_impulse(std::span<const Index> points, std::span<const double> weight, const Vec3& normal, double impulse, double approach,
                       std::span<const double> inverse_mass, std::span<const Vec3> velocity);

// Four points at x with `angular` [kg m^2/s] too much angular momentum turn about their center of mass, like a rigid body, until they are
// without it. Not if one of them is fixed, which would exert a torque anyway, or if they are on a straight line.
void remove_angular_momentum(const Vec3& angular, const std::array<Index, 4>& points, std::span<const Vec3> x,
                             std::span<const double> inverse_mass, std::span<Vec3> velocity);

// A point that touches something and may reach an obstacle.
struct ObstacleContact {
  Index point = 0;
  Vec3 normal{0.0};
  double target = 0.0;      // [m/s]
  double end_target = 0.0;  // [m/s], at the end of the substep
  double friction = 0.0;    // [1]
  Vec3 surface{0.0};        // [m/s]
  ContactImpulse impulse;
  ContactImpulse end_impulse;  // that with which the end of the substep starts
  double pressing = 0.0;       // [N s], as above
  bool is_pressed = false;
};

struct SurfaceContacts {
  std::vector<SurfaceContact> surface;
  std::vector<ObstacleContact> obstacles;
  bool has_points = false;  // whether `surface` contains pairs of points
  long impulses = 0;        // computed between features, since it was set

  // Changes velocities, per point, in Gauss-Seidel sweeps, forward and backward in turn, obstacles last, until they change little: by the
  // least impulses for which nothing is below its target, and the Coulomb impulses of up to friction times these. What one contact no
  // longer needs when others have pushed is taken back: otherwise, what rests on many contacts would be pushed apart. Continues from the
  // impulses there are. If no target is positive, this removes kinetic energy. Returns whether any was necessary.
  bool settle(std::span<const double> inverse_mass, double friction, std::span<Vec3> velocity);
  // The same for what separates, from no impulses: `velocity` is that of the displacement by which it does. Obstacles do not rub there.
  bool separate(std::span<const double> inverse_mass, double friction, std::span<Vec3> velocity);

 private:
  bool settle(std::span<const double> inverse_mass, double friction, double leverage, int max_sweeps, std::span<Vec3> velocity);
};

}  // namespace hooke
