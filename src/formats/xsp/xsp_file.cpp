#include "formats/xsp/xsp_file.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "base/json_writer.h"
#include "base/text_lines.h"
#include "formats/stable_stepping.h"
#include "formats/xsp/xsp_text.h"
#include "sim/forces/terms/rows.h"

namespace hooke {
namespace {

constexpr double pixel = 1.0 / xsp_pixels_per_meter;  // [m]: the repulsion of a wall does not grow within one pixel
enum ForceId { Gravity = 0, MassCenter = 1, Center = 2, Wall = 3, Collisions = 4 };

// XSpringies replaces a mass of 0.
double mass_of(const XspMass& mass) { return mass.mass == 0.0 ? 1.0 : std::abs(mass.mass); }

double elasticity_of(const XspMass& mass) { return mass.elasticity; }

// The most common value among the free masses or the nails, and the number of them with another one.
struct MostCommon {
  double value;
  std::size_t others = 0;
};
MostCommon most_common(const std::vector<XspMass>& masses, double value_without_masses, double (*value_of)(const XspMass& mass),
                       bool of_nails = false) {
  std::map<double, std::size_t> counts;
  std::size_t all = 0;
  for (const XspMass& mass : masses)
    if ((mass.mass < 0.0) == of_nails) {
      ++counts[value_of(mass)];
      ++all;
    }
  if (counts.empty()) return {value_without_masses};
  const auto found = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return {found->first, all - found->second};
}

class Importer {
 public:
  Importer(const XspDocument& document, const std::string& file) : document_(document), file_(file) {}

  LoadedScene import() {
    Scene& scene = loaded_.scene;
    scene.name = std::filesystem::path(file_).stem().string();
    scene.system.dimensions = 2;
    import_masses();
    import_springs();
    find_center();
    import_forces();
    import_walls();
    import_editor_settings();
    import_stepping();
    for (const std::string& warning : document_.warnings) warn(warning);
    keep_unknown_lines();
    return std::move(loaded_);
  }

 private:
  void warn(const std::string& sentence) { loaded_.warnings.push_back(file_ + ": " + sentence); }

  void import_masses() {
    System& system = loaded_.scene.system;
    std::vector<Point> points;
    std::size_t zero = 0;
    for (const XspMass& mass : document_.masses) {
      zero += mass.mass == 0.0 ? 1 : 0;
      const bool is_fixed = mass.mass < 0.0;
      const PointId id = system.new_point_id();
      point_of_[mass.id] = id;
      points.push_back({.id = id, .nailed = is_fixed, .mass = mass_of(mass), .radius = xsp_radius(mass_of(mass), is_fixed)});
      loaded_.scene.state.position.push_back(Vec3(mass.x, mass.y, 0.0) / xsp_pixels_per_meter);
      loaded_.scene.state.velocity.push_back(Vec3(mass.vx, mass.vy, 0.0) / xsp_pixels_per_meter);
    }
    system.set_points(std::move(points));
    if (zero > 0) warn(pluralize(zero, "mass", "masses") + " of 0: 1, as in XSpringies");
  }

  void import_springs() {
    System& system = loaded_.scene.system;
    std::vector<Spring> springs;
    for (const XspSpring& spring : document_.springs)
      springs.push_back({.id = system.new_spring_id(),
                         .first = point_of_.at(spring.first),
                         .second = point_of_.at(spring.second),
                         .stiffness = spring.stiffness,
                         .damping = spring.damping,
                         .rest_length = spring.rest_length / xsp_pixels_per_meter});
    const auto has_coincident_ends = [&](const Spring& spring) {
      const auto& position = loaded_.scene.state.position;
      return position[system.index_of(spring.first)] == position[system.index_of(spring.second)];
    };
    const auto count = static_cast<std::size_t>(std::count_if(springs.begin(), springs.end(), has_coincident_ends));
    const auto is_driven = [&](const Spring& spring) {
      const auto moves = [&](PointId id) {
        const XspMass& mass = document_.masses[static_cast<std::size_t>(system.index_of(id))];
        return mass.mass < 0.0 && (mass.vx != 0.0 || mass.vy != 0.0);
      };
      return spring.damping > 0.0 && (moves(spring.first) || moves(spring.second));
    };
    const auto driven = static_cast<std::size_t>(std::count_if(springs.begin(), springs.end(), is_driven));
    if (driven > 0)
      warn(pluralize(driven, "spring is", "springs are") +
           " damped towards a nail at rest: XSpringies uses the velocity that the file gives it");
    if (count > 0)
      warn(pluralize(count, "spring connects", "springs connect") +
           " masses at the same position: no force between them until they separate");
    system.set_springs(springs);
  }

  void import_forces() {
    System& system = loaded_.scene.system;
    system.gravity = Vec3(0.0);
    system.drag = document_.viscosity;
    bool uses_center = false;
    for (const auto& [id, force] : document_.forces) {
      if (!force.active) continue;
      if (id == ForceId::Gravity) {
        // p2 rotates "down" towards +x
        const double angle = glm::radians(force.p2);
        system.gravity = force.p1 / xsp_pixels_per_meter * Vec3(std::sin(angle), -std::cos(angle), 0.0);
      } else if (id == ForceId::MassCenter) {
        add_force(mass_center_force, {center_.x, center_.y, 0.0, force.p1, force.p2});
        uses_center = true;
      } else if (id == ForceId::Center) {
        add_center_force(force);
        uses_center = true;
      } else if (id == ForceId::Wall) {
        add_force(wall_force, {scaled(force), force.p2, pixel});
      } else if (id == ForceId::Collisions) {
        system.contact = {.points = true, .restitution = import_contact_elasticity(), .friction = 0.0};
      } else {
        warn("force " + std::to_string(id) + " is unknown and ignored");
      }
    }
    if (document_.stickiness != 0.0) add_force(sticky_force, {document_.stickiness / xsp_pixels_per_meter});
    if (uses_center) warn_of_center();
  }

  // In XSpringies the pull falls with the square of the distance where a mass is closer than its radius and one pixel.
  void add_center_force(const XspForce& force) {
    const MostCommon radius = most_common(document_.masses, 0.0, [](const XspMass& mass) { return xsp_radius(mass_of(mass), false); });
    add_force(center_force, {center_.x, center_.y, 0.0, scaled(force), force.p2, radius.value + pixel, 1.0});
    if (radius.others > 0)
      warn("the pull to the center is approximate within " + format_rounded(radius.value + pixel) +
           " m of it, the radius of most masses and a pixel");
  }

  // converts p1 of an acceleration p1 / distance^p2 to meters
  static double scaled(const XspForce& force) { return force.p1 / std::pow(xsp_pixels_per_meter, 1.0 + force.p2); }

  void add_force(const ForceTerm& term, const ForceValues& values) {
    for (std::size_t i = 0; i < term.numbers.size(); ++i) {
      const ForceParameter& number = term.numbers[i];
      if (std::isfinite(values[i]) && (number.min < 0.0 || values[i] >= number.min)) continue;
      warn("\"" + std::string(term.label) + "\" is ignored: " + std::string(number.label) + " would be " + format_rounded(values[i]));
      return;
    }
    loaded_.scene.system.forces.push_back({.term = &term, .values = values});
  }

  // The middle of the window, or a mass.
  void find_center() {
    center_ = 0.5 / xsp_pixels_per_meter * Vec3(xsp_window_width, xsp_window_height, 0.0);
    for (const XspMass& mass : document_.masses)
      if (mass.id == document_.center) {
        center_ = Vec3(mass.x, mass.y, 0.0) / xsp_pixels_per_meter;
        loaded_.scene.system.center_point = point_of_.at(mass.id);
      }
  }

  void warn_of_center() {
    if (!loaded_.scene.system.center_point)
      warn("the file does not contain the size of the window: the center of forces is at x = " + format_rounded(xsp_window_width / 2.0) +
           ", y = " + format_rounded(xsp_window_height / 2.0) + " pixels");
  }

  // The highest frequency [rad/s] of the listed forces treated as springs: the square root of the largest slope of their acceleration.
  // Outside the core of s / r^p it is s max(1, |p|) / r^(p + 1), largest at one end.
  double frequency_bound_of_forces() const {
    constexpr double max_distance = 10.0;  // [m]
    double mass = 0.0, squares = 0.0;
    for (const XspMass& one : document_.masses) mass += one.mass >= 0.0 ? mass_of(one) : 0.0;
    const auto slope = [&](double strength, double power, double core) {
      const double at_core = std::pow(core, -1.0 - power), at_far = std::pow(max_distance, -1.0 - power);
      return std::abs(strength) * std::max(1.0, std::abs(power)) * std::max(at_core, at_far);
    };
    for (const Force& force : loaded_.scene.system.forces) {
      const ForceValues& values = force.values;
      if (force.term == &center_force) squares += slope(values[3], values[4], values[5]);
      if (force.term == &wall_force) squares += 4.0 * slope(values[0], values[1], values[2]);
      if (force.term == &mass_center_force && mass > 0.0) squares += values[3] / mass + values[4] / mass * (values[4] / mass);
    }
    return std::sqrt(squares);
  }

  void import_walls() {
    const auto& walls = document_.walls;
    if (std::none_of(walls.begin(), walls.end(), [](bool is_on) { return is_on; })) return;
    const double restitution = import_elasticity("all walls");

    const auto add = [&](XspSide side, double x, double y, const Vec3& normal) {
      if (!walls[static_cast<std::size_t>(side)]) return;
      const Plane plane{Vec3(x, y, 0.0) / xsp_pixels_per_meter, normal};
      loaded_.scene.system.colliders.push_back({.shape = plane, .restitution = restitution, .one_way = true});
    };
    add(XspSide::Top, 0.0, xsp_window_height, Vec3(0.0, -1.0, 0.0));
    add(XspSide::Left, 0.0, 0.0, Vec3(1.0, 0.0, 0.0));
    add(XspSide::Right, xsp_window_width, 0.0, Vec3(-1.0, 0.0, 0.0));
    add(XspSide::Bottom, 0.0, 0.0, Vec3(0.0, 1.0, 0.0));

    warn("the file does not contain the size of the window: the walls are at x = 0 and " + format_rounded(xsp_window_width) +
         ", y = 0 and " + format_rounded(xsp_window_height) + " pixels");
  }

  // The restitution of these, which masses have in XSpringies.
  double import_elasticity(const std::string& whose) {
    const MostCommon elasticity = most_common(document_.masses, document_.new_elasticity, elasticity_of);
    const double restitution = std::clamp(elasticity.value, 0.0, 1.0);
    if (elasticity.others > 0)
      warn(pluralize(elasticity.others, "mass", "masses") + " with an elasticity other than " + format_rounded(elasticity.value) +
           ", that of " + whose);
    if (restitution != elasticity.value) warn("elasticity " + format_rounded(elasticity.value) + " becomes " + format_rounded(restitution));
    return restitution;
  }

  // In XSpringies that of a pair is the mean of both. Here it is that of most pairs: of free masses and nails, or of two free masses.
  double import_contact_elasticity() {
    const double restitution = import_elasticity("contact");
    const auto nails = static_cast<std::size_t>(std::ranges::count_if(document_.masses, [](const XspMass& m) { return m.mass < 0.0; }));
    if (2 * nails <= document_.masses.size() - nails) return restitution;
    const MostCommon nail_elasticity = most_common(document_.masses, restitution, elasticity_of, true);
    return 0.5 * (restitution + std::clamp(nail_elasticity.value, 0.0, 1.0));
  }

  // The defaults of new masses and springs.
  void import_editor_settings() {
    Defaults& defaults = loaded_.scene.defaults;
    defaults.radius = xsp_radius(document_.new_mass == 0.0 ? 1.0 : std::abs(document_.new_mass), false);
    const auto import_default = [&](double& target, double file_value, bool allowed, const std::string& name) {
      if (allowed)
        target = file_value;
      else
        warn(name + " " + format_rounded(file_value) + " of new masses and springs becomes " + format_rounded(target));
    };
    import_default(defaults.mass, std::abs(document_.new_mass), document_.new_mass != 0.0, "cmas");
    import_default(defaults.stiffness, document_.new_stiffness, document_.new_stiffness >= 0.0, "kspr");
    import_default(defaults.damping, document_.new_damping, document_.new_damping >= 0.0, "kdmp");
    if (document_.new_masses_fixed) warn("new masses are not fixed automatically (fixm)");
    if (!document_.springs_shown) warn("the springs are shown, although the file hides them (shws)");
    if (document_.snap_to_grid) warn("points do not snap to the grid (gsnp)");
  }

  void keep_unknown_lines() {
    if (document_.unknown.empty()) return;
    const std::string list = joined(document_.unknown, [](const std::string& line) { return to_json(line); });
    loaded_.scene.preserved_json.unknown = "\"xsp\": [" + list + "]";
  }

  void import_stepping() {
    Scene& scene = loaded_.scene;
    if (document_.adaptive && document_.precision > 0.0) scene.settings.tolerance = document_.precision / xsp_pixels_per_meter;

    // at least as fine as the step of the file, within reason
    constexpr double max_requested_substeps = 1000.0;
    const double requested_substeps = std::min(max_requested_substeps, std::ceil(1.0 / (scene.settings.frame_rate * document_.step)));
    if (const auto warning =
            choose_stable_stepping(scene, std::max(Settings().substeps, static_cast<int>(requested_substeps)), frequency_bound_of_forces()))
      warn(*warning);
  }

  const XspDocument& document_;
  const std::string& file_;
  std::map<int, PointId> point_of_;  // by the id of the mass
  Vec3 center_{0.0};                 // [m], of the forces
  LoadedScene loaded_;
};

}  // namespace

// The integer part of 2 ln(4 m + 1) pixels, from 1 to 64; nails have 4.
double xsp_radius(double mass, bool is_fixed) {
  return (is_fixed ? 4.0 : std::clamp(std::floor(2.0 * std::log(4.0 * mass + 1.0)), 1.0, 64.0)) * pixel;
}

LoadedScene parse_xsp(std::string_view text, const std::string& file) {
  const XspDocument document = parse_xsp_text(text, file);
  return Importer(document, file).import();
}

}  // namespace hooke
