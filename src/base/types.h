// Basic types: vectors, indices and ids. SI units throughout.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace hooke {

using Vec3 = glm::dvec3;

// Index of a point or spring in a System's list. Changes when an element before it is removed.
using Index = std::int32_t;

// Id of a point or a spring: assigned once, never reused within a document.
enum class PointId : std::uint32_t {};
enum class SpringId : std::uint32_t {};

inline constexpr Index no_index = -1;

}  // namespace hooke
