// The recording that is being written, if any. A write error ends the recording without disturbing the session.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lab/recording.h"

namespace hooke {

class Recorder {
 public:
  // Starts a recording with this scene; an earlier one ends.
  void start(const std::filesystem::path& file, const Scene& scene);
  void stop();

  // Like those of RecordingWriter; no effect if there is no recording.
  void record(const Command& command, const Scene& now);
  void record_scene(const Scene& scene);
  void record_frame(const State& state);

  // The file being written; null: none.
  const std::filesystem::path* file() const { return writer_ ? &writer_->file() : nullptr; }
  // The error that ended the last recording; empty: none.
  const std::string& error() const { return error_; }

 private:
  void write(const std::function<void(RecordingWriter&)>& record);

  std::optional<RecordingWriter> writer_;
  std::string error_;
};

}  // namespace hooke
