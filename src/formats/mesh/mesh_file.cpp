#include "formats/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/errors.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "formats/file_kinds.h"
#include "formats/mesh/clean_mesh.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/mesh_cloth.h"
#include "formats/stable_stepping.h"
#include "sim/forces/energy/energy.h"

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

// The vertices, polygons, lines and points of a file. Everything else is ignored, and no file that it refers to, such as materials, is
// opened. Appends what is ignored to `warnings`, one sentence each. Throws InputError with the line of the error: invalid coordinates,
// elements with missing vertices, more elements than file_limits.h allows. `file` is its name in messages.
Mesh parse_obj_text(std::string_view text, const std::string& file, std::vector<std::string>& warnings) {
  return ObjReader(text, file).read(warnings);
}

// Springs that the faces do not stand for, and points without a face and a spring.
struct LooseParts {
  std::vector<std::array<Index, 2>> lines;
  std::vector<Index> points;
};

LooseParts loose_parts_of(const System& system) {
  std::vector<bool> is_on_face(system.points().size(), false);
  std::vector<std::array<Index, 2>> sides;
  for (const Face& face : system.faces)
    for (int c = 0; c < 3; ++c) {
      const Index i = system.index_of(face.points[c]), j = system.index_of(face.points[(c + 1) % 3]);
      is_on_face[i] = true;
      sides.push_back({std::min(i, j), std::max(i, j)});
    }
  std::sort(sides.begin(), sides.end());

  LooseParts loose;
  std::vector<bool> is_used = is_on_face;
  for (const Spring& spring : system.springs()) {
    const Index first = system.index_of(spring.first), second = system.index_of(spring.second);
    const std::array<Index, 2> line{std::min(first, second), std::max(first, second)};
    const bool is_free = !is_on_face[first] || !is_on_face[second];
    if (!is_free && (spring.family == SpringFamily::Shear || spring.family == SpringFamily::Bend ||
                     std::binary_search(sides.begin(), sides.end(), line)))
      continue;
    loose.lines.push_back(line);
    is_used[first] = is_used[second] = true;
  }
  std::sort(loose.lines.begin(), loose.lines.end());
  loose.lines.erase(std::unique(loose.lines.begin(), loose.lines.end()), loose.lines.end());
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (!is_used[i]) loose.points.push_back(static_cast<Index>(i));
  return loose;
}

template <class Number>
void append(std::string& bytes, Number number) {
  static_assert(std::endian::native == std::endian::little);
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof raw);
}

}  // namespace

LoadedScene parse_obj(std::string_view text, const std::string& file, const ImportOptions& options) {
  LoadedScene loaded;
  Mesh vertices = parse_obj_text(text, file, loaded.warnings);
  for (Vec3& x : vertices.vertices) {
    x = options.scale * (options.is_z_up ? Vec3(x.x, x.z, 0.0 - x.y) : x);
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(x[c]) <= largest_coordinate))
        throw InputError(file + ": scale: " + format_rounded(x[c]) + ": must be from -1e9 to 1e9 (meters)");
  }
  CleanMesh mesh = clean_mesh(vertices, options.seam_distance, file, loaded.warnings);
  loaded.summary = file + ": " + format_size(mesh.max - mesh.min) + ", " + pluralize(mesh.points.size(), "point", "points");
  loaded.scene = make_cloth(std::move(mesh), file, loaded.warnings);
  loaded.scene.name = std::filesystem::path(file).stem().string();
  if (const auto warning = choose_stable_stepping(loaded.scene, Settings().substeps)) loaded.warnings.push_back(file + ": " + *warning);
  return loaded;
}

// vertices are numbered from 1
std::string format_obj(const Scene& scene) {
  std::string text = "# written by Hooke; meters\no " + printable(scene.name) + "\n";
  for (const Vec3& x : scene.state.position) text += "v " + format_exact(x.x) + " " + format_exact(x.y) + " " + format_exact(x.z) + "\n";
  const auto number = [&](PointId id) { return " " + std::to_string(scene.system.index_of(id) + 1); };
  const FaceList& faces = scene.system.faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces.is_quad(f)) {
      // the diagonal of what is read is from the first corner to the third
      const auto [a, b, c, d] = faces.quad(f++);
      text += "f" + number(d) + number(a) + number(b) + number(c) + "\n";
      continue;
    }
    const auto [a, b, c] = faces[f].points;
    text += "f" + number(a) + number(b) + number(c) + "\n";
  }
  const LooseParts loose = loose_parts_of(scene.system);
  for (const auto& [i, j] : loose.lines) text += "l " + std::to_string(i + 1) + " " + std::to_string(j + 1) + "\n";
  for (const Index i : loose.points) text += "p " + std::to_string(i + 1) + "\n";
  return text;
}

// The Stanford format, binary: a text header, then the values in little-endian order.
std::string format_ply(const Scene& scene) {
  const System& system = scene.system;
  const auto lines = loose_parts_of(system).lines;
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment written by Hooke; meters; strain: mean l / l0 - 1 of the springs at the vertex\n"
      "element vertex " +
      std::to_string(system.points().size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nproperty float strain\n"
      "element face " +
      std::to_string(system.faces.size()) + "\nproperty list uchar int vertex_indices\n";
  if (!lines.empty()) bytes += "element edge " + std::to_string(lines.size()) + "\nproperty int vertex1\nproperty int vertex2\n";
  bytes += "end_header\n";

  const std::vector<double> strains = strain_of_points(scene);
  for (std::size_t i = 0; i < strains.size(); ++i) {
    for (int c = 0; c < 3; ++c) append(bytes, scene.state.position[i][c]);
    append(bytes, static_cast<float>(strains[i]));
  }
  for (const Face& face : system.faces) {
    append(bytes, std::uint8_t{3});
    for (const PointId id : face.points) append(bytes, std::int32_t{system.index_of(id)});
  }
  for (const auto& [i, j] : lines) {
    append(bytes, std::int32_t{i});
    append(bytes, std::int32_t{j});
  }
  return bytes;
}

std::vector<double> strain_of_points(const Scene& scene) {
  const System& system = scene.system;
  std::vector<double> sums(system.points().size(), 0.0);
  std::vector<int> counts(system.points().size(), 0);
  for (const Spring& spring : system.springs()) {
    if (spring.rest_length == 0.0) continue;
    const double spring_strain = strain(system, scene.state, spring);
    for (const PointId id : {spring.first, spring.second}) {
      const auto i = static_cast<std::size_t>(system.index_of(id));
      sums[i] += spring_strain;
      ++counts[i];
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (counts[i] > 0) sums[i] /= counts[i];
  return sums;
}

constinit const FileKind obj_file{
    .extension = ".obj",
    .title = "Wavefront mesh",
    .parse = parse_obj,
    .format = [](const Scene& scene, const std::string&, std::vector<std::string>&) { return format_obj(scene); },
    .source = ExportSource::Scene,
    .label = "Mesh",
    .description = "The current points, faces, and springs without faces in the Wavefront format.",
    .is_mesh = true};

constinit const FileKind ply_file{
    .extension = ".ply",
    .title = "Stanford mesh with strain",
    .format = [](const Scene& scene, const std::string&, std::vector<std::string>&) { return format_ply(scene); },
    .source = ExportSource::Scene,
    .label = "Mesh with strain",
    .description = "The current points, faces and springs in the Stanford format, with the strain at each vertex."};

}  // namespace hooke
