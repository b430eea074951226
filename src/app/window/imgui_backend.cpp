#include "app/window/imgui_backend.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

namespace hooke {

ImGuiBackend::ImGuiBackend(GLFWwindow* window) : window_(window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window, false);
}

ImGuiBackend::~ImGuiBackend() {
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void ImGuiBackend::key(int key, int scancode, int action, int mods) {
  ImGui_ImplGlfw_KeyCallback(window_, key, scancode, action, mods);
  // it takes the modifiers that are down now, which may be after their release
  if (action != GLFW_PRESS || key >= GLFW_KEY_LEFT_SHIFT) return;
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = (mods & GLFW_MOD_CONTROL) != 0;
  io.KeyShift = (mods & GLFW_MOD_SHIFT) != 0;
  io.KeyAlt = (mods & GLFW_MOD_ALT) != 0;
}
void ImGuiBackend::character(unsigned code) { ImGui_ImplGlfw_CharCallback(window_, code); }
void ImGuiBackend::button(int button, int action, int mods) { ImGui_ImplGlfw_MouseButtonCallback(window_, button, action, mods); }
void ImGuiBackend::scroll(double x, double y) { ImGui_ImplGlfw_ScrollCallback(window_, x, y); }
void ImGuiBackend::focus(int focused) { ImGui_ImplGlfw_WindowFocusCallback(window_, focused); }
void ImGuiBackend::enter(int entered) { ImGui_ImplGlfw_CursorEnterCallback(window_, entered); }

bool ImGuiBackend::wants_text() const { return ImGui::GetIO().WantTextInput; }

void ImGuiBackend::begin_frame() {
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

const ImDrawData* ImGuiBackend::end_frame() {
  ImGui::Render();
  return ImGui::GetDrawData();
}

}  // namespace hooke
