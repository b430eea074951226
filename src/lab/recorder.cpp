#include "lab/recorder.h"

#include "base/errors.h"

namespace hooke {

void Recorder::start(const std::filesystem::path& file, const Scene& scene) {
  stop();
  try {
    writer_.emplace(file, scene);
  } catch (const FileError& error) {
    error_ = error.what();
  }
}

void Recorder::stop() {
  error_.clear();
  write([](RecordingWriter& writer) { writer.close(); });
  writer_.reset();
}

void Recorder::record(const Command& command, const Scene& now) {
  write([&](RecordingWriter& writer) { writer.record(command, now); });
}
void Recorder::record_scene(const Scene& scene) {
  write([&](RecordingWriter& writer) { writer.record_scene(scene); });
}
void Recorder::record_frame(const State& state) {
  write([&](RecordingWriter& writer) { writer.record_frame(state); });
}

void Recorder::write(const std::function<void(RecordingWriter&)>& record) {
  if (!writer_) return;
  try {
    record(*writer_);
  } catch (const FileError& error) {
    error_ = error.what();
    writer_.reset();
  }
}

}  // namespace hooke
