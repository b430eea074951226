#include "scene/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/file_limits.h"
#include "scene/flatness.h"
#include "scene/parameter_access.h"
#include "scene/parameter_groups.h"
#include "scene/spring_laws.h"
#include "sim/control/automatic.h"

namespace hooke {
namespace {

using Kind = Parameter::Kind;
using Scope = Parameter::Scope;
using Weight = Parameter::Weight;

constexpr std::array dimensions_choices{
    ParameterChoice{"2", "Flat (2-D)", "Everything stays in the plane z = 0 and is viewed from the front."},
    ParameterChoice{"3", "3-D", "Points move in space; cloths, bodies and meshes can be added."},
};
// The scene stays 3-D if something is not in the plane. Undo must restore any flat scene that a file may
// contain, also one with a collider out of the plane.
void write_dimensions(Scene& scene, double value) {
  if (value != 0.0)
    scene.system.dimensions = 3;
  else if (why_not_in_plane(scene.system, scene.state).empty())
    scene.system.dimensions = 2;
}

bool has_contact_in_scene(const Scene& scene) { return scene.system.contact.any(); }

constexpr std::array parameterizations{
    ParameterChoice{"plain", "Each spring: k, d", "Every spring has exactly the k and d given; a finer mesh behaves differently."},
    ParameterChoice{"per_strain", "By strain: Y, d",
                    "k = Y / l0: a spring of half the length is twice as stiff, like a piece of the same thread."},
    ParameterChoice{"by_size", "By size: k, d per length", "d = c l0: half as much damping in quads of half the width."},
    ParameterChoice{
        "material", "As a material: E t, \u03b7, density",
        "The same sheet for any number of points: k = 3/4 E t along threads and 3/8 E t on diagonals, half along borders; bend springs "
        "keep their own k."},
};

// Nothing jumps: the time of the muscles is the same before and after.
void set_muscles(Scene& scene, MuscleClock muscles) {
  const double time = scene.state.time, now = scene.system.muscles.at(time);
  const double offset = now - muscles.rate() * time;
  muscles.offset = std::isfinite(offset) ? offset : 0.0;
  scene.system.muscles = muscles;
}
bool has_muscles(const Scene& scene) {
  return scene.system.springs().have_laws() &&
         std::ranges::any_of(scene.system.springs(), [](const Spring& spring) { return spring.law && spring.law->moves(); });
}

bool has_automatic_method(const Scene& scene) { return is_automatic(scene.settings); }
bool has_iterations(const Scene& scene) { return scene.settings.integrator->iterates(); }

// Of k, d and the like: so far from what a double can represent that no weight of a spring leads beyond that.
constexpr Bounds spring_range{.min = 0.0, .max = 1e12};

// Rows are formatted as a table, so clang-format is off.
// clang-format off
constexpr std::array rows{
    Parameter{.name = "dimensions", .field = "", .group = parameter_group::simulation, .label = "Dimensions", .unit = "",
              .description = "Whether the scene stays in a plane or moves in space.",
              .kind = Kind::Choice, .max = double(dimensions_choices.size() - 1), .scope = Scope::Structure, .choices = dimensions_choices,
              .access = {.read = [](const Scene& s) { return s.system.dimensions == 3 ? 1.0 : 0.0; }, .write = write_dimensions}},
    Parameter{.name = "substeps", .field = "simulation.substeps", .group = parameter_group::simulation, .label = "Substeps", .unit = "",
              .description = "Steps of the integrator per frame: more are slower and more accurate.",
              .kind = Kind::Integer, .min = 1, .max = 1000, .default_value = 20, .physical = {.min = 1, .max = max_substeps}, .logarithmic = true,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.settings.substeps; })},
    Parameter{.name = "iterations", .field = "simulation.iterations", .group = parameter_group::simulation, .label = "Iterations", .unit = "",
              .description = "Iterations of projective dynamics and vertex block descent in each substep: more are slower and closer to implicit Euler.",
              .kind = Kind::Integer, .min = 1, .max = 200, .default_value = 10, .physical = {.min = 1, .max = max_iterations}, .logarithmic = true, .omit_if_default = true,
              .scope = Scope::Setting, .applies = has_iterations, .access = plain([](auto& s) -> auto& { return s.settings.iterations; })},
    Parameter{.name = "tolerance", .field = "", .group = parameter_group::simulation, .label = "Tolerance", .unit = "m/s",
              .description = "For the automatic method: RMS error of the positions [m] that a simulated second may add.",
              .min = 1e-10, .max = 0.1, .default_value = default_automatic_tolerance, .physical = positive, .logarithmic = true, .scope = Scope::Setting, .applies = has_automatic_method,
              .access = {.read = [](const Scene& s) { return automatic_tolerance(s.settings); }, .write = [](Scene& s, double value) { s.settings.tolerance = value; },
              .is_given = [](const Scene& s) { return s.settings.tolerance.has_value(); }, .clear = [](Scene& s) { s.settings.tolerance.reset(); }}},
    Parameter{.name = "budget", .field = "simulation.budget", .group = parameter_group::simulation, .label = "Budget", .unit = "ms",
              .description = "CPU time of a frame, by a fixed model, that the automatic method may use; 0: no limit. If the tolerance needs more, the error is as small as the budget allows.",
              .min = 0, .max = 1000, .default_value = 0, .physical = {.min = 0, .max = 1e6}, .zero_text = "no limit", .omit_if_default = true, .scope = Scope::Setting,
              .applies = has_automatic_method,
              .access = plain([](auto& s) -> auto& { return s.settings.budget_ms; })},
    Parameter{.name = "frame_rate", .field = "simulation.frame_rate", .group = parameter_group::simulation, .label = "Frame rate", .unit = "1/s",
              .description = "Frames of simulated time per simulated second.",
              .min = 1, .max = 1000, .default_value = 60, .physical = positive, .logarithmic = true,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.settings.frame_rate; })},
    Parameter{.name = "speed", .field = "simulation.speed", .group = parameter_group::simulation, .label = "Speed", .unit = "s/s",
              .description = "Simulated seconds per real second.",
              .min = 0.01, .max = 10, .default_value = 1, .physical = positive, .logarithmic = true,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.settings.speed; })},
    Parameter{.name = "reading", .field = "reading", .group = parameter_group::springs, .label = "Given as", .unit = "",
              .description = "Which quantities the sliders set: those of each spring, or those of the material.",
              .kind = Kind::Choice, .max = double(parameterizations.size() - 1), .scope = Scope::Setting, .choices = parameterizations, .applies = has_springs,
              .access = plain([](auto& s) -> auto& { return s.parameterization; })},
    Parameter{.name = "stiffness", .field = "", .group = parameter_group::springs, .label = "Stiffness k", .unit = "N/m",
              .description = "Force per elongation of every spring.",
              .min = 0.01, .max = 1e6, .default_value = 100, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringStiffness, .springs = {.property = &Spring::stiffness}, .applies = has_plain_stiffness},
    Parameter{.name = "stiffness_per_strain", .field = "", .group = parameter_group::springs, .label = "Stiffness Y", .unit = "N",
              .description = "Force per strain of every spring: k = Y / rest length.",
              .min = 0.001, .max = 1e6, .default_value = 10, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringStiffness,
              .springs = {.property = &Spring::stiffness, .weight = Weight::InverseLength}, .applies = is_per_strain},
    Parameter{.name = "sheet_stiffness", .field = "", .group = parameter_group::springs, .label = "Stretch E t", .unit = "N/m",
              .description = "Young's modulus times thickness of the cloth; bend springs keep their own k.",
              .min = 0.01, .max = 1e6, .default_value = 1000, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringStiffness,
              .springs = {.property = &Spring::stiffness, .weight = Weight::SheetWeight}, .applies = is_sheet_material},
    Parameter{.name = "sheet_density", .field = "", .group = parameter_group::springs, .label = "Density", .unit = "kg/m^2",
              .description = "Mass per area of the cloth.",
              .min = 0.001, .max = 100, .default_value = 0.2, .physical = {.min = 1e-9, .max = 1e9}, .logarithmic = true, .scope = Scope::PointMass, .applies = is_sheet_material,
              .access = {.read = read_density, .write = write_density}},
    Parameter{.name = "structural_springs", .field = "structural_springs", .group = parameter_group::springs, .label = "Structural springs", .unit = "",
              .description = "Whether the springs along the threads of cloths are active.",
              .kind = Kind::Switch, .default_value = 1, .springs = {.family = SpringFamily::Structural}, .applies = has_family<SpringFamily::Structural>,
              .access = plain([](auto& s) -> auto& { return s.system.switches.families[std::size_t(SpringFamily::Structural)]; })},
    Parameter{.name = "structural_stiffness", .field = "", .group = parameter_group::springs, .label = "Structural k", .unit = "N/m",
              .description = "Stiffness of every spring along the threads of cloths.",
              .min = 0.01, .max = 1e6, .default_value = 100, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringStiffness,
              .springs = {.property = &Spring::stiffness, .family = SpringFamily::Structural}, .applies = has_family_stiffness<SpringFamily::Structural>},
    Parameter{.name = "shear_springs", .field = "shear_springs", .group = parameter_group::springs, .label = "Shear springs", .unit = "",
              .description = "Whether the diagonal springs of cloths are active.",
              .kind = Kind::Switch, .default_value = 1, .springs = {.family = SpringFamily::Shear}, .applies = has_family<SpringFamily::Shear>,
              .access = plain([](auto& s) -> auto& { return s.system.switches.families[std::size_t(SpringFamily::Shear)]; })},
    Parameter{.name = "shear_stiffness", .field = "", .group = parameter_group::springs, .label = "Shear k", .unit = "N/m",
              .description = "Stiffness of every diagonal spring of cloths.",
              .min = 0.01, .max = 1e6, .default_value = 50, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringStiffness,
              .springs = {.property = &Spring::stiffness, .family = SpringFamily::Shear}, .applies = has_family_stiffness<SpringFamily::Shear>},
    Parameter{.name = "bend_springs", .field = "bend_springs", .group = parameter_group::springs, .label = "Bend springs", .unit = "",
              .description = "Whether the springs to the second next point of cloths are active.",
              .kind = Kind::Switch, .default_value = 1, .springs = {.family = SpringFamily::Bend}, .applies = has_family<SpringFamily::Bend>,
              .access = plain([](auto& s) -> auto& { return s.system.switches.families[std::size_t(SpringFamily::Bend)]; })},
    Parameter{.name = "bend_stiffness", .field = "", .group = parameter_group::springs, .label = "Bend k", .unit = "N/m",
              .description = "Stiffness of every spring to the second next point of cloths.",
              .min = 0.01, .max = 1e6, .default_value = 50, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringStiffness,
              .springs = {.property = &Spring::stiffness, .family = SpringFamily::Bend}, .applies = has_bend_stiffness},
    Parameter{.name = "damped_springs", .field = "damped_springs", .group = parameter_group::springs, .label = "Damped springs", .unit = "",
              .description = "Whether the dashpots of springs are active.",
              .kind = Kind::Switch, .default_value = 1,
              .access = plain([](auto& s) -> auto& { return s.system.switches.dashpots; })},
    Parameter{.name = "damping", .field = "", .group = parameter_group::springs, .label = "Damping d", .unit = "N s/m",
              .description = "Damping force of every spring per rate of elongation.",
              .min = 0, .max = 1e4, .default_value = 0, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringDamping, .springs = {.property = &Spring::damping}, .applies = has_plain_damping},
    Parameter{.name = "damping_per_length", .field = "", .group = parameter_group::springs, .label = "Damping per length", .unit = "N s/m^2",
              .description = "Damping of every spring per length: d = c times the rest length.",
              .min = 0, .max = 1e5, .default_value = 0, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringDamping,
              .springs = {.property = &Spring::damping, .weight = Weight::Length}, .applies = is_by_size},
    Parameter{.name = "sheet_damping", .field = "", .group = parameter_group::springs, .label = "Damping \u03b7", .unit = "N s/m",
              .description = "Viscosity times thickness of the cloth: sets the dashpots as E t sets the springs.",
              .min = 0, .max = 1e4, .default_value = 0, .physical = spring_range, .logarithmic = true, .scope = Scope::SpringDamping,
              .springs = {.property = &Spring::damping, .weight = Weight::SheetWeight}, .applies = is_sheet_material},
    Parameter{.name = "break_strain", .field = "break_strain", .group = parameter_group::springs, .label = "Breaks at strain", .unit = "",
              .description = "Strain at which every spring breaks, with the faces along it, unless its own break strain is smaller; 0: only its own applies.",
              .min = 0, .max = 10, .default_value = 0, .physical = not_negative, .logarithmic = true, .zero_text = "never", .omit_if_default = true,
              .access = plain([](auto& s) -> auto& { return s.system.break_strain; })},
    Parameter{.name = "strain_limit_percent", .field = "strain_limit_percent", .group = parameter_group::springs, .label = "Strain limit", .unit = "%",
              .description = "Maximum strain of every spring. Longer ones are shortened after each substep, which conserves linear momentum but not energy; 0: none.",
              .min = 0, .max = 1000, .default_value = 0, .physical = not_negative, .logarithmic = true, .zero_text = "off", .omit_if_default = true,
              .access = {.read = [](const Scene& s) { return percent_of(s.system.strain_limit); },
              .write = [](Scene& s, double value) { s.system.strain_limit = value / 100.0; }}},
    Parameter{.name = "muscles", .field = "muscles", .group = parameter_group::springs, .label = "Muscles", .unit = "",
              .description = "Whether muscles and winches move; otherwise they keep their present rest lengths.",
              .kind = Kind::Switch, .default_value = 1, .omit_if_default = true, .applies = has_muscles,
              .access = {.read = [](const Scene& s) { return s.system.muscles.on ? 1.0 : 0.0; },
              .write = [](Scene& s, double value) { set_muscles(s, {.on = value != 0.0, .speed = s.system.muscles.speed}); }}},
    Parameter{.name = "muscle_speed", .field = "muscle_speed", .group = parameter_group::springs, .label = "Muscle speed", .unit = "s/s",
              .description = "How fast the time of muscles and winches passes.",
              .min = 0, .max = 10, .default_value = 1, .physical = not_negative, .omit_if_default = true, .applies = has_muscles,
              .access = {.read = [](const Scene& s) { return s.system.muscles.speed; },
              .write = [](Scene& s, double value) { set_muscles(s, {.on = s.system.muscles.on, .speed = value}); }}},
    Parameter{.name = "muscle_offset", .field = "", .group = parameter_group::springs, .label = "Muscle offset", .unit = "s",
              .description = "Added to the time of muscles and winches. A change of their speed changes it so that nothing jumps.",
              .min = -10, .max = 10, .default_value = 0, .omit_if_default = true, .applies = has_muscles,
              .access = plain([](auto& s) -> auto& { return s.system.muscles.offset; })},
    Parameter{.name = "radius", .field = "", .group = parameter_group::points, .label = "Radius r", .unit = "m",
              .description = "Radius of every point, as drawn and for contact.",
              .min = 0.001, .max = 1, .default_value = 0.02, .physical = {.min = 1e-9, .max = 1e6}, .logarithmic = true, .scope = Scope::PointSize,
              .access = {.read = read_radius, .write = write_radius}},
    Parameter{.name = "mass_follows_radius", .field = "defaults.mass_follows_radius", .group = parameter_group::points, .label = "Mass follows r\u00b2", .unit = "",
              .description = "Whether setting the radius of a point scales its mass by the radius squared.",
              .kind = Kind::Switch, .default_value = 0, .omit_if_default = true,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.defaults.mass_follows_radius; })},
    Parameter{.name = "point_damping", .field = "point_damping", .group = parameter_group::surroundings, .label = "Point damping", .unit = "",
              .description = "Whether drag acts on the points.",
              .kind = Kind::Switch, .default_value = 1,
              .access = plain([](auto& s) -> auto& { return s.system.switches.drag; })},
    Parameter{.name = "drag", .field = "drag", .group = parameter_group::surroundings, .label = "Drag c", .unit = "1/s",
              .description = "Rate at which the velocity of every point relative to the air decays.",
              .min = 0, .max = 100, .default_value = 0, .physical = not_negative, .logarithmic = true,
              .access = plain([](auto& s) -> auto& { return s.system.drag; })},
    Parameter{.name = "gravity", .field = "", .group = parameter_group::surroundings, .label = "Gravity", .unit = "m/s^2",
              .description = "Magnitude of gravity; its direction is unchanged.",
              .min = 0, .max = 30, .default_value = 9.81, .physical = {.min = 0, .max = 1e6}, .scope = Scope::Gravity,
              .access = {.read = [](const Scene& s) { return glm::length(s.system.gravity); },
              .write = set_gravity}},
    Parameter{.name = "restitution", .field = "", .group = parameter_group::surroundings, .label = "Restitution", .unit = "",
              .description = "Ratio of the normal speeds after and before an impact, of every collider.",
              .min = 0, .max = 1, .default_value = 0, .physical = {.min = 0, .max = 1}, .scope = Scope::Colliders, .collider = &Collider::restitution},
    Parameter{.name = "friction", .field = "", .group = parameter_group::surroundings, .label = "Friction", .unit = "",
              .description = "Coulomb friction coefficient of every collider.",
              .min = 0, .max = 2, .default_value = 0.3, .physical = not_negative, .scope = Scope::Colliders, .collider = &Collider::friction},
    Parameter{.name = "contact_points", .field = "contact.points", .group = parameter_group::contact, .label = "Points touch", .unit = "",
              .description = "Whether points collide with each other, as spheres of their radii, unless a spring joins them where they touch.",
              .kind = Kind::Switch, .default_value = 0, .omit_if_default = true,
              .access = plain([](auto& s) -> auto& { return s.system.contact.points; })},
    Parameter{.name = "contact_faces", .field = "contact.faces", .group = parameter_group::contact, .label = "Faces touch", .unit = "",
              .description = "Whether faces collide with each other, such as the folds of a cloth, and with points on no spring or face. In 3-D scenes.",
              .kind = Kind::Switch, .default_value = 0, .omit_if_default = true,
              .access = plain([](auto& s) -> auto& { return s.system.contact.faces; })},
    Parameter{.name = "contact_springs", .field = "contact.springs", .group = parameter_group::contact, .label = "Springs touch", .unit = "",
              .description = "Whether springs collide with each other, such as ropes, with faces, and with points on no spring; where faces collide, not springs between two points of faces.",
              .kind = Kind::Switch, .default_value = 0, .omit_if_default = true,
              .access = plain([](auto& s) -> auto& { return s.system.contact.springs; })},
    Parameter{.name = "contact_thickness", .field = "contact.thickness", .group = parameter_group::contact, .label = "Thickness", .unit = "m",
              .description = "Distance at which faces, springs and the surfaces of points touch. For faces and springs, it is limited to a twentieth to half of their smallest height or length.",
              .min = 0, .max = 0.1, .default_value = 0, .physical = not_negative, .logarithmic = true, .omit_if_default = true, .applies = has_contact_in_scene,
              .access = plain([](auto& s) -> auto& { return s.system.contact.thickness; })},
    Parameter{.name = "contact_restitution", .field = "contact.restitution", .group = parameter_group::contact, .label = "Restitution of contact", .unit = "",
              .description = "Ratio of the normal speeds after and before an impact of points, faces and springs; 0 for what only continuous collision detection keeps apart.",
              .min = 0, .max = 1, .default_value = 0, .physical = {.min = 0, .max = 1}, .omit_if_default = true, .applies = has_contact_in_scene,
              .access = plain([](auto& s) -> auto& { return s.system.contact.restitution; })},
    Parameter{.name = "contact_friction", .field = "contact.friction", .group = parameter_group::contact, .label = "Friction of contact", .unit = "",
              .description = "Coulomb friction coefficient between points, faces and springs.",
              .min = 0, .max = 2, .default_value = 0.3, .physical = not_negative, .omit_if_default = true, .applies = has_contact_in_scene,
              .access = plain([](auto& s) -> auto& { return s.system.contact.friction; })},
    Parameter{.name = "contact_frequency", .field = "contact.frequency", .group = parameter_group::contact, .label = "Frequency of contact", .unit = "Hz",
              .description = "Frequency at which overlaps of points, faces and springs are removed, at most a quarter of the number of substeps per second.",
              .min = 1, .max = 1000, .default_value = 30, .physical = positive, .logarithmic = true, .omit_if_default = true, .applies = has_contact_in_scene,
              .access = plain([](auto& s) -> auto& { return s.system.contact.frequency; })},
    Parameter{.name = "contact_damping_ratio", .field = "contact.damping_ratio", .group = parameter_group::contact, .label = "Damping of contact", .unit = "",
              .description = "Damping ratio with which overlaps of points, faces and springs are removed.",
              .min = 0.1, .max = 100, .default_value = 1, .physical = positive, .logarithmic = true, .omit_if_default = true, .applies = has_contact_in_scene,
              .access = plain([](auto& s) -> auto& { return s.system.contact.damping_ratio; })},
    Parameter{.name = "new_stiffness", .field = "defaults.stiffness", .group = parameter_group::new_parts, .label = "New springs' k", .unit = "N/m",
              .description = "Stiffness of springs that are added from now on.",
              .min = 0.01, .max = 1e6, .default_value = 100, .physical = not_negative, .logarithmic = true,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.defaults.stiffness; })},
    Parameter{.name = "new_damping", .field = "defaults.damping", .group = parameter_group::new_parts, .label = "New springs' d", .unit = "N s/m",
              .description = "Damping of springs that are added from now on.",
              .min = 0, .max = 1e4, .default_value = 0, .physical = not_negative, .logarithmic = true,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.defaults.damping; })},
    Parameter{.name = "new_law", .field = "defaults.law", .group = parameter_group::new_parts, .label = "New springs' law", .unit = "",
              .description = "Law of springs that are added from now on.",
              .kind = Kind::Choice, .max = double(new_springs.size() - 1), .default_value = 0, .omit_if_default = true,
              .scope = Scope::Setting, .choices = new_springs, .access = plain([](auto& s) -> auto& { return s.defaults.law; })},
    Parameter{.name = "new_mass", .field = "defaults.mass", .group = parameter_group::new_parts, .label = "New points' mass", .unit = "kg",
              .description = "Mass of points that are added from now on; 0: chosen from the points of the scene.",
              .min = 0, .max = 1e3, .default_value = 0, .physical = not_negative, .logarithmic = true, .zero_text = "as the others", .omit_if_default = true,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.defaults.mass; })},
    Parameter{.name = "pull", .field = "", .group = parameter_group::hand, .label = "Drag with a spring", .unit = "",
              .description = "Whether a spring pulls the dragged point; otherwise the point follows the cursor exactly.",
              .kind = Kind::Switch, .default_value = 0,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.defaults.grab; })},
    Parameter{.name = "pull_stiffness", .field = "defaults.pull_stiffness", .group = parameter_group::hand, .label = "Drag spring k", .unit = "N/m",
              .description = "Stiffness of the spring between the cursor and the dragged point; 0: chosen from the springs of the point.",
              .min = 0, .max = 1e6, .default_value = 0, .physical = not_negative, .logarithmic = true, .zero_text = "automatic",
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.defaults.pull_stiffness; })},
    Parameter{.name = "hand_speed", .field = "hand_speed", .group = parameter_group::hand, .label = "Maximum speed", .unit = "m/s",
              .description = "Maximum speed of the dragged point, which then lags behind the cursor; 0: unlimited.",
              .min = 0, .max = 1000, .default_value = 0, .physical = not_negative, .logarithmic = true, .zero_text = "unlimited", .omit_if_default = true,
              .scope = Scope::Setting, .access = plain([](auto& s) -> auto& { return s.system.hand_speed; })},
};
// clang-format on

// Fails to compile if there is no such row.
consteval const Parameter& row_named(std::string_view name) {
  for (const Parameter& row : rows)
    if (row.name == name) return row;
  throw "no such parameter";
}

}  // namespace

constinit const Parameter& dimensions_parameter = row_named("dimensions");
constinit const Parameter& substeps_parameter = row_named("substeps");
constinit const Parameter& tolerance_parameter = row_named("tolerance");
constinit const Parameter& speed_parameter = row_named("speed");
constinit const Parameter& stiffness_parameter = row_named("stiffness");
constinit const Parameter& new_stiffness_parameter = row_named("new_stiffness");
constinit const Parameter& drag_parameter = row_named("drag");
constinit const Parameter& friction_parameter = row_named("friction");

double Parameter::read(const Scene& scene) const {
  if (springs.property != nullptr) return read_springs(springs, scene);
  if (collider == nullptr) return access.read(scene);
  return scene.system.colliders.empty() ? 0.0 : scene.system.colliders.front().*collider;
}

void Parameter::write(Scene& scene, double value) const {
  if (springs.property != nullptr) return write_springs(springs, scene, value);
  if (collider == nullptr) return access.write(scene, value);
  for (Collider& each : scene.system.colliders) each.*collider = value;
}

std::span<const Parameter> parameters() { return rows; }

const Parameter* find_parameter(std::string_view name) {
  for (const Parameter& row : rows)
    if (row.name == name) return &row;
  return nullptr;
}

double weight_of(const Parameter& parameter, const SheetWeights* sheet, const Spring& spring) {
  return weight_of(parameter.springs, sheet, spring);
}

void CommonValue::include(double value) {
  constexpr double rounding = 1e-12;
  if (count_++ == 0) first_ = value;
  sum_ += value;
  is_uniform_ = is_uniform_ && std::abs(value - first_) <= rounding * std::abs(first_);
}

Bounds allowed_range(const Parameter& parameter) {
  const bool is_limited = std::isfinite(parameter.physical.min) || std::isfinite(parameter.physical.max);
  return is_limited ? parameter.physical : Bounds{.min = parameter.min, .max = parameter.max};
}

double clamp_to_range(const Parameter& parameter, double value) {
  if (std::isnan(value)) return parameter.default_value;
  if (!allowed_range(parameter).contains(value) || std::isinf(value)) value = std::clamp(value, parameter.min, parameter.max);
  return parameter.kind == Kind::Number ? value : std::round(value);
}

void copy_surroundings(const Scene& from, Scene& to) {
  for (const Parameter& row : rows) {
    const bool is_of_scene = row.scope == Parameter::Scope::Number || row.scope == Parameter::Scope::Setting;
    if (!row.field.empty() && is_of_scene && row.is_given(from)) row.write(to, row.read(from));
  }
  to.system.gravity = from.system.gravity;
  to.system.wind = from.system.wind;
  to.system.contact = from.system.contact;
  to.settings = from.settings;
}

}  // namespace hooke
