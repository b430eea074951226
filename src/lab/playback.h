// Playback of a recording, frame by frame: the next recorded edit, and the comparison with the recorded frames.
#pragma once

#include <memory>
#include <string>

#include "lab/recording.h"

namespace hooke {

class Playback {
 public:
  void start(std::shared_ptr<const Recording> recording);
  // Keeps the difference found until the next start or clear_difference.
  void stop() { recording_.reset(); }
  void clear_difference() { difference_.clear(); }
  bool is_on() const { return recording_ != nullptr; }

  // The next edit before the next frame: a Command or a scene; null if a frame comes first. Playback ends with the last item.
  const Recording::Item* next_edit();

  // Compares the frame just computed with the recorded one, up to the first difference: from there on the motion is another one, to which
  // the rest of the edits applies. Playback ends with a frame that diverged.
  void compare(const State& state, Index points);
  void record_divergence();
  // Whether the last frame has been computed; edits may follow.
  bool is_after_last_frame() const { return is_on() && frames_ == recording_->frames; }

  // Where the playback differs from the recording: "frame 12, at 0.2 s: point 5 is not where recorded"; empty: nowhere so far.
  const std::string& difference() const { return difference_; }
  // Fraction of the frames that has been computed [1].
  double progress() const { return static_cast<double>(frames_) / static_cast<double>(recording_->frames); }

 private:
  std::shared_ptr<const Recording> recording_;
  std::size_t next_ = 0;  // item
  long frames_ = 0;
  std::string difference_;
};

}  // namespace hooke
