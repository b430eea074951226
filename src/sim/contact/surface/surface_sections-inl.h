// What both parts of SurfaceSearch use.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "sim/contact/surface/surface_search.h"
#include "sim/forces/bands.h"

namespace hooke {

// Of a part of a pass over the leaves: some microseconds.
inline constexpr Index min_leaves_of_pass = 64;

inline double distance_between(const SurfaceBox& a, const SurfaceBox& b) {
  const Vec3 d = glm::max(Vec3(0.0), glm::max(a.min - b.max, b.min - a.max));
  return std::sqrt(glm::dot(d, d));
}

// use(section), for each of them. A thread begins with those next to each other, and continues with those that others have not begun.
template <class Use>
void SurfaceSearch::for_sections(const Plan& plan, const Use& use) {
  const auto sections = static_cast<Index>(sections_.size());
  const ThreadTeam::Turn turn(sections > 1 ? plan.execution.team.get() : nullptr);
  const int parts = count_parts(plan, turn, sections, 1);
  if (parts == 1) {
    for (Section& section : sections_) use(section);
    return;
  }
  struct alignas(64) Next {
    std::atomic<Index> section;
  };
  std::array<Next, max_parts> next;
  for (int part = 0; part < parts; ++part) next[part].section.store(start_of_part(part, parts, sections), std::memory_order_relaxed);
  turn.run(parts, [&](int own) {
    for (int i = 0; i < parts; ++i) {
      const int part = (own + i) % parts;
      const Index end = start_of_part(part + 1, parts, sections);
      for (Index s = 0; (s = next[part].section.fetch_add(1, std::memory_order_relaxed)) < end;) {
        try {
          use(sections_[s]);
        } catch (...) {
          sections_[s].failure = std::current_exception();
        }
      }
    }
  });
  for (Section& section : sections_)
    if (section.failure != nullptr) std::rethrow_exception(std::exchange(section.failure, nullptr));
}

}  // namespace hooke
