#include "scene/shapes/cloth.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

// Springs of one family: from each point to the one `columns` further and `rows` below.
struct ClothSpring {
  SpringFamily family;
  std::int64_t columns, rows;
  double fraction;                             // [1], of the E t of the sheet, inside a cloth of square cells
  double stiffness, damping;                   // [N/m], [N s/m], likewise
  std::optional<double> stiffness_per_strain;  // [N], instead of stiffness
};

std::vector<ClothSpring> springs_of(const Cloth& cloth) {
  const Fabric& fabric = cloth.fabric;
  const double k = fabric.stiffness, d = fabric.damping;
  const auto y = fabric.stiffness_per_strain;
  const double shear = cloth.shear_stiffness.value_or(0.5 * k);
  const auto shear_y = cloth.shear_stiffness ? std::nullopt : y;
  const bool has_shear = cloth.stencil ? *cloth.stencil >= 8 : shear > 0.0 || shear_y || cloth.sheet_stiffness;

  // isotropic, Poisson's ratio 1/3: E t = 4/3 k with half of k on diagonals; without diagonals each thread carries its strip alone
  const double along = has_shear ? 0.75 : 1.0, across = 0.375;
  std::vector<ClothSpring> kinds{{SpringFamily::Structural, 1, 0, along, k, d, y}, {SpringFamily::Structural, 0, 1, along, k, d, y}};

  // the diagonals of an isotropic sheet have half the damping as well
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
  ClothMaker(const Cloth& cloth, Network& network) : cloth_(cloth), network_(network), builder_(network) {}

  void make_points() {
    const double area = glm::length(glm::cross(cloth_.across, cloth_.down));
    const double total = cloth_.fabric.mass ? *cloth_.fabric.mass : *cloth_.fabric.density * area;
    const double cells = static_cast<double>((cloth_.columns - 1) * (cloth_.rows - 1));
    const double full_mass = tributary_ ? total / cells : total / static_cast<double>(cloth_.columns * cloth_.rows);
    // not by doubling: the points have memory for all shapes already
    network_.cloth_coordinates.reserve(network_.points.capacity());
    network_.cloth_coordinates.resize(first_, no_cloth_coordinates);
    network_.sheet_areas.resize(first_, 0.0);
    for (std::int64_t row = 0; row < cloth_.rows; ++row)
      for (std::int64_t column = 0; column < cloth_.columns; ++column) {
        network_.cloth_coordinates.emplace_back(static_cast<double>(column) * a_, static_cast<double>(row) * b_);
        // a quarter of each adjacent cell: half a cell on an edge, a quarter of one in a corner
        const double cell_fraction = (is_edge_column(column) ? 0.5 : 1.0) * (is_edge_row(row) ? 0.5 : 1.0);
        network_.sheet_areas.push_back(cell_fraction * area / cells);
        const double fraction = tributary_ ? cell_fraction : 1.0;
        const double u = static_cast<double>(column) / static_cast<double>(cloth_.columns - 1);
        const double v = static_cast<double>(row) / static_cast<double>(cloth_.rows - 1);
        builder_.add_point(cloth_.corner + u * cloth_.across + v * cloth_.down, fraction * full_mass,
                           cloth_.fabric.point_radius.value_or(0.25 * std::min(a_, b_)));
      }
    for (const Index i : cloth_.fabric.nails) network_.points[first_ + static_cast<std::size_t>(i)].nailed = true;
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
          builder_.add_spring(i, j, stiffness, damping, kind.family);
          network_.sheet_weights.push_back(fraction);
        }
  }

  // two triangles per cell, both with the same orientation
  void make_faces() {
    for (std::int64_t row = 0; row + 1 < cloth_.rows; ++row)
      for (std::int64_t column = 0; column + 1 < cloth_.columns; ++column) {
        builder_.add_face(at(column, row), at(column, row + 1), at(column + 1, row));
        builder_.add_face(at(column + 1, row), at(column, row + 1), at(column + 1, row + 1));
      }
  }

 private:
  std::size_t at(std::int64_t column, std::int64_t row) const { return first_ + static_cast<std::size_t>(row * cloth_.columns + column); }
  bool is_edge_column(std::int64_t column) const { return column == 0 || column == cloth_.columns - 1; }
  bool is_edge_row(std::int64_t row) const { return row == 0 || row == cloth_.rows - 1; }

  // Weights for springs of a material in cells of a x b: k l^2 / area is the same for every edge (Van Gelder 1998), so k b / a along rows,
  // k a / b along columns, k 2 a b / (a^2 + b^2) on diagonals; half of it along the border, which has a cell on only one side.
  double weight_of(const ClothSpring& spring, std::int64_t column, std::int64_t row) const {
    if (spring.family == SpringFamily::Shear) return 2.0 * a_ * b_ / (a_ * a_ + b_ * b_);
    const bool is_border = spring.rows == 0 ? is_edge_row(row) : is_edge_column(column);
    return (spring.rows == 0 ? b_ / a_ : a_ / b_) * (is_border ? 0.5 : 1.0);
  }

  const Cloth& cloth_;
  Network& network_;
  ShapeBuilder builder_;
  const std::size_t first_ = builder_.first();
  const double a_ = glm::length(cloth_.across) / static_cast<double>(cloth_.columns - 1);  // [m], spacing of points in a row
  const double b_ = glm::length(cloth_.down) / static_cast<double>(cloth_.rows - 1);       // [m], in a column
  const bool tributary_ = cloth_.fabric.mass_model == MassModel::Tributary;
};

// ---- the row: cloth in a file

constexpr ShapeVector vectors[] = {{"corner"}, {"across"}, {"down"}, {"points", "[columns, rows]", 2}};

constexpr auto numbers = [] {
  constexpr ShapeNumber own[] = {
      {.name = "stencil", .min = 4, .max = 12, .default_value = not_given, .integer = true, .max_integer = 12},
      {.name = "sheet_stiffness", .unit = "N/m", .min = 0, .max = 1e5, .default_value = not_given},
      {.name = "sheet_damping", .unit = "N s/m", .min = 0, .max = 10, .default_value = not_given},
      {.name = "shear_stiffness", .unit = "N/m", .min = 0, .max = 1e5, .default_value = not_given},
      {.name = "bend_stiffness", .unit = "N/m", .min = 0, .max = 1e5, .default_value = not_given},
  };
  std::array<ShapeNumber, fabric_numbers + std::size(own)> all{};
  std::ranges::copy(own, std::ranges::copy(make_fabric_numbers(MassModel::Tributary), all.begin()).out);
  return all;
}();

Cloth cloth_of(const Shape& shape) {
  Cloth cloth{.corner = shape.vectors[0],
              .across = shape.vectors[1],
              .down = shape.vectors[2],
              .columns = static_cast<std::int64_t>(shape.vectors[3].x),
              .rows = static_cast<std::int64_t>(shape.vectors[3].y),
              .fabric = fabric_of(shape),
              .sheet_stiffness = shape.find("sheet_stiffness"),
              .sheet_damping = shape.value_or("sheet_damping", 0.0),
              .shear_stiffness = shape.find("shear_stiffness"),
              .bend_stiffness = shape.find("bend_stiffness")};
  if (shape.has("stencil")) cloth.stencil = shape.count("stencil");
  return cloth;
}

// A material determines the stiffness and damping of all springs except bend springs.
std::optional<ShapeError> check_sheet(const Shape& shape) {
  if (!shape.has("sheet_stiffness")) return ShapeError{{}, "must have sheet_stiffness if it has sheet_damping"};
  if (static_cast<MassModel>(shape.count("mass_model")) != MassModel::Tributary)
    return ShapeError{{}, "must have the mass_model \"tributary\" for sheet_stiffness"};
  for (const std::string_view key : {"stiffness", "stiffness_per_strain", "shear_stiffness", "damping", "damping_per_length"})
    if (shape.has(key)) return ShapeError{{}, "must have sheet_stiffness or " + std::string(key) + ", not both"};
  return check_fabric(shape, false);
}

std::optional<ShapeError> check(const Shape& shape) {
  if (shape.has("stencil") && shape.count("stencil") % 4 != 0) return ShapeError{"stencil", "must be 4, 8 or 12"};
  const bool is_sheet = shape.has("sheet_stiffness") || shape.has("sheet_damping");
  if (auto error = is_sheet ? check_sheet(shape) : check_fabric(shape)) return error;
  if (shape.value_or("stencil", 8) < 8 && shape.value_or("shear_stiffness", 0.0) > 0.0)
    return ShapeError{{}, "must have a stencil of 8 or 12 for shear_stiffness"};
  if (shape.value_or("stencil", 12) < 12 && shape.value_or("bend_stiffness", 0.0) > 0.0)
    return ShapeError{{}, "must have a stencil of 12 for bend_stiffness"};
  const Cloth cloth = cloth_of(shape);
  if (!(glm::length(glm::cross(cloth.across, cloth.down)) > 0.0)) return ShapeError{{}, "must have across and down that span an area"};
  return std::nullopt;
}

// The sides of the cloth on which a point lies.
struct Sides {
  bool top, bottom, left, right;
};

template <auto is_nailed>
std::vector<Index> border_points(const Shape& shape) {
  const Cloth cloth = cloth_of(shape);
  std::vector<Index> points;
  for (std::int64_t row = 0; row < cloth.rows; ++row) {
    // only the first and the last row have border points between their ends
    const bool is_whole_row = row == 0 || row == cloth.rows - 1;
    for (std::int64_t column = 0; column < cloth.columns; column += is_whole_row ? 1 : cloth.columns - 1)
      if (is_nailed(Sides{row == 0, row == cloth.rows - 1, column == 0, column == cloth.columns - 1}))
        points.push_back(static_cast<Index>(row * cloth.columns + column));
  }
  return points;
}

constexpr NailKeyword nail_keywords[] = {
    {"top", border_points<[](const Sides& s) { return s.top; }>},
    {"bottom", border_points<[](const Sides& s) { return s.bottom; }>},
    {"left", border_points<[](const Sides& s) { return s.left; }>},
    {"right", border_points<[](const Sides& s) { return s.right; }>},
    {"border", border_points<[](const Sides& s) { return s.top || s.bottom || s.left || s.right; }>},
    {"corners", border_points<[](const Sides& s) { return (s.top || s.bottom) && (s.left || s.right); }>},
    {"top_left", border_points<[](const Sides& s) { return s.top && s.left; }>},
    {"top_right", border_points<[](const Sides& s) { return s.top && s.right; }>},
    {"bottom_left", border_points<[](const Sides& s) { return s.bottom && s.left; }>},
    {"bottom_right", border_points<[](const Sides& s) { return s.bottom && s.right; }>},
};

ElementCount element_count(const Shape& shape) { return element_count_of(cloth_of(shape)); }
void make(const Shape& shape, Network& network) { generate(cloth_of(shape), network); }

}  // namespace

ElementCount element_count_of(const Cloth& cloth) {
  ElementCount count{.points = at_least_zero(cloth.columns) * at_least_zero(cloth.rows)};
  for (const ClothSpring& kind : springs_of(cloth))
    count.springs += at_least_zero(cloth.columns - std::abs(kind.columns)) * at_least_zero(cloth.rows - kind.rows);
  count.faces = 2 * at_least_zero(cloth.columns - 1) * at_least_zero(cloth.rows - 1);
  return count;
}

void generate(const Cloth& cloth, Network& network) {
  ClothMaker maker(cloth, network);
  maker.make_points();
  maker.make_springs();
  maker.make_faces();
}

constinit const ShapeKind cloth_shape{.id = "cloth",
                                      .description = "A sheet of columns x rows points between given corners.",
                                      .numbers = numbers,
                                      .vectors = vectors,
                                      .nail_keywords = nail_keywords,
                                      .check = check,
                                      .element_count = element_count,
                                      .make = make};

}  // namespace hooke
