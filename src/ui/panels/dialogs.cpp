// Modal dialogs: open, save as, unsaved changes, recovery, progress, messages.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "base/option_error.h"
#include "base/printable.h"
#include "formats/file_kind.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

bool push_button(const char* label) {
  const float text = ImGui::CalcTextSize(label, nullptr, true).x;
  return ImGui::Button(label, {std::max(units(96.0), text + units(24.0)), units(30.0)});
}

bool enter_pressed(const PanelInput& input) { return input.presses(PanelKey::Target::Dialog, Key::Enter) > 0 && !has_focused_item(); }
bool escape_pressed(const PanelInput& input) { return input.presses(PanelKey::Target::Dialog, Key::Escape) > 0; }

// The first button, also pressed by Enter.
bool accepted(const PanelInput& input, const char* label) {
  ImGui::PushStyleColor(ImGuiCol_Button, palette::tinted);
  const bool pressed = push_button(label);
  ImGui::PopStyleColor();
  return pressed || enter_pressed(input);
}
// The last button, also pressed by Esc.
bool canceled(const PanelInput& input) {
  ImGui::SameLine();
  return push_button("Cancel") || escape_pressed(input);
}

void close(Panels& panels) {
  panels.dialog = {};
  ImGui::CloseCurrentPopup();
}

// The name without folder and extension is what is usually changed.
int select_name(ImGuiInputTextCallbackData* data) {
  bool& wanted = *static_cast<bool*>(data->UserData);
  if (!std::exchange(wanted, false)) return 0;
  const std::string_view path(data->Buf, static_cast<std::size_t>(data->BufTextLen));
  const std::size_t folder = path.rfind('/'), name = folder == std::string_view::npos ? 0 : folder + 1, dot = path.rfind('.');
  const std::size_t end = dot == std::string_view::npos || dot <= name ? path.size() : dot;
  data->SelectionStart = static_cast<int>(name);
  data->SelectionEnd = data->CursorPos = static_cast<int>(end);
  return 0;
}

void path_line(Panels& panels) {
  int& shown = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("anew"), -1);
  if (ImGui::IsWindowAppearing() || shown != panels.dialog.text_version) {
    ImGui::SetKeyboardFocusHere();
    panels.dialog.selects_name = panels.dialog.kind == Dialog::Kind::Save;
  }
  shown = panels.dialog.text_version;
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::PushID(shown);
  follow_text(panels.dialog.typed);
  const RareCharacters kept(panels.dialog.typed);
  ImGui::InputTextWithHint("##path", "Name or path", &panels.dialog.typed, ImGuiInputTextFlags_CallbackAlways, select_name,
                           &panels.dialog.selects_name);
  ImGui::PopID();
}

// Of the text in a dialog of a width [design units].
float text_width(double desired) { return std::max(1.0f, box_width(desired) - 2.0f * ImGui::GetStyle().WindowPadding.x); }

void message_box(const PanelInput& input, Panels& panels, Requests& requests) {
  ImGui::TextUnformatted(wrapped(panels.dialog.text, text_width(480.0)).c_str());
  ImGui::Spacing();
  std::vector<Choice>& choices = panels.dialog.choices;
  if (choices.empty()) {
    if (accepted(input, "OK") || escape_pressed(input)) close(panels);
    return;
  }
  std::optional<Request> chosen;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    if (i == 0 ? accepted(input, choices[i].label.c_str()) : push_button(choices[i].label.c_str())) chosen = choices[i].request;
  }
  if (escape_pressed(input)) chosen = choices.back().request;
  if (!chosen) return;
  close(panels);
  requests.push_back(std::move(*chosen));
}

// Shows a typed folder. Returns false if the text is not a folder.
bool goes_to_folder(Panels& panels, FileDialogMode mode) {
  std::error_code error;
  const std::filesystem::path chosen_path = resolved_path(panels.dialog);
  if (!std::filesystem::is_directory(chosen_path, error)) return false;
  panels.dialog.typed.clear();
  go_to_folder(panels.dialog, chosen_path, mode);
  return true;
}

void desktop_button(const PanelInput& input, Panels& panels, Requests& requests, bool to_save) {
  if (!input.has_desktop_dialog) return;
  ImGui::SameLine(0.0f, units(24.0));
  if (!ImGui::Button("System dialog", {0.0f, units(30.0)})) return;
  requests.emplace_back(OpenSystemDialog{to_save});
  close(panels);
}

// A field for each option of a mesh.
void import_fields(Dialog& dialog) {
  const FileKind* kind = find_readable_kind(dialog.typed);
  if (dialog.picks_mesh || kind == nullptr || !kind->is_mesh) return dialog.import_texts.clear();
  dialog.import_texts.resize(import_options().size());
  for (std::size_t i = 0; i < import_options().size(); ++i) {
    const ImportOption& row = import_options()[i];
    const std::string name(row.name), hint = name + " " + std::string(row.value);
    if (i > 0) ImGui::SameLine();
    ImGui::SetNextItemWidth(units(120.0));
    ImGui::InputTextWithHint(("##import_" + name).c_str(), hint.c_str(), &dialog.import_texts[i]);
    tooltip(std::string(row.description));
  }
}

// Throws UsageError.
ImportOptions typed_options(const Dialog& dialog) {
  ImportOptions options;
  for (std::size_t i = 0; i < dialog.import_texts.size(); ++i)
    if (!dialog.import_texts[i].empty()) import_options()[i].set(options, dialog.import_texts[i]);
  return options;
}

void open_box(const PanelInput& input, Panels& panels, Requests& requests) {
  bool chosen = build_browser(input, panels.dialog, FileDialogMode::Open);
  path_line(panels);
  import_fields(panels.dialog);
  ImGui::Spacing();
  chosen = accepted(input, "Open") || chosen;
  if (canceled(input)) return close(panels);
  if (!panels.dialog.picks_mesh) desktop_button(input, panels, requests, false);
  if (!chosen || panels.dialog.typed.empty() || goes_to_folder(panels, FileDialogMode::Open)) return;
  const std::filesystem::path chosen_path = resolved_path(panels.dialog);
  if (panels.dialog.picks_mesh) {
    panels.placement.mesh_path = chosen_path.string();
    requests.emplace_back(LoadMesh{chosen_path});
  } else {
    try {
      requests.emplace_back(OpenFile{chosen_path, typed_options(panels.dialog)});
    } catch (const OptionError& refusal) {
      return panels.show_message("Cannot open the mesh", refusal.as_argument());
    }
  }
  close(panels);
}

void save_box(const PanelInput& input, Panels& panels, Requests& requests) {
  bool chosen = build_browser(input, panels.dialog, FileDialogMode::Save);
  path_line(panels);
  std::error_code error;
  const std::filesystem::path chosen_path = resolved_path(panels.dialog);
  const bool replaces = chosen_path != input.file && std::filesystem::is_regular_file(chosen_path, error);
  text_in(palette::warning, replaces ? "A file with this name exists" : " ");
  // Enter goes to the button that replaces a file, and only there presses it
  if (replaces && enter_pressed(input)) ImGui::SetKeyboardFocusHere();
  chosen = (replaces ? push_button("Replace") : accepted(input, "Save")) || (chosen && !replaces);
  if (canceled(input)) {
    requests.emplace_back(Answer::Cancel);
    return close(panels);
  }
  desktop_button(input, panels, requests, true);
  if (!chosen || panels.dialog.typed.empty() || goes_to_folder(panels, FileDialogMode::Save)) return;
  requests.emplace_back(SaveFile{chosen_path});
  close(panels);
}

void unsaved_box(const PanelInput& input, Panels& panels, Requests& requests) {
  ImGui::TextUnformatted(wrapped(panels.dialog.text, text_width(480.0)).c_str());
  ImGui::Spacing();
  struct Button {
    const char* label;
    Answer answer;
  };
  std::optional<Answer> answer;
  if (accepted(input, "Save")) answer = Answer::Save;
  ImGui::SameLine();
  if (push_button("Discard")) answer = Answer::Discard;
  if (canceled(input)) answer = Answer::Cancel;
  if (!answer) return;
  close(panels);
  requests.emplace_back(*answer);
}

void texture_box(const PanelInput& input, Panels& panels, Requests& requests) {
  dim_text("Path of a PNG file in the folder of the scene");
  ImGui::Dummy({units(460.0), 0.0f});
  path_line(panels);
  ImGui::Spacing();
  const bool chosen = accepted(input, "Choose");
  if (canceled(input)) return close(panels);
  if (!chosen || panels.dialog.typed.empty()) return;
  requests.emplace_back(ChooseTexture{panels.dialog.typed});
  close(panels);
}

void recovery_box(const PanelInput& input, Panels& panels, Requests& requests) {
  const float width = text_width(520.0);
  const char* text = input.recovered.size() == 1 ? "Hooke ended before this scene was saved. You can restore the last autosave."
                                                 : "Hooke ended before these scenes were saved. You can restore the last autosaves.";
  ImGui::TextUnformatted(wrapped(text, width).c_str());
  ImGui::Spacing();
  std::optional<Request> request;
  for (std::size_t i = 0; i < input.recovered.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::TextUnformatted(wrapped(input.recovered[i].title, width).c_str());
    dim_text(wrapped(input.recovered[i].detail, width));
    if (push_button("Restore") || (i == 0 && enter_pressed(input))) request = Recover{i};
    ImGui::SameLine();
    if (push_button("Delete")) requests.emplace_back(DiscardRecovery{i});
    ImGui::PopID();
    ImGui::Dummy({0.0f, units(4.0)});
  }
  if (push_button("Later") || escape_pressed(input) || input.recovered.empty()) return close(panels);
  ImGui::SameLine();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + units(6.0));
  dim_text("The remaining ones are offered again at the next start.");
  if (!request) return;
  close(panels);
  requests.push_back(*request);
}

void working_box(const PanelInput& input, Panels& panels, Requests& requests) {
  const FileWork& work = input.work;
  if (!work.is_running) return close(panels);
  ImGui::TextUnformatted(printable(work.what, 60).c_str());
  ImGui::Spacing();
  progress_bar(work.fraction, work.seconds, units(420.0));
  ImGui::Spacing();
  if (work.is_stopping)
    dim_text("Stopping...");
  else if (push_button("Cancel") || escape_pressed(input))
    requests.emplace_back(CancelWork{});
}

struct DialogRow {
  const char* title;
  void (*build)(const PanelInput& input, Panels& panels, Requests& requests);
};
// In the order of Dialog::Kind, after None.
constexpr DialogRow dialog_rows[] = {{"Message", message_box},          {"Open scene", open_box},
                                     {"Save scene as", save_box},       {"Save changes?", unsaved_box},
                                     {"Choose a texture", texture_box}, {"Unsaved work found", recovery_box},
                                     {"Please wait", working_box}};

}  // namespace

void build_dialogs(const PanelInput& input, Panels& panels, Requests& requests) {
  if (panels.dialog.kind == Dialog::Kind::None && !panels.waiting.empty()) {
    panels.dialog = std::move(panels.waiting.front());
    panels.waiting.pop_front();
  }
  if (panels.dialog.kind == Dialog::Kind::None) return;
  const DialogRow& row = dialog_rows[static_cast<int>(panels.dialog.kind) - 1];
  const std::string heading = panels.dialog.title.empty() ? row.title : printable(panels.dialog.title);
  if (panels.dialog.is_new) ImGui::OpenPopup(row.title);
  panels.dialog.is_new = false;

  ImGui::SetNextWindowPos({0.5f * ImGui::GetIO().DisplaySize.x, 0.42f * ImGui::GetIO().DisplaySize.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(20.0), units(16.0)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, units(8.0));
  if (ImGui::BeginPopupModal(
          row.title, nullptr,
          ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
    strong_text(heading);
    ImGui::Dummy({0.0f, units(4.0)});
    if (input.presses(PanelKey::Target::Dialog, Key::Enter) > 0 && has_focused_item()) press_focused_item();
    begin_tab_stops();
    row.build(input, panels, requests);
    end_tab_stops();
    ImGui::EndPopup();
  } else {
    panels.dialog = {};
  }
  ImGui::PopStyleVar(2);
}

}  // namespace hooke
