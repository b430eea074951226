#include "lab/playback.h"

#include "base/bounds.h"
#include "base/build_info.h"
#include "base/printable.h"

namespace hooke {

void Playback::start(std::shared_ptr<const Recording> recording) {
  recording_ = std::move(recording);
  next_ = 0;
  frames_ = 0;
  difference_.clear();
}

const Recording::Item* Playback::next_edit() {
  if (!is_on()) return nullptr;
  const auto& items = recording_->items;
  if (next_ < items.size()) return std::holds_alternative<Fingerprint>(items[next_]) ? nullptr : &items[next_++];
  stop();
  return nullptr;
}

void Playback::compare(const State& state, Index points) {
  const Fingerprint& recorded = std::get<Fingerprint>(recording_->items[next_++]);
  ++frames_;
  if (!difference_.empty()) return;
  const Fingerprint now = fingerprint_of(state);
  if (now == recorded) return;

  difference_ = "frame " + std::to_string(frames_) + ", at " + format_exact(state.time) + " s: ";
  if (const auto apart = first_difference(now, recorded, points)) {
    const auto& [first, last] = *apart;
    difference_ += first == last ? "point " + std::to_string(first) + " is"
                                 : "points " + std::to_string(first) + " to " + std::to_string(last) + " are";
    difference_ += " not where recorded";
  } else {
    difference_ += "not the state that was recorded";
  }
  if (!recording_->program.empty() && recording_->program != program_version)
    difference_ += "; Hooke " + printable(recording_->program) + " recorded it";
}

void Playback::record_divergence() {
  if (is_on()) difference_ = "frame " + std::to_string(frames_ + 1) + " diverges; it did not when it was recorded";
  stop();
}

}  // namespace hooke
