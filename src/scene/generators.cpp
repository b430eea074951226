#include "scene/generators.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

// The place of a new point in the network is its id.
PointId add_point(Network& network, const Fabric& fabric, const Vec3& position, double mass, double radius) {
  const PointId id{static_cast<std::uint32_t>(network.points.size())};
  network.points.push_back({.id = id, .color = fabric.color, .mass = mass, .radius = fabric.point_radius.value_or(radius)});
  network.position.push_back(position);
  network.velocity.emplace_back(0.0);
  return id;
}

void add_spring(Network& network, std::size_t first, std::size_t second, SpringFamily family, double length, double stiffness,
                double damping) {
  network.springs.push_back({.id = SpringId{static_cast<std::uint32_t>(network.springs.size())},
                             .first = network.points[first].id,
                             .second = network.points[second].id,
                             .family = family,
                             .stiffness = stiffness,
                             .damping = damping,
                             .rest_length = length});
}

void nail(Network& network, const Fabric& fabric, std::size_t first_point) {
  for (const Index i : fabric.nails) network.points[first_point + static_cast<std::size_t>(i)].nailed = true;
}

// Springs of one kind in a cloth: from each point to the one `columns` on and `rows` below.
struct ClothSpring {
  SpringFamily family;
  std::int64_t columns, rows;
  double fraction;                             // [1], of the sheet's E t, inside a cloth of square cells
  double stiffness, damping;                   // [N/m], [N s/m], likewise
  std::optional<double> stiffness_per_strain;  // [N], takes the place of stiffness
};

std::vector<ClothSpring> springs_of(const Cloth& cloth) {
  const Fabric& fabric = cloth.fabric;
  const double k = fabric.stiffness, d = fabric.damping;
  const auto y = fabric.stiffness_per_strain;
  const double shear = cloth.shear_stiffness.value_or(0.5 * k);
  const auto shear_y = cloth.shear_stiffness ? std::nullopt : y;
  const bool has_shear = cloth.stencil ? *cloth.stencil >= 8 : shear > 0.0 || shear_y || cloth.sheet_stiffness;

  // isotropic, Poisson's ratio 1/3: E t = 4/3 k with half of k across; without diagonals a thread alone bears its strip
  const double along = has_shear ? 0.75 : 1.0, across = 0.375;
  std::vector<ClothSpring> kinds{{SpringFamily::Structural, 1, 0, along, k, d, y}, {SpringFamily::Structural, 0, 1, along, k, d, y}};

  // an isotropic sheet has half the damping, too, on its diagonals
  const double other_d = fabric.mass_model == MassModel::Tributary ? 0.5 * d : d;
  if (has_shear) {
    kinds.push_back({SpringFamily::Shear, 1, 1, across, shear, other_d, shear_y});
    kinds.push_back({SpringFamily::Shear, -1, 1, across, shear, other_d, shear_y});
  }
  const double bend = cloth.bend_stiffness.value_or(0.5 * k);
  const auto bend_y = cloth.bend_stiffness ? std::nullopt : y;
  if (cloth.stencil ? *cloth.stencil >= 12 : cloth.bend_stiffness.value_or(0.0) > 0.0) {
    kinds.push_back({SpringFamily::Bend, 2, 0, 0.0, bend, other_d, bend_y});
    kinds.push_back({SpringFamily::Bend, 0, 2, 0.0, bend, other_d, bend_y});
  }
  return kinds;
}

std::uint64_t at_least_zero(std::int64_t count) { return static_cast<std::uint64_t>(std::max<std::int64_t>(count, 0)); }

class ClothMaker {
 public:
  ClothMaker(const Cloth& cloth, Network& network) : cloth_(cloth), network_(network) {}

  void make_points() {
    const double area = glm::length(glm::cross(cloth_.across, cloth_.down));
    const double total = cloth_.fabric.mass ? *cloth_.fabric.mass : *cloth_.fabric.density * area;
    const double cells = static_cast<double>((cloth_.columns - 1) * (cloth_.rows - 1));
    const double full_mass = tributary_ ? total / cells : total / static_cast<double>(cloth_.columns * cloth_.rows);
    network_.cloth_coordinates.resize(first_, no_cloth_coordinates);
    network_.sheet_areas.resize(first_, 0.0);
    for (std::int64_t row = 0; row < cloth_.rows; ++row)
      for (std::int64_t column = 0; column < cloth_.columns; ++column) {
        network_.cloth_coordinates.emplace_back(static_cast<double>(column) * a_, static_cast<double>(row) * b_);
        // a quarter of each cell around it: half a cell on an edge, a quarter of one in a corner
        const double cell_fraction = (is_edge_column(column) ? 0.5 : 1.0) * (is_edge_row(row) ? 0.5 : 1.0);
        network_.sheet_areas.push_back(cell_fraction * area / cells);
        const double fraction = tributary_ ? cell_fraction : 1.0;
        const double u = static_cast<double>(column) / static_cast<double>(cloth_.columns - 1);
        const double v = static_cast<double>(row) / static_cast<double>(cloth_.rows - 1);
        add_point(network_, cloth_.fabric, cloth_.corner + u * cloth_.across + v * cloth_.down, fraction * full_mass,
                  0.25 * std::min(a_, b_));
      }
    nail(network_, cloth_.fabric, first_);
  }

  void make_springs() {
    const std::vector<ClothSpring> kinds = springs_of(cloth_);
    network_.sheet_weights.resize(network_.springs.size(), 0.0);
    for (std::int64_t row = 0; row < cloth_.rows; ++row)
      for (std::int64_t column = 0; column < cloth_.columns; ++column)
        for (const ClothSpring& kind : kinds) {
          const std::int64_t to_column = column + kind.columns, to_row = row + kind.rows;
          if (to_column < 0 || to_column >= cloth_.columns || to_row >= cloth_.rows) continue;
          const std::size_t i = at(column, row), j = at(to_column, to_row);
          const double length = glm::length(network_.position[j] - network_.position[i]);
          const double geometry_weight = weight_of(kind, column, row), fraction = geometry_weight * kind.fraction;
          const double weight = tributary_ ? geometry_weight : 1.0;
          double stiffness = weight * kind.stiffness, damping = weight * kind.damping;
          if (kind.stiffness_per_strain) stiffness = *kind.stiffness_per_strain / length;
          if (cloth_.fabric.damping_per_length) damping = *cloth_.fabric.damping_per_length * length;
          if (cloth_.sheet_stiffness && fraction > 0.0) {
            stiffness = fraction * *cloth_.sheet_stiffness;
            damping = fraction * cloth_.sheet_damping;
          }
          add_spring(network_, i, j, kind.family, length, stiffness, damping);
          network_.sheet_weights.push_back(fraction);
        }
  }

  // two triangles a cell, both turned the same way
  void make_faces() {
    for (std::int64_t row = 0; row + 1 < cloth_.rows; ++row)
      for (std::int64_t column = 0; column + 1 < cloth_.columns; ++column) {
        const auto id = [&](std::int64_t right, std::int64_t below) { return network_.points[at(column + right, row + below)].id; };
        network_.faces.push_back({{id(0, 0), id(0, 1), id(1, 0)}});
        network_.faces.push_back({{id(1, 0), id(0, 1), id(1, 1)}});
      }
  }

 private:
  std::size_t at(std::int64_t column, std::int64_t row) const { return first_ + static_cast<std::size_t>(row * cloth_.columns + column); }
  bool is_edge_column(std::int64_t column) const { return column == 0 || column == cloth_.columns - 1; }
  bool is_edge_row(std::int64_t row) const { return row == 0 || row == cloth_.rows - 1; }

  // What makes a material of springs in cells of a x b: k l^2 / area is the same for every edge (Van Gelder 1998), so
  // k b / a along rows, k a / b along columns, k 2 a b / (a^2 + b^2) on diagonals; and half of it along the border,
  // where there is a cell on one side only.
  double weight_of(const ClothSpring& spring, std::int64_t column, std::int64_t row) const {
    if (spring.family == SpringFamily::Shear) return 2.0 * a_ * b_ / (a_ * a_ + b_ * b_);
    const bool is_border = spring.rows == 0 ? is_edge_row(row) : is_edge_column(column);
    return (spring.rows == 0 ? b_ / a_ : a_ / b_) * (is_border ? 0.5 : 1.0);
  }

  const Cloth& cloth_;
  Network& network_;
  const std::size_t first_ = network_.points.size();
  const double a_ = glm::length(cloth_.across) / static_cast<double>(cloth_.columns - 1);  // [m], from point to point in a row
  const double b_ = glm::length(cloth_.down) / static_cast<double>(cloth_.rows - 1);       // [m], in a column
  const bool tributary_ = cloth_.fabric.mass_model == MassModel::Tributary;
};

void make(const Cloth& cloth, Network& network) {
  ClothMaker maker(cloth, network);
  maker.make_points();
  maker.make_springs();
  maker.make_faces();
}

void make(const Rope& rope, Network& network) {
  const std::size_t first = network.points.size();
  const Fabric& fabric = rope.fabric;
  const bool tributary = fabric.mass_model == MassModel::Tributary;
  const double length = glm::length(rope.to - rope.from), segments = static_cast<double>(rope.points - 1);
  const double total = fabric.mass ? *fabric.mass : *fabric.density * length;

  for (std::int64_t i = 0; i < rope.points; ++i) {
    const bool is_end = i == 0 || i == rope.points - 1;
    const double mass = tributary ? total / segments * (is_end ? 0.5 : 1.0) : total / static_cast<double>(rope.points);
    add_point(network, fabric, rope.from + static_cast<double>(i) / segments * (rope.to - rope.from), mass, 0.25 * length / segments);
  }
  nail(network, fabric, first);

  // springs in a row are as stiff as the whole when each is that many times stiffer; dashpots likewise
  const double weight = tributary ? segments : 1.0;
  for (std::size_t i = first; i + 1 < network.points.size(); ++i) {
    const double segment_length = glm::length(network.position[i + 1] - network.position[i]);
    const double stiffness = fabric.stiffness_per_strain ? *fabric.stiffness_per_strain / segment_length : weight * fabric.stiffness;
    const double damping = fabric.damping_per_length ? *fabric.damping_per_length * segment_length : weight * fabric.damping;
    add_spring(network, i, i + 1, SpringFamily::None, segment_length, stiffness, damping);
  }
}

ElementCount element_count(const Cloth& cloth) {
  ElementCount element_count{.points = at_least_zero(cloth.columns) * at_least_zero(cloth.rows)};
  for (const ClothSpring& kind : springs_of(cloth))
    element_count.springs += at_least_zero(cloth.columns - std::abs(kind.columns)) * at_least_zero(cloth.rows - kind.rows);
  element_count.faces = 2 * at_least_zero(cloth.columns - 1) * at_least_zero(cloth.rows - 1);
  return element_count;
}

ElementCount element_count(const Rope& rope) { return {.points = at_least_zero(rope.points), .springs = at_least_zero(rope.points - 1)}; }

void make(const Shape& shape, Network& network) { generate(shape, network); }
ElementCount element_count(const Shape& shape) { return element_count_of(shape); }

}  // namespace

ElementCount element_count_of(const Generator& generator) {
  return std::visit([](const auto& alternative) { return element_count(alternative); }, generator);
}

void generate(const Generator& generator, Network& network) {
  std::visit([&](const auto& alternative) { make(alternative, network); }, generator);
}

}  // namespace hooke
