// A recording: the edits of a session and a fingerprint of every frame, sufficient to replay it and to locate differences.
// A text file with one item per line (docs/reference/recording-format.md).
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
// About a recording that is_truncated.
inline constexpr const char* truncated_recording = "its last line is incomplete: the replay ends before it";

// Of a state: its hash_state, and one byte for each group of neighboring points, to locate a difference. In scenes of up to max_groups
// points each group is a single point.
struct Fingerprint {
  static constexpr std::size_t max_groups = 1024;
  std::uint64_t hash = 0;
  std::vector<std::uint8_t> groups;
  bool operator==(const Fingerprint&) const = default;
};
Fingerprint fingerprint_of(const State& state);

// Indices of the first and the last point of the first group in which two fingerprints of `points` points differ; nothing if only the
// hash differs.
std::optional<std::pair<Index, Index>> first_difference(const Fingerprint& a, const Fingerprint& b, Index points);

struct Recording {
  // In order: edits, scenes that replace the previous one, ends of frames.
  using Item = std::variant<Command, std::shared_ptr<const Scene>, Fingerprint>;
  std::shared_ptr<const Scene> start;
  std::vector<Item> items;
  long frames = 0;
  std::string program;        // version of Hooke that wrote it; empty: not stated
  bool is_truncated = false;  // the last line is incomplete: its writer was stopped
};

// Throws InputError ("FILE: line N: ...") or FileError.
Recording read_recording(const std::filesystem::path& file);
Recording parse_recording(const std::string& text, const std::string& name);

// Writes each item at once, so that the recording of a killed program is usable. Every function throws FileError.
class RecordingWriter {
 public:
  RecordingWriter(const std::filesystem::path& file, const Scene& start);

  // An edit that was just applied to the scene.
  void record(const Command& command, const Scene& now);
  void record_scene(const Scene& scene);
  void record_frame(const State& state);
  // Ensures that everything is in the file.
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
