#include "app/view/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "draw/camera_text.h"
#include "edit/copy_selection.h"

namespace hooke {
namespace {

constexpr double zoom_per_step = 0.88;
constexpr double flight_seconds = 0.5;
constexpr double turn_per_height = 3.14159265358979323846;  // [rad], for a drag over the height of the view

constexpr const char* flat_only_from_front = "A flat scene is always viewed from the front: set Dimensions to 3-D to turn it";

}  // namespace

void CameraControl::show(const Scene& scene) {
  dimensions_known_ = false;
  flight_.reset();
  context_.camera = make_scene_camera(scene.view, scene.system, scene.state, aspect_ratio());
}

// A running scene without nails would soon be out of view again: the camera follows it.
void CameraControl::frame_all() {
  flight_.reset();
  frame_scene(context_.camera, context_.system(), context_.snapshot().state, aspect_ratio());
  const bool is_held = std::ranges::any_of(context_.system().points(), &Point::nailed);
  if (!context_.status->run.running || is_held || context_.camera.follows || context_.system().points().empty()) return;
  context_.camera.follows = true;
  panels_.show_toast("Following moving objects; " + key_text(shortcut_of(Action::FollowScene)) + " stops it");
}

void CameraControl::frame_selection() {
  const Scene part = copy_selection(context_.snapshot(), context_.status->document->sheet, context_.selection);
  if (part.system.points().empty()) return panels_.show_toast("No point or spring is selected");
  flight_.reset();
  frame_scene(context_.camera, part.system, part.state, aspect_ratio());
}

void CameraControl::fly_to_selection() {
  const Camera from = context_.camera;
  frame_selection();
  const Camera to = std::exchange(context_.camera, from);
  flight_ = {from, to, std::chrono::steady_clock::now()};
}

void CameraControl::look_from(const Vec3& direction) {
  flight_.reset();
  if (is_flat()) return panels_.show_toast(flat_only_from_front);
  const bool is_there = glm::dot(context_.camera.back, glm::normalize(direction)) > 1.0 - 1e-9;
  context_.camera.look_from(is_there ? -direction : direction);
}

void CameraControl::switch_projection() {
  context_.camera.orthographic = !context_.camera.orthographic;
  panels_.show_toast(context_.camera.orthographic ? "Orthographic" : "Perspective");
}

void CameraControl::switch_following() {
  context_.camera.follows = !context_.camera.follows;
  panels_.show_toast(context_.camera.follows ? "Following moving objects" : "Not following");
}

void CameraControl::copy() {
  const std::string text = camera_text(pose_of(context_.camera));
  clipboard_.put(text);
  panels_.show_toast("Copied camera: " + text);
}

void CameraControl::paste() {
  const auto pose = camera_from_text(clipboard_.take());
  if (!pose) return panels_.show_toast("The clipboard contains no camera");
  ViewSettings view;
  view.camera = pose;
  view.camera->follows = context_.camera.follows;
  const Camera pasted = make_camera(view, context_.system(), context_.snapshot().state, aspect_ratio());
  if (is_flat() && pasted.back != context_.camera.back) return panels_.show_toast(flat_only_from_front);
  flight_.reset();
  context_.camera = pasted;
  panels_.show_toast("Pasted camera");
}

void CameraControl::move(const glm::dvec2& from, const Pointer& to) {
  if (!button_) return;
  const bool pan = is_flat() || (*button_ == Button::Middle && to.modifiers.shift);
  if (pan) return context_.camera.pan(from, to.at, context_.size);
  const glm::dvec2 angle = (to.at - from) * turn_per_height / context_.size.y;
  context_.camera.orbit(-angle.x, angle.y);
}

void CameraControl::release(Button button) {
  if (button_ == button) button_.reset();
}

void CameraControl::zoom(double steps, const glm::dvec2& at) {
  flight_.reset();
  context_.camera.zoom(std::pow(zoom_per_step, steps), at, context_.size);
}

// A scene that becomes flat is viewed from the front; one that becomes 3-D, in perspective.
void CameraControl::follow() {
  const int dimensions = context_.system().dimensions;
  if (std::exchange(dimensions_, dimensions) != dimensions && dimensions_known_) {
    if (dimensions == 2) context_.camera = make_camera({}, context_.system(), context_.snapshot().state, aspect_ratio());
    context_.camera.orthographic = dimensions == 2;
  }
  dimensions_known_ = true;
  if (flight_) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - flight_->start).count();
    const double t = std::min(1.0, seconds / flight_seconds), part = t * t * (3.0 - 2.0 * t);
    const auto& [from, to, start] = *flight_;
    context_.camera.target = glm::mix(from.target, to.target, part);
    context_.camera.distance = from.distance * std::pow(to.distance / from.distance, part);
    if (t == 1.0) flight_.reset();
  }
  follow_scene(context_.camera, context_.snapshot().state);
}

}  // namespace hooke
