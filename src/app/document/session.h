// The folder of a run of Hooke: it contains the name of the open file and the autosave. The folder is locked while the program runs; an
// unlocked one was left by a crashed run.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

// An autosave left by a crashed run.
struct RecoverableScene {
  std::filesystem::path folder;
  std::filesystem::path file;  // of the document; empty if it had none
  std::string name;            // of the document
  std::string saved_at;        // "15:20", with the date if that is not today

  std::filesystem::path copy() const;  // the scene
};

class Session {
 public:
  // `sessions`: the folder of all runs, created if missing. If it is empty or cannot be created, nothing is saved.
  explicit Session(const std::filesystem::path& sessions);
  // Releases the lock. The autosave stays, and the next run offers it.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  bool is_enabled() const { return !folder_.empty(); }
  // Names the open document.
  void set_document(const std::filesystem::path& file, const std::string& name);
  // Writes the autosave atomically. Throws FileError.
  void write_autosave(std::string_view scene) const;
  // Deletes the autosave.
  void delete_autosave() const;
  // The run ends normally: deletes the folder.
  void end();

  // Whether another running Hooke has this file open.
  bool is_open_elsewhere(const std::filesystem::path& file) const;

  // Autosaves of crashed runs, newest first. Folders of such runs without an autosave are deleted.
  std::vector<RecoverableScene> recoverable_scenes() const;
  void discard(const RecoverableScene& left) const;

 private:
  std::filesystem::path sessions_, folder_;
  int lock_ = -1;
};

}  // namespace hooke
