// The window: GLFW, its events in order, and the input of ImGui. Nothing else includes GLFW.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/edit/clipboard.h"
#include "app/window/event.h"
#include "app/window/imgui_backend.h"
#include "app/window/input_queue.h"

struct GLFWwindow;

namespace hooke {

// No display, or no OpenGL 3.3; what() is one line.
struct WindowError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Window {
 public:
  // Opens a window with a current OpenGL 3.3 core context, and an ImGui context that receives its input. Throws WindowError.
  Window(const std::string& title, const glm::ivec2& size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Waits for an event, up to this time [s].
  void wait(double seconds);
  // The events for the next frame, oldest first.
  std::vector<Event> take_events();

  glm::dvec2 size() const;              // in window coordinates
  glm::ivec2 framebuffer_size() const;  // [px]
  double content_scale() const;         // window units per design unit
  bool is_hidden() const;               // iconified, or without area
  double refresh_period() const;        // [s], of the monitor

  void set_title(const std::string& title);
  void swap();
  ImGuiBackend& gui() { return *gui_; }
  // Valid during the lifetime of the window.
  Clipboard clipboard();

 private:
  struct Callbacks;
  struct Press {
    Button button = Button::Left;
    double time = -1.0;  // [s], on the clock of GLFW
    glm::dvec2 at{0.0};
  };
  bool is_second_press(Button button);
  bool is_alt_alone(int key, int action);
  void press_key(const KeyPress& press);
  GLFWwindow* window_ = nullptr;
  std::unique_ptr<ImGuiBackend> gui_;
  InputQueue inputs_;
  std::vector<Event> events_;
  glm::dvec2 cursor_{0.0};
  Press last_press_;
  bool alt_is_alone_ = false;  // pressed, and nothing else since
  std::string title_;
};

}  // namespace hooke
