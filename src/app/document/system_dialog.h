// The file dialog of the desktop, as a separate program: zenity or kdialog, started without a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hooke {

// The path of an installed program; empty if it is not.
std::filesystem::path find_program(const char* name);

class SystemDialog {
 public:
  enum class Kind { Open, Save };

  SystemDialog() = default;
  ~SystemDialog();  // closes the dialog
  SystemDialog(const SystemDialog&) = delete;
  SystemDialog& operator=(const SystemDialog&) = delete;

  // The installed program, or an empty path.
  static std::filesystem::path find();
  // The arguments for `program`; the first one is its path.
  static std::vector<std::string> command_line(const std::filesystem::path& program, Kind kind, const std::filesystem::path& start);

  // False if it cannot be started.
  bool start(Kind kind, const std::filesystem::path& start);
  bool is_installed() const { return is_installed_; }
  bool is_open() const { return process_ > 0; }
  Kind kind() const { return kind_; }
  // After the user closed it: the chosen file, or an empty path if it was canceled.
  std::optional<std::filesystem::path> take_answer();

 private:
  void stop();
  const bool is_installed_ = !find().empty();
  int process_ = 0, answers_ = -1;
  Kind kind_ = Kind::Open;
  std::string answer_;
};

}  // namespace hooke
