#include "app/edit/placer.h"

#include "app/document/files.h"
#include "app/edit/placement_part.h"
#include "base/printable.h"
#include "edit/copy_selection.h"

namespace hooke {

void Placer::start(const ShapeKind* shape) {
  mesh_.reset();
  Placement& placement = panels_.placement;
  placement = {};
  placement.is_mesh = shape == nullptr;
  if (shape != nullptr) placement.shape = default_shape(*shape);
  placement.shape.at = context_.camera.target;
}

void Placer::read_mesh(const std::filesystem::path& file) {
  task_.start("Reading " + printable(file.filename().native(), 60), [this, file](const Progress& progress) -> BackgroundTask::Completion {
    return [this, loaded = load_mesh_part(file, progress)] {
      if (task_.was_stopped()) return panels_.show_toast("Canceled: no mesh was read");
      if (!loaded.scene) panels_.show_message("Cannot use the mesh", loaded.error);
      mesh_ = loaded.scene;
      panels_.placement.mesh_info = mesh_ ? std::to_string(mesh_->system.point_count()) + " points" : "";
    };
  });
}

void Placer::place() {
  const Scene placed = part();
  if (placed.system.point_count() == 0) return panels_.show_toast("Nothing to place yet");
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
