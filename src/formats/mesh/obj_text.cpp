#include "formats/mesh/obj_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

constexpr std::size_t max_corners = 1000;     // of one polygon
constexpr std::size_t max_quoted_bytes = 40;  // bytes of an invalid value in a message

// Statements that do not affect the shape.
constexpr std::array<std::string_view, 18> ignored_keywords{"vn",       "vt",       "vp",     "g",          "o",         "s",
                                                            "mg",       "usemtl",   "mtllib", "usemap",     "maplib",    "bevel",
                                                            "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj", "res"};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& file) : lines_(text), file_(file) {}

  Mesh read(std::vector<std::string>& warnings) {
    while (next_statement()) {
      std::string_view rest = statement_;
      const std::string_view name = next_token(rest);
      if (name == "v")
        add_vertex(rest);
      else if (name == "f")
        add_polygon(rest);
      else if (name == "l")
        add_lines(rest);
      else if (name == "p")
        add_points(rest);
      else
        skip(name);
    }
    if (max_vertex_ >= vertex_count()) refuse_missing(max_vertex_line_, max_vertex_element_, max_vertex_ + 1);
    warn_about_skipped(warnings);
    return std::move(mesh_);
  }

 private:
  // Without comments. A backslash at the end of a line continues it on the next.
  bool next_statement() {
    std::string_view line;
    if (!lines_.next(line)) return false;
    line_ = lines_.number();
    statement_ = line.substr(0, line.find('#'));
    while (removed_backslash() && lines_.next(line)) statement_ += line.substr(0, line.find('#'));
    return true;
  }

  bool removed_backslash() {
    const std::size_t last = statement_.find_last_not_of(" \t");
    if (last == std::string::npos || statement_[last] != '\\') return false;
    statement_[last] = ' ';
    return true;
  }

  // x y z, optionally followed by a weight or a color, which are not read
  void add_vertex(std::string_view rest) {
    Vec3 x(0.0);
    for (int c = 0; c < 3; ++c) {
      const std::string_view word = next_token(rest);
      if (word.empty()) refuse("v: " + std::to_string(c) + " numbers: must be at least 3");
      const auto number = parse_number(word);
      if (!number) refuse("v: \"" + printable(word, max_quoted_bytes) + "\": must be a number");
      if (!(std::abs(*number) <= largest_coordinate)) refuse("v: " + format_rounded(*number) + ": must be from -1e9 to 1e9 (meters)");
      x[c] = *number;
    }
    if (mesh_.vertices.size() == max_points) refuse("v: too many vertices: must be at most " + std::to_string(max_points));
    mesh_.vertices.push_back(x);
  }

  // Of a vertex written as 7, 7/1, 7//3 or 7/1/3; a negative number counts backwards from the last vertex. Vertices may come after the
  // elements that use them.
  Index vertex_of(std::string_view word, char element) {
    const std::string_view vertex = word.substr(0, word.find('/')), others = word.substr(vertex.size());
    const auto number = parse_integer(vertex);
    if (!number || *number == 0 || others.find_first_not_of("/-+0123456789") != std::string_view::npos)
      refuse(std::string(1, element) + ": \"" + printable(word, max_quoted_bytes) + "\": must be the number of a vertex");
    const Index index = *number > 0 ? *number - 1 : vertex_count() + *number;
    if (index < 0) refuse_missing(line_, element, *number);
    if (index > max_vertex_) {
      max_vertex_ = index;
      max_vertex_element_ = element;
      max_vertex_line_ = line_;
    }
    return index;
  }

  void add_polygon(std::string_view rest) {
    std::size_t count = 0;
    for (std::string_view word = next_token(rest); !word.empty(); word = next_token(rest)) {
      if (count++ == max_corners) refuse("f: more than " + std::to_string(max_corners) + " corners: too many");
      mesh_.corners.push_back(vertex_of(word, 'f'));
    }
    // with fewer corners it has no area and is removed later
    triangles_ += count < 3 ? 1 : count - 2;
    if (triangles_ > max_faces) refuse("f: too many faces: must be at most " + std::to_string(max_faces) + ", counted in triangles");
    mesh_.polygon_ends.push_back(static_cast<Index>(mesh_.corners.size()));
  }

  void add_lines(std::string_view rest) {
    Index last = no_index;
    for (std::string_view word = next_token(rest); !word.empty(); word = next_token(rest)) {
      const Index vertex = vertex_of(word, 'l');
      if (mesh_.lines.size() == max_springs) refuse("l: too many lines: must be at most " + std::to_string(max_springs));
      if (last != no_index) mesh_.lines.push_back({last, vertex});
      last = vertex;
    }
  }

  void add_points(std::string_view rest) {
    for (std::string_view word = next_token(rest); !word.empty(); word = next_token(rest)) {
      if (mesh_.lone_points.size() == max_points) refuse("p: too many points: must be at most " + std::to_string(max_points));
      mesh_.lone_points.push_back(vertex_of(word, 'p'));
    }
  }

  void skip(std::string_view name) {
    if (name.empty() || std::find(ignored_keywords.begin(), ignored_keywords.end(), name) != ignored_keywords.end()) return;
    if (skipped_++ > 0) return;
    first_skipped_ = line_location(file_, line_) + ": \"" + printable(name, max_quoted_bytes) + "\": ";
  }

  void warn_about_skipped(std::vector<std::string>& warnings) const {
    if (skipped_ > 0)
      warnings.push_back(first_skipped_ +
                         (skipped_ == 1 ? "is ignored" : "and " + std::to_string(skipped_ - 1) + " more statements are ignored") +
                         ": only vertices, faces, lines and points are read");
  }

  Index vertex_count() const { return static_cast<Index>(mesh_.vertices.size()); }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(line_location(file_, line_) + ": " + what); }
  [[noreturn]] void refuse_missing(int line, char element, Index number) const {
    throw InputError(line_location(file_, line) + ": " + element + ": " + std::to_string(number) + ": there are only " +
                     pluralize(mesh_.vertices.size(), "vertex", "vertices"));
  }

  TextLines lines_;
  const std::string& file_;
  std::string statement_;
  int line_ = 0;  // where the statement begins
  Mesh mesh_;
  std::uint64_t triangles_ = 0;
  Index max_vertex_ = no_index;  // of any element so far
  char max_vertex_element_ = 'f';
  int max_vertex_line_ = 0;
  std::size_t skipped_ = 0;
  std::string first_skipped_;
};

}  // namespace

Mesh parse_obj_text(std::string_view text, const std::string& file, std::vector<std::string>& warnings) {
  return ObjReader(text, file).read(warnings);
}

}  // namespace hooke
