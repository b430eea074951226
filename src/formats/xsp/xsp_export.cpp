// Writes a scene as an .xsp file.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "base/file_limits.h"
#include "base/formatted.h"
#include "base/json_field.h"
#include "base/json_text.h"
#include "base/text_lines.h"
#include "formats/file_kinds.h"
#include "formats/xsp/xsp_file.h"
#include "formats/xsp/xsp_text.h"
#include "scene/new_point.h"
#include "sim/forces/terms/rows.h"
#include "sim/model/bounding_box.h"

namespace hooke {
namespace {

// The shortest number of pixels that reads back as this length, bit for bit if there is one.
double pixels(double meters) {
  for (const int digits : {15, 16, 17}) {
    const double value = std::strtod(formatted("%.*g", digits, meters * xsp_pixels_per_meter).c_str(), nullptr);
    if (value / xsp_pixels_per_meter == meters) return value;
  }
  return meters * xsp_pixels_per_meter;
}

// Solid planes with the orientation of a side of the window.
struct Wall {
  XspSide side;
  double place = 0.0;  // [m], x or y of the side
  const Collider* collider = nullptr;
};

std::optional<XspSide> side_of(const Vec3& normal) {
  if (normal == Vec3(0.0, -1.0, 0.0)) return XspSide::Top;
  if (normal == Vec3(1.0, 0.0, 0.0)) return XspSide::Left;
  if (normal == Vec3(-1.0, 0.0, 0.0)) return XspSide::Right;
  if (normal == Vec3(0.0, 1.0, 0.0)) return XspSide::Bottom;
  return std::nullopt;
}

class Exporter {
 public:
  Exporter(const Scene& scene, const std::string& file, std::vector<std::string>& losses)
      : scene_(scene),
        system_(scene.system),
        file_(file),
        losses_(losses),
        center_point_(system_.center_point ? system_.index_of(*system_.center_point) : no_index) {}

  std::string text() {
    if (system_.dimensions != 2)
      throw InputError(file_ + ": dimensions: " + std::to_string(system_.dimensions) + ": must be 2 to be written as .xsp");
    find_walls();
    choose_window_shift();
    export_gravity();
    export_forces();
    export_walls();
    export_masses();
    export_springs();
    export_editor_settings();
    report_remaining_losses();
    return format_xsp_text(document_);
  }

 private:
  void find_walls() {
    std::size_t unsupported = 0, moving = 0;
    for (const Collider& collider : system_.colliders) {
      if (!collider.solid) continue;
      if (collider.path.moves()) ++moving;
      const Plane* plane = std::get_if<Plane>(&collider.shape);
      const auto side = plane ? side_of(plane->normal) : std::nullopt;
      const bool is_known = side && std::any_of(walls_.begin(), walls_.end(), [&](const Wall& wall) { return wall.side == *side; });
      if (!side || is_known)
        ++unsupported;
      else
        walls_.push_back({*side, glm::dot(plane->point + extra_radius() * plane->normal, glm::abs(plane->normal)), &collider});
    }
    if (unsupported > 0) report_loss(pluralize(unsupported, "collider", "colliders"));
    const auto has_other_radius = [&](const Point& point) {
      return !point.nailed && std::abs(point.radius - xsp_radius(point.mass, false) - extra_radius()) > 1e-9;
    };
    const auto radii = static_cast<std::size_t>(std::count_if(system_.points().begin(), system_.points().end(), has_other_radius));
    if (radii > 0 && !walls_.empty()) report_loss("the radius of " + pluralize(radii, "point", "points") + ": it follows from the mass");
    const auto count = [&](auto has) { return static_cast<std::size_t>(std::ranges::count_if(system_.points(), has)); };
    if (const std::size_t loads = count([](const Point& point) { return point.load != Vec3(0.0); }); loads > 0)
      report_loss("the load of " + pluralize(loads, "point", "points"));
    if (const std::size_t rollers = count([](const Point& point) { return point.fixed_axes != 0; }); rollers > 0)
      report_loss("the fixed axes of " + pluralize(rollers, "point", "points"));
    if (moving > 0) report_loss("the motion of " + pluralize(moving, "collider", "colliders"));
    if (system_.contact.faces || system_.contact.springs) report_loss("contact of faces and springs");
  }

  // Of the first free point [m], compared with that of its mass in XSpringies: walls are moved by it, so that points turn back at the same
  // place.
  double extra_radius() const {
    for (const Point& point : system_.points())
      if (!point.nailed) return point.radius - xsp_radius(point.mass, false);
    return 0.0;
  }

  const Wall* wall_at(XspSide side) const {
    const auto wall = std::find_if(walls_.begin(), walls_.end(), [&](const Wall& one) { return one.side == side; });
    return wall == walls_.end() ? nullptr : &*wall;
  }

  // The target [m] of the first force towards a center.
  std::optional<Vec3> center() const {
    for (const Force& force : system_.forces)
      if (force.on && (force.term == &center_force || force.term == &mass_center_force)) return Vec3(force.values[0], force.values[1], 0.0);
    return std::nullopt;
  }

  // Moves the scene so that its walls are the sides of the window; if it has none, so that its center of forces is the middle of the
  // window; otherwise so that it is in the window.
  void choose_window_shift() {
    const BoundingBox box = bounding_box(scene_.state.position);
    auto center_of_forces = center();
    if (center_point_ != no_index) center_of_forces.reset();  // that mass can be named
    const auto shift = [&](XspSide low, XspSide high, double width, int c) {
      const double size = width / xsp_pixels_per_meter;
      if (const Wall* wall = wall_at(low)) return -wall->place;
      if (const Wall* wall = wall_at(high)) return size - wall->place;
      if (center_of_forces) return 0.5 * size - (*center_of_forces)[c];
      return box.min[c] >= 0.0 && box.max[c] <= size ? 0.0 : 0.5 * size - box.center()[c];
    };
    shift_.x = shift(XspSide::Left, XspSide::Right, xsp_window_width, 0);
    shift_.y = shift(XspSide::Bottom, XspSide::Top, xsp_window_height, 1);
    if (shift_ != Vec3(0.0))
      report_loss("the origin: everything is moved by (" + format_rounded(shift_.x) + ", " + format_rounded(shift_.y) +
                  ") m, into the window");
  }

  // With drag relative to wind, a = g - c (v - w) = (g + c w) - c v; a lift of b changes gravity by a factor of 1 - b.
  void export_gravity() {
    double gravity_factor = 1.0;
    for (const Force& force : system_.forces)
      if (force.on && force.term == &buoyancy_force) gravity_factor -= force.values[0];
    document_.viscosity = system_.drag_rate();
    const Vec3 acceleration = gravity_factor * system_.gravity + system_.drag_rate() * system_.wind;
    const double size = std::hypot(acceleration.x, acceleration.y);
    const double angle = size > 0.0 ? glm::degrees(std::atan2(acceleration.x, -acceleration.y)) : 0.0;
    document_.forces = {{0, {size > 0.0, pixels(size), angle}}, {1, {}}, {2, {}}, {3, {}}};
  }

  void export_forces() {
    for (const Force& force : system_.forces) {
      if (!force.on || force.term == &buoyancy_force) continue;
      const ForceValues& values = force.values;
      const auto scaled = [](double strength, double power) { return strength * std::pow(xsp_pixels_per_meter, 1.0 + power); };
      if (force.term == &mass_center_force)
        export_force(1, values[3], values[4], force);
      else if (force.term == &center_force)
        export_force(2, scaled(values[3], values[4]), values[4], force);
      else if (force.term == &wall_force)
        export_force(3, scaled(values[0], values[1]), values[1], force);
      else if (force.term == &sticky_force && document_.stickiness == 0.0)
        document_.stickiness = pixels(values[0]);
      else
        report_loss("the force \"" + std::string(force.term->label) + "\"");
    }
  }

  // Each can occur once, and all have the same center.
  void export_force(int id, double p1, double p2, const Force& force) {
    XspForce& place = document_.forces[id];
    const Vec3 force_center(force.values[0], force.values[1], 0.0);
    if (place.active || !std::isfinite(p1) || (id != 3 && force_center != *center())) {
      report_loss("a further force \"" + std::string(force.term->label) + "\"");
      return;
    }
    place = {true, p1, p2};
    if (id == 3) return;
    const Vec3 middle = 0.5 / xsp_pixels_per_meter * Vec3(xsp_window_width, xsp_window_height, 0.0);
    if (center_point_ != no_index)
      document_.center = center_point_ + 1;
    else if (glm::distance(force_center + shift_, middle) >= 1e-9)
      report_loss("the position of the center of forces: it is the middle of the window");
  }

  void export_walls() {
    double window[] = {xsp_window_height, 0.0, xsp_window_width, 0.0};
    double friction = 0.0, restitution = walls_.empty() ? 1.0 : walls_[0].collider->restitution;
    bool moved = false, restitutions_differ = false, slides = false;
    for (const Wall& wall : walls_) {
      const auto side = static_cast<std::size_t>(wall.side);
      const bool is_vertical = wall.side == XspSide::Left || wall.side == XspSide::Right;
      const double place = (wall.place + (is_vertical ? shift_.x : shift_.y)) * xsp_pixels_per_meter;
      document_.walls[side] = true;
      moved = moved || std::abs(place - window[side]) > 0.01;
      restitutions_differ = restitutions_differ || wall.collider->restitution != restitution;
      friction = std::max(friction, wall.collider->friction);
      slides = slides || (!wall.collider->one_way && wall.collider->restitution < 1.0);
    }
    if (const PairContact& contact = system_.contact; contact.points) {
      document_.forces[4] = {.active = true};
      if (walls_.empty()) restitution = contact.restitution;
      if (contact.restitution != restitution) report_loss("the restitution of points: it is that of the first wall");
      if (contact.friction > 0.0) report_loss("the friction between points");
      if (contact.thickness > 0.0) report_loss("the thickness of points");
    }
    document_.new_elasticity = restitution;
    if (moved) report_loss("the positions of the walls: they are the sides of the window");
    if (restitutions_differ) report_loss("different restitutions of walls: all have that of the first");
    if (friction > 0.0) report_loss("the friction of walls");
    if (slides) report_loss("slides along walls: impacts multiply the tangential velocity by the restitution");
  }

  void export_masses() {
    int id = 0;
    for (Index i = 0; i < system_.point_count(); ++i) {
      const Point& point = system_.points()[i];
      const Vec3 x = scene_.state.position[i] + shift_, v = scene_.state.velocity[i];
      document_.masses.push_back({.id = ++id,
                                  .x = pixels(x.x),
                                  .y = pixels(x.y),
                                  .vx = pixels(v.x),
                                  .vy = pixels(v.y),
                                  .mass = point.nailed ? -point.mass : point.mass,
                                  .elasticity = document_.new_elasticity});
      const XspMass& mass = document_.masses.back();
      for (const double value : {mass.x, mass.y, mass.vx, mass.vy})
        if (!std::isfinite(value)) throw InputError(file_ + ": points[" + std::to_string(i) + "]: the number is too large for .xsp");
    }
  }

  void export_springs() {
    int id = 0;
    for (const Spring& spring : system_.springs()) {
      if (spring.law)
        throw InputError(file_ + ": springs[" + std::to_string(id) + "].law: .xsp cannot represent laws, muscles and winches");
      document_.springs.push_back({.id = ++id,
                                   .first = system_.index_of(spring.first) + 1,
                                   .second = system_.index_of(spring.second) + 1,
                                   .stiffness = spring.stiffness,
                                   .damping = system_.damping_of(spring),
                                   .rest_length = pixels(spring.rest_length)});
    }
  }

  void export_editor_settings() {
    if (const std::string& unknown = scene_.preserved_json.unknown; !unknown.empty()) {
      JsonParser parser;
      const std::string text = "{" + unknown + "}";
      for (const JsonField member : JsonField(file_, "", parser.parse(text)).members())
        if (member.is("xsp"))
          for (const JsonField line : member.items(0, max_springs)) document_.unknown.emplace_back(line.text());
    }
    document_.new_mass = new_point_like(scene_.defaults, scene_.system).mass;
    document_.new_stiffness = scene_.defaults.stiffness;
    document_.new_damping = scene_.defaults.damping;
    document_.step = scene_.settings.substep();
    if (scene_.settings.tolerance) {
      document_.adaptive = true;
      document_.precision = pixels(*scene_.settings.tolerance);
    }
  }

  void report_remaining_losses() {
    const auto& springs = system_.springs();
    const auto breaking =
        std::count_if(springs.begin(), springs.end(), [](const Spring& spring) { return spring.break_strain != never_breaks; });
    if (breaking > 0) report_loss("the break strains of " + pluralize(static_cast<std::size_t>(breaking), "spring", "springs"));
    if (system_.scripted_hand) report_loss("the scripted hand");
    if (system_.strain_limit > 0.0) report_loss("the strain limit");
    if (!system_.faces.empty()) report_loss(pluralize(system_.faces.size(), "face", "faces"));
  }

  void report_loss(const std::string& what) { losses_.push_back(file_ + ": .xsp cannot represent " + what); }

  const Scene& scene_;
  const System& system_;
  const std::string& file_;
  std::vector<std::string>& losses_;
  const Index center_point_;
  std::vector<Wall> walls_;
  Vec3 shift_{0.0};  // [m]
  XspDocument document_;
};

}  // namespace

std::string format_xsp(const Scene& scene, const std::string& file, std::vector<std::string>& losses) {
  return Exporter(scene, file, losses).text();
}

constinit const FileKind xsp_file{
    .extension = ".xsp",
    .title = "XSpringies scene",
    .parse = [](std::string_view text, const std::string& file, const ImportOptions&) { return parse_xsp(text, file); },
    .format = format_xsp,
    .source = ExportSource::Scene,
    .label = "XSpringies",
    .description = "A flat scene for XSpringies, in its current state.",
    .is_flat_only = true};

}  // namespace hooke
