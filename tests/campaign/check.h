// The checks of the reliability campaign (docs/reliability.md): each tries one case, which follows from its number alone, so that
// a campaign continues where the one before ended and a failure can be repeated.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hooke {

// A promise that does not hold in a case: what() says what happened.
struct Finding : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void expect(bool holds, const std::string& what) {
  if (!holds) throw Finding(what);
}

struct Check {
  std::string_view name;
  std::string_view unit;  // what it counts
  unsigned max_seconds;   // that a case may take; 0: as long as it takes
  // Tries a case and returns how many units it covered. Throws Finding. A crash is a finding too.
  long (*run)(std::uint64_t number);
};

// A row each, in the file of the same name.
extern const Check round_trips, saves_killed, saves_failing, actions, replays, extremes, long_run, hostile_paths;
std::span<const Check* const> checks();

}  // namespace hooke
