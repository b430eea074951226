// The requests of the panels. The app handles the requests of a frame after its panels are built. Besides, it only reads which panels are
// shown, to compute no more than they show.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "formats/import_options.h"
#include "lab/controls.h"
#include "scene/collider_kinds.h"
#include "scene/selection.h"
#include "scene/shape.h"
#include "ui/actions.h"

namespace hooke {

// `continues`: part of the same undo step as the previous edit (the slider is still held). `name`: of that step, or the command's own.
struct Edit {
  Command command;
  bool continues = false;
  std::string name{};
};
struct OpenFile {
  std::filesystem::path file;
  ImportOptions options;
};
struct SaveFile {
  std::filesystem::path file;
};
// Go to a recorded frame. `continues`: part of the same drag as the previous request.
struct Scrub {
  double time;  // [s]
  bool continues = false;
};
// A texture for the faces: the name of a shipped one, the path of a PNG, or nothing.
struct ChooseTexture {
  std::string texture;
};
// The file dialog of the desktop (zenity or kdialog).
struct OpenSystemDialog {
  bool to_save = false;
};
// Rotate the camera to look at the scene from this direction.
struct LookFrom {
  Vec3 direction;
};
// Open or delete an autosave left by a crashed run, by its index in PanelInput::recovered.
struct Recover {
  std::size_t which;
};
struct DiscardRecovery {
  std::size_t which;
};
// Cancel the file operation whose progress is shown.
struct CancelWork {};
// Stop the comparison of methods in progress.
struct StopComparison {};
struct StopResultCheck {};
// Compute what stretches the selected springs.
struct ExplainStretch {};
// Write the compared methods to a file beside the document: ".svg", ".png", ".csv" or ".json".
struct SaveComparison {
  std::string extension;
};
// Run these settings beside the run, from its present state on, drawn as ghosts; `with_reference`: and a very accurate run.
struct SetGhosts {
  bool with_reference = false;
  std::vector<Settings> settings;
};
// Move the camera to where the run diverged.
struct ShowFailure {};
// Export what panels.export_state describes, or stop the export in progress.
struct StartExport {};
struct StopExport {};
struct Select {
  Selection selection;
};
// Show a shape, or a mesh where `shape` is null, which is moved before it is placed. `in_space`: first make a flat scene 3-D.
struct StartPlacement {
  const ShapeKind* shape;
  bool in_space = false;
  const ColliderKind* collider = nullptr;  // instead of a shape or a mesh
};
// A button that only closes its dialog.
struct CloseDialog {};
// Read the mesh whose path was typed.
struct LoadMesh {
  std::filesystem::path file;
};
// Add the preview to the scene, or discard it.
struct Place {};
struct StopPlacement {};
// A button of a dialog or a banner about the document.
enum class Answer {
  Save,       // save the changes, then continue
  Discard,    // continue without saving
  Cancel,     // do not continue
  Overwrite,  // replace the file although it changed on disk
  SaveAs,     // choose another file
  MakeCopy,   // keep the scene, detach it from its file
  Reload,     // load the file again
  KeepMine,   // keep the scene as it is
};

using RequestVariant =
    std::variant<Edit, Scrub, Control, Action, OpenFile, SaveFile, ChooseTexture, OpenSystemDialog, LookFrom, Recover, DiscardRecovery,
                 CancelWork, StopComparison, StopResultCheck, ExplainStretch, SaveComparison, SetGhosts, ShowFailure, StartExport,
                 StopExport, Select, StartPlacement, CloseDialog, LoadMesh, Place, StopPlacement, Answer>;
// Copies are compiled once, in panels.cpp.
struct Request : RequestVariant {
  using RequestVariant::RequestVariant;
  Request(const Request&);
  Request(Request&&) noexcept;
  Request& operator=(const Request&);
  Request& operator=(Request&&) noexcept;
  ~Request();
};
using Requests = std::vector<Request>;

}  // namespace hooke
