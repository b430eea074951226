#include "app/document/system_dialog.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <utility>

extern char** environ;

namespace hooke {
namespace {

namespace fs = std::filesystem;

// Longer answers are not paths.
constexpr std::size_t longest_answer = 1 << 16;

}  // namespace

fs::path find_program(const char* name) {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders != nullptr ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');) {
    fs::path program = fs::path(folder) / name;
    if (!folder.empty() && folder.front() == '/' && ::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

SystemDialog::~SystemDialog() { stop(); }

fs::path SystemDialog::find() {
  const fs::path zenity = find_program("zenity");
  return zenity.empty() ? find_program("kdialog") : zenity;
}

std::vector<std::string> SystemDialog::command_line(const fs::path& program, Kind kind, const fs::path& start) {
  const std::string title = kind == Kind::Open ? "Open scene" : "Save scene as";
  if (program.filename() == "kdialog")
    return {program.string(), "--title", title, kind == Kind::Open ? "--getopenfilename" : "--getsavefilename", start.string()};
  std::vector<std::string> command_line = {program.string(), "--file-selection", "--title=" + title, "--filename=" + start.string()};
  if (kind == Kind::Save) command_line.insert(command_line.end(), {"--save", "--confirm-overwrite"});
  return command_line;
}

bool SystemDialog::start(Kind kind, const fs::path& start) {
  stop();
  const fs::path program = find();
  int pipe[2];
  if (program.empty() || ::pipe2(pipe, O_CLOEXEC) != 0) return false;
  ::fcntl(pipe[0], F_SETFL, O_NONBLOCK);

  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  std::vector<std::string> called = command_line(program, kind, start);
  std::vector<char*> arguments;
  for (std::string& argument : called) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  const bool started = ::posix_spawn(&process, program.c_str(), &actions, nullptr, arguments.data(), environ) == 0;
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  if (!started) {
    ::close(pipe[0]);
    return false;
  }
  process_ = process;
  answers_ = pipe[0];
  kind_ = kind;
  answer_.clear();
  return true;
}

std::optional<fs::path> SystemDialog::take_answer() {
  if (!is_open()) return std::nullopt;
  char bytes[4096];
  ssize_t count = 0;
  while ((count = ::read(answers_, bytes, sizeof bytes)) > 0 && answer_.size() < longest_answer)
    answer_.append(bytes, static_cast<std::size_t>(count));
  if (count != 0) return std::nullopt;  // the dialog is still open

  // it closed its end of the pipe, so it is exiting
  int status = 0;
  ::waitpid(std::exchange(process_, 0), &status, 0);
  ::close(std::exchange(answers_, -1));
  if (!answer_.empty() && answer_.back() == '\n') answer_.pop_back();
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? fs::path(answer_) : fs::path();
}

void SystemDialog::stop() {
  if (!is_open()) return;
  ::kill(process_, SIGTERM);
  ::waitpid(std::exchange(process_, 0), nullptr, 0);
  ::close(std::exchange(answers_, -1));
}

}  // namespace hooke
