// The panels of the window. They read a PanelInput, keep their own state in Panels between frames, and return Requests. They access nothing
// else, so tests run them without a window.
#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/folder_listing.h"
#include "draw/view.h"
#include "lab/accuracy/judgement.h"
#include "lab/status.h"
#include "scene/selection.h"
#include "study/check/result_check.h"
#include "study/check/stretch.h"
#include "study/compare_methods.h"
#include "study/cost_advice.h"
#include "study/remedy/remedy.h"
#include "ui/export_state.h"
#include "ui/layout.h"
#include "ui/panels/affected_parts.h"
#include "ui/placement.h"
#include "ui/requests.h"
#include "ui/shortcuts.h"
#include "ui/theme.h"

namespace hooke {

struct Forecast;

// An autosave left by a crashed run.
struct RecoveryEntry {
  std::string title, detail;
};

// A key for an open panel, as App's input handlers passed it on.
struct PanelKey {
  enum class Target { Dialog, Search, Menu, Export };
  Target target;
  Key key;
};

// A file operation in progress.
struct FileWork {
  std::string what;  // "Opening sheet.json"
  double fraction = 0.0, seconds = 0.0;
  bool is_running = false, is_stopping = false;
};

// An export in progress.
struct ExportWork {
  double fraction = 0.0, seconds = 0.0;
  bool is_running = false;
};

// The search for a remedy of a run that diverged.
struct RemedyStatus {
  std::string test;             // what is being tested; empty: no search is in progress
  std::optional<Remedy> found;  // its result
};

// Something that is computed in the background.
template <class Result>
struct ResultStatus {
  bool is_running = false;
  double fraction = 0.0, seconds = 0.0;  // done, and taken so far
  std::shared_ptr<const Result> result;  // of the last one; null: none
};

// What was computed about the scene in the background.
struct BackgroundResults {
  const Forecast* forecast = nullptr;  // null if there is none
  std::optional<CostAdvice> advice{};  // none: not computed yet
  RemedyStatus remedy{};
  ResultStatus<MethodComparison> comparison{};
  ResultStatus<ResultCheck> result_check{};
  ResultStatus<StretchBreakdown> stretch{};
};

struct ToolInput {
  std::span<const ToolButton> buttons;
  Action action;                      // of the current tool
  std::string next_step{};            // "click the second point, Esc cancels"
  std::optional<Rect> rubber_band{};  // of a selection in progress, in window coordinates
  std::vector<glm::dvec2> stroke{};   // of a cut or a lasso in progress, relative to the corner of the scene
};

// The input of the panels, constant while a frame is built.
struct PanelInput {
  const Status& status;
  const Selection& selection;
  Layout layout;
  ToolInput tool;
  std::filesystem::path file;      // of the document; empty if it has none
  std::filesystem::path folder{};  // where file dialogs start
  double frames_per_second = 0.0, draw_ms = 0.0;
  double waiting_seconds = 0.0;                   // for the frame in progress; 0: paused
  double film_seconds = -1.0;                     // length of the film in progress; negative if none
  std::span<const std::filesystem::path> recent;  // files, newest first
  std::span<const RecoveryEntry> recovered;
  std::span<const PanelKey> keys;  // pressed since the last frame
  FileWork work{};
  ExportWork export_work{};
  bool has_desktop_dialog = false;
  Camera camera{};
  BackgroundResults results{};
  const Marks* marks = nullptr;  // of the last frame; null: none

  // The number of times that the key was pressed for the panel since the last frame.
  int presses(PanelKey::Target target, Key key) const;
};

// Where a dialog looks for files.
struct Browser {
  enum class Place { Folder, Recent, Shipped };
  Place place = Place::Folder;
  std::filesystem::path folder;
  FolderListing listing;
  double listed_at = 0.0;  // [s], on the clock of ImGui
};

struct Choice {
  std::string label;
  Request request;
};

struct Dialog {
  enum class Kind { None, Message, Open, Save, Unsaved, Texture, Recovery, Working };
  Kind kind = Kind::None;
  std::string title, text;                // of a message
  std::vector<Choice> choices;            // its buttons: Enter chooses the first, Esc the last; without any, "OK"
  std::string typed;                      // the path
  std::vector<std::string> import_texts;  // of import_options(), for a mesh
  int text_version = 0;                   // incremented when the program changes the path, so that the text field is recreated
  Browser browser;
  bool selects_name = false;  // in the path, without folder and extension
  bool picks_mesh = false;    // an .obj file for the placement
  bool is_new = false;        // opens with the next frame
};

// The page of scenes.
struct Gallery {
  bool is_shown = false;
  void* thumbnails = nullptr;  // texture of the renderer with the pictures of gallery.h; null until it is uploaded
  std::size_t chosen = 0;      // the card under the mouse or the arrow keys
  bool follows = false;        // scroll to it
};

// The command palette.
struct Search {
  bool shown = false, is_new = false;
  std::string typed;
  int text_version = 0;  // incremented when the program changes the text
  bool continues_text = false;
  int highlighted = 0;  // the row that Enter chooses
};

// The panel of the runs beside the run on screen. Closing it ends them.
struct Ghosts {
  bool is_shown = false;
  bool with_reference = false;
  std::vector<Settings> settings;
  static constexpr std::size_t max_settings = 4;
};

// What the program said: a line over the scene until it was read, and all of them in a panel.
struct Messages {
  struct Entry {
    std::string time, text;  // "15:20:03"
  };
  std::string toast;          // disappears by itself, unless the mouse is over it; empty: none
  double toast_until = 0.0;   // [s], on the clock of ImGui; negative: from the next frame on
  std::deque<Entry> entries;  // oldest first
  std::string banners;        // that are in the log
  bool is_shown = false;

  void log(const std::string& text);
};

// A spectrum and what it was computed from.
struct SpectrumOfPlots {
  std::shared_ptr<const TraceTable> traces;
  std::pair<double, double> span;  // [s]
  TraceTable table;
};

struct TimelineState {
  bool scrub_in_progress = false;  // the scrubber is being dragged
  double run_to = 10.0;            // [s], last time typed
};

// The table of points or springs, in place of the plots.
struct PartTable {
  bool is_shown = false, of_springs = false;
  std::vector<Index> order;  // the points or springs, row by row
};

// What the plots, the table and the timeline below the scene show.
struct PlotView {
  bool is_shown = false;
  double seconds = 1e9;         // [s], maximum time span
  std::optional<double> end;    // [s], end of the time span; without a value it follows the newest time
  bool is_dragged = false;      // since the mouse was pressed over a plot
  bool shows_spectrum = false;  // amplitudes over the frequency, of the visible time span
  SpectrumOfPlots spectrum;
  std::array<std::optional<double>, 2> cursors;  // [s], A and B
  // [s], over a plot or the timeline, which both mark it; and the one that the next frame marks
  std::optional<double> time_under_mouse, next_time_under_mouse;
  PartTable table;
  TimelineState timeline;
};

// The menus of the menu bar, and open lists.
struct Menus {
  bool is_open = false;      // one of them, or a list
  bool opens_first = false;  // with the next frame, with the focus on its first item
  bool on_submenu = false;   // the focus is on an item that opens another menu
};

struct Banners {
  std::optional<double> dismissed;  // time of the divergence whose banner was closed [s]
  std::string file_warnings;        // about the opened file
  std::string file_notice;          // the file changed on disk
  bool file_is_missing = false;
};

// The slider or text field in use.
struct FieldState {
  bool text_in_progress = false;             // a text field has the keyboard
  bool edit_in_progress = false;             // the active slider has already made an edit
  std::shared_ptr<const System> tuned_from;  // by a drag that scales different values; null: there is none
  bool slider_waits = false;                 // pressed far from its handle, and not dragged yet
  std::optional<double> typed_number;        // into a slider, unfinished
  unsigned typing = 0;                       // ImGui's id of the slider or field being typed into
  std::string typed_text;                    // into the field, unfinished
};

struct SideState {
  bool to_top = true;              // scroll the side panel up and open its groups: another scene was opened
  unsigned lesson_steps_done = 0;  // one bit for each step of the lesson that is open
  AffectedPartsCache affected_parts;
};

struct ShownPanels {
  bool panels = true;  // all but the menu and status bars
  bool keys = false, accuracy = false, comparison = false, result_check = false;
  bool takes_fastest = false;  // when the comparison in progress is done
  std::vector<Rect> floating;  // over the scene in the last frame
};

// The time per frame and phase, and how it was in the last seconds [ms].
struct TimesPanel {
  bool is_shown = false;
  std::array<std::deque<float>, phase_count> history;
};

struct Panels {
  ViewOptions view;
  Dialog dialog;
  std::deque<Dialog> waiting;  // dialogs that open one after the other
  Search search;
  Gallery gallery;
  Placement placement;
  ExportState export_state;
  Menus menus;
  Messages messages;
  Banners banners;
  FieldState field;
  Look look = Look::Dark;
  ShownPanels shown;
  SideState side;
  Ghosts ghosts;
  PlotView plots;
  TimesPanel times;

  // Of the panels at the left edge of the scene only one is shown.
  void show_at_left(bool* panel) {
    shown.comparison = shown.takes_fastest = shown.result_check = messages.is_shown = times.is_shown = false;
    ghosts = {};
    *panel = true;
  }
  // The second is not in the log: a value while it is tuned.
  void show_toast(std::string line) {
    messages.log(line);
    show_value(std::move(line));
  }
  void show_value(std::string line) { messages.toast = std::move(line), messages.toast_until = -1.0; }
  void open_dialog(Dialog::Kind kind, std::string typed = {}) { dialog = {.kind = kind, .typed = std::move(typed), .is_new = true}; }
  void open_file_dialog(Dialog::Kind kind, std::filesystem::path folder, std::string typed = {}) {
    open_dialog(kind, std::move(typed));
    dialog.browser.folder = std::move(folder);
  }
  void show_message(std::string title, std::string text, std::vector<Choice> choices = {}) {
    dialog = message(std::move(title), std::move(text), std::move(choices));
  }
  // Opens when the dialogs before it are closed.
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

// Whether a panel is at this position of the window and takes mouse input there.
bool panels_cover(const Panels& panels, const Layout& layout, double x, double y);

// Moves the highlighted card with the arrow keys. Returns false for other keys.
bool move_in_gallery(Panels& panels, const Layout& layout, Key key);

// The parts, each in a file of its own.
void start_placement(const ShapeKind* shape, const PanelInput& input, Panels& panels, Requests& requests);
void build_menu(const PanelInput& input, Panels& panels, Requests& requests);
void build_toolbar(const PanelInput& input, Requests& requests);
void build_side(const PanelInput& input, Panels& panels, Requests& requests);
// The steps of a lesson; each is checked off when it was done.
void build_lesson(const PanelInput& input, Panels& panels);
void build_inspector(const PanelInput& input, Panels& panels, Requests& requests);
// The selected collider; and the rows of one, with what a row changed.
void build_collider(const PanelInput& input, Panels& panels, Requests& requests);
std::optional<Collider> collider_rows(const Collider& collider, int dimensions, Panels& panels);
// The law of these springs.
void build_spring_law(const PanelInput& input, const std::vector<Index>& springs, Panels& panels, Requests& requests);
void build_arrange(const PanelInput& input, Panels& panels, Requests& requests);
// What stretches the selected springs.
void build_stretch(const PanelInput& input, Requests& requests);
void build_parameters(const PanelInput& input, Panels& panels, Requests& requests);
// After the method where the scene was opened with forces, else after the parameters.
inline constexpr const char* forces_section = "Forces";
inline bool has_forces_first(const PanelInput& input) { return !input.status.document->opened_forces.empty(); }
// The effect of a parameter on the scene, below its slider: the step and omega h, the sag, the damping ratios; a dash if it is not known.
void parameter_hint_row(const Parameter& row, const PanelInput& input);
void build_forces(const PanelInput& input, Panels& panels, Requests& requests);
// What is plotted: of the document, or by default the energies.
std::vector<Quantity> plotted(const DocumentStatus& document, const System& system);
// The visible time span [s]; the table must have times.
std::pair<double, double> shown_times(const TraceTable& table, const Panels& panels);
// Within an open list or menu: it takes Esc, which closes it.
void close_on_escape(const PanelInput& input, Panels& panels);
// The list of quantities to plot.
void build_plot_choices(const PanelInput& input, Requests& requests);
void build_part_table(const PanelInput& input, Panels& panels, Requests& requests);
void build_plots(const PanelInput& input, Panels& panels, Requests& requests);
void build_timeline(const PanelInput& input, Panels& panels, Requests& requests);
void build_history(const PanelInput& input, Requests& requests);
void build_search(const PanelInput& input, Panels& panels, Requests& requests);
void build_export(const PanelInput& input, Panels& panels, Requests& requests);
void build_placement(const PanelInput& input, Panels& panels, Requests& requests);
// Grey only where all is well.
ImU32 color_of(const Judgement& judgement);
// The line below the method; a click shows or hides the panel.
void build_accuracy_line(const PanelInput& input, Panels& panels);
void build_accuracy(const PanelInput& input, Panels& panels, Requests& requests);
void build_comparison(const PanelInput& input, Panels& panels, Requests& requests);
void build_result_check(const PanelInput& input, Panels& panels, Requests& requests);
void build_times(const PanelInput& input, Panels& panels);
// Ghosts: runs beside the run, and their distance from it. `ghost_color` is that of the n-th in the scene and in the panel.
void build_ghosts(const PanelInput& input, Panels& panels, Requests& requests);
ImU32 ghost_color(std::size_t n);
void build_status_bar(const PanelInput& input);
void build_axes(const PanelInput& input, Panels& panels, Requests& requests);
void build_overlays(const PanelInput& input, Panels& panels, Requests& requests);
void build_keys(const PanelInput& input, Panels& panels);
void build_messages(const PanelInput& input, Panels& panels);
void build_gallery(const PanelInput& input, Panels& panels, Requests& requests);
// A list of folders and files within a dialog, whose selected file is copied to `dialog.typed`; returns whether a double click confirmed
// it.
enum class FileDialogMode { Open, Save };
bool build_browser(const PanelInput& input, Dialog& dialog, FileDialogMode mode);
// The typed path, relative to the folder shown; and to another folder, which keeps the name of a file to save.
std::filesystem::path resolved_path(const Dialog& dialog);
void go_to_folder(Dialog& dialog, const std::filesystem::path& folder, FileDialogMode mode);
void build_dialogs(const PanelInput& input, Panels& panels, Requests& requests);

}  // namespace hooke
