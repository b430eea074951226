#include "app/gui_glue.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

namespace hooke {

GuiGlue::GuiGlue(GLFWwindow* window) : window_(window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window, false);
}

GuiGlue::~GuiGlue() {
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void GuiGlue::key(int key, int scancode, int action, int mods) { ImGui_ImplGlfw_KeyCallback(window_, key, scancode, action, mods); }
void GuiGlue::character(unsigned code) { ImGui_ImplGlfw_CharCallback(window_, code); }
void GuiGlue::button(int button, int action, int mods) { ImGui_ImplGlfw_MouseButtonCallback(window_, button, action, mods); }
void GuiGlue::scroll(double x, double y) { ImGui_ImplGlfw_ScrollCallback(window_, x, y); }
void GuiGlue::focus(int focused) { ImGui_ImplGlfw_WindowFocusCallback(window_, focused); }
void GuiGlue::enter(int entered) { ImGui_ImplGlfw_CursorEnterCallback(window_, entered); }

bool GuiGlue::wants_text() const { return ImGui::GetIO().WantTextInput; }

void GuiGlue::begin_frame() {
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

const ImDrawData* GuiGlue::end_frame() {
  ImGui::Render();
  return ImGui::GetDrawData();
}

}  // namespace hooke
