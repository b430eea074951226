// The order of points in which a scene is stepped: nets that are listed in any order become grids, and what is in order already, or small,
// stays as it is.
#include "sim/plan/numbering/point_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "sim/plan/numbering/cuthill_mckee.h"
#include "sim/plan/numbering/spring_runs.h"
#include "support/shuffled.h"

namespace hooke {
namespace {

enum class ClothDiagonals { None, Down, Up, Both, Alternating };

struct NetOfCells {
  int rows = 20, columns = 30;
  ClothDiagonals diagonals = ClothDiagonals::Both;
  bool has_families = false, is_tube = false;
  bool has_bend_springs = false;
  int missing = 0;  // one spring of so many; 0: none
};

void add_net(TestSim& sim, const NetOfCells& net) {
  Random random(5);
  const Index begin = sim.system.point_count();
  const auto join = [&](int r, int c, int other_r, int other_c, SpringFamily family) {
    if (net.is_tube) other_c %= net.columns;
    if (other_r >= net.rows || other_c >= net.columns || other_c < 0 || (net.missing > 0 && random.one_in(net.missing))) return;
    const auto id_of = [&](int row, int column) { return sim.system.points()[begin + row * net.columns + column].id; };
    sim.system.append_spring({.id = sim.system.new_spring_id(),
                              .first = id_of(r, c),
                              .second = id_of(other_r, other_c),
                              .family = net.has_families ? family : SpringFamily::None});
  };
  for (int row = 0; row < net.rows; ++row)
    for (int column = 0; column < net.columns; ++column) sim.add({0.1 * column, -0.1 * row, 0.0});
  for (int r = 0; r < net.rows; ++r)
    for (int c = 0; c < net.columns; ++c) {
      const bool is_even = (r + c) % 2 == 0, alternates = net.diagonals == ClothDiagonals::Alternating;
      join(r, c, r, c + 1, SpringFamily::Structural);
      join(r, c, r + 1, c, SpringFamily::Structural);
      if (net.diagonals == ClothDiagonals::Down || net.diagonals == ClothDiagonals::Both || (alternates && is_even))
        join(r, c, r + 1, c + 1, SpringFamily::Shear);
      if (net.diagonals == ClothDiagonals::Up || net.diagonals == ClothDiagonals::Both || (alternates && is_even))
        join(r, c, r + 1, c - 1, SpringFamily::Shear);
      if (!net.has_bend_springs) continue;
      join(r, c, r, c + 2, SpringFamily::Bend);
      join(r, c, r + 2, c, SpringFamily::Bend);
    }
}

TestSim make_net_of_cells(const NetOfCells& net) {
  TestSim sim;
  add_net(sim, net);
  return sim;
}

// [1], of the springs.
double part_in_grids(const Plan& plan) {
  std::size_t count = 0;
  for (const Grid& grid : plan.spring.grids)
    for (const std::vector<Index>& spring : grid.spring)
      count += spring.size() - static_cast<std::size_t>(std::ranges::count(spring, no_index));
  return static_cast<double>(count) / plan.springs;
}

bool is_permutation_of_points(const Plan& plan) {
  if (plan.numbering.index.size() != static_cast<std::size_t>(plan.points) || plan.numbering.number.size() != plan.numbering.index.size())
    return false;
  for (Index i = 0; i < plan.points; ++i)
    if (plan.number_of(plan.listed_index(i)) != i) return false;
  return true;
}

TEST(PointOrder, MakesOneGridOfAShuffledNet) {
  for (const bool families : {false, true})
    for (const auto& [rows, columns] : {std::pair{20, 30}, {30, 20}, {8, 90}, {17, 17}})
      for (const ClothDiagonals diagonals : {ClothDiagonals::None, ClothDiagonals::Down, ClothDiagonals::Up, ClothDiagonals::Both})
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
          const NetOfCells net{.rows = rows, .columns = columns, .diagonals = diagonals, .has_families = families};
          const Plan plan = make_plan(shuffled(make_net_of_cells(net), seed).system);
          ASSERT_EQ(plan.spring.grids.size(), 1u)
              << rows << " x " << columns << ", diagonals " << static_cast<int>(diagonals) << ", " << seed;
          EXPECT_TRUE(is_permutation_of_points(plan));
          EXPECT_EQ(plan.spring.grids[0].columns, std::max(rows, columns));
          EXPECT_EQ(plan.spring.grids[0].rows, std::min(rows, columns));
          EXPECT_EQ(part_in_grids(plan), 1.0);
        }
}

TEST(PointOrder, FollowsTheThreadsOfAClothWhateverItsDiagonals) {
  const NetOfCells net{.diagonals = ClothDiagonals::Alternating, .has_families = true};
  EXPECT_EQ(part_in_grids(make_plan(shuffled(make_net_of_cells(net)).system)), 1.0);
}

// those are long runs
TEST(PointOrder, LeavesOnlyBendSpringsOutsideOfTheGrid) {
  const NetOfCells net{.has_families = true, .has_bend_springs = true};
  const Plan plan = make_plan(shuffled(make_net_of_cells(net)).system);
  EXPECT_EQ(plan.spring.grids.size(), 1u);
  const auto bends = std::ranges::count(make_net_of_cells(net).system.springs(), SpringFamily::Bend, &Spring::family);
  EXPECT_EQ(plan.springs - std::lround(part_in_grids(plan) * plan.springs), bends);
  EXPECT_LT(plan.spring.loose_runs.size(), static_cast<std::size_t>(bends / 10));
}

TEST(PointOrder, FindsSeveralNetsBesideOtherThings) {
  TestSim sim;
  add_net(sim, {.rows = 12, .columns = 15});
  add_net(sim, {.rows = 20, .columns = 30, .diagonals = ClothDiagonals::Down});
  add_net(sim, {.rows = 16, .columns = 16, .diagonals = ClothDiagonals::None});
  for (int i = 0; i < 40; ++i) sim.add({0.0, 1.0, 0.1 * i});  // without springs
  const PointId hub = sim.add({0.0, 2.0, 0.0});
  for (Index i = 0; i < 30; ++i) sim.join(hub, sim.system.points()[sim.system.point_count() - 2 - i].id, 1.0, 1.0);
  const Plan plan = make_plan(shuffled(sim).system);
  EXPECT_TRUE(is_permutation_of_points(plan));
  EXPECT_EQ(plan.spring.grids.size(), 3u);
  EXPECT_EQ(std::lround(part_in_grids(plan) * plan.springs), plan.springs - 30);
}

TEST(PointOrder, FindsMostOfNetsWithMissingSprings) {
  for (const ClothDiagonals diagonals : {ClothDiagonals::None, ClothDiagonals::Down, ClothDiagonals::Both}) {
    const Plan plan = make_plan(shuffled(make_net_of_cells({.rows = 40, .columns = 40, .diagonals = diagonals, .missing = 200})).system);
    EXPECT_GT(part_in_grids(plan), 0.85) << static_cast<int>(diagonals);
  }
}

TEST(PointOrder, FindsTheGridOfATubeExceptItsSeam) {
  const Plan plan = make_plan(shuffled(make_net_of_cells({.diagonals = ClothDiagonals::None, .is_tube = true})).system);
  EXPECT_EQ(plan.spring.grids.size(), 1u);
  EXPECT_GT(part_in_grids(plan), 0.95);
}

TEST(PointOrder, MakesGridsOfShuffledRopes) {
  TestSim sim;
  for (int rope = 0; rope < 5; ++rope) {
    PointId last = sim.add({0.0, rope, 0.0});
    for (int i = 0; i < 100; ++i) {
      const PointId next = sim.add({0.1 * i, rope, 0.0});
      sim.join(last, next, 1.0, 0.1);
      last = next;
    }
  }
  EXPECT_EQ(part_in_grids(make_plan(shuffled(sim).system)), 1.0);
}

TEST(PointOrder, IsThatOfTheSystemIfItHasGridsOrIsSmall) {
  for (const ClothDiagonals diagonals : {ClothDiagonals::None, ClothDiagonals::Down, ClothDiagonals::Both, ClothDiagonals::Alternating})
    EXPECT_TRUE(make_plan(make_net_of_cells({.diagonals = diagonals, .missing = 30}).system).numbering.index.empty());
  const TestSim small = make_net_of_cells({.rows = 7, .columns = 10});
  ASSERT_LT(small.system.spring_count(), min_springs_of_grids);
  EXPECT_TRUE(make_plan(shuffled(small).system).numbering.index.empty());
  const System net = shuffled(make_net_of_cells({})).system;
  EXPECT_FALSE(make_plan(net).numbering.index.empty());
  EXPECT_TRUE(make_plan(net, Numbering::AsListed).numbering.index.empty());
}

TEST(PointOrder, ContainsEveryPointOfHostileGraphsOnce) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    TestSim sim = random_sim(seed, 20 + 10 * static_cast<Index>(seed), 300 + 20 * static_cast<Index>(seed));
    if (seed % 2 == 0) add_net(sim, {.missing = 1 + static_cast<int>(seed)});
    // a point with thousands of springs, springs from a point to itself, and a bridge to the net
    const auto any = [&] { return sim.system.points()[random.below(sim.system.point_count())].id; };
    const PointId hub = any();
    for (int s = 0; s < 2000 && seed % 3 == 0; ++s) sim.join(hub, any(), 1.0, 1.0);
    for (int s = 0; s < 10; ++s) sim.join(hub, hub, 1.0, 1.0);
    const TestSim mixed = shuffled(sim, seed);
    const std::vector<EdgeEnds> ends = spring_ends(mixed.system);
    const Plan plan = make_plan(mixed.system);
    if (!plan.numbering.index.empty()) {
      EXPECT_TRUE(is_permutation_of_points(plan)) << seed;
    }
    std::multiset<Index> packed(plan.spring.index.begin(), plan.spring.index.end());
    EXPECT_EQ(packed.size(), mixed.system.springs().size());
    for (const SpringRun& run : plan.spring.runs)
      for (Index e = 0; e < run.count; ++e) {
        const auto& [i, j] = ends[plan.spring.index[run.begin + e]];
        EXPECT_EQ(edge_ends(plan.listed_index(run.first + e), plan.listed_index(run.second + e)), edge_ends(i, j));
      }
  }
}

// n x n x n points with springs along the axes
TestSim lattice_block(int n) {
  TestSim sim;
  for (int layer = 0; layer < n; ++layer)
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column) sim.add({0.1 * column, 0.1 * row, 0.1 * layer});
  const auto join = [&](int i, int j) { sim.join(sim.system.points()[i].id, sim.system.points()[j].id, 1.0, 0.1); };
  for (int i = 0; i < n * n * n; ++i) {
    if (i % n + 1 < n) join(i, i + 1);
    if (i / n % n + 1 < n) join(i, i + n);
    if (i / n / n + 1 < n) join(i, i + n * n);
  }
  return sim;
}

// in a random order, they are a third of the points apart
TEST(PointOrder, BringsTheEndsOfSpringsCloseInABlock) {
  constexpr int n = 20;
  const System block = shuffled(lattice_block(n)).system;
  const std::vector<EdgeEnds> ends = spring_ends(block);
  EXPECT_GT(measure_order(block.point_count(), ends, {}).distance, 0.3 * n * n * n);
  std::vector<char> done(static_cast<std::size_t>(block.point_count()), 0);
  std::vector<Index> order;
  append_near_neighbors({block.point_count(), ends}, done, order);
  std::vector<Index> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<Index>(i);
  // levels of the search are diagonal planes of the block, of up to 3/4 n^2 points
  EXPECT_LT(measure_order(block.point_count(), ends, number).distance, 0.75 * n * n);
  EXPECT_EQ(make_plan(block).numbering.index, order);
  EXPECT_TRUE(make_plan(lattice_block(n).system).numbering.index.empty());
}

}  // namespace
}  // namespace hooke
