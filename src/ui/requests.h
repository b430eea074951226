// What the panels ask for. The app handles the requests of a frame after its panels are built; there is no other way from a
// panel to the app.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "lab/lab.h"
#include "scene/shape.h"
#include "ui/actions.h"

namespace hooke {

// `continues`: belongs to the same undo step as the edit before it (the slider is still held).
struct Edit {
  Command command;
  bool continues = false;
};
struct OpenFile {
  std::filesystem::path file;
};
struct SaveFile {
  std::filesystem::path file;
};
// Go to a recorded frame. `continues`: belongs to the same drag as the one before it.
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
// Turn the camera to look at the scene from this direction.
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
// Cancels the file operation whose progress is shown.
struct CancelWork {};
// Export what panels.export_state describes, or stop the export in progress.
struct StartExport {};
struct StopExport {};
// Show a shape, or a mesh where `shape` is null, to be moved about before it is placed.
struct StartPlacement {
  const ShapeKind* shape;
};
// Read the mesh whose path was typed.
struct LoadMesh {
  std::filesystem::path file;
};
// Add what is shown to the scene.
struct Place {};
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

using Request = std::variant<Edit, Scrub, Control, Action, OpenFile, SaveFile, ChooseTexture, OpenSystemDialog, LookFrom, Recover,
                             DiscardRecovery, CancelWork, StartExport, StopExport, StartPlacement, LoadMesh, Place, Answer>;
using Requests = std::vector<Request>;

}  // namespace hooke
