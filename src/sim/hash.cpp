#include "sim/hash.h"

#include <bit>

namespace hooke {
namespace {

void add(std::uint64_t& hash, double value) {
  hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ull;
}

}  // namespace

std::uint64_t hash_state(const State& state) {
  std::uint64_t hash = 14695981039346656037ull;
  add(hash, state.time);
  for (const auto* vectors : {&state.position, &state.velocity})
    for (const Vec3& v : *vectors)
      for (int c = 0; c < 3; ++c) add(hash, v[c]);
  return hash;
}

}  // namespace hooke
