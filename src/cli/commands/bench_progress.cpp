#include "cli/commands/bench_progress.h"

#include <unistd.h>

#include <cstdio>

#include "base/formatted.h"

namespace hooke {

BenchProgress::BenchProgress(std::size_t parts, bool enabled) : parts_(parts), enabled_(enabled && isatty(STDERR_FILENO) == 1) {}

void BenchProgress::begin_part(const std::string& label) {
  ++started_;
  label_ = label;
  part_start_ = Clock::now();
  show("");
}

void BenchProgress::show(const std::string& detail) const {
  if (enabled_) std::fprintf(stderr, "\r\033[K%zu of %zu%s: %s  %s", started_, parts_, time_left().c_str(), label_.c_str(), detail.c_str());
}

void BenchProgress::end_part(bool was_measured) {
  if (!was_measured) return;
  ++measured_;
  spent_ += Clock::now() - part_start_;
}

void BenchProgress::clear() const {
  if (enabled_) std::fputs("\r\033[K", stderr);
}

// from the mean time of the parts measured so far
std::string BenchProgress::time_left() const {
  if (measured_ == 0) return "";
  const double each = std::chrono::duration<double>(spent_).count() / static_cast<double>(measured_);
  const double seconds = each * static_cast<double>(parts_ + 1 - started_);
  return seconds < 90.0 ? formatted(", %.0f s left", seconds) : formatted(", %.0f min left", seconds / 60.0);
}

}  // namespace hooke
