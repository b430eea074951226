// Appends points and springs to a network. Springs are at rest as drawn.
#pragma once

#include <glm/geometric.hpp>

#include "scene/network.h"

namespace hooke {

class ShapeBuilder {
 public:
  explicit ShapeBuilder(Network& network) : network_(network), first_(network.points.size()) {}

  std::size_t add_point(const Vec3& position, double mass, double radius, bool nailed = false) {
    const PointId id{static_cast<std::uint32_t>(network_.points.size())};
    network_.points.push_back({.id = id, .nailed = nailed, .mass = mass, .radius = radius});
    network_.position.push_back(position);
    network_.velocity.emplace_back(0.0);
    return network_.points.size() - 1;
  }

  void add_spring(std::size_t i, std::size_t j, double stiffness, double damping, SpringFamily family = SpringFamily::None,
                  bool is_cable = false) {
    network_.springs.push_back({.id = SpringId{static_cast<std::uint32_t>(network_.springs.size())},
                                .first = network_.points[i].id,
                                .second = network_.points[j].id,
                                .family = family,
                                .stiffness = stiffness,
                                .damping = damping,
                                .rest_length = glm::length(network_.position[j] - network_.position[i]),
                                .law = is_cable ? std::optional(SpringLaw{.force = SpringForce::Cable}) : std::nullopt});
  }

  void add_face(std::size_t a, std::size_t b, std::size_t c) {
    network_.faces.push_back({{network_.points[a].id, network_.points[b].id, network_.points[c].id}});
  }

  Network& network() { return network_; }
  // The first point of this shape.
  std::size_t first() const { return first_; }

 private:
  Network& network_;
  std::size_t first_;
};

}  // namespace hooke
