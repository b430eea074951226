#include "batch/engine/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/errors.h"
#include "base/printable.h"

namespace hooke {
namespace {

constexpr int poll_ms = 100;
constexpr int end_timeout_ms = 3000;  // before a program that was asked to end is killed

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  const std::string name = printable(words.front(), 80);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw FileError(name + ": cannot be started: " + std::strerror(errno));
  output_ = ends[0];

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  // a group of its own, so that ending it reaches whatever it started
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);

  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int error = posix_spawnp(&id_, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (error == 0) return;
  close(output_);
  throw FileError(name + ": cannot be started: " + std::strerror(error));
}

ChildProcess::~ChildProcess() {
  if (!has_ended_) end();
  close(output_);
}

void ChildProcess::end() {
  kill(-id_, SIGTERM);
  for (int waited = 0; waited < end_timeout_ms; waited += poll_ms) {
    if (waitpid(id_, &status_, WNOHANG) != 0) {
      has_ended_ = true;
      break;
    }
    poll(nullptr, 0, poll_ms);
  }
  // also what outlives the program itself
  kill(-id_, SIGKILL);
  if (!has_ended_) waitpid(id_, &status_, 0);
  has_ended_ = true;
}

int ChildProcess::wait(const std::function<void(const std::string&)>& line, const std::function<bool()>& should_continue) {
  std::string text;
  pollfd source{output_, POLLIN, 0};
  for (bool is_open = true; is_open;) {
    if (!should_continue()) {
      end();
      break;
    }
    if (poll(&source, 1, poll_ms) <= 0) continue;
    char buffer[1 << 12];
    const ssize_t count = read(output_, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    is_open = count > 0;
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    if (!is_open && !text.empty()) text += '\n';
    for (std::size_t end = 0; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1)) line(text.substr(0, end));
  }
  while (!has_ended_) has_ended_ = waitpid(id_, &status_, 0) == id_ || errno != EINTR;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

}  // namespace hooke
