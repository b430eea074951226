// Connects ImGui to the window: its input from GLFW, and its frames. The only part of app that includes ImGui.
#pragma once

struct GLFWwindow;
struct ImDrawData;

namespace hooke {

class ImGuiBackend {
 public:
  explicit ImGuiBackend(GLFWwindow* window);
  ~ImGuiBackend();
  ImGuiBackend(const ImGuiBackend&) = delete;
  ImGuiBackend& operator=(const ImGuiBackend&) = delete;

  // Forward the callbacks of GLFW.
  void key(int key, int scancode, int action, int mods);
  void character(unsigned code);
  void button(int button, int action, int mods);
  void scroll(double x, double y);
  void focus(int focused);
  void enter(int entered);

  // Whether a text field has keyboard focus.
  bool wants_text() const;

  void begin_frame();
  const ImDrawData* end_frame();

 private:
  GLFWwindow* window_;
};

}  // namespace hooke
