#include "draw/stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "draw/surface_motion.h"

namespace hooke {
namespace {

constexpr double faint = 0.35;    // opacity of colliders that only look like ones, against solid ones
constexpr double outline = 1.5;   // [px of the screen]
constexpr double hatching = 9.0;  // [px of the screen], between hatches and their depth

double pixel_at_target(const Subject& subject) {
  const glm::dvec2 size(subject.projection.width(), subject.projection.height());
  return subject.camera.metres_per_pixel(subject.camera.target, size) * subject.options.scale;
}

void add_box(const Subject& subject, const Box& box, Ink fill, Ink line, Surfaces& surfaces, Strokes& strokes) {
  const auto corner = [&](int which) {
    return Vec3(which & 1 ? box.most.x : box.least.x, which & 2 ? box.most.y : box.least.y, which & 4 ? box.most.z : box.least.z);
  };

  // anticlockwise from outside
  constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (int side = 0; side < 6; ++side) {
    Vec3 normal(0.0);
    normal[side / 2] = side % 2 == 0 ? -1.0 : 1.0;
    const Vec3 corners[4] = {corner(sides[side][0]), corner(sides[side][1]), corner(sides[side][2]), corner(sides[side][3])};
    surfaces.add_quad(subject.projection, corners, normal, fill);
  }
  for (int a = 0; a < 8; ++a)
    for (const int bit : {1, 2, 4})
      if (!(a & bit)) strokes.add(subject.projection, corner(a), corner(a | bit), line, static_cast<float>(subject.options.scale), 4.0);
}

// A closed shape in the plane z = 0, filled from its middle.
void add_shape(const Subject& subject, const Vec3& middle, const std::vector<Vec3>& border, Ink fill, Ink line, Stage& stage) {
  const Projection& projection = subject.projection;
  const GLuint center = stage.solids.add_corner(projection.clip(middle), Vec3(0.0), fill);
  for (const Vec3& place : border) stage.solids.add_corner(projection.clip(place), Vec3(0.0), fill);
  const auto count = static_cast<GLuint>(border.size());
  for (GLuint i = 0; i < count; ++i) {
    const GLuint next = (i + 1) % count;
    stage.solids.add_triangle(center, center + 1 + i, center + 1 + next);
    stage.outlines.add(projection, border[i], border[next], line, static_cast<float>(outline * subject.options.scale));
  }
}

// The edge of a half-plane, hatched on the side that is closed; a dashed line where nothing is solid.
void add_edge(const Subject& subject, const Plane& plane, const ColliderPath& path, bool solid, Ink line, Strokes& strokes) {
  Vec3 normal(plane.normal.x, plane.normal.y, 0.0);
  if (!(glm::length(normal) > 1e-9)) return;
  normal = glm::normalize(normal);
  const Vec3 along(-normal.y, normal.x, 0.0);
  const Vec3 middle = subject.camera.target - glm::dot(subject.camera.target - plane.point, normal) * normal;
  const double pixel = pixel_at_target(subject);
  const double reach = pixel / subject.options.scale * (subject.projection.width() + subject.projection.height());
  const auto width = static_cast<float>(outline * subject.options.scale);
  if (!solid) {
    const auto scale = static_cast<float>(subject.options.scale);
    return strokes.add_dashed(subject.projection, middle - reach * along, middle + reach * along, line, 2.0f * scale, 10.0f * scale,
                              6.0f * scale);
  }
  strokes.add(subject.projection, middle - reach * along, middle + reach * along, line, width);

  // hatches start at multiples of their spacing along the edge, so that they stay where they are as the camera moves, and run
  // along with it
  const double spacing = hatching * pixel;
  const double time = subject.snapshot.state.time;
  const double start = glm::dot(middle - path.offset(time) - time * path.belt, along);
  const auto first = static_cast<long>(std::floor((start - reach) / spacing)),
             last = static_cast<long>(std::ceil((start + reach) / spacing));
  Ink thin = line;
  thin.opacity = static_cast<std::uint8_t>(line.opacity / 2);
  for (long n = first; n <= last; ++n) {
    const Vec3 from = middle + (static_cast<double>(n) * spacing - start) * along;
    strokes.add(subject.projection, from, from - spacing * (normal + along), thin, static_cast<float>(subject.options.scale));
  }
}

}  // namespace

void Stage::clear() {
  for (Ground* ground : {&backdrop, &floors, &veils}) ground->clear();
  for (Surfaces* surfaces : {&solids, &faint_solids}) surfaces->clear();
  for (Balls* each : {&balls, &faint_balls}) each->clear();
  outlines.clear();
}

void Stage::add(const Subject& subject, const Shadows& shadows) {
  if (subject.options.grid) add_grid(subject);
  if (!subject.options.colliders) return;
  const System& system = *subject.snapshot.system;
  for (std::size_t c = 0; c < system.colliders.size(); ++c) {
    const Collider collider = moved_at(system.colliders[c], subject.snapshot.state.time);
    const bool is_hovered = subject.marks.hovered_collider == static_cast<Index>(c);
    if (system.dimensions == 2)
      add_flat(subject, collider, is_hovered);
    else
      add_spatial(subject, collider, is_hovered, shadows.on_ball(static_cast<Index>(c)));
  }
}

// In flat scenes squared paper behind everything; in spatial ones a level grid through the origin, where no floor is.
void Stage::add_grid(const Subject& subject) {
  const System& system = *subject.snapshot.system;
  const bool is_flat = system.dimensions == 2;
  const Vec3 pole = subject.camera.pole;
  const auto is_floor = [&](const Collider& collider) {
    const auto* plane = std::get_if<Plane>(&collider.shape);
    return plane && std::abs(glm::dot(plane->normal, pole)) > 0.9;
  };
  if (!is_flat && subject.options.colliders && std::any_of(system.colliders.begin(), system.colliders.end(), is_floor)) return;

  GroundLook look = look_from(subject.camera);
  look.line = ink(subject.palette.line, is_flat ? 0.22 : 0.3);
  backdrop.add(subject.projection, subject.camera, {.normal = is_flat ? Vec3(0.0, 0.0, 1.0) : pole}, look);
}

void Stage::add_spatial(const Subject& subject, const Collider& collider, bool is_hovered, const BallShade& shade) {
  const double opacity = collider.solid ? 1.0 : faint;
  const Color color = is_hovered ? mix(subject.palette.collider, subject.palette.line, 0.3) : subject.palette.collider;
  if (const auto* sphere = std::get_if<Sphere>(&collider.shape))
    (collider.solid ? balls : faint_balls)
        .add(subject.projection, sphere->center, sphere->radius, ink(color, opacity), meridians_of(subject, collider.path), shade);
  if (const auto* box = std::get_if<Box>(&collider.shape)) {
    add_belt(subject, *box, collider.path.belt, ink(subject.palette.line, 0.6 * opacity), outlines);
    add_box(subject, *box, ink(color, opacity), ink(subject.palette.line, 0.8 * opacity), collider.solid ? solids : faint_solids, outlines);
  }
  if (const auto* plane = std::get_if<Plane>(&collider.shape)) {
    const bool is_shown = collider.solid && is_before(subject.camera, *plane);
    GroundLook look = look_from(subject.camera);
    look.fill = ink(mix(subject.options.background, color, 0.45), is_shown ? 1.0 : 0.0);
    look.line = ink(subject.palette.line, is_shown ? 0.35 : 0.15);
    move_grid(look, subject, *plane, collider.path);
    (is_shown ? floors : veils).add(subject.projection, subject.camera, *plane, look);
  }
}

void Stage::add_flat(const Subject& subject, const Collider& collider, bool is_hovered) {
  const double opacity = collider.solid ? 1.0 : faint;
  const Ink fill = ink(subject.palette.collider, (is_hovered ? 0.75 : 0.5) * opacity), line = ink(subject.palette.line, opacity);
  if (const auto* plane = std::get_if<Plane>(&collider.shape))
    add_edge(subject, *plane, collider.path, collider.solid, ink(subject.palette.line), outlines);
  if (const auto* box = std::get_if<Box>(&collider.shape)) {
    const Vec3 least(box->least.x, box->least.y, 0.0), most(box->most.x, box->most.y, 0.0);
    add_shape(subject, 0.5 * (least + most), {least, {most.x, least.y, 0.0}, most, {least.x, most.y, 0.0}}, fill, line, *this);
    add_belt(subject, *box, collider.path.belt, line, outlines);
  }
  if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) {
    const double radius = sphere->radius / pixel_at_target(subject);  // [px]
    const int corners = std::clamp(static_cast<int>(4.0 * std::sqrt(std::max(radius, 1.0))), 32, 512);
    const Vec3 middle(sphere->center.x, sphere->center.y, 0.0);
    std::vector<Vec3> border;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      border.push_back(middle + sphere->radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
    add_shape(subject, middle, border, fill, line, *this);
    if (collider.path.spin.z != 0.0) add_diameters(subject, *sphere, collider.path.spin.z, line, outlines);
  }
}

}  // namespace hooke
