// A recording that is done again, frame by frame: what comes next in it, and whether it comes out the same.
#pragma once

#include <memory>
#include <string>

#include "lab/recording.h"

namespace hooke {

class Playback {
 public:
  void start(std::shared_ptr<const Recording> recording);
  // What it found out is still known, until the next one starts or it is forgotten.
  void stop() { recording_.reset(); }
  void clear_difference() { difference_.clear(); }
  bool is_on() const { return recording_ != nullptr; }

  // What was done next, before the next frame: a Command or a scene; null where a frame comes first. It is over when nothing
  // comes any more.
  const Recording::Item* next_edit();

  // Compares the frame just computed with the recorded one, or says that it diverged; where they are not the same it is over.
  void compare(const State& state, Index points);
  void record_divergence();
  // Whether the last frame has been done; edits may follow.
  bool is_after_last_frame() const { return is_on() && frames_ == recording_->frames; }

  // Where it came out otherwise: "frame 12, at 0.2 s: point 5 is not where recorded"; empty: nowhere so far.
  const std::string& difference() const { return difference_; }
  // The share of the frames that has been done [1].
  double progress() const { return static_cast<double>(frames_) / static_cast<double>(recording_->frames); }

 private:
  std::shared_ptr<const Recording> recording_;
  std::size_t next_ = 0;  // item
  long frames_ = 0;
  std::string difference_;
};

}  // namespace hooke
