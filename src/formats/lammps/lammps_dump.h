// Reads the frames that LAMMPS has written (dump style custom).
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/types.h"

namespace hooke {

struct LammpsFrame {
  long step = 0;
  std::vector<Vec3> position, velocity;  // [m], [m/s], in the order of the ids
  std::vector<Vec3> force;               // [N]; empty: the dump has none
};

class LammpsDump {
 public:
  // For a dump of `points` atoms with the ids 1 to `points`. Throws FileError.
  LammpsDump(const std::filesystem::path& file, std::size_t points);

  // False at the end. Throws InputError ("FILE: line N: ...") if the file is not such a dump.
  bool next(LammpsFrame& frame);

 private:
  [[noreturn]] void refuse(const std::string& why) const;
  bool next_line();
  void expect_line();

  std::filesystem::path file_;
  std::ifstream stream_;
  std::size_t points_;
  std::string line_;
  long number_ = 0;  // of the line, from 1
};

}  // namespace hooke
