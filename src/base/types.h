// The words that every part of Hooke shares: vectors, indices and identities. SI units throughout.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace hooke {

using Vec3 = glm::dvec3;

// Place of a point or spring in a System's list. Changes when something before it is removed.
using Index = std::int32_t;

// Identity of a point or a spring: given once, never reused within a document.
enum class PointId : std::uint32_t {};
enum class SpringId : std::uint32_t {};

inline constexpr Index no_index = -1;

}  // namespace hooke
