// App with its panels, without a window and without OpenGL: tests move the mouse, press keys and build frames.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <glm/vec2.hpp>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <thread>

#include "app/app.h"
#include "support/gui_text.h"
#include "support/scratch_folder.h"
#include "ui/theme.h"

namespace hooke {

class GuiFixture {
 public:
  explicit GuiFixture(Scene scene = {}, std::filesystem::path file = {}, const Home& home = {}) {
    // without a document, settings would be written to the home and working folders of the user
    ::setenv("HOME", scratch_.folder.c_str(), 1);
    std::filesystem::current_path(scratch_.folder);
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {1280.0f, 800.0f};
    io.DeltaTime = 1.0f / 60.0f;
    for (int i = 0; i < ImGuiKey_COUNT; ++i) io.KeyMap[i] = i;
    load_fonts(1.0);
    app_ = std::make_unique<App>(std::make_shared<const Scene>(std::move(scene)), std::move(file), home);
    app_->set_event_patience(patience);
    app_->resize({1280.0, 800.0}, 1.0);
    frames(3);
  }
  ~GuiFixture() {
    std::filesystem::current_path(std::filesystem::temp_directory_path());
    ImGui::DestroyContext();
  }

  App& app() { return *app_; }

  // Changes the size and the content scale of the window.
  void resize(const glm::dvec2& size, double scale) {
    scale = fitting_scale(scale, size.x, size.y);
    if (scale != scale_) load_fonts(scale);
    ImGui::GetIO().DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
    app_->resize(size, scale);
    frames(2);
  }

  const Status& status() {
    settle();
    return app_->status();
  }
  const System& system() { return *status().snapshot->system; }
  void settled() { settle(); }

  void frame() {
    ImGui::NewFrame();
    app_->build_frame({});
    ImGui::Render();
    settle();
  }
  void frames(int many) {
    for (int i = 0; i < many; ++i) frame();
  }
  // Builds frames until the condition holds; false if it does not within the patience.
  template <class Condition>
  bool wait_until(const Condition& condition) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > until) return false;
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  // Until a run that was started has ended.
  bool wait_for_end_of_run() {
    return wait_until([&] { return !status().run.running && status().run.frames > 0; });
  }
  // Whether frames wait for file operations; if not, frames continue during them, as in the window.
  bool waits_for_work = true;

  // All text of a frame.
  std::string text() {
    frame();
    return read_text(*ImGui::GetDrawData());
  }

  // Where a position of the scene appears in the window [px].
  glm::dvec2 seen(const Vec3& place) {
    const Rect& scene = app_->layout().scene;
    const Vec3 at = app_->camera().project(place, {scene.width, scene.height});
    return {scene.x + at.x, scene.y + at.y};
  }

  void move(const glm::dvec2& to, Modifiers modifiers = {}) {
    ImGui::GetIO().MousePos = {static_cast<float>(to.x), static_cast<float>(to.y)};
    app_->handle(CursorMove{to, modifiers});
    at_ = to;
    frame();
  }
  void press(Button button = Button::Left, Modifiers modifiers = {}) {
    ImGui::GetIO().MouseDown[static_cast<int>(button)] = true;
    ImGui::GetIO().KeyCtrl = modifiers.control;
    app_->handle(ButtonPress{button, at_, modifiers});
    frame();
  }
  void release(Button button = Button::Left, Modifiers modifiers = {}) {
    ImGui::GetIO().MouseDown[static_cast<int>(button)] = false;
    app_->handle(ButtonRelease{button, at_, modifiers});
    frame();
    ImGui::GetIO().KeyCtrl = false;
  }
  void click(const glm::dvec2& at, Button button = Button::Left, Modifiers modifiers = {}) {
    move(at);
    press(button, modifiers);
    release(button, modifiers);
  }
  void drag(const glm::dvec2& from, const glm::dvec2& to, Button button = Button::Left, Modifiers modifiers = {}) {
    move(from, modifiers);
    press(button, modifiers);
    for (const double fraction : {0.25, 0.5, 0.75, 1.0}) move(from + fraction * (to - from), modifiers);
    release(button, modifiers);
  }
  void key(Key key, Modifiers modifiers = {}, bool repeated = false) {
    app_->handle(KeyPress{key, modifiers, repeated});
    frames(2);
  }
  // An edit of the document, where the scene starts.
  void unnail(Index point) {
    app_->handle(Request(Edit{SetNailed{{{system().points()[point].id, false}}}}));
    frames(2);
  }
  void type(const std::string& text) {
    for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
    frames(2);
  }

  // By its name; "window/child" for a child, whose name continues with a number.
  static const ImGuiWindow* find_window(const std::string& name) {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (window->Active && (window->Name == name || std::string_view(window->Name).starts_with(name + "_"))) return window;
    return nullptr;
  }

  // The center of an item with this path of ids, found by moving the mouse over its whole window, if it is not where it was seen last.
  glm::dvec2 find(const char* window, std::initializer_list<const char*> names) {
    const ImGuiID id = id_of(window, names);
    if (const auto seen = places_.find(id); seen != places_.end()) {
      move(seen->second);
      if (ImGui::GetCurrentContext()->HoveredId == id) return at_;
    }
    glm::dvec2 found(-1.0);
    scan(window, [&](ImGuiID hovered) {
      places_[hovered] = at_;
      if (hovered == id) found = at_;
      return hovered != id;
    });
    return found;
  }
  // All items of a window that the mouse reaches.
  std::set<ImGuiID> items_in(const char* window) {
    std::set<ImGuiID> items;
    scan(window, [&](ImGuiID hovered) { return items.insert(hovered), true; });
    return items;
  }
  static ImGuiID id_of(const char* window, std::initializer_list<const char*> names) {
    const ImGuiWindow* found = find_window(window);
    ImGuiID id = found != nullptr ? found->ID : 0;
    for (const char* name : names) id = ImHashStr(name, 0, id);
    return id;
  }

 private:
  // Moves the mouse over a window until `visit` returns false for the item below it.
  template <class Visit>
  void scan(const char* window, const Visit& visit) {
    const ImGuiWindow* found = find_window(window);
    if (found == nullptr) return;
    const glm::dvec2 min(found->Pos.x, found->Pos.y), size(found->Size.x, found->Size.y);
    for (double y = 2.0; y < size.y; y += 5.0)
      for (const double fraction : {0.7, 0.42, 0.1, 0.06, 0.13, 0.92}) {
        move(min + glm::dvec2(fraction * size.x, y));
        if (!visit(ImGui::GetCurrentContext()->HoveredId)) return;
      }
  }
  // Far longer than any machine needs, so that the test does not fail on a slow machine.
  static constexpr auto patience = std::chrono::seconds(60);

  // Waits until every submitted command has taken effect.
  void settle() {
    if (waits_for_work) app_->wait_for_file_task();
    if (!app_->settle()) ADD_FAILURE() << "the laboratory did not settle within a minute";
  }
  void load_fonts(double scale) {
    scale_ = scale;
    load_theme(scale, 1.0);
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  }

  ScratchFolder scratch_;
  double scale_ = 1.0;
  std::unique_ptr<App> app_;
  glm::dvec2 at_{-1.0};
  std::map<ImGuiID, glm::dvec2> places_;  // where the mouse found items
};

}  // namespace hooke
