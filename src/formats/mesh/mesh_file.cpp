#include "formats/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/bounds.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "formats/file_kinds.h"
#include "formats/mesh/clean_mesh.h"
#include "formats/mesh/mesh_cloth.h"
#include "formats/mesh/obj_text.h"
#include "formats/stable_stepping.h"
#include "sim/forces/energy/energy.h"

namespace hooke {
namespace {

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
      is_on_face[static_cast<std::size_t>(i)] = true;
      sides.push_back({std::min(i, j), std::max(i, j)});
    }
  std::sort(sides.begin(), sides.end());

  LooseParts loose;
  std::vector<bool> is_used = is_on_face;
  for (const Spring& spring : system.springs()) {
    const auto first = static_cast<std::size_t>(system.index_of(spring.first)),
               second = static_cast<std::size_t>(system.index_of(spring.second));
    const std::array<Index, 2> line{static_cast<Index>(std::min(first, second)), static_cast<Index>(std::max(first, second))};
    const bool is_free = !is_on_face[first] || !is_on_face[second];
    if (!is_free && (spring.family != SpringFamily::Structural || std::binary_search(sides.begin(), sides.end(), line))) continue;
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
    .description = "The current points, faces, and springs without faces, in the Wavefront format.",
    .is_mesh = true};

constinit const FileKind ply_file{
    .extension = ".ply",
    .title = "Stanford mesh with strain",
    .format = [](const Scene& scene, const std::string&, std::vector<std::string>&) { return format_ply(scene); },
    .source = ExportSource::Scene,
    .label = "Mesh with strain",
    .description = "The same in the Stanford format, with the strain at each vertex."};

}  // namespace hooke
