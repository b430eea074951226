// The desktop's own dialog for files, as a program beside ours: zenity or kdialog, started without a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hooke {

class SystemDialog {
 public:
  enum class Kind { Open, Save };

  SystemDialog() = default;
  ~SystemDialog();  // closes it
  SystemDialog(const SystemDialog&) = delete;
  SystemDialog& operator=(const SystemDialog&) = delete;

  // The program there is, or an empty path.
  static std::filesystem::path find();
  // How `program` is called; the first word is its path.
  static std::vector<std::string> command_line(const std::filesystem::path& program, Kind kind, const std::filesystem::path& start);

  // Whether it came up.
  bool start(Kind kind, const std::filesystem::path& start);
  bool is_open() const { return process_ > 0; }
  Kind kind() const { return kind_; }
  // Once it is closed: the file that was chosen, or an empty path.
  std::optional<std::filesystem::path> take_answer();

 private:
  void stop();
  int process_ = 0, answers_ = -1;
  Kind kind_ = Kind::Open;
  std::string answer_;
};

}  // namespace hooke
