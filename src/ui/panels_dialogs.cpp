// Boxes that ask or tell: open, save as, unsaved changes, what a file was refused for.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "lab/printable.h"
#include "lab/scene_file.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

bool push_button(const char* label) { return ImGui::Button(label, {units(96.0), units(30.0)}); }

// The first button, and Enter; the last one, and Esc.
bool accepted(Panels& panels, const char* label) {
  ImGui::PushStyleColor(ImGuiCol_Button, palette::tinted);
  const bool pressed = push_button(label);
  ImGui::PopStyleColor();
  return pressed || panels.dialog.accepted;
}
bool cancelled(Panels& panels) {
  ImGui::SameLine();
  return push_button("Cancel") || panels.dialog.cancelled;
}

void close(Panels& panels) {
  panels.dialog = {};
  ImGui::CloseCurrentPopup();
}

void path_line(Panels& panels) {
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(units(460.0));
  ImGui::InputText("##path", &panels.dialog.typed);
}

void message_box(const Desk&, Panels& panels, Requests&) {
  ImGui::PushTextWrapPos(units(480.0));
  ImGui::TextUnformatted(panels.dialog.text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  if (accepted(panels, "OK") || panels.dialog.cancelled) close(panels);
}

void open_box(const Desk&, Panels& panels, Requests& requests) {
  dim_text("Path of a scene file");
  path_line(panels);
  bool chosen = false;
  dim_text("or a scene that comes with Hooke");
  ImGui::BeginChild("shipped", {units(460.0), units(200.0)});
  for (const ShippedScene& scene : shipped_scenes()) {
    ImGui::PushID(scene.id.c_str());
    ImGui::SetCursorPosX(units(8.0));
    if (ImGui::Selectable(printable(scene.title).c_str(), panels.dialog.typed == scene.file.string())) {
      panels.dialog.typed = scene.file.string();
      chosen = true;
    }
    ImGui::PopID();
  }
  ImGui::EndChild();
  ImGui::Spacing();
  chosen = accepted(panels, "Open") || chosen;
  if (cancelled(panels)) return close(panels);
  if (!chosen || panels.dialog.typed.empty()) return;
  requests.emplace_back(OpenFile{panels.dialog.typed});
  close(panels);
}

void save_box(const Desk& desk, Panels& panels, Requests& requests) {
  dim_text("Path of the scene file");
  path_line(panels);
  std::error_code error;
  const bool replaces = panels.dialog.typed != desk.file && std::filesystem::is_regular_file(panels.dialog.typed, error);
  text_in(palette::warning, replaces ? "There is such a file: it will be replaced." : " ");
  ImGui::Spacing();
  const bool chosen = accepted(panels, replaces ? "Replace" : "Save");
  if (cancelled(panels)) {
    requests.emplace_back(Answer::Cancel);
    return close(panels);
  }
  if (!chosen || panels.dialog.typed.empty()) return;
  requests.emplace_back(SaveFile{panels.dialog.typed});
  close(panels);
}

void unsaved_box(const Desk&, Panels& panels, Requests& requests) {
  ImGui::TextUnformatted("The scene has changes that are not saved.");
  ImGui::Spacing();
  struct Button {
    const char* label;
    Answer answer;
  };
  std::optional<Answer> answer;
  if (accepted(panels, "Save")) answer = Answer::Save;
  ImGui::SameLine();
  if (push_button("Discard")) answer = Answer::Discard;
  if (cancelled(panels)) answer = Answer::Cancel;
  if (!answer) return;
  close(panels);
  requests.emplace_back(*answer);
}

void texture_box(const Desk&, Panels& panels, Requests& requests) {
  dim_text("Path of a PNG in the folder of the scene");
  path_line(panels);
  ImGui::Spacing();
  const bool chosen = accepted(panels, "Choose");
  if (cancelled(panels)) return close(panels);
  if (!chosen || panels.dialog.typed.empty()) return;
  requests.emplace_back(ChooseTexture{panels.dialog.typed});
  close(panels);
}

struct Question {
  const char* title;
  void (*build)(const Desk& desk, Panels& panels, Requests& requests);
};
// In the order of Dialog::Kind, after None.
constexpr Question questions[] = {{"Message", message_box},
                                  {"Open a scene", open_box},
                                  {"Save the scene as", save_box},
                                  {"Save the changes?", unsaved_box},
                                  {"Put a picture on the cloth", texture_box}};

}  // namespace

void build_dialogs(const Desk& desk, Panels& panels, Requests& requests) {
  if (panels.dialog.kind == Dialog::Kind::None) return;
  const Question& question = questions[static_cast<int>(panels.dialog.kind) - 1];
  const std::string heading = panels.dialog.title.empty() ? question.title : printable(panels.dialog.title);
  if (panels.dialog.is_new) ImGui::OpenPopup(question.title);
  panels.dialog.is_new = false;

  ImGui::SetNextWindowPos({0.5f * ImGui::GetIO().DisplaySize.x, 0.42f * ImGui::GetIO().DisplaySize.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(20.0), units(16.0)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, units(8.0));
  if (ImGui::BeginPopupModal(
          question.title, nullptr,
          ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
    ImGui::PushFont(fonts().strong);
    ImGui::TextUnformatted(heading.c_str());
    ImGui::PopFont();
    ImGui::Dummy({0.0f, units(4.0)});
    question.build(desk, panels, requests);
    panels.dialog.accepted = panels.dialog.cancelled = false;
    ImGui::EndPopup();
  } else {
    panels.dialog = {};
  }
  ImGui::PopStyleVar(2);
}

}  // namespace hooke
