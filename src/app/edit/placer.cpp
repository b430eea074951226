#include "app/edit/placer.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "app/document/files.h"
#include "app/edit/placement_part.h"
#include "base/printable.h"
#include "edit/copy_selection.h"
#include "formats/mesh/mesh_cloth.h"

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

// The material that suits cloth of the mesh's size.
void Placer::set_material_for_size() {
  Placement& placement = panels_.placement;
  const SheetMaterial material = cloth_of_size(placement.mesh_size);
  placement.mesh_stiffness = material.stiffness;
  placement.mesh_density = material.density;
  placement.mesh_damping = material.damping;
}

// Starts in the middle of what the dialog leaves free, above the colliders that it would be in.
void Placer::place_in_sight() {
  constexpr double dialog_width = 324.0;  // [design units]
  Vec3& at = panels_.placement.shape.at;
  const double left = std::min(dialog_width * context_.scale, 0.5 * context_.size.x);
  at = context_.point_in_view_plane({0.5 * (left + context_.size.x), 0.5 * context_.size.y}, context_.camera.target);
  const Scene preview = part();
  if (preview.system.points().empty()) return;
  const Box box = bounding_box(preview);
  const double step = std::max(0.05 * glm::length(box.max - box.min), 1e-3);
  Vec3 shift(0.0);
  constexpr int max_steps = 200;
  for (int i = 0; i < max_steps && is_inside_collider(context_.system(), {box.min + shift, box.max + shift}); ++i)
    shift += step * context_.camera.pole;
  at += shift;
}

void Placer::read_mesh(const std::filesystem::path& file) {
  task_.start("Reading " + printable(file.filename().native(), 60), [this, file](const Progress& progress) -> BackgroundTask::Completion {
    return [this, loaded = load_mesh_part(file, progress)] {
      if (task_.was_stopped()) return panels_.show_toast("Canceled: no mesh was read");
      if (!loaded.scene) panels_.show_message("Cannot use the mesh", loaded.error);
      mesh_ = loaded.scene;
      set_material_for_size();
      place_in_sight();
      panels_.placement.mesh_info = mesh_ ? std::to_string(mesh_->system.point_count()) + " points" : "";
    };
  });
}

void Placer::place() {
  const Scene placed = part();
  if (placed.system.point_count() == 0) return panels_.show_toast("Nothing to place yet");
  // a mesh that is alone looks as if its file were opened
  if (panels_.placement.is_mesh && context_.system().points().empty()) panels_.view.points = panels_.view.springs = false;
  LabThread& lab = context_.lab;
  lab.submit(make_insert(placed, Vec3(0.0), {[&lab] { return lab.new_point_id(); }, [&lab] { return lab.new_spring_id(); }}));
  stop();
}

void Placer::follow(const Pointer& pointer) {
  if (!is_on()) {
    mesh_.reset();
    is_pressed_ = false;
    return;
  }
  Vec3& at = panels_.placement.shape.at;
  if (is_pressed_) at = context_.point_in_view_plane(pointer.at, at);
  if (context_.system().dimensions == 2) at.z = 0.0;
}

void Placer::mark(Marks& marks) const { mark_part(part(), marks); }

Scene Placer::part() const { return part_of(panels_.placement, mesh_.get(), context_.camera.pole, context_.system().dimensions == 2); }

}  // namespace hooke
