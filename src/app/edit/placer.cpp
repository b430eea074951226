#include "app/edit/placer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

#include "app/document/files.h"
#include "app/edit/placement_part.h"
#include "base/printable.h"
#include "formats/mesh/mesh_cloth.h"
#include "ui/text.h"

namespace hooke {
namespace {

Box bounding_box(const Scene& part) {
  Box box{part.state.position.front(), part.state.position.front()};
  for (Index i = 0; i < part.system.point_count(); ++i) {
    box.min = glm::min(box.min, part.state.position[i] - part.system.points()[i].radius);
    box.max = glm::max(box.max, part.state.position[i] + part.system.points()[i].radius);
  }
  return box;
}

// Whether the box reaches into a solid collider.
bool is_inside_collider(const System& system, const Box& box) {
  const Vec3 center = 0.5 * (box.min + box.max), half = 0.5 * (box.max - box.min);
  return std::ranges::any_of(system.colliders, [&](const Collider& collider) {
    if (!collider.solid) return false;
    if (const auto* plane = std::get_if<Plane>(&collider.shape))
      return glm::dot(center - plane->point, plane->normal) < glm::dot(half, glm::abs(plane->normal));
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape))
      return glm::distance(sphere->center, glm::clamp(sphere->center, box.min, box.max)) < sphere->radius;
    const auto& other = std::get<Box>(collider.shape);
    return glm::all(glm::lessThan(box.min, other.max)) && glm::all(glm::lessThan(other.min, box.max));
  });
}

}  // namespace

void Placer::start(const ShapeKind* shape) {
  mesh_.reset();
  Placement& placement = panels_.placement;
  placement = {};
  placement.is_mesh = shape == nullptr;
  if (shape != nullptr) placement.shape = default_shape(*shape);
  set_material_for_size();
  place_in_sight();
}

// A third of the height of the view [m].
double Placer::size_in_view() const {
  return context_.camera.meters_per_pixel(context_.camera.target, context_.size) * context_.size.y / 3.0;
}

void Placer::start(const ColliderKind& kind) {
  mesh_.reset();
  const Vec3 up = context_.system().dimensions == 2 ? Vec3(0.0, 1.0, 0.0) : context_.camera.pole;
  const Dock dock = placement_dock(context_.layout, context_.scale);
  const double left = dock.is_over_scene ? dock.place.x + dock.place.width - context_.layout.scene.x : 0.0;
  const Vec3 at = context_.point_in_view_plane({0.5 * (left + context_.size.x), 0.5 * context_.size.y}, context_.camera.target);
  panels_.placement = {};
  panels_.placement.collider = kind.make(at, size_in_view(), up);
}

// The material that suits cloth of the size of the mesh.
void Placer::set_material_for_size() {
  Placement& placement = panels_.placement;
  const SheetMaterial material = cloth_of_size(placement.mesh_size);
  placement.mesh_stiffness = material.stiffness;
  placement.mesh_density = material.density;
  placement.mesh_damping = material.damping;
}

// The middle of the preview to this position of the view, above the colliders that it would be in. Returns it.
Scene Placer::preview_at(const glm::dvec2& cursor) {
  Vec3& at = panels_.placement.shape.at;
  at = context_.point_in_view_plane(cursor, context_.camera.target);
  Scene preview = part();
  if (preview.system.points().empty()) return preview;
  Box box = bounding_box(preview);
  // its middle, wherever its own origin is
  Vec3 shift = at - 0.5 * (box.min + box.max);
  const double step = std::max(0.05 * glm::length(box.max - box.min), 1e-3);
  constexpr int max_steps = 200;
  for (int i = 0; i < max_steps && is_inside_collider(context_.system(), {box.min + shift, box.max + shift}); ++i)
    shift += step * context_.camera.pole;
  at += shift;
  for (Vec3& place : preview.state.position) place += shift;
  return preview;
}

// Starts in the middle of what the panel leaves free; what is larger is seen from farther away.
void Placer::place_in_sight() {
  restore_view();
  const Dock dock = placement_dock(context_.layout, context_.scale);
  const double left = dock.is_over_scene ? dock.place.x + dock.place.width - context_.layout.scene.x : 0.0;
  const glm::dvec2 middle{0.5 * (left + context_.size.x), 0.5 * context_.size.y};
  const glm::dvec2 room{std::max(1.0, 0.5 * (context_.size.x - left)), middle.y};
  const Camera before = context_.camera;
  // more than once, since perspective is not proportional
  constexpr int attempts = 4;
  constexpr double margin = 1.1;
  for (int i = 0; i < attempts; ++i) {
    double excess = 0.0;
    for (const Vec3& place : preview_at(middle).state.position) {
      const Vec3 at = context_.camera.project(place, context_.size);
      excess = std::max({excess, std::abs(at.x - middle.x) / room.x, std::abs(at.y - middle.y) / room.y});
    }
    if (!(excess > 1.0) || i + 1 == attempts) break;
    context_.camera.distance *= std::min(margin * excess, 10.0);
    view_before_ = before;
    view_now_ = context_.camera;
  }
}

// Unless it was changed since.
void Placer::restore_view() {
  const auto before = std::exchange(view_before_, std::nullopt);
  const Camera& now = context_.camera;
  if (before && now.target == view_now_.target && now.back == view_now_.back && now.distance == view_now_.distance)
    context_.camera = *before;
}

void Placer::read_mesh(const std::filesystem::path& file) {
  task_.start("Reading " + printable(file.filename().native(), 60), [this, file](const Progress& progress) -> BackgroundTask::Completion {
    return [this, loaded = load_mesh_part(file, progress)] {
      if (task_.was_stopped()) return panels_.show_toast("Canceled: no mesh was read");
      if (!loaded.scene) panels_.show_message("Cannot use the mesh", loaded.error);
      mesh_ = loaded.scene;
      set_material_for_size();
      place_in_sight();
      panels_.placement.mesh_info = mesh_ ? count(mesh_->system.point_count(), "point") : "";
    };
  });
}

void Placer::place() {
  if (const auto& collider = panels_.placement.collider) {
    std::vector<Collider> colliders = carried_colliders(context_.system(), context_.snapshot().state);
    context_.selection = {.points = {}, .springs = {}, .collider = static_cast<Index>(colliders.size())};
    colliders.push_back(*collider);
    context_.note_gaps(*collider);
    context_.lab.submit(SetColliders{std::move(colliders)}, context_.begin_gesture());
    return stop();
  }
  Scene placed = part();
  if (placed.system.point_count() == 0) return panels_.show_toast("Nothing to place yet");
  // in an empty scene, the mesh looks as it does when its file is opened
  if (panels_.placement.is_mesh && context_.system().points().empty()) panels_.view.points = panels_.view.springs = false;
  view_before_.reset();
  Insert insert = make_insert(placed, Vec3(0.0), context_.new_ids());
  insert.contact = contact_of(panels_.placement, placed, context_.system().dimensions == 2);
  context_.lab.submit(std::move(insert));
  placed_ = std::move(placed);
  stop();
}

void Placer::follow(const Pointer& pointer) {
  if (!is_on()) {
    if (context_.lab.settle(std::chrono::milliseconds(0)))
      placed_.reset();
    else if (placed_ && placed_->system.point_count() >= 5000)
      panels_.show_value("Placing " + count(placed_->system.point_count(), "point") + "...");
    restore_view();
    mesh_.reset();
    is_pressed_ = false;
    return;
  }
  if (auto& collider = panels_.placement.collider) {
    const Vec3 from = anchor_of(*collider);
    if (is_pressed_) collider = translated(*collider, context_.point_in_view_plane(pointer.at, from) - from);
    return;
  }
  Vec3& at = panels_.placement.shape.at;
  if (is_pressed_) at = context_.point_in_view_plane(pointer.at, at);
  if (context_.system().dimensions == 2) at.z = 0.0;
}

void Placer::mark(Marks& marks) const {
  if (const auto& collider = panels_.placement.collider)
    marks.ghost_lines = outline_of(*collider, size_in_view());
  else if (is_on() || placed_)
    mark_part(is_on() ? part() : *placed_, marks);
}

Scene Placer::part() const { return part_of(panels_.placement, mesh_.get(), context_.camera.pole, context_.system().dimensions == 2); }

}  // namespace hooke
