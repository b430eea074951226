#include "formats/lammps/lammps_dump.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>

#include "base/errors.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

constexpr std::string_view columns = "ITEM: ATOMS id x y z vx vy vz";

// Unlike parse_number also "nan" and "inf", which a run that diverged contains.
bool parse_any_number(std::string_view word, double& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

}  // namespace

LammpsDump::LammpsDump(const std::filesystem::path& file, std::size_t points) : file_(file), stream_(file), points_(points) {
  if (!stream_) throw FileError(printable(file.native()) + ": cannot be read: " + std::strerror(errno));
}

void LammpsDump::refuse(const std::string& why) const {
  throw InputError(printable(file_.native()) + ": line " + std::to_string(number_) + ": " + why + ": not the expected dump");
}

bool LammpsDump::next_line() {
  if (!std::getline(stream_, line_)) return false;
  ++number_;
  while (!line_.empty() && line_.back() == ' ') line_.pop_back();
  return true;
}

void LammpsDump::expect_line() {
  if (!next_line()) refuse("ends early");
}

bool LammpsDump::next(LammpsFrame& frame) {
  if (!next_line()) return false;
  if (line_ != "ITEM: TIMESTEP") refuse(printable(line_, 80));
  expect_line();
  const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), frame.step);
  if (error != std::errc() || end != line_.data() + line_.size()) refuse("the step must be whole");
  expect_line();
  expect_line();
  if (line_ != std::to_string(points_)) refuse("must be " + std::to_string(points_) + " atoms, not " + printable(line_, 80));
  for (int i = 0; i < 5; ++i) expect_line();
  const bool has_forces = line_ == std::string(columns) + " fx fy fz";
  if (!has_forces && line_ != columns) refuse(printable(line_, 80));

  frame.position.assign(points_, Vec3(0.0));
  frame.velocity.assign(points_, Vec3(0.0));
  frame.force.assign(has_forces ? points_ : 0, Vec3(0.0));
  std::vector<bool> is_read(points_, false);
  for (std::size_t i = 0; i < points_; ++i) {
    expect_line();
    std::string_view rest = line_;
    const std::optional<int> id = parse_integer(next_token(rest));
    if (!id || *id < 1 || static_cast<std::size_t>(*id) > points_ || is_read[static_cast<std::size_t>(*id) - 1]) refuse("id");
    const auto at = static_cast<std::size_t>(*id) - 1;
    is_read[at] = true;
    std::vector<Vec3>* const parts[] = {&frame.position, &frame.velocity, &frame.force};
    for (int part = 0; part < (has_forces ? 3 : 2); ++part)
      for (int c = 0; c < 3; ++c)
        if (!parse_any_number(next_token(rest), (*parts[part])[at][c])) refuse("must be numbers");
  }
  return true;
}

}  // namespace hooke
