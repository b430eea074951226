// Saving never loses work: whenever the program is killed and whichever system call fails, the file contains the complete old version or
// the complete new one.

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>

#include "campaign/check.h"
#include "formats/scene_file.h"
#include "support/random_scene.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// Which of the calls below fails, counted from 1, and with which error; 0: none.
struct Failure {
  long call = 0;
  int error = 0;
  long calls = 0;  // so far
};
Failure failure;

// Whether this call must fail; sets errno if so.
bool fails() {
  if (failure.call == 0 || ++failure.calls != failure.call) return false;
  errno = failure.error;
  return true;
}

template <class Function>
Function* system_call(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace
}  // namespace hooke

// Definitions in the program take precedence over those of the C library.
extern "C" {

ssize_t write(int file, const void* bytes, size_t size) {
  static auto* const real = hooke::system_call<ssize_t(int, const void*, size_t)>("write");
  if (!hooke::fails()) return real(file, bytes, size);
  // a disk that fills up accepts a part first; the rest then fails
  if (hooke::failure.error != ENOSPC || size < 2) return -1;
  hooke::failure.call = hooke::failure.calls + 1;
  return real(file, bytes, size / 2);
}
int fsync(int file) {
  static auto* const real = hooke::system_call<int(int)>("fsync");
  return hooke::fails() ? -1 : real(file);
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  static auto* const real = hooke::system_call<int(int, const char*, int, const char*)>("renameat");
  return hooke::fails() ? -1 : real(from_folder, from, to_folder, to);
}
int fchmod(int file, mode_t mode) noexcept {
  static auto* const real = hooke::system_call<int(int, mode_t)>("fchmod");
  return hooke::fails() ? -1 : real(file, mode);
}
int openat(int folder, const char* name, int flags, ...) {
  static auto* const real = hooke::system_call<int(int, const char*, int, ...)>("openat");
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return hooke::fails() ? -1 : real(folder, name, flags, mode);
}
int open(const char* name, int flags, ...) {
  static auto* const real = hooke::system_call<int(const char*, int, ...)>("open");
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return hooke::fails() ? -1 : real(name, flags, mode);
}
}

namespace hooke {
namespace {

// A scene that contains its version number and the corresponding number of points: some versions fit in a page, some have 300 KiB.
Scene version_of(long version) {
  Scene scene = empty_scene();
  scene.name = std::to_string(version);
  const Index points = version % 3 == 0 ? 3 : 1000 * (1 + static_cast<Index>(version % 3));
  scene.description = std::to_string(points);
  for (Index i = 0; i < points; ++i) {
    scene.system.append_point({.id = scene.system.new_point_id()});
    scene.state.position.emplace_back(0.125 * static_cast<double>(i), static_cast<double>(version), 0.0);
    scene.state.velocity.emplace_back(0.0);
  }
  return scene;
}

// The version that the file contains completely.
long version_in(const fs::path& file) {
  const Scene scene = load_scene(file).scene;
  const long version = std::stol(scene.name);
  expect(scene.system.point_count() == std::stol(scene.description) &&
             (scene.system.point_count() == 0 || scene.state.position.back().y == static_cast<double>(version)),
         "the file holds parts of two versions");
  return version;
}

std::size_t files_in(const fs::path& folder) { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})); }

// Saves version after version until it is killed, and reports which are saved.
void save_without_end(const fs::path& file, std::atomic<long>& saved) {
  for (;;) {
    save_scene(version_of(saved + 1), file);
    ++saved;
  }
}

long kill_during_save(std::uint64_t number) {
  Random random(number);
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "scene.json";
  save_scene(version_of(0), file);
  void* shared = mmap(nullptr, sizeof(std::atomic<long>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto& saved = *new (shared) std::atomic<long>(0);

  const pid_t child = fork();
  if (child == 0) save_without_end(file, saved);
  usleep(static_cast<useconds_t>(random.uniform(500.0, 30'000.0)));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);

  const long last = saved, found = version_in(file);
  munmap(shared, sizeof(std::atomic<long>));
  expect(found == last || found == last + 1, "version " + std::to_string(last) + " was saved, the file holds " + std::to_string(found));
  // the next save removes temporary files of the killed one
  save_scene(version_of(last + 2), file);
  expect(version_in(file) == last + 2 && files_in(scratch.folder) == 1, "the next save leaves temporary files");
  return 1;
}

// The target of a save.
enum class Target { NewFile, OldFile, Link, FolderWithLeftovers };
constexpr Target targets[] = {Target::NewFile, Target::OldFile, Target::Link, Target::FolderWithLeftovers};

// Saves with call number `call` failing; returns false if there are fewer calls.
bool save_with_failure(Target target, long call, int error) {
  const ScratchFolder scratch;
  const fs::path real = scratch.folder / (target == Target::Link ? "real.json" : "scene.json"), file = scratch.folder / "scene.json";
  const bool is_old = target != Target::NewFile;
  if (is_old) save_scene(version_of(1), real);
  if (target == Target::Link) fs::create_symlink("real.json", file);
  if (target == Target::FolderWithLeftovers) std::ofstream(scratch.folder / ".hooke-0123456789abcdef") << "half";

  failure = {.call = call, .error = error};
  std::string message;
  try {
    save_scene(version_of(2), file);
  } catch (const FileError& refused) {
    message = refused.what();
  }
  const bool has_failed = failure.calls >= call;
  failure = {};

  const std::string what = "call " + std::to_string(call) + " fails with " + std::strerror(error) + ": ";
  const bool exists = fs::exists(file);
  expect(exists || !is_old, what + "the old file is missing");
  const long found = exists ? version_in(file) : 0;
  expect(found == (is_old ? 1 : 0) || found == 2, what + "the file holds neither version");
  expect(!message.empty() || found == 2, what + "the save failed without a message");
  expect(target != Target::Link || fs::is_symlink(file), what + "the link is missing");
  // an existing temporary file may stay if it could not be examined; no new one may
  for (const fs::directory_entry& entry : fs::directory_iterator(scratch.folder)) {
    const std::string name = entry.path().filename();
    expect(name == "scene.json" || name == "real.json" || name == ".hooke-0123456789abcdef", what + "it leaves " + name);
  }
  return has_failed;
}

// A case is a target and an error, with each call failing in turn.
long fail_each_call(std::uint64_t number) {
  constexpr int errors[] = {ENOSPC, EIO, EINTR, EDQUOT, EROFS, EACCES, EMFILE, ENOMEM};
  const Target target = targets[number % std::size(targets)];
  const int error = errors[number / std::size(targets) % std::size(errors)];
  long calls = 0;
  while (save_with_failure(target, calls + 1, error)) ++calls;
  return calls;
}

}  // namespace

const Check saves_killed{"saves_killed", "kills", 60, kill_during_save};
const Check saves_failing{"saves_failing", "failing calls", 60, fail_each_call};

}  // namespace hooke
