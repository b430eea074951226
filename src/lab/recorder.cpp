#include "lab/recorder.h"

#include "sim/errors.h"

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

void Recorder::note(const Command& command, const Scene& now) {
  write([&](RecordingWriter& writer) { writer.note(command, now); });
}
void Recorder::note_scene(const Scene& scene) {
  write([&](RecordingWriter& writer) { writer.note_scene(scene); });
}
void Recorder::note_frame(const State& state) {
  write([&](RecordingWriter& writer) { writer.note_frame(state); });
}

void Recorder::write(const std::function<void(RecordingWriter&)>& note) {
  if (!writer_) return;
  try {
    note(*writer_);
  } catch (const FileError& error) {
    error_ = error.what();
    writer_.reset();
  }
}

}  // namespace hooke
