#include "study/hard_cases/test_network.h"

#include <glm/geometric.hpp>

namespace hooke {

PointId TestNetwork::add(const Vec3& position, double mass, const Vec3& velocity) {
  const PointId id = system.new_point_id();
  system.append_point({.id = id, .mass = mass, .radius = 0.0});
  state.position.push_back(position);
  state.velocity.push_back(velocity);
  return id;
}

PointId TestNetwork::nail(const Vec3& position) {
  const PointId id = add(position);
  system.point(index(id)).nailed = true;
  return id;
}

SpringId TestNetwork::join(PointId first, PointId second, double stiffness, double rest_length, double damping) {
  const SpringId id = system.new_spring_id();
  system.append_spring(
      {.id = id, .first = first, .second = second, .stiffness = stiffness, .damping = damping, .rest_length = rest_length});
  return id;
}

SpringId TestNetwork::join(PointId first, PointId second, double stiffness) {
  return join(first, second, stiffness, glm::distance(state.position[index(first)], state.position[index(second)]));
}

TestNetwork make_sheet(const SheetShape& shape) {
  TestNetwork network;
  network.system.reserve(shape.rows * shape.columns, 4 * shape.rows * shape.columns);
  for (int row = 0; row < shape.rows; ++row)
    for (int column = 0; column < shape.columns; ++column)
      network.add(shape.corner + static_cast<double>(column) * shape.across + static_cast<double>(row) * shape.down, shape.mass);

  const auto at = [&](int row, int column) { return network.system.points()[row * shape.columns + column].id; };
  for (int row = 0; row < shape.rows; ++row)
    for (int column = 0; column < shape.columns; ++column) {
      const bool has_right = column + 1 < shape.columns, has_below = row + 1 < shape.rows;
      if (has_right) network.join(at(row, column), at(row, column + 1), shape.stiffness);
      if (has_below) network.join(at(row, column), at(row + 1, column), shape.stiffness);
      if (shape.diagonal_stiffness == 0.0 || !has_right || !has_below) continue;
      network.join(at(row, column), at(row + 1, column + 1), shape.diagonal_stiffness);
      network.join(at(row, column + 1), at(row + 1, column), shape.diagonal_stiffness);
    }
  return network;
}

std::uint64_t Random::next_bits() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

double Random::uniform(double min, double max) { return min + (max - min) * static_cast<double>(next_bits() >> 11) * 0x1p-53; }

Vec3 Random::vector(double size) {
  const double x = uniform(-size, size), y = uniform(-size, size), z = uniform(-size, size);
  return {x, y, z};
}

}  // namespace hooke
