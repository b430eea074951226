#include "app/input/mouse_input.h"

namespace hooke {

Pointer MouseInput::pointer() const { return {cursor_ - glm::dvec2(context_.layout.scene.x, context_.layout.scene.y), modifiers_}; }

bool MouseInput::is_over_scene() const { return is_in_window_ && !panels_cover(panels_, context_.layout, cursor_.x, cursor_.y); }

std::optional<glm::dvec2> MouseInput::place_in_scene() const { return is_over_scene() ? std::optional(pointer().at) : std::nullopt; }

void MouseInput::move_cursor(const glm::dvec2& at) {
  cursor_ = at;
  is_in_window_ = true;
}

void MouseInput::handle(const ButtonPress& press) {
  move_cursor(press.at);
  modifiers_ = press.modifiers;
  if (!is_over_scene()) return;
  context_.settle();
  if (press.button != Button::Left) return camera_.press(press.button);
  if (placer_.is_on()) return placer_.press();
  Pointer pressed = pointer();
  pressed.twice = press.twice;
  tool_.press(pressed);
}

void MouseInput::handle(const ButtonRelease& release) {
  move_cursor(release.at);
  modifiers_ = release.modifiers;
  camera_.release(release.button);
  if (release.button != Button::Left) return;
  placer_.release();
  tool_.release(pointer());
}

void MouseInput::handle(const CursorMove& move) {
  const glm::dvec2 from = pointer().at;
  move_cursor(move.at);
  modifiers_ = move.modifiers;
  camera_.move(from, pointer());
}

void MouseInput::handle(const Scroll& scroll) {
  if (!panels_cover(panels_, context_.layout, scroll.at.x, scroll.at.y)) camera_.zoom(scroll.steps, pointer().at);
}

}  // namespace hooke
