#include "cli/progress_bar.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace hooke {

ProgressBar::ProgressBar(long total, bool enabled) : total_(total), enabled_(enabled && total > 0 && isatty(STDERR_FILENO) == 1) {}

// clears its line
ProgressBar::~ProgressBar() {
  if (was_shown_) std::fprintf(stderr, "\r%60s\r", "");
}

void ProgressBar::show(long done) {
  constexpr std::chrono::milliseconds pause(100);
  const auto now = Clock::now();
  if (!enabled_ || now - last_ < pause) return;
  last_ = now;
  was_shown_ = true;

  constexpr int width = 30;
  const double part = static_cast<double>(done) / static_cast<double>(total_);
  const double left = std::chrono::duration<double>(now - start_).count() * (1.0 / part - 1.0);
  std::string bar(width, '.');
  bar.replace(0, static_cast<std::size_t>(part * width), static_cast<std::size_t>(part * width), '#');
  std::fprintf(stderr, "\r[%s] %3.0f %%  %.0f s left    ", bar.c_str(), 100.0 * part, left);
}

}  // namespace hooke
