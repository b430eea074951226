#include "app/document/session.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "app/document/home.h"
#include "base/atomic_write.h"
#include "base/errors.h"
#include "base/json_field.h"
#include "base/json_writer.h"
#include "base/printable.h"
#include "base/read_file.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

constexpr const char *lock_name = "lock", *run_info_name = "about.json", *scene_name = "scene.json";

// A lock on a file, which is created if missing. Released by the destructor.
class FileLock {
 public:
  FileLock(const fs::path& file, int operation) : number_(::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600)) {
    if (number_ >= 0 && ::flock(number_, operation) != 0) close();
  }
  ~FileLock() { close(); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  bool is_held() const { return number_ >= 0; }
  int release_descriptor() { return std::exchange(number_, -1); }

 private:
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  int number_;
};

// Whether the run that owns this folder has ended, normally or not.
bool has_ended(const fs::path& folder) {
  std::error_code error;
  return !fs::exists(folder / lock_name, error) || FileLock(folder / lock_name, LOCK_EX | LOCK_NB).is_held();
}

std::vector<fs::path> folders_in(const fs::path& sessions) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(sessions, error), end; !error && entry != end; entry.increment(error))
    if (std::error_code ignored; entry->is_directory(ignored) && !entry->is_symlink(ignored)) folders.push_back(entry->path());
  return folders;
}

struct RunInfo {
  fs::path file;
  std::string name;
};

// Empty if the file cannot be read.
RunInfo read_run_info(const fs::path& folder) {
  RunInfo run_info;
  try {
    const std::string text = read_file(folder / run_info_name), shown = printable((folder / run_info_name).native());
    read_members(text, shown, [&](const JsonField& field) {
      if (field.is("file")) run_info.file = std::string(field.text());
      if (field.is("name")) run_info.name = std::string(field.text());
    });
  } catch (const std::runtime_error&) {  // InputError or FileError
  }
  return run_info;
}

std::string time_text(fs::file_time_type when) {
  const std::time_t then = std::chrono::system_clock::to_time_t(std::chrono::file_clock::to_sys(when)), now = std::time(nullptr);
  std::tm local{}, today{};
  ::localtime_r(&then, &local);
  ::localtime_r(&now, &today);
  const bool same_day = local.tm_year == today.tm_year && local.tm_yday == today.tm_yday;
  char text[64];
  std::strftime(text, sizeof text, same_day ? "%H:%M" : "%Y-%m-%d %H:%M", &local);
  return text;
}

fs::path resolved(const fs::path& file) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(file, error);
  return error ? file : path;
}

}  // namespace

fs::path RecoverableScene::copy() const { return folder / scene_name; }

Session::Session(const fs::path& sessions) : sessions_(sessions) {
  if (sessions.empty() || !make_private_folder(sessions)) return;
  // other runs must not delete the folder before it is locked
  const FileLock all(sessions / "lock", LOCK_EX);
  std::string pattern = (sessions / "run-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) return;
  FileLock own(fs::path(pattern) / lock_name, LOCK_EX | LOCK_NB);
  if (!own.is_held()) return;
  lock_ = own.release_descriptor();
  folder_ = pattern;
}

Session::~Session() {
  if (lock_ >= 0) ::close(lock_);
}

void Session::set_document(const fs::path& file, const std::string& name) {
  if (!is_enabled()) return;
  JsonWriter writer;
  writer.begin_object(JsonWriter::Layout::Lines);
  writer.text("file", file.empty() ? std::string() : resolved(file).native());
  writer.text("name", name);
  writer.end();
  try {
    write_atomically(folder_ / run_info_name, writer.take() + "\n");
  } catch (const FileError&) {  // other runs are not notified
  }
}

void Session::write_autosave(std::string_view scene) const {
  if (is_enabled()) write_atomically(folder_ / scene_name, scene);
}

void Session::delete_autosave() const {
  std::error_code ignored;
  if (is_enabled()) fs::remove(folder_ / scene_name, ignored);
}

void Session::end() {
  if (!is_enabled()) return;
  const FileLock all(sessions_ / "lock", LOCK_EX);
  std::error_code ignored;
  fs::remove_all(std::exchange(folder_, {}), ignored);
  ::close(std::exchange(lock_, -1));
}

bool Session::is_open_elsewhere(const fs::path& file) const {
  if (!is_enabled() || file.empty()) return false;
  const fs::path wanted = resolved(file);
  return std::ranges::any_of(folders_in(sessions_), [&](const fs::path& folder) {
    return folder != folder_ && !has_ended(folder) && read_run_info(folder).file == wanted;
  });
}

std::vector<RecoverableScene> Session::recoverable_scenes() const {
  std::vector<RecoverableScene> found;
  if (!is_enabled()) return found;
  const FileLock all(sessions_ / "lock", LOCK_EX);
  std::vector<std::pair<fs::file_time_type, RecoverableScene>> by_time;
  for (const fs::path& folder : folders_in(sessions_)) {
    if (folder == folder_ || !has_ended(folder)) continue;
    std::error_code error;
    const fs::file_time_type when = fs::last_write_time(folder / scene_name, error);
    if (error) {
      fs::remove_all(folder, error);
      continue;
    }
    const RunInfo run_info = read_run_info(folder);
    by_time.emplace_back(when, RecoverableScene{folder, run_info.file, run_info.name, time_text(when)});
  }
  std::ranges::sort(by_time, std::ranges::greater(), &std::pair<fs::file_time_type, RecoverableScene>::first);
  for (auto& [when, left] : by_time) found.push_back(std::move(left));
  return found;
}

void Session::discard(const RecoverableScene& left) const {
  std::error_code ignored;
  if (has_ended(left.folder)) fs::remove_all(left.folder, ignored);
}

}  // namespace hooke
