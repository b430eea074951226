// A hash of bits, for determinism tests, replays and `run --json`.
#pragma once

#include <cstdint>

#include "sim/state.h"

namespace hooke {

// FNV-1a (Fowler, Noll, Vo) over the 64-bit patterns of time, positions and velocities.
std::uint64_t hash_state(const State& state);

}  // namespace hooke
