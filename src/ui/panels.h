// The panels of the window. They read a PanelInput, keep Panels between frames, and return Requests; nothing else is
// touched, so they run in tests without a window.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/folder_listing.h"
#include "draw/view.h"
#include "lab/status.h"
#include "scene/selection.h"
#include "ui/export_state.h"
#include "ui/icons.h"
#include "ui/layout.h"
#include "ui/placement.h"
#include "ui/requests.h"
#include "ui/theme.h"
#include "ui/tool_buttons.h"

namespace hooke {

struct Forecast;

// Unsaved work that a killed run left behind.
struct RecoveryEntry {
  std::string title, detail;
};

// What the panels look at.
struct PanelInput {
  const Status& status;
  const Selection& selection;
  Layout layout;
  std::span<const ToolButton> tools;
  Action tool;                 // in hand
  std::string next_step;       // what it waits for: "click the second point, Esc cancels"
  std::filesystem::path file;  // of the document; empty: it has none
  double frames_per_second = 0.0, draw_ms = 0.0;
  double film_seconds = -1.0;                     // of the film in progress; below 0: none
  std::optional<Rect> rubber_band;                // of a selection in progress, in window coordinates
  std::vector<glm::dvec2> stroke;                 // of a cut in progress, from the scene's corner
  std::span<const std::filesystem::path> recent;  // files, newest first
  std::span<const RecoveryEntry> left;
  bool has_desktop_dialog = false;
  Camera camera{};
  const Forecast* forecast = nullptr;  // null: none is made
};

// Where a dialog looks for files.
struct Browser {
  enum class Place { Folder, Recent, Shipped };
  Place place = Place::Folder;
  std::filesystem::path folder;
  FolderListing listing;
  double listed_at = 0.0;  // [s], ImGui's clock
};

struct Choice {
  std::string label;
  Request request;
};

struct Dialog {
  enum class Kind { None, Message, Open, Save, Unsaved, Texture, Recovery, Working };
  Kind kind = Kind::None;
  std::string title, text;      // of a message
  std::vector<Choice> choices;  // under it: the first is Enter's, the last Esc's; none: "OK"
  std::string typed;            // the path
  int text_version = 0;         // grows when it is not the person who changed it: the field begins anew
  Browser browser;
  bool is_new = false;                       // to be opened by the next frame
  bool accepted = false, cancelled = false;  // by a key
};

// A file that is being read or written, while the window goes on.
struct FileWork {
  std::string what;  // "Opening sheet.json"
  double fraction = 0.0, seconds = 0.0;
  bool is_running = false, wants_stop = false;
};

// The page of scenes.
struct Gallery {
  bool is_shown = false;
  void* thumbnails = nullptr;  // the picture of gallery.h as the window's renderer has it; null: none yet
  std::size_t chosen = 0;      // the card under the mouse or the arrow keys
  bool follows = false;        // the page is to scroll to it
};

// The search through all commands.
struct Search {
  bool shown = false, is_new = false;
  std::string typed;
  int highlighted = 0;    // the row that Enter means
  bool accepted = false;  // by a key
};

struct Panels {
  ViewOptions view;
  Dialog dialog;
  FileWork work;
  std::deque<Dialog> waiting;  // come up one after the other
  Search search;
  bool keys_shown = false;
  Gallery gallery;
  Placement placement;
  ExportState export_state;
  bool menu_is_open = false, menu_closes = false;
  std::string toast;          // a line shown for a moment
  double toast_until = 0.0;   // [s], ImGui's clock
  std::string dismissed;      // the message whose banner was closed
  std::string file_warnings;  // on the file that was opened
  std::string file_notice;    // that the open file is not what it was
  bool file_is_gone = false;
  bool text_in_progress = false;  // letters go into a field
  bool edit_in_progress = false;  // the active slider has edited already
  Look look = Look::Dark;
  bool panels_hidden = false;  // all but the menu and the line at the bottom
  bool plots_shown = false;
  double plot_seconds = 1e9;           // [s] of time in the plots, at most
  std::optional<double> plot_end;      // [s], the last time in them; none: the newest
  bool scrub_in_progress = false;      // the scrubber is being dragged already
  double run_to = 10.0;                // [s], the time typed last
  std::optional<double> typed_number;  // into a slider, not finished
  unsigned typing = 0;                 // ImGui's id of the slider or field that is typed into
  std::string typed_text;              // into the field
  std::vector<Rect> floating;          // panels over the scene, of the last frame

  void show_toast(std::string line) { toast = std::move(line), toast_until = -1.0; }
  void open_dialog(Dialog::Kind kind, std::string typed = {}) { dialog = {.kind = kind, .typed = std::move(typed), .is_new = true}; }
  void open_file_dialog(Dialog::Kind kind, std::filesystem::path folder, std::string typed = {}) {
    open_dialog(kind, std::move(typed));
    dialog.browser.folder = std::move(folder);
  }
  void show_message(std::string title, std::string text, std::vector<Choice> choices = {}) {
    dialog = message(std::move(title), std::move(text), std::move(choices));
  }
  // When the boxes before it are closed.
  void queue_message(std::string title, std::string text, std::vector<Choice> choices = {}) {
    waiting.push_back(message(std::move(title), std::move(text), std::move(choices)));
  }
  static Dialog message(std::string title, std::string text, std::vector<Choice> choices) {
    return {
        .kind = Dialog::Kind::Message, .title = std::move(title), .text = std::move(text), .choices = std::move(choices), .is_new = true};
  }
};

// Between ImGui::NewFrame and ImGui::Render.
void build_panels(const PanelInput& input, Panels& panels, Requests& requests);

// Whether a press at this place of the window belongs to the panels.
bool panels_cover(const Panels& panels, const Layout& layout, double x, double y);

// Whether it is a key that moves from card to card.
bool move_in_gallery(Panels& panels, const Layout& layout, Key key);

// The parts, each in a file of its own.
void build_menu(const PanelInput& input, Panels& panels, Requests& requests);
void build_toolbar(const PanelInput& input, Requests& requests);
void build_side(const PanelInput& input, Panels& panels, Requests& requests);
void build_inspector(const PanelInput& input, Panels& panels, Requests& requests);
void build_parameters(const PanelInput& input, Panels& panels, Requests& requests);
void build_forces(const PanelInput& input, Panels& panels, Requests& requests);
// What is plotted before anything is chosen: the energies.
std::vector<Quantity> first_plots(const System& system);
void build_plots(const PanelInput& input, Panels& panels, Requests& requests);
void build_timeline(const PanelInput& input, Panels& panels, Requests& requests);
void build_history(const PanelInput& input, Requests& requests);
// The rows that the search finds for what was typed, the best first.
std::vector<const Shortcut*> find_commands(const std::string& typed);
void build_search(const PanelInput& input, Panels& panels, Requests& requests);
void build_export(const PanelInput& input, Panels& panels);
void build_placement(const PanelInput& input, Panels& panels);
void build_status_bar(const PanelInput& input);
void build_axes(const PanelInput& input, Panels& panels, Requests& requests);
void build_overlays(const PanelInput& input, Panels& panels, Requests& requests);
void build_keys(const PanelInput& input, Panels& panels);
void build_gallery(const PanelInput& input, Panels& panels, Requests& requests);
void build_dialogs(const PanelInput& input, Panels& panels, Requests& requests);

}  // namespace hooke
