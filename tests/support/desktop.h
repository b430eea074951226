// A separate display (Xvfb), the program on it, and user input (xdotool), for tests of the real window.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/contents.h"

namespace hooke {

inline void rest(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

// Polls until the condition holds, by default for up to half a minute, because the machine may be busy.
inline bool wait_for(const std::function<bool()>& condition, double seconds = 30.0) {
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::duration<double>(seconds)) {
    if (condition()) return true;
    rest(0.05);
  }
  return false;
}

// A child process whose output goes to a file; killed by the destructor.
class Process {
 public:
  Process() = default;
  Process(const std::vector<std::string>& words, const std::filesystem::path& output) {
    pid_ = ::fork();
    if (pid_ != 0) return;
    // killed when the test process ends for any reason
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int to = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(to, STDOUT_FILENO);
    ::dup2(to, STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ~Process() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Process(Process&& other) noexcept : pid_(std::exchange(other.pid_, 0)) {}
  Process& operator=(Process&& other) noexcept {
    std::swap(pid_, other.pid_);
    return *this;
  }

  // Never signal 0 or -1, which address groups of other processes.
  void signal(int which) const {
    if (pid_ > 0) ::kill(pid_, which);
  }
  bool is_running() { return pid_ > 0 && !collect(WNOHANG); }
  // The exit code; -1 if a signal ended the process or it did not end.
  int exit_code() {
    if (!wait_for([this] { return !is_running(); })) return -1;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  bool collect(int options) {
    if (::waitpid(pid_, &status_, options) != pid_) return false;
    pid_ = 0;
    return true;
  }
  pid_t pid_ = 0;
  int status_ = 0;
};

class Desktop {
 public:
  static constexpr int width = 1280, height = 800;

  Desktop() {
    folder_ = std::filesystem::temp_directory_path() / ("hooke_window_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    const std::filesystem::path number = folder_ / "display";
    const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
    // An explicit display number: servers that search for a free one at the same time can choose the same. -displayfd reports when the
    // server is ready.
    static int many = 0;
    const std::string own = ":" + std::to_string(100 + (::getpid() + 7919 * many++) % 50000);
    server_ = Process(
        {"sh", "-c", "exec Xvfb " + own + " -displayfd 3 -noreset -screen 0 " + screen + " -dpi 96 -nolisten tcp 3>" + number.string()},
        folder_ / "server.log");
    wait_for([&] { return contents(number).find('\n') != std::string::npos; });
    std::istringstream(contents(number)) >> display_;
    ::setenv("DISPLAY", (":" + display_).c_str(), 1);
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    ::unsetenv("WAYLAND_DISPLAY");
    ::setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
    ::setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
  }
  ~Desktop() {
    std::error_code error;  // ignored, since a program that is being killed may still write there
    std::filesystem::remove_all(folder_, error);
  }
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  bool is_up() const { return !display_.empty(); }
  const std::filesystem::path& folder() const { return folder_; }

  // The output of a command.
  std::string output_of(const std::string& command) const {
    const std::filesystem::path answer = folder_ / "answer";
    if (std::system((command + " >" + answer.string() + " 2>/dev/null").c_str()) != 0) return {};
    return contents(answer);
  }
  std::string window_title() const { return output_of("xdotool search --onlyvisible --class hooke getwindowname"); }
  testing::AssertionResult wait_for_title(const std::string& title) const {
    if (wait_for([&] { return window_title() == title + "\n"; })) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "the title is " << window_title() << "; the program says: " << contents(folder_ / "output")
                                       << "; the display says: " << contents(folder_ / "server.log");
  }

  void run_xdotool(const std::string& what) const { output_of("xdotool " + what); }
  // Presses, waits and releases: users do not press keys for less than a frame.
  void key(const std::string& name) const {
    run_xdotool("keydown " + name);
    rest(0.12);
    run_xdotool("keyup " + name);
    rest(0.12);
  }
  void control(const std::string& name) const {
    run_xdotool("keydown ctrl");
    key(name);
    run_xdotool("keyup ctrl");
  }
  void type(const std::string& text) const { run_xdotool("type --delay 40 " + text); }
  void move(const glm::dvec2& to) const {
    run_xdotool("mousemove " + std::to_string(static_cast<int>(to.x)) + " " + std::to_string(static_cast<int>(to.y)));
    rest(0.12);
  }
  void press(const glm::dvec2& at) const {
    move(at);
    run_xdotool("mousedown 1");
    rest(0.12);
  }
  void release() const {
    run_xdotool("mouseup 1");
    rest(0.12);
  }
  void click(const glm::dvec2& at) const {
    press(at);
    release();
  }
  void drag(const glm::dvec2& from, const glm::dvec2& to) const {
    press(from);
    for (const double fraction : {0.3, 0.6, 1.0}) move(from + fraction * (to - from));
    release();
  }
  // "close" or "drop", with a file. Returns whether the window accepted it.
  bool send_to_window(const std::string& what, const std::filesystem::path& file = {}) const {
    const std::string window = output_of("xdotool search --onlyvisible --class hooke");
    const std::string words = HOOKE_WINDOW_MESSAGE " " + what + " " + window.substr(0, window.find('\n')) + " " + file.string();
    return std::system(words.c_str()) == 0;
  }
  // A hash of the screen, excluding a lower right corner of this size.
  std::string digest(int width_left_out, int height_left_out) const {
    return output_of(HOOKE_WINDOW_MESSAGE " digest " + std::to_string(width_left_out) + " " + std::to_string(height_left_out));
  }
  // A screenshot for visual inspection.
  void save_screenshot(const std::filesystem::path& file) const { output_of("import -window root " + file.string()); }

 private:
  std::filesystem::path folder_;
  std::string display_;
  Process server_;
};

}  // namespace hooke
