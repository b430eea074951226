// Hashes of bits (FNV-1a: Fowler, Noll, Vo), for determinism tests, replays, `run --json`, and to detect changes.
#pragma once

#include <cstdint>
#include <string_view>

#include "sim/model/state.h"

namespace hooke {

// Over the 64-bit patterns of time, positions and velocities.
std::uint64_t hash_state(const State& state);

// Over bytes.
std::uint64_t hash_bytes(std::string_view bytes);

}  // namespace hooke
