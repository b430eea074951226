#include "lab/recording.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <limits>

#include "base/build_info.h"
#include "base/errors.h"
#include "base/file_limits.h"
#include "base/json_text.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "edit/command_text.h"
#include "edit/resume_state.h"
#include "formats/scene_file.h"
#include "formats/texture.h"
#include "sim/model/hash.h"

namespace hooke {
namespace {

// The longest text of a command; instead of a longer one, the resulting scene is recorded.
constexpr std::size_t max_command_bytes = std::size_t{1} << 20;

// Frames between two flushes of the file: about a second.
constexpr long frames_per_flush = 60;

std::size_t group_of(std::size_t point, std::size_t points) {
  const std::size_t size = (points + Fingerprint::max_groups - 1) / Fingerprint::max_groups;
  return point / size;
}

std::string hexadecimal(const Fingerprint& fingerprint) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += digits[(fingerprint.hash >> shift) & 15];
  for (const std::uint8_t group : fingerprint.groups) {
    text += digits[group >> 4];
    text += digits[group & 15];
  }
  return text;
}

Fingerprint read_fingerprint(const JsonField& field) {
  const std::string_view text = field.text();
  const auto byte_at = [&](std::size_t at) {
    unsigned byte = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + at + 2, byte, 16);
    if (error != std::errc() || end != text.data() + at + 2) field.refuse("must be hexadecimal digits");
    return static_cast<std::uint8_t>(byte);
  };
  if (text.size() < 16 || text.size() % 2 != 0 || text.size() > 16 + 2 * Fingerprint::max_groups)
    field.refuse("must be the 16 hexadecimal digits of a hash, and two for every group of points");
  Fingerprint fingerprint;
  for (std::size_t at = 0; at < 16; at += 2) fingerprint.hash = fingerprint.hash << 8 | byte_at(at);
  for (std::size_t at = 16; at < text.size(); at += 2) fingerprint.groups.push_back(byte_at(at));
  return fingerprint;
}

// Removes line ends and the indents after them. Both occur only between values: those inside strings are escaped.
std::string to_single_line(std::string_view text) {
  std::string line;
  bool in_indent = false;
  for (const char c : text) {
    in_indent = c == '\n' || (in_indent && c == ' ');
    if (!in_indent) line += c;
  }
  return line;
}

std::string scene_line(const Scene& scene) {
  Scene plain = scene;
  plain.system.colliders = carried_colliders(scene.system, scene.state);
  // a picture of the user's own is in another file
  if (!is_shipped_texture(plain.view.texture)) {
    plain.view.texture.clear();
    plain.view.texture_size.reset();
  }
  return to_single_line(format_scene(plain));
}

std::string resume_state_line(const Scene& scene) {
  JsonWriter out;
  out.begin_object(JsonWriter::Layout::Line);
  out.key("rest");
  write_resume_state(out, resume_state_of(scene));
  out.end();
  return out.take();
}

class RecordingReader {
 public:
  RecordingReader(const std::string& text, const std::string& name) : text_(text), file_(name) {}

  Recording read() {
    while (next_line()) read_line();
    if (number_ == 0 && recording_.is_truncated) refuse("ends within its first line: must begin with \"hooke_recording\"");
    if (number_ == 0) refuse("empty: must begin with \"hooke_recording\"");
    if (pending_scene_) refuse("must continue with the rest of the scene: {\"rest\": ...}");
    if (!recording_.start) refuse("no scene: must be on the second line");
    return std::move(recording_);
  }

 private:
  bool next_line() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = text_.find('\n', at_);
    // a line that its writer did not finish is ignored
    if (end == std::string::npos) {
      recording_.is_truncated = true;
      return false;
    }
    line_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    name_ = file_ + ": line " + std::to_string(++number_);
    return true;
  }

  void read_line() {
    if (is_scene()) return read_scene();
    unknown_.clear();
    has_known_member_ = false;
    const auto take = [this](const JsonField& field) { read_member(field); };
    read_members(line_, name_, take, true);
    if (number_ == 1)
      check_version();
    else if (!has_known_member_)
      refuse_unknown_line();
  }

  // Whether the line has the member "hooke" and is not the first line of a recording, which may have any unknown member.
  bool is_scene() const {
    // most lines are frames
    if (line_.find("\"hooke\"") == std::string::npos && line_.find('\\') == std::string::npos) return false;
    bool has_scene = false, has_recording = false;
    walk_json(line_, name_,
              {.is_list = [](std::string_view) { return true; },
               .item = [](std::string_view, std::size_t, std::string_view) {},
               .member =
                   [&](std::string_view key, std::string_view) {
                     has_scene = has_scene || key == "hooke";
                     has_recording = has_recording || key == "hooke_recording";
                   },
               .is_one_line = true});
    return has_scene && !(number_ == 1 && has_recording);
  }

  void read_scene() {
    if (number_ == 1) refuse("a scene: must be a recording, {\"hooke_recording\": 1, ...}");
    if (pending_scene_) refuse("must be the rest of the scene: {\"rest\": ...}");
    pending_scene_ = parse_scene(line_, name_).scene;
    if (const std::string& texture = pending_scene_->view.texture; is_shipped_texture(texture))
      pending_scene_->cloth_texture.picture = read_texture(texture, {}, name_ + ": view.texture");
  }

  // A line consists of one known member; members that a newer program adds to it are optional and ignored.
  void read_member(const JsonField& field) {
    if (number_ == 1) return read_header(field);
    const bool is_frame = field.is("frame"), is_rest = field.is("rest");
    if (!is_frame && !is_rest && !is_command(field)) {
      if (unknown_.empty()) unknown_ = field.key();
      return;
    }
    has_known_member_ = true;
    if (is_rest != pending_scene_.has_value())
      field.refuse(is_rest ? "must come after a scene" : "must be the rest of the scene: {\"rest\": ...}");
    if (is_rest) {
      restore_resume_state(field, *pending_scene_);
      add_pending_scene();
    } else if (!recording_.start) {
      field.refuse("must be a scene first");
    } else if (is_frame) {
      recording_.items.emplace_back(read_fingerprint(field));
      ++recording_.frames;
    } else {
      recording_.items.emplace_back(read_command(field));
    }
  }

  void read_header(const JsonField& field) {
    if (field.is("hooke_recording")) version_ = field.integer(1, std::numeric_limits<int>::max());
    if (field.is("program") && field.value().IsString()) recording_.program = field.text();
  }

  void check_version() const {
    if (version_ == 0) refuse("must be a recording: {\"hooke_recording\": 1, ...}");
    if (version_ > newest_recording_version)
      refuse("version " + std::to_string(version_) + " of the format: this is Hooke " + program_version + ", which reads up to version " +
             std::to_string(newest_recording_version) + "; " + needed_program());
  }

  // A line without a known member may hold an edit, so it cannot be ignored.
  [[noreturn]] void refuse_unknown_line() const {
    if (pending_scene_) refuse("must be the rest of the scene: {\"rest\": ...}");
    if (unknown_.empty()) refuse("no member: must be an edit or a frame");
    const bool is_other_program = !recording_.program.empty() && recording_.program != program_version;
    refuse(printable(unknown_) + ": is unknown" + (is_other_program ? "; " + needed_program() : ""));
  }

  std::string needed_program() const {
    return recording_.program.empty() ? "a newer program is required"
                                      : "Hooke " + printable(recording_.program) + " wrote it: that version or a newer one is required";
  }

  void add_pending_scene() {
    auto scene = std::make_shared<const Scene>(std::move(*pending_scene_));
    pending_scene_.reset();
    if (recording_.start)
      recording_.items.emplace_back(std::move(scene));
    else
      recording_.start = std::move(scene);
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError((number_ == 0 ? file_ : name_) + ": " + what); }

  const std::string& text_;
  std::string file_, name_, line_;
  std::size_t at_ = 0, number_ = 0;
  std::int64_t version_ = 0;            // of the format; 0: not read yet
  std::string unknown_;                 // first unknown member of the line
  bool has_known_member_ = false;       // in the line
  std::optional<Scene> pending_scene_;  // its rest has not been read yet
  Recording recording_;
};

}  // namespace

Fingerprint fingerprint_of(const State& state) {
  Fingerprint fingerprint{.hash = hash_state(state), .groups = {}};
  const std::size_t points = state.position.size();
  if (points == 0) return fingerprint;
  fingerprint.groups.assign(group_of(points - 1, points) + 1, 0);
  for (std::size_t i = 0; i < points; ++i) {
    std::uint64_t mixed = i;
    for (const Vec3* v : {&state.position[i], &state.velocity[i]})
      for (int c = 0; c < 3; ++c) mixed = (std::rotl(mixed, 23) ^ std::bit_cast<std::uint64_t>((*v)[c])) * 0x9e3779b97f4a7c15ull;
    fingerprint.groups[group_of(i, points)] ^= static_cast<std::uint8_t>(mixed >> 56);
  }
  return fingerprint;
}

std::optional<std::pair<Index, Index>> first_difference(const Fingerprint& a, const Fingerprint& b, Index points) {
  const std::size_t count = static_cast<std::size_t>(points);
  if (a.groups.size() != b.groups.size() || count == 0) return std::nullopt;
  const auto [differing, other] = std::ranges::mismatch(a.groups, b.groups);
  if (differing == a.groups.end()) return std::nullopt;
  const auto group = static_cast<std::size_t>(differing - a.groups.begin());
  std::size_t first = 0, last = 0;
  while (group_of(first, count) < group) ++first;
  for (last = first; last + 1 < count && group_of(last + 1, count) == group;) ++last;
  return std::pair(static_cast<Index>(first), static_cast<Index>(last));
}

Recording read_recording(const std::filesystem::path& file) { return parse_recording(read_file(file), printable(file.native())); }

Recording parse_recording(const std::string& text, const std::string& name) { return RecordingReader(text, name).read(); }

namespace {

// Throws FileError with the reason of the system.
void check_written(const std::ofstream& out, const std::filesystem::path& file) {
  if (!out) throw FileError(printable(file.native()) + ": cannot be written: " + std::strerror(errno != 0 ? errno : EIO));
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& file, const Scene& start) : file_(file), out_(file, std::ios::binary) {
  check_written(out_, file_);
  write_line("{\"hooke_recording\": " + std::to_string(newest_recording_version) + ", \"program\": " + to_json(program_version) + "}");
  record_scene(start);
}

void RecordingWriter::record(const Command& command, const Scene& now) {
  if (!std::holds_alternative<Replace>(command)) {
    JsonWriter out;
    write_command(out, command);
    if (const std::string line = out.take(); line.size() <= max_command_bytes) {
      write_line(line);
      return;
    }
  }
  record_scene(now);
}

void RecordingWriter::record_scene(const Scene& scene) {
  write_line(scene_line(scene));
  write_line(resume_state_line(scene));
  out_.flush();
}

void RecordingWriter::record_frame(const State& state) {
  write_line("{\"frame\": \"" + hexadecimal(fingerprint_of(state)) + "\"}");
  if (++frames_ % frames_per_flush == 0) out_.flush();
}

void RecordingWriter::write_line(const std::string& line) {
  bytes_ += line.size() + 1;
  if (bytes_ > max_file_bytes)
    throw FileError(printable(file_.native()) + ": the recording is full: files of more than 256 MiB are not read");
  errno = 0;
  out_ << line << '\n';
  check_written(out_, file_);
}

void RecordingWriter::close() {
  errno = 0;
  out_.close();
  check_written(out_, file_);
}

}  // namespace hooke
