#include "study/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/atomic_write.h"

namespace hooke {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

std::string reason(const char* what) { return std::string("no chart: ") + what + ": " + std::strerror(errno); }

// Runs gnuplot and reads its output to the end. Returns why there is none.
std::optional<std::string> run_gnuplot(const std::string& script, std::string& chart) {
  // the script is passed in an unnamed file, not a pipe, which rules out a deadlock
  const OpenFile input(::fdopen(::memfd_create("script", MFD_CLOEXEC), "w+"));
  if (!input || std::fwrite(script.data(), 1, script.size(), input.get()) != script.size() || std::fflush(input.get()) != 0)
    return reason("the script for gnuplot could not be written");
  std::rewind(input.get());

  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return reason("gnuplot could not be started");
  const OpenFile output(::fdopen(pipe[0], "r"));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(input.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  // -d: without the user's start-up files, which may change the terminal
  char name[] = "gnuplot", defaults[] = "-d";
  char* arguments[] = {name, defaults, nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, name, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  if (error == ENOENT) return "no chart: gnuplot is not installed (Debian: gnuplot-nox)";
  if (error != 0) return std::string("no chart: gnuplot could not be started: ") + std::strerror(error);

  std::array<char, 1 << 14> buffer{};
  for (ssize_t size = 1; size != 0;) {
    size = ::read(fileno(output.get()), buffer.data(), buffer.size());
    if (size > 0) chart.append(buffer.data(), static_cast<std::size_t>(size));
    if (size < 0 && errno != EINTR) break;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return reason("the exit status of gnuplot is unknown");
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !chart.empty()) return std::nullopt;
  return "no chart: gnuplot failed";
}

}  // namespace

std::optional<std::string> draw_chart(const std::string& script, const std::filesystem::path& file) {
  std::string chart;
  if (std::optional<std::string> failure = run_gnuplot(script, chart)) return failure;
  write_atomically(file, chart);
  return std::nullopt;
}

}  // namespace hooke
