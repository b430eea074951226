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
// The answer to "save the changes first?"
enum class Answer { Save, Discard, Cancel };

using Request = std::variant<Edit, Scrub, Control, Action, OpenFile, SaveFile, ChooseTexture, Answer>;
using Requests = std::vector<Request>;

}  // namespace hooke
