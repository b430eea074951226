#include "formats/mesh/mesh_cloth.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/errors.h"
#include "base/file_limits.h"
#include "base/text_lines.h"
#include "sim/plan/hinges.h"

namespace hooke {
namespace {

constexpr double relative_strip_width = 0.1;     // width of the cloth strip that a line stands for, relative to the size of the mesh
constexpr double min_relative_area = 1e-13;      // area of a point, relative to the square of the size of the mesh
constexpr double radius_without_springs = 0.01;  // of the points, relative to the size of the mesh

// The contribution of one cell or line to the spring between two points.
struct SpringWeight {
  enum class Of { Side, Diagonal, Line };
  Index first = 0, second = 0;  // points, first < second
  double weight = 0.0;          // [m^2]: k = E t sum(weight) / l^2
  Of of = Of::Side;
};

class ClothMaker {
 public:
  ClothMaker(CleanMesh mesh, const std::string& file, std::vector<std::string>& notes)
      : mesh_(std::move(mesh)), file_(file), notes_(notes), material_(cloth_of_size(mesh_.size())) {}

  Scene make() {
    make_points();
    make_springs();
    make_faces();
    add_floor();
    scene_.sheet = std::make_shared<const SheetWeights>(std::move(sheet_));
    return std::move(scene_);
  }

 private:
  double strip_width() const { return relative_strip_width * mesh_.size(); }
  double length_of(const std::array<Index, 2>& line) const { return glm::distance(mesh_.points[line[0]], mesh_.points[line[1]]); }

  void make_points() {
    std::vector<Point> points(mesh_.points.size());
    for (Point& point : points) point.id = scene_.system.new_point_id();
    std::vector<double> area(points.size(), 0.0);  // [m^2]
    for (const Cell& cell : mesh_.cells)
      for (int c = 0; c < cell.size(); ++c) area[cell.corners[c]] += cell.area / cell.size();
    for (const auto& line : mesh_.lines)
      for (const Index end : line) area[end] += 0.5 * strip_width() * length_of(line);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (area[i] == 0.0) area[i] = strip_width() * strip_width();
      // a lower bound for degenerate faces, so that rounding does not lose their mass
      area[i] = std::max(area[i], min_relative_area * mesh_.size() * mesh_.size());
      points[i].mass = material_.density * area[i];
      if (!(points[i].mass > 0.0)) points[i].mass = 1.0;  // the mesh is a single point and has no size
    }
    sheet_.area = area;
    scene_.state.position = mesh_.points;
    scene_.state.velocity.assign(points.size(), Vec3(0.0));
    scene_.system.set_points(std::move(points));
  }

  std::vector<SpringWeight> spring_weights() const {
    std::vector<SpringWeight> spring_weights;
    using Of = SpringWeight::Of;
    const auto add = [&](Index a, Index b, double weight, Of of) {
      spring_weights.push_back({std::min(a, b), std::max(a, b), weight, of});
    };
    for (const Cell& cell : mesh_.cells) {
      const auto& [a, b, c, d] = cell.corners;
      const double side = cell.size() == 3 ? cell.area : 0.375 * cell.area;
      for (int i = 0; i < cell.size(); ++i) add(cell.corners[i], cell.corners[(i + 1) % cell.size()], side, Of::Side);
      if (cell.size() == 4) {
        add(a, c, 0.75 * cell.area, Of::Diagonal);
        add(b, d, 0.75 * cell.area, Of::Diagonal);
      }
    }
    for (const auto& line : mesh_.lines) add(line[0], line[1], strip_width() * length_of(line), Of::Line);
    // also sorted by weight, so that sums do not depend on the sorting algorithm
    std::sort(spring_weights.begin(), spring_weights.end(), [](const SpringWeight& s, const SpringWeight& t) {
      return std::tie(s.first, s.second, s.weight, s.of) < std::tie(t.first, t.second, t.weight, t.of);
    });
    return spring_weights;
  }

  void make_springs() {
    System& system = scene_.system;
    const auto& x = scene_.state.position;
    const std::vector<SpringWeight> all = spring_weights();
    std::vector<Spring> springs;
    double sum_of_lengths = 0.0;
    std::size_t non_manifold = 0;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      double weight = 0.0;
      int sides = 0;
      bool is_diagonal = true;
      for (; end < all.size() && all[end].first == all[begin].first && all[end].second == all[begin].second; ++end) {
        weight += all[end].weight;
        sides += all[end].of == SpringWeight::Of::Side ? 1 : 0;
        is_diagonal = is_diagonal && all[end].of == SpringWeight::Of::Diagonal;
      }
      non_manifold += sides > 2 ? 1 : 0;
      if (springs.size() == max_springs) throw InputError(file_ + ": springs: more than " + std::to_string(max_springs) + ": too many");

      const Index first = all[begin].first, second = all[begin].second;
      const double length = glm::distance(x[first], x[second]);
      springs.push_back({.id = system.new_spring_id(),
                         .first = system.points()[first].id,
                         .second = system.points()[second].id,
                         .family = is_diagonal ? SpringFamily::Shear : SpringFamily::Structural,
                         .stiffness = material_.stiffness * weight / (length * length),
                         .damping = material_.damping * weight / (length * length),
                         .rest_length = length});
      sheet_.spring_weight.push_back(weight / (length * length));
      sum_of_lengths += length;
    }

    // the surface is what a mesh is about; its points would cover it
    scene_.view.points = mesh_.cells.empty();
    scene_.view.springs = !mesh_.lines.empty();
    const double radius =
        springs.empty() ? radius_without_springs * mesh_.size() : 0.25 * sum_of_lengths / static_cast<double>(springs.size());
    for (Index i = 0; i < system.point_count(); ++i) system.point(i).radius = radius;
    system.set_springs(springs);
    if (non_manifold > 0)
      notes_.push_back(file_ + ": " + pluralize(non_manifold, "edge has", "edges have") + " more than two faces: each is a single spring");
  }

  void make_faces() {
    const auto id = [&](Index i) { return scene_.system.points()[i].id; };
    for (const Cell& cell : mesh_.cells) {
      const auto& [a, b, c, d] = cell.corners;
      if (cell.size() == 4)
        scene_.system.faces.push_quad({id(a), id(b), id(c), id(d)});
      else
        scene_.system.faces.push_triangle({id(a), id(b), id(c)});
    }
    set_rest_angles(scene_.system, scene_.state.position);
  }

  // Nothing is nailed, so without a floor the cloth would fall out of view.
  void add_floor() {
    const Vec3 center = 0.5 * (mesh_.min + mesh_.max);
    const double drop = 0.25 * mesh_.size();
    const Plane floor{Vec3(center.x, mesh_.min.y - drop, center.z), Vec3(0.0, 1.0, 0.0)};
    scene_.system.colliders.push_back({.shape = floor, .friction = 0.5});
  }

  const CleanMesh mesh_;
  const std::string& file_;
  std::vector<std::string>& notes_;
  const SheetMaterial material_;
  SheetWeights sheet_;  // ids are indices
  Scene scene_;
};

}  // namespace

SheetMaterial cloth_of_size(double size) {
  constexpr double gravity = 9.81;  // [m/s^2]
  SheetMaterial material;

  // when hung, its weight per meter of width, density g size, stretches it at the top by that over E t
  material.stiffness = 100.0 * material.density * gravity * size;

  // d / k = 2 zeta / omega, for the slowest wave across it, omega = pi c / size, c = sqrt(E t / density)
  constexpr double zeta = 0.02;
  const double omega = std::numbers::pi / size * std::sqrt(material.stiffness / material.density);
  material.damping = 2.0 * zeta / omega * material.stiffness;
  return material;
}

Scene make_cloth(CleanMesh mesh, const std::string& file, std::vector<std::string>& notes) {
  return ClothMaker(std::move(mesh), file, notes).make();
}

}  // namespace hooke
