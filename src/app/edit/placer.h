// Placing a shape or a mesh: it is previewed in the scene, moved with the mouse, and added when the user confirms.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "app/tools/tools.h"
#include "app/work/file_task.h"

namespace hooke {

class Placer {
 public:
  Placer(ToolContext& context, Panels& panels, FileTask& task) : context_(context), panels_(panels), task_(task) {}

  // Starts where the camera looks; a mesh if `shape` is null.
  void start(const ShapeKind* shape);
  void start(const ColliderKind& kind);
  void stop() { panels_.placement.stop(); }
  bool is_on() const { return panels_.placement.is_on(); }
  void read_mesh(const std::filesystem::path& file);
  // Adds it to the scene.
  void place();

  // While the left mouse button is down, it follows the cursor.
  void press() { is_pressed_ = true; }
  void release() { is_pressed_ = false; }
  void follow(const Pointer& pointer);
  // The preview, until what was placed is in the scene.
  void mark(Marks& marks) const;

 private:
  Scene part() const;
  double size_in_view() const;
  void set_material_for_size();
  void place_in_sight();
  Scene preview_at(const glm::dvec2& cursor);
  void restore_view();

  ToolContext& context_;
  Panels& panels_;
  FileTask& task_;
  std::shared_ptr<const Scene> mesh_;  // null until one is read
  std::optional<Scene> placed_;        // on its way into the scene
  bool is_pressed_ = false;
  std::optional<Camera> view_before_;  // the preview needed another distance
  Camera view_now_{};
};

}  // namespace hooke
