// What the panels ask for: the app obeys after the panels of a frame are built.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "lab/lab.h"
#include "ui/shortcuts.h"

namespace hooke {

// `continues`: part of the same step of undo as the edit before it (a slider still under the mouse).
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
// To another frame of the past; continues: of the same drag.
struct Scrub {
  double time;  // [s]
  bool continues = false;
};
// A texture for the faces: the name of one that ships, a PNG, or nothing.
struct ChooseTexture {
  std::string texture;
};
// The desktop's own dialog for files.
struct OpenSystemDialog {
  bool to_save = false;
};
// The camera turned to see the scene from there.
struct LookFrom {
  Vec3 direction;
};
// Unsaved work that a killed run left behind, by its place in the list: to be opened, or thrown away.
struct Recover {
  std::size_t which;
};
struct DiscardRecovery {
  std::size_t which;
};
// What a button of a box or a banner says.
enum class Answer {
  Save,       // the changes first
  Discard,    // the changes
  Cancel,     // what was asked for
  Overwrite,  // the file, though it is not what was read
  SaveAs,     // under another name
  MakeCopy,   // go on without the file
  Reload,     // the file as it is now
  KeepMine,   // the scene as it is here
};

using Request = std::variant<Edit, Scrub, Control, Action, OpenFile, SaveFile, ChooseTexture, OpenSystemDialog, LookFrom, Recover,
                             DiscardRecovery, Answer>;
using Requests = std::vector<Request>;

}  // namespace hooke
