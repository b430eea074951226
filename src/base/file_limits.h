// Limits on files and on what they declare, checked before memory is allocated.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace hooke {

inline constexpr std::uint64_t max_file_bytes = std::uint64_t{256} << 20;
inline constexpr std::uint64_t max_points = 5'000'000;
inline constexpr std::uint64_t max_springs = 20'000'000;
inline constexpr std::uint64_t max_faces = 10'000'000;
inline constexpr std::uint64_t max_colliders = 1'000;
inline constexpr std::uint64_t max_forces = 100;
inline constexpr std::uint64_t max_generators = 1'000;
inline constexpr std::uint64_t max_string_bytes = 4096;
inline constexpr std::uint64_t max_values_per_item = 1'000'000;  // in one point, generator, ...
inline constexpr std::uint64_t max_nesting = 32;
inline constexpr std::uint32_t max_picture_side = 8192;  // [px]
inline constexpr int max_substeps = 1'000'000;
inline constexpr int max_iterations = 10'000;  // per substep
inline constexpr int newest_scene_version = 1;

// The table that `hooke --limits` prints.
struct FileLimit {
  std::string_view what;
  std::string_view limit;
};
std::span<const FileLimit> file_limits();

}  // namespace hooke
