// Unsaved work that killed runs left behind: listed, opened again, or thrown away.
#include "app/app.h"
#include "lab/printable.h"
#include "lab/read_file.h"
#include "lab/scene_file.h"

namespace hooke {

void App::list_left() {
  left_ = session_.left_behind();
  left_work_.clear();
  for (const LeftBehind& left : left_) {
    const std::string where = left.file.empty() ? "never saved" : printable(left.file.native(), 60);
    const std::string name = !left.file.empty() ? left.file.stem().string() : left.name.empty() ? "Untitled" : left.name;
    left_work_.push_back({printable(name, 40) + ", kept at " + left.kept_at, where});
  }
}

void App::recover(std::size_t which) {
  if (which >= left_.size()) return;
  const LeftBehind left = left_[which];
  try {
    LoadedScene loaded = load_copy(left.copy(), left.file.empty() ? left.copy() : left.file);
    const std::string text = read_file(left.copy());
    take_document(std::make_shared<const Scene>(std::move(loaded.scene)), left.file, true);
    // kept by this run before it is thrown away where it lay
    session_.keep(text);
    session_.discard(left);
    panels_.say("Recovered, and not saved yet");
  } catch (const std::runtime_error& error) {  // Refused or FileError
    panels_.tell("Cannot recover the scene", error.what());
  }
  list_left();
}

void App::throw_away(std::size_t which) {
  if (which >= left_.size()) return;
  session_.discard(left_[which]);
  list_left();
}

}  // namespace hooke
