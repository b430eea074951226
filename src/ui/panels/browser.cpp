// The file browser: locations on the left, their content on the right.
#include <algorithm>

#include "base/printable.h"
#include "formats/open_file.h"
#include "formats/scene_file.h"
#include "lab/recording.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

constexpr double places_width = 168.0;  // [design units]

// The preferred size, limited to what fits into the window. [design units]
double width() { return std::clamp(ImGui::GetIO().DisplaySize.x / units(1.0) - 64.0, 300.0, 640.0); }
double height() { return std::clamp(ImGui::GetIO().DisplaySize.y / units(1.0) - 220.0, 80.0, 300.0); }

// Age after which a folder is listed again [s].
constexpr double stale_after = 2.0;

bool is_readable(const fs::path& file) {
  if (file.extension() == recording_extension) return true;
  const FileKind* kind = find_readable_kind(file);
  return kind != nullptr && kind->parse != nullptr;
}

void refresh(Browser& browser, FileDialogMode mode, bool picks_mesh) {
  const double now = ImGui::GetTime();
  if (browser.listing.folder == browser.folder && now < browser.listed_at + stale_after) return;
  browser.listing = list_folder(browser.folder, [&](const fs::path& file) {
    if (const FileKind* kind = find_readable_kind(file); picks_mesh) return kind != nullptr && kind->is_mesh;
    return mode == FileDialogMode::Open ? is_readable(file) : is_scene_file(file);
  });
  browser.listed_at = now;
}

// A name on the left, a remark on the right; names need not be unique, ids must.
bool row(const char* id, const std::string& name, const std::string& remark, bool chosen, Icon icon, bool* twice = nullptr) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float end = at.x + ImGui::GetContentRegionAvail().x;
  ImGui::PushStyleColor(ImGuiCol_Header, palette::tinted);
  const bool clicked =
      ImGui::Selectable(id, chosen, ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups, {0.0f, units(22.0)});
  ImGui::PopStyleColor();
  if (twice != nullptr) *twice = clicked && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = at.y + 0.5f * units(22.0) - 0.5f * ImGui::GetFontSize();
  draw_icon(list, icon, {at.x + units(12.0), at.y + units(11.0)}, units(13.0), icon == Icon::Folder ? palette::accent : palette::dim);
  follow_text(name);
  const float remark_width = ImGui::CalcTextSize(remark.c_str()).x;
  list.PushClipRect(at, {end - remark_width - units(16.0), at.y + units(24.0)}, true);
  list.AddText({at.x + units(26.0), middle}, palette::text, name.c_str());
  list.PopClipRect();
  list.AddText({end - remark_width - units(6.0), middle}, palette::dim, remark.c_str());
  return clicked;
}

void place(Dialog& dialog, FileDialogMode mode, const char* name, const fs::path& folder) {
  const Browser& browser = dialog.browser;
  const bool here = browser.place == Browser::Place::Folder && browser.folder == folder;
  if (row(("##" + folder.string()).c_str(), name, "", here, Icon::Folder)) go_to_folder(dialog, folder, mode);
  tooltip(printable(folder.native()));
}

void place_row(Dialog& dialog, const char* name, Browser::Place which) {
  if (row(name, name, "", dialog.browser.place == which, Icon::Scene)) dialog.browser.place = which;
}

void places(const PanelInput& input, Dialog& dialog, FileDialogMode mode) {
  ImGui::BeginChild("places", {units(places_width), units(height())});
  if (mode == FileDialogMode::Open && !dialog.picks_mesh) {
    ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(0, 0, 0, 0));
    place_row(dialog, "Recent", Browser::Place::Recent);
    place_row(dialog, "Shipped with Hooke", Browser::Place::Shipped);
    ImGui::PopStyleColor();
    ImGui::Dummy({0.0f, units(4.0)});
  }
  place(dialog, mode, "Home", home_folder());
  place(dialog, mode, "File system", "/");
  std::vector<fs::path> shown = {home_folder(), "/"};
  for (const fs::path& file : input.recent) {
    const fs::path folder = file.parent_path();
    if (std::ranges::find(shown, folder) != shown.end() || shown.size() >= 8) continue;
    shown.push_back(folder);
    place(dialog, mode, printable(folder.filename().native(), 24).c_str(), folder);
  }
  ImGui::EndChild();
}

// The path of the folder; clicking a part goes there.
void breadcrumbs(Dialog& dialog, FileDialogMode mode) {
  const fs::path folder = dialog.browser.folder;
  // only the last parts
  std::vector<fs::path> parts;
  for (fs::path part = folder; parts.size() < 4; part = part.parent_path()) {
    parts.push_back(part);
    if (part == part.parent_path()) break;
  }
  ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(0, 0, 0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {units(1.0), 0.0f});
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    const std::string name = part->has_filename() ? printable(part->filename().native(), 24) : "/";
    if (part != parts.rbegin()) ImGui::SameLine();
    if (ImGui::Button((name + "##" + part->string()).c_str())) go_to_folder(dialog, *part, mode);
    if (part + 1 == parts.rend() || !part->has_filename()) continue;
    ImGui::SameLine();
    dim_text("/");
  }
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

// A sentence in place of rows, or below them, aligned with them.
void note(const std::string& text, ImU32 color = palette::dim) {
  const float edge = units(8.0);
  ImGui::SetCursorPos({ImGui::GetCursorPosX() + edge, ImGui::GetCursorPosY() + units(6.0)});
  text_in(color, wrapped(text, ImGui::GetContentRegionAvail().x - edge));
}

bool folder_list(Dialog& dialog, FileDialogMode mode) {
  Browser& browser = dialog.browser;
  refresh(browser, mode, dialog.picks_mesh);
  if (!browser.listing.error.empty()) note("Cannot read this folder: " + browser.listing.error, palette::warning);
  if (browser.listing.items.empty() && browser.listing.error.empty())
    note(dialog.picks_mesh              ? "No folders or meshes here."
         : mode == FileDialogMode::Save ? "No folders or scenes here."
                                        : "No folders, scenes or recordings here.");

  const fs::path folder = browser.folder, chosen_path = resolved_path(dialog);
  fs::path next;
  bool confirmed = false;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(browser.listing.items.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const FolderItem& item = browser.listing.items[static_cast<std::size_t>(i)];
      const fs::path path = folder / item.name;
      bool twice = false;
      const bool clicked = row(("##" + item.name).c_str(), printable(item.name), item.modified, !item.is_folder && path == chosen_path,
                               item.is_folder ? Icon::Folder : Icon::Scene, &twice);
      if (clicked && item.is_folder) next = path;
      if (clicked && !item.is_folder) dialog.typed = path.string();
      confirmed = confirmed || (twice && !item.is_folder);
    }
  }
  clipper.End();
  if (browser.listing.truncated) note("Not all files are shown; type a name to open others.");
  if (!next.empty()) go_to_folder(dialog, next, mode);
  return confirmed;
}

bool recent_list(const PanelInput& input, Dialog& dialog) {
  if (input.recent.empty()) note("No files opened or saved yet.");
  bool confirmed = false;
  for (const fs::path& file : input.recent) {
    bool twice = false;
    if (row(("##" + file.string()).c_str(), printable(file.stem().native()), printable(file.parent_path().native(), 36),
            dialog.typed == file.string(), Icon::Scene, &twice))
      dialog.typed = file.string();
    confirmed = confirmed || twice;
  }
  return confirmed;
}

// A click opens the scene immediately.
bool shipped_list(Dialog& dialog) {
  bool chosen = false;
  for (const ShippedScene& scene : shipped_scenes()) {
    if (row(("##" + scene.id).c_str(), printable(scene.title), scene.id, false, Icon::Scene)) {
      dialog.typed = scene.file.string();
      chosen = true;
    }
  }
  return chosen;
}

}  // namespace

// A path typed in place of the selected name is a path of its own: "/home/ada//tmp/net.json" is /tmp/net.json, and an extension that was
// typed before the one that is there counts once.
fs::path resolved_path(const Dialog& dialog) {
  std::string typed = dialog.typed;
  if (const std::size_t at = typed.rfind("//"); at != std::string::npos) typed.erase(0, at + 1);
  if (const std::size_t at = typed.rfind("/~/"); at != std::string::npos) typed.erase(0, at + 1);
  if (const fs::path name = fs::path(typed).stem(); typed.ends_with(".json") && find_file_kind(name) != nullptr)
    typed.resize(typed.size() - 5);
  return resolve_typed_path(typed, dialog.browser.folder);
}

void go_to_folder(Dialog& dialog, const fs::path& folder, FileDialogMode mode) {
  const fs::path name = resolved_path(dialog).filename();
  dialog.browser.folder = folder.has_filename() ? folder : folder.parent_path();
  dialog.browser.place = Browser::Place::Folder;
  ++dialog.text_version;
  dialog.typed = mode == FileDialogMode::Save && !dialog.typed.empty() ? (folder / name).string() : std::string();
}

bool build_browser(const PanelInput& input, Dialog& dialog, FileDialogMode mode) {
  places(input, dialog, mode);
  ImGui::SameLine();
  ImGui::BeginGroup();
  const bool shows_folder = dialog.browser.place == Browser::Place::Folder;
  const float above = shows_folder ? units(34.0) : 0.0f;
  if (shows_folder) breadcrumbs(dialog, mode);
  ImGui::BeginChild(shows_folder ? "files" : "list", {units(width() - places_width), units(height()) - above});
  const bool chosen = shows_folder                                     ? folder_list(dialog, mode)
                      : dialog.browser.place == Browser::Place::Recent ? recent_list(input, dialog)
                                                                       : shipped_list(dialog);
  ImGui::EndChild();
  ImGui::EndGroup();
  return chosen;
}

}  // namespace hooke
