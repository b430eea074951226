// What a run of Hooke tells the others, in a folder of its own that is locked as long as the run lives: the file that it
// has open, and a copy of what is not saved. A folder without its lock was left by a run that was killed.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

// Unsaved work of a run that did not end by itself.
struct RecoverableScene {
  std::filesystem::path folder;
  std::filesystem::path file;  // of the document; empty: it had none
  std::string name;            // of the document
  std::string saved_at;        // "15:20", or with the date when it was another day

  std::filesystem::path copy() const;  // the scene
};

class Session {
 public:
  // `sessions`: the folder that all runs share, made where it is missing. Empty, or when it cannot be made: keeps nothing.
  explicit Session(const std::filesystem::path& sessions);
  // Lets go of the lock; what is kept stays, to be offered by the next run.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  bool is_enabled() const { return !folder_.empty(); }
  // The document that is open from now on.
  void set_document(const std::filesystem::path& file, const std::string& name);
  // Keeps a copy, whole or not at all. Throws FileError.
  void keep(std::string_view scene) const;
  // There is nothing unsaved any more.
  void forget() const;
  // The run ends as it should: nothing is left behind.
  void end();

  // Whether another living run has this file open.
  bool is_open_elsewhere(const std::filesystem::path& file) const;

  // Of runs that were killed, newest first; empty folders of such runs are swept away.
  std::vector<RecoverableScene> recoverable_scenes() const;
  void discard(const RecoverableScene& left) const;

 private:
  std::filesystem::path sessions_, folder_;
  int lock_ = -1;
};

}  // namespace hooke
