#include "sim/model/hash.h"

#include <bit>

namespace hooke {
namespace {

constexpr std::uint64_t basis = 14695981039346656037ull;

void add(std::uint64_t& hash, std::uint64_t bits) { hash = (hash ^ bits) * 1099511628211ull; }

}  // namespace

std::uint64_t hash_state(const State& state) {
  std::uint64_t hash = basis;
  add(hash, std::bit_cast<std::uint64_t>(state.time));
  for (const auto* vectors : {&state.position, &state.velocity})
    for (const Vec3& v : *vectors)
      for (int c = 0; c < 3; ++c) add(hash, std::bit_cast<std::uint64_t>(v[c]));
  return hash;
}

std::uint64_t hash_bytes(std::string_view bytes) {
  std::uint64_t hash = basis;
  for (const char byte : bytes) add(hash, static_cast<unsigned char>(byte));
  return hash;
}

}  // namespace hooke
