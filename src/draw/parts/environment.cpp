#include "draw/parts/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "draw/parts/surface_motion.h"

namespace hooke {
namespace {

constexpr double transparent_opacity = 0.35;  // opacity of colliders that are not solid, in 2-D scenes
constexpr double outline = 1.5;               // [px of the screen]
constexpr double hatching = 9.0;              // [px of the screen], between hatches and their depth

double pixel_at_target(const DrawContext& context) {
  const glm::dvec2 size(context.projection.width(), context.projection.height());
  return context.camera.meters_per_pixel(context.camera.target, size) * context.options.scale;
}

void add_box(const DrawContext& context, const Box& box, Rgba fill, Rgba line, Surfaces& surfaces, Strokes& strokes) {
  // Counterclockwise, seen from outside.
  constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (int side = 0; side < 6; ++side) {
    Vec3 normal(0.0);
    normal[side / 2] = side % 2 == 0 ? -1.0 : 1.0;
    const Vec3 corners[4] = {box.corner(sides[side][0]), box.corner(sides[side][1]), box.corner(sides[side][2]),
                             box.corner(sides[side][3])};
    surfaces.add_quad(context.projection, corners, normal, fill);
  }
  for (int a = 0; a < 8; ++a)
    for (const int bit : {1, 2, 4})
      if (!(a & bit))
        strokes.add(context.projection, box.corner(a), box.corner(a | bit), line, static_cast<float>(context.options.scale), 1.0);
}

// A convex shape in the plane z = 0, filled from its center.
void add_shape(const DrawContext& context, const Vec3& middle, const std::vector<Vec3>& border, Rgba fill, Rgba line,
               Environment& environment) {
  const Projection& projection = context.projection;
  const GLuint center = environment.solids.add_corner(projection.clip(middle), Vec3(0.0), fill);
  for (const Vec3& place : border) environment.solids.add_corner(projection.clip(place), Vec3(0.0), fill);
  const auto count = static_cast<GLuint>(border.size());
  for (GLuint i = 0; i < count; ++i) {
    const GLuint next = (i + 1) % count;
    environment.solids.add_triangle(center, center + 1 + i, center + 1 + next);
    environment.outlines.add(projection, border[i], border[next], line, static_cast<float>(outline * context.options.scale));
  }
}

// The edge of a half-plane, hatched on the solid side; a dashed line if the collider is not solid.
void add_edge(const DrawContext& context, const Plane& plane, const ColliderPath& path, bool solid, Rgba line, Strokes& strokes) {
  Vec3 normal(plane.normal.x, plane.normal.y, 0.0);
  if (!(glm::length(normal) > 1e-9)) return;
  normal = glm::normalize(normal);
  const Vec3 along(-normal.y, normal.x, 0.0);
  const Vec3 middle = context.camera.target - glm::dot(context.camera.target - plane.point, normal) * normal;
  const double pixel = pixel_at_target(context);
  const double reach = pixel / context.options.scale * (context.projection.width() + context.projection.height());
  const auto width = static_cast<float>(outline * context.options.scale);
  if (!solid) {
    const auto scale = static_cast<float>(context.options.scale);
    return strokes.add_dashed(context.projection, middle - reach * along, middle + reach * along, line, 2.0f * scale, 10.0f * scale,
                              6.0f * scale);
  }
  strokes.add(context.projection, middle - reach * along, middle + reach * along, line, width);

  // hatches start at multiples of their spacing along the edge, so that they stay in place as the camera moves, and move with the edge
  const double spacing = hatching * pixel;
  const double time = context.snapshot.state.time;
  const double start = glm::dot(middle - path.offset(time) - time * path.belt, along);
  const auto first = static_cast<long>(std::floor((start - reach) / spacing)),
             last = static_cast<long>(std::ceil((start + reach) / spacing));
  Rgba thin = line;
  thin.opacity = static_cast<std::uint8_t>(line.opacity / 2);
  for (long n = first; n <= last; ++n) {
    const Vec3 from = middle + (static_cast<double>(n) * spacing - start) * along;
    strokes.add(context.projection, from, from - spacing * (normal + along), thin, static_cast<float>(context.options.scale));
  }
}

}  // namespace

void Environment::clear() {
  for (Ground* ground : {&backdrop, &floors, &transparent_floors}) ground->clear();
  solids.clear();
  balls.clear();
  outlines.clear();
}

void Environment::add(const DrawContext& context, const Shadows& shadows) {
  if (context.options.grid) add_grid(context);
  if (!context.options.colliders) return;
  const System& system = *context.snapshot.system;
  for (std::size_t c = 0; c < system.colliders.size(); ++c) {
    const Collider collider = current_collider(system, context.snapshot.state, c);
    const bool is_hovered = context.marks.hovered_collider == static_cast<Index>(c);
    if (system.dimensions == 2)
      add_flat(context, collider, is_hovered);
    else
      add_spatial(context, collider, is_hovered, shadows.on_ball(static_cast<Index>(c)));
  }
}

// In 2-D scenes a grid behind everything; in 3-D scenes a horizontal grid through the origin, unless there is a floor.
void Environment::add_grid(const DrawContext& context) {
  const System& system = *context.snapshot.system;
  const bool is_flat = system.dimensions == 2;
  const Vec3 pole = context.camera.pole;
  const auto is_floor = [&](const Collider& collider) {
    const auto* plane = std::get_if<Plane>(&collider.shape);
    return plane && std::abs(glm::dot(plane->normal, pole)) > 0.9;
  };
  if (!is_flat && context.options.colliders && std::any_of(system.colliders.begin(), system.colliders.end(), is_floor)) return;

  GroundStyle style = grid_style_for(context.camera);
  style.line = rgba(context.palette.line, is_flat ? 0.22 : 0.3);
  backdrop.add(context.projection, context.camera, {.normal = is_flat ? Vec3(0.0, 0.0, 1.0) : pole}, style);
}

void Environment::add_spatial(const DrawContext& context, const Collider& collider, bool is_hovered, const BallShadow& shade) {
  const Color color = is_hovered ? mix(context.palette.collider, context.palette.line, 0.3) : context.palette.collider;
  if (const auto* sphere = std::get_if<Sphere>(&collider.shape))
    balls.add(context.projection, sphere->center, sphere->radius, rgba(color), meridians_of(context, collider.path), shade);
  if (const auto* box = std::get_if<Box>(&collider.shape)) {
    add_belt(context, *box, collider.path.belt, rgba(context.palette.line, 0.6), outlines);
    add_box(context, *box, rgba(color), rgba(context.palette.line, 0.8), solids, outlines);
  }
  if (const auto* plane = std::get_if<Plane>(&collider.shape)) {
    const bool is_shown = collider.solid && is_before(context.camera, *plane);
    GroundStyle style = grid_style_for(context.camera);
    style.fill = rgba(mix(context.options.background, color, 0.45), is_shown ? 1.0 : 0.0);
    style.line = rgba(context.palette.line, is_shown ? 0.35 : 0.15);
    move_grid(style, context, *plane, collider.path);
    (is_shown ? floors : transparent_floors).add(context.projection, context.camera, *plane, style);
  }
}

void Environment::add_flat(const DrawContext& context, const Collider& collider, bool is_hovered) {
  const double opacity = collider.solid ? 1.0 : transparent_opacity;
  const Rgba fill = rgba(context.palette.collider, (is_hovered ? 0.75 : 0.5) * opacity), line = rgba(context.palette.line, opacity);
  if (const auto* plane = std::get_if<Plane>(&collider.shape))
    add_edge(context, *plane, collider.path, collider.solid, rgba(context.palette.line), outlines);
  if (const auto* box = std::get_if<Box>(&collider.shape)) {
    const Vec3 min(box->min.x, box->min.y, 0.0), max(box->max.x, box->max.y, 0.0);
    add_shape(context, 0.5 * (min + max), {min, {max.x, min.y, 0.0}, max, {min.x, max.y, 0.0}}, fill, line, *this);
    add_belt(context, *box, collider.path.belt, line, outlines);
  }
  if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) {
    const double radius = sphere->radius / pixel_at_target(context);  // [px]
    const int corners = std::clamp(static_cast<int>(4.0 * std::sqrt(std::max(radius, 1.0))), 32, 512);
    const Vec3 middle(sphere->center.x, sphere->center.y, 0.0);
    std::vector<Vec3> border;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      border.push_back(middle + sphere->radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
    add_shape(context, middle, border, fill, line, *this);
    if (collider.path.spin.z != 0.0) add_diameters(context, *sphere, collider.path.spin.z, line, outlines);
  }
}

}  // namespace hooke
