// ImGui's place in the window: what GLFW tells it, and its frames. The only file of app that knows ImGui.
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

  // As GLFW's callbacks of the same meaning.
  void key(int key, int scancode, int action, int mods);
  void character(unsigned code);
  void button(int button, int action, int mods);
  void scroll(double x, double y);
  void focus(int focused);
  void enter(int entered);

  // A text is being typed: keys are letters.
  bool wants_text() const;

  void begin_frame();
  const ImDrawData* end_frame();

 private:
  GLFWwindow* window_;
};

}  // namespace hooke
