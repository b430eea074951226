// The mouse over the scene: the left button is for the placement in progress or the tool, the others and the wheel for the camera.
#pragma once

#include <optional>

#include "app/edit/placer.h"
#include "app/tools/active_tool.h"
#include "app/view/camera_control.h"

namespace hooke {

class MouseInput {
 public:
  MouseInput(ToolContext& context, const Panels& panels, ActiveTool& tool, CameraControl& camera, Placer& placer)
      : context_(context), panels_(panels), tool_(tool), camera_(camera), placer_(placer) {}

  void handle(const ButtonPress& press);
  void handle(const ButtonRelease& release);
  void handle(const CursorMove& move);
  void handle(const CursorLeave&) { is_in_window_ = false; }
  void handle(const Scroll& scroll);

  Pointer pointer() const;
  // Whether the cursor is over the scene and not over a panel.
  bool is_over_scene() const;
  // The cursor in the view of the scene [px], if it is there.
  std::optional<glm::dvec2> place_in_scene() const;

 private:
  void move_cursor(const glm::dvec2& at);

  ToolContext& context_;
  const Panels& panels_;
  ActiveTool& tool_;
  CameraControl& camera_;
  Placer& placer_;
  glm::dvec2 cursor_{0.0};  // in window coordinates
  bool is_in_window_ = true;
  Modifiers modifiers_;
};

}  // namespace hooke
