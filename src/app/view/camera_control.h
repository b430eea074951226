// Control of the camera with keys, menus and the mouse.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "app/edit/clipboard.h"
#include "app/tools/tools.h"
#include "app/window/event.h"
#include "ui/panels.h"

namespace hooke {

class CameraControl {
 public:
  CameraControl(ToolContext& context, Panels& panels, Clipboard& clipboard, std::shared_ptr<const Scene> first)
      : context_(context), panels_(panels), clipboard_(clipboard), first_(std::move(first)) {}

  // To be called when the size of the view is known; shows the first scene.
  void show_first() {
    if (const auto scene = std::exchange(first_, nullptr)) show(*scene);
  }
  // The camera of the scene, or one that frames it.
  void show(const Scene& scene);
  void frame_all();
  void frame_selection();
  // The same in half a second, so that the user sees from where to where; any other motion of the camera ends it.
  void fly_to_selection();
  bool is_flying() const { return flight_.has_value(); }
  // From this direction, or from the opposite one if the camera already is there.
  void look_from(const Vec3& direction);
  void switch_projection();
  void switch_following();
  // As text in the format of `hooke capture --camera`.
  void copy();
  void paste();

  // A drag with this button orbits or pans.
  void press(Button button) {
    button_ = button;
    flight_.reset();
  }
  void move(const glm::dvec2& from, const Pointer& to);
  void release(Button button);
  bool is_dragging() const { return button_.has_value(); }
  void zoom(double steps, const glm::dvec2& at);
  // Once per frame: flies, and follows moving objects, if enabled.
  void follow();

 private:
  double aspect_ratio() const { return context_.size.x / context_.size.y; }
  bool is_flat() const { return context_.system().dimensions == 2; }

  ToolContext& context_;
  Panels& panels_;
  Clipboard& clipboard_;
  std::shared_ptr<const Scene> first_;
  struct Flight {
    Camera from, to;
    std::chrono::steady_clock::time_point start;
  };
  std::optional<Flight> flight_;
  std::optional<Button> button_;
  int dimensions_ = 0;             // of the scene in the last frame
  bool dimensions_known_ = false;  // since the scene was opened
};

}  // namespace hooke
