// What was done in the laboratory, frame by frame, with a fingerprint of every frame: enough to do it again and to see where
// it came out otherwise. A text, a line an item (docs/recording-format.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "edit/command.h"

namespace hooke {

inline constexpr int newest_recording_version = 1;
inline constexpr const char* recording_extension = ".hookelog";

// Of a state: hash_state of all of it, and a byte a group of neighbouring points, so that a difference can be placed. A group
// is one point in scenes of up to max_groups of them.
struct Fingerprint {
  static constexpr std::size_t max_groups = 1024;
  std::uint64_t hash = 0;
  std::vector<std::uint8_t> groups;
  bool operator==(const Fingerprint&) const = default;
};
Fingerprint fingerprint_of(const State& state);

// The first point by its number, and the last one of its group, where two fingerprints of `points` points differ; nothing
// when only the hash or the time does.
std::optional<std::pair<Index, Index>> first_difference(const Fingerprint& a, const Fingerprint& b, Index points);

struct Recording {
  // In the order in which it happened: an edit, a scene that took the place of the one before, the end of a frame.
  using Item = std::variant<Command, std::shared_ptr<const Scene>, Fingerprint>;
  std::shared_ptr<const Scene> start;
  std::vector<Item> items;
  long frames = 0;
  bool is_truncated = false;  // the last line was not finished: who wrote it was stopped
};

// Throws InputError ("FILE: line N: ...") or FileError.
Recording read_recording(const std::filesystem::path& file);
Recording parse_recording(const std::string& text, const std::string& name);

// Writes as it goes, so that a program that is killed leaves what it recorded. Every function throws FileError.
class RecordingWriter {
 public:
  RecordingWriter(const std::filesystem::path& file, const Scene& start);

  // An edit that was just applied to the scene.
  void record(const Command& command, const Scene& now);
  void record_scene(const Scene& scene);
  void record_frame(const State& state);
  // All of it is in the file.
  void close();

  const std::filesystem::path& file() const { return file_; }
  long frames() const { return frames_; }

 private:
  void write_line(const std::string& line);

  std::filesystem::path file_;
  std::ofstream out_;
  std::uint64_t bytes_ = 0;
  long frames_ = 0;
};

}  // namespace hooke
