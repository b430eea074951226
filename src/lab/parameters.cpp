#include "lab/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "lab/file_limits.h"

namespace hooke {
namespace {

using Kind = Parameter::Kind;
using Scope = Parameter::Scope;

// Scales the gravity to a size; down when there was none.
void set_gravity(Scene& scene, double size) {
  Vec3& gravity = scene.system.gravity;
  const double now = glm::length(gravity);
  gravity = now > 0.0 ? gravity * (size / now) : Vec3(0.0, -size, 0.0);
}

// What all springs have on average: the one value shown for many.
double mean_of_springs(const Scene& scene, double Spring::*property, double none) {
  const auto& springs = scene.system.springs();
  if (springs.empty()) return none;
  double sum = 0.0;
  bool same = true;
  for (const Spring& spring : springs) {
    sum += spring.*property;
    same = same && spring.*property == springs.front().*property;
  }
  return same ? springs.front().*property : sum / static_cast<double>(springs.size());
}

// The same of one family, and its switch.
template <SpringFamily family>
double read_family_stiffness(const Scene& scene) {
  double sum = 0.0, first = 0.0;
  long count = 0;
  bool same = true;
  for (const Spring& spring : scene.system.springs()) {
    if (spring.family != family) continue;
    if (count++ == 0) first = spring.stiffness;
    sum += spring.stiffness;
    same = same && spring.stiffness == first;
  }
  return same ? first : sum / static_cast<double>(count);
}
template <SpringFamily family>
void write_family_stiffness(Scene& scene, double value) {
  for (Index s = 0; s < scene.system.spring_count(); ++s)
    if (scene.system.springs()[s].family == family) scene.system.spring(s).stiffness = value;
}
template <SpringFamily family>
double read_family_switch(const Scene& scene) {
  return scene.system.family_on[static_cast<std::size_t>(family)] ? 1.0 : 0.0;
}
template <SpringFamily family>
void write_family_switch(Scene& scene, double value) {
  scene.system.family_on[static_cast<std::size_t>(family)] = value != 0.0;
}
template <SpringFamily family>
bool has_family(const Scene& scene) {
  return scene.system.count_of(family) > 0;
}

void set_springs(Scene& scene, double Spring::*property, double value) {
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s).*property = value;
}

double first_of_colliders(const Scene& scene, double Collider::*property) {
  return scene.system.colliders.empty() ? 0.0 : scene.system.colliders.front().*property;
}

void set_colliders(Scene& scene, double Collider::*property, double value) {
  for (Collider& collider : scene.system.colliders) collider.*property = value;
}

// A row reads as a table does, so clang-format leaves it alone.
// clang-format off
const std::array rows{
    Parameter{.name = "substeps", .field = "simulation.substeps", .group = "Simulation", .label = "Substeps", .unit = "",
              .meaning = "Steps of the method in each frame: more are slower and more accurate.",
              .kind = Kind::Whole, .least = 1, .most = 1000, .usual = 20, .physical = {.least = 1, .most = most_substeps}, .logarithmic = true,
              .read = [](const Scene& s) { return double(s.settings.substeps); },
              .write = [](Scene& s, double value) { s.settings.substeps = int(value); }},
    Parameter{.name = "frame_rate", .field = "simulation.frame_rate", .group = "Simulation", .label = "Frame rate", .unit = "1/s",
              .meaning = "Frames of simulated time per simulated second.",
              .least = 1, .most = 1000, .usual = 60, .physical = positive, .logarithmic = true,
              .read = [](const Scene& s) { return s.settings.frame_rate; },
              .write = [](Scene& s, double value) { s.settings.frame_rate = value; }},
    Parameter{.name = "speed", .field = "simulation.speed", .group = "Simulation", .label = "Speed", .unit = "s/s",
              .meaning = "Simulated seconds per real second.",
              .least = 0.01, .most = 10, .usual = 1, .physical = positive, .logarithmic = true,
              .read = [](const Scene& s) { return s.settings.speed; },
              .write = [](Scene& s, double value) { s.settings.speed = value; }},
    Parameter{.name = "stiffness", .field = "", .group = "Springs", .label = "Stiffness k", .unit = "N/m",
              .meaning = "Force per stretched metre of every spring.",
              .least = 0.01, .most = 1e6, .usual = 100, .logarithmic = true, .scope = Scope::SpringStiffness,
              .read = [](const Scene& s) { return mean_of_springs(s, &Spring::stiffness, s.defaults.stiffness); },
              .write = [](Scene& s, double value) { set_springs(s, &Spring::stiffness, value); }},
    Parameter{.name = "structural_springs", .field = "structural_springs", .group = "Springs", .label = "Structural springs", .unit = "",
              .meaning = "Whether the springs along the threads of cloths act.",
              .kind = Kind::Switch, .usual = 1, .family = SpringFamily::Structural, .applies = has_family<SpringFamily::Structural>,
              .read = read_family_switch<SpringFamily::Structural>, .write = write_family_switch<SpringFamily::Structural>},
    Parameter{.name = "structural_stiffness", .field = "", .group = "Springs", .label = "Structural k", .unit = "N/m",
              .meaning = "Stiffness of every spring along the threads of cloths.",
              .least = 0.01, .most = 1e6, .usual = 100, .logarithmic = true, .scope = Scope::SpringStiffness,
              .family = SpringFamily::Structural, .applies = has_family<SpringFamily::Structural>,
              .read = read_family_stiffness<SpringFamily::Structural>, .write = write_family_stiffness<SpringFamily::Structural>},
    Parameter{.name = "shear_springs", .field = "shear_springs", .group = "Springs", .label = "Shear springs", .unit = "",
              .meaning = "Whether the springs across the cells of cloths act.",
              .kind = Kind::Switch, .usual = 1, .family = SpringFamily::Shear, .applies = has_family<SpringFamily::Shear>,
              .read = read_family_switch<SpringFamily::Shear>, .write = write_family_switch<SpringFamily::Shear>},
    Parameter{.name = "shear_stiffness", .field = "", .group = "Springs", .label = "Shear k", .unit = "N/m",
              .meaning = "Stiffness of every spring across the cells of cloths.",
              .least = 0.01, .most = 1e6, .usual = 50, .logarithmic = true, .scope = Scope::SpringStiffness,
              .family = SpringFamily::Shear, .applies = has_family<SpringFamily::Shear>,
              .read = read_family_stiffness<SpringFamily::Shear>, .write = write_family_stiffness<SpringFamily::Shear>},
    Parameter{.name = "bend_springs", .field = "bend_springs", .group = "Springs", .label = "Bend springs", .unit = "",
              .meaning = "Whether the springs over the next point but one of cloths act.",
              .kind = Kind::Switch, .usual = 1, .family = SpringFamily::Bend, .applies = has_family<SpringFamily::Bend>,
              .read = read_family_switch<SpringFamily::Bend>, .write = write_family_switch<SpringFamily::Bend>},
    Parameter{.name = "bend_stiffness", .field = "", .group = "Springs", .label = "Bend k", .unit = "N/m",
              .meaning = "Stiffness of every spring over the next point but one of cloths.",
              .least = 0.01, .most = 1e6, .usual = 50, .logarithmic = true, .scope = Scope::SpringStiffness,
              .family = SpringFamily::Bend, .applies = has_family<SpringFamily::Bend>,
              .read = read_family_stiffness<SpringFamily::Bend>, .write = write_family_stiffness<SpringFamily::Bend>},
    Parameter{.name = "damped_springs", .field = "damped_springs", .group = "Springs", .label = "Damped springs", .unit = "",
              .meaning = "Whether the springs' dashpots act.",
              .kind = Kind::Switch, .usual = 1,
              .read = [](const Scene& s) { return s.system.dashpots_on ? 1.0 : 0.0; },
              .write = [](Scene& s, double value) { s.system.dashpots_on = value != 0.0; }},
    Parameter{.name = "damping", .field = "", .group = "Springs", .label = "Damping d", .unit = "N s/m",
              .meaning = "Force along the spring per speed at which its ends part, of every spring.",
              .least = 0, .most = 1e4, .usual = 0, .logarithmic = true, .scope = Scope::SpringDamping,
              .read = [](const Scene& s) { return mean_of_springs(s, &Spring::damping, s.defaults.damping); },
              .write = [](Scene& s, double value) { set_springs(s, &Spring::damping, value); }},
    Parameter{.name = "point_damping", .field = "point_damping", .group = "Surroundings", .label = "Point damping", .unit = "",
              .meaning = "Whether drag acts on the points.",
              .kind = Kind::Switch, .usual = 1,
              .read = [](const Scene& s) { return s.system.drag_on ? 1.0 : 0.0; },
              .write = [](Scene& s, double value) { s.system.drag_on = value != 0.0; }},
    Parameter{.name = "drag", .field = "drag", .group = "Surroundings", .label = "Drag c", .unit = "1/s",
              .meaning = "Rate at which the air takes speed from every point.",
              .least = 0, .most = 100, .usual = 0, .physical = not_negative, .logarithmic = true,
              .read = [](const Scene& s) { return s.system.drag; },
              .write = [](Scene& s, double value) { s.system.drag = value; }},
    Parameter{.name = "gravity", .field = "", .group = "Surroundings", .label = "Gravity", .unit = "m/s^2",
              .meaning = "Size of the gravity; its direction is the scene's.",
              .least = 0, .most = 30, .usual = 9.81, .scope = Scope::Gravity,
              .read = [](const Scene& s) { return glm::length(s.system.gravity); },
              .write = set_gravity},
    Parameter{.name = "restitution", .field = "", .group = "Surroundings", .label = "Restitution", .unit = "",
              .meaning = "Speed after a bounce against the speed before, on every collider.",
              .least = 0, .most = 1, .usual = 0, .scope = Scope::Colliders,
              .read = [](const Scene& s) { return first_of_colliders(s, &Collider::restitution); },
              .write = [](Scene& s, double value) { set_colliders(s, &Collider::restitution, value); }},
    Parameter{.name = "friction", .field = "", .group = "Surroundings", .label = "Friction", .unit = "",
              .meaning = "Coulomb's coefficient on every collider.",
              .least = 0, .most = 2, .usual = 0.3, .scope = Scope::Colliders,
              .read = [](const Scene& s) { return first_of_colliders(s, &Collider::friction); },
              .write = [](Scene& s, double value) { set_colliders(s, &Collider::friction, value); }},
    Parameter{.name = "new_stiffness", .field = "defaults.stiffness", .group = "New parts", .label = "New springs' k", .unit = "N/m",
              .meaning = "Stiffness of the springs that are attached from now on.",
              .least = 0.01, .most = 1e6, .usual = 100, .physical = not_negative, .logarithmic = true,
              .read = [](const Scene& s) { return s.defaults.stiffness; },
              .write = [](Scene& s, double value) { s.defaults.stiffness = value; }},
    Parameter{.name = "new_damping", .field = "defaults.damping", .group = "New parts", .label = "New springs' d", .unit = "N s/m",
              .meaning = "Damping of the springs that are attached from now on.",
              .least = 0, .most = 1e4, .usual = 0, .physical = not_negative, .logarithmic = true,
              .read = [](const Scene& s) { return s.defaults.damping; },
              .write = [](Scene& s, double value) { s.defaults.damping = value; }},
    Parameter{.name = "new_mass", .field = "defaults.mass", .group = "New parts", .label = "New points' mass", .unit = "kg",
              .meaning = "Mass of the points that are added from now on.",
              .least = 1e-6, .most = 1e3, .usual = 1, .physical = positive, .logarithmic = true,
              .read = [](const Scene& s) { return s.defaults.mass; },
              .write = [](Scene& s, double value) { s.defaults.mass = value; }},
    Parameter{.name = "pull", .field = "", .group = "Hand", .label = "Pull, not hold", .unit = "",
              .meaning = "Whether dragging pulls the point with a spring; else the point follows the cursor exactly.",
              .kind = Kind::Switch, .usual = 0,
              .read = [](const Scene& s) { return s.defaults.grab == GrabKind::Pull ? 1.0 : 0.0; },
              .write = [](Scene& s, double value) { s.defaults.grab = value != 0.0 ? GrabKind::Pull : GrabKind::Hold; }},
    Parameter{.name = "pull_stiffness", .field = "defaults.pull_stiffness", .group = "Hand", .label = "Pull of the hand", .unit = "N/m",
              .meaning = "Stiffness of the spring between the cursor and a pulled point; 0 fits it to the point.",
              .least = 0, .most = 1e6, .usual = 0, .physical = not_negative, .logarithmic = true,
              .read = [](const Scene& s) { return s.defaults.pull_stiffness; },
              .write = [](Scene& s, double value) { s.defaults.pull_stiffness = value; }},
};
// clang-format on

}  // namespace

std::span<const Parameter> parameters() { return rows; }

const Parameter* find_parameter(std::string_view name) {
  for (const Parameter& row : rows)
    if (row.name == name) return &row;
  return nullptr;
}

double clamp_to(const Parameter& parameter, double value) {
  if (std::isnan(value)) return parameter.usual;
  const double clamped = std::clamp(value, parameter.least, parameter.most);
  return parameter.kind == Kind::Number ? clamped : std::round(clamped);
}

}  // namespace hooke
