// Document: autosaves left by crashed runs are listed, restored or deleted.
#include "app/document/document.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "formats/scene_file.h"

namespace hooke {

void Document::list_recoverable() {
  recoverable_ = session_.recoverable_scenes();
  recovery_entries_.clear();
  for (const RecoverableScene& left : recoverable_) {
    const std::string where = left.file.empty() ? "never saved" : printable(left.file.native(), 60);
    const std::string name = !left.file.empty() ? left.file.stem().string() : left.name.empty() ? "Untitled" : left.name;
    recovery_entries_.push_back({printable(name, 40) + ", autosaved at " + left.saved_at, where});
  }
}

void Document::recover(std::size_t which) {
  if (which >= recoverable_.size()) return;
  const RecoverableScene left = recoverable_[which];
  try {
    LoadedScene loaded = load_scene_from_copy(left.copy(), left.file.empty() ? left.copy() : left.file);
    const std::string text = read_file(left.copy());
    replace(std::make_shared<const Scene>(std::move(loaded.scene)), left.file, true);
    // autosaved by this run before the old copy is deleted
    session_.write_autosave(text);
    session_.discard(left);
    panels_.show_toast("Restored from autosave; not saved yet");
  } catch (const std::runtime_error& error) {  // InputError or FileError
    panels_.show_message("Cannot restore the scene", error.what());
  }
  list_recoverable();
}

void Document::discard_recovery(std::size_t which) {
  if (which >= recoverable_.size()) return;
  session_.discard(recoverable_[which]);
  list_recoverable();
}

}  // namespace hooke
