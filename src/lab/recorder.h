// The recording that is being written, if there is one. One that cannot be written ends, and what it recorded of is not
// disturbed.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lab/recording.h"

namespace hooke {

class Recorder {
 public:
  // From this scene on; an earlier one ends.
  void start(const std::filesystem::path& file, const Scene& scene);
  void stop();

  // As RecordingWriter's; nothing without a recording.
  void record(const Command& command, const Scene& now);
  void record_scene(const Scene& scene);
  void record_frame(const State& state);

  // What is written; null: nothing.
  const std::filesystem::path* file() const { return writer_ ? &writer_->file() : nullptr; }
  // Why the last one ended before it was stopped; empty: it did not.
  const std::string& error() const { return error_; }

 private:
  void write(const std::function<void(RecordingWriter&)>& record);

  std::optional<RecordingWriter> writer_;
  std::string error_;
};

}  // namespace hooke
