#include "study/gnuplot.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace hooke {

std::optional<std::string> run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  // the script is passed in an unnamed file, not a pipe, which rules out a deadlock
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> input(std::tmpfile(), &std::fclose);
  if (!input || std::fwrite(script.data(), 1, script.size(), input.get()) != script.size() || std::fflush(input.get()) != 0)
    return std::string("no chart: the script for gnuplot could not be written: ") + std::strerror(errno);
  std::rewind(input.get());

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(input.get()), STDIN_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  // -d: without the user's start-up files, which may change the terminal
  char name[] = "gnuplot", defaults[] = "-d";
  char* arguments[] = {name, defaults, nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, name, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return "no chart: gnuplot is not installed (Debian: gnuplot-nox)";
  if (error != 0) return std::string("no chart: gnuplot could not be started: ") + std::strerror(error);

  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return std::string("no chart: the exit status of gnuplot is unknown: ") + std::strerror(errno);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  return "no chart: gnuplot failed";
}

}  // namespace hooke
