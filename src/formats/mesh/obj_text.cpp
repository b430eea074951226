#include "formats/mesh/obj_text.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <span>
#include <streambuf>

#include "base/errors.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

constexpr double largest_coordinate = 1e9;    // [m]
constexpr std::size_t max_corners = 1000;     // of one polygon
constexpr std::size_t max_quoted_bytes = 40;  // bytes of an invalid value in a message

// Statements that do not affect the shape.
constexpr std::array<std::string_view, 18> ignored_keywords{"vn",       "vt",       "vp",     "g",          "o",         "s",
                                                            "mg",       "usemtl",   "mtllib", "usemap",     "maplib",    "bevel",
                                                            "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj", "res"};

// Filters the text for tinyobjloader, which reads non-numbers as 0 and an index 12abc as 12, and opens files named in the text. It receives
// one line at a time, only vertices and polygons, and only if their words are numbers.
class CheckedObjStream : public std::streambuf {
 public:
  CheckedObjStream(std::string_view text, const std::string& file) : lines_(text), file_(file) {}

  // The position of the statement returned last.
  int line() const { return line_; }

  [[noreturn]] void refuse(const std::string& what) const { refuse(line_, what); }
  [[noreturn]] void refuse(int line, const std::string& what) const { throw InputError(line_location(file_, line) + ": " + what); }

  void warn_about_skipped(std::vector<std::string>& warnings) const {
    if (skipped_ == 0) return;
    warnings.push_back(line_location(file_, first_skipped_line_) + ": \"" + first_skipped_ +
                       "\": " + (skipped_ == 1 ? "is ignored" : "and " + std::to_string(skipped_ - 1) + " more statements are ignored") +
                       ": only vertices and faces are read");
  }

 protected:
  int_type underflow() override {
    while (next_statement()) {
      std::string_view rest = statement_;
      const std::string_view name = next_token(rest);
      if (name == "v")
        check_vertex(rest);
      else if (name == "f")
        check_polygon(rest);
      else {
        skip(name);
        continue;
      }
      statement_ += '\n';
      setg(statement_.data(), statement_.data(), statement_.data() + statement_.size());
      return traits_type::to_int_type(statement_[0]);
    }
    return traits_type::eof();
  }

 private:
  // Without comments. A backslash at the end of a line continues it on the next.
  bool next_statement() {
    std::string_view line;
    if (!lines_.next(line)) return false;
    line_ = lines_.number();
    statement_ = line.substr(0, line.find('#'));
    while (!statement_.empty() && statement_.back() == '\\') {
      statement_.back() = ' ';
      if (!lines_.next(line)) break;
      statement_ += line.substr(0, line.find('#'));
    }
    return true;
  }

  // x y z, optionally followed by a weight or a color
  void check_vertex(std::string_view rest) const {
    std::size_t count = 0;
    for (std::string_view word = next_token(rest); !word.empty(); word = next_token(rest), ++count)
      if (!parse_number(word)) refuse("v: \"" + printable(word, max_quoted_bytes) + "\": must be a number");
    if (count < 3) refuse("v: " + std::to_string(count) + " numbers: must be at least 3");
  }

  // 7, 7/1, 7//3 or 7/1/3; a negative number counts backwards from the last vertex
  void check_polygon(std::string_view rest) const {
    std::size_t count = 0;
    for (std::string_view word = next_token(rest); !word.empty(); word = next_token(rest), ++count) {
      const std::string_view vertex = word.substr(0, word.find('/')), others = word.substr(vertex.size());
      const auto index = parse_integer(vertex);
      if (!index || *index == 0 || others.find_first_not_of("/-+0123456789") != std::string_view::npos)
        refuse("f: \"" + printable(word, max_quoted_bytes) + "\": must be the number of a vertex");
      if (count == max_corners) refuse("f: more than " + std::to_string(max_corners) + " corners: too many");
    }
  }

  void skip(std::string_view name) {
    if (name.empty()) return;
    if (std::find(ignored_keywords.begin(), ignored_keywords.end(), name) != ignored_keywords.end()) return;
    if (skipped_++ > 0) return;
    first_skipped_ = printable(name, max_quoted_bytes);
    first_skipped_line_ = line_;
  }

  TextLines lines_;
  const std::string& file_;
  std::string statement_;
  int line_ = 0;
  std::size_t skipped_ = 0;
  std::string first_skipped_;
  int first_skipped_line_ = 0;
};

class MeshReader {
 public:
  MeshReader(std::string_view text, const std::string& file) : lines_(text, file) {}

  Mesh read(std::vector<std::string>& warnings) {
    std::istream stream(&lines_);
    stream.exceptions(std::ios::badbit);  // so that errors thrown while reading lines are passed on
    tinyobj::callback_t callback;
    callback.vertex_cb = [](void* self, double x, double y, double z, double) {
      static_cast<MeshReader*>(self)->add_vertex(Vec3(x, y, z));
    };
    callback.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
      static_cast<MeshReader*>(self)->add_polygon({corners, static_cast<std::size_t>(count)});
    };
    tinyobj::LoadObjWithCallback(stream, callback, this);

    if (max_vertex_ >= static_cast<Index>(mesh_.vertices.size()))
      lines_.refuse(max_vertex_line_,
                    "f: " + std::to_string(max_vertex_ + 1) + ": there are only " + pluralize(mesh_.vertices.size(), "vertex", "vertices"));
    lines_.warn_about_skipped(warnings);
    return std::move(mesh_);
  }

 private:
  void add_vertex(const Vec3& x) {
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(x[c]) <= largest_coordinate)) lines_.refuse("v: " + format_rounded(x[c]) + ": must be from -1e9 to 1e9 (meters)");
    if (mesh_.vertices.size() == max_points) lines_.refuse("v: too many vertices: must be at most " + std::to_string(max_points));
    mesh_.vertices.push_back(x);
  }

  // Vertices may come after the polygons that use them.
  void add_polygon(std::span<const tinyobj::index_t> corners) {
    // with fewer corners it has no area and is removed later
    triangles_ += corners.size() < 3 ? 1 : corners.size() - 2;
    if (triangles_ > max_faces) lines_.refuse("f: too many faces: must be at most " + std::to_string(max_faces) + ", counted in triangles");
    for (const tinyobj::index_t& corner : corners) {
      const int file_index = corner.vertex_index;
      const Index vertex = file_index > 0 ? file_index - 1 : static_cast<Index>(mesh_.vertices.size()) + file_index;
      if (vertex < 0)
        lines_.refuse("f: " + std::to_string(file_index) + ": there are only " + pluralize(mesh_.vertices.size(), "vertex", "vertices"));
      if (vertex > max_vertex_) {
        max_vertex_ = vertex;
        if (vertex >= static_cast<Index>(mesh_.vertices.size())) max_vertex_line_ = lines_.line();
      }
      mesh_.corners.push_back(vertex);
    }
    mesh_.polygon_ends.push_back(static_cast<Index>(mesh_.corners.size()));
  }

  CheckedObjStream lines_;
  Mesh mesh_;
  std::uint64_t triangles_ = 0;
  Index max_vertex_ = no_index;  // vertex of any polygon so far
  int max_vertex_line_ = 0;
};

}  // namespace

Mesh parse_obj_text(std::string_view text, const std::string& file, std::vector<std::string>& warnings) {
  return MeshReader(text, file).read(warnings);
}

}  // namespace hooke
