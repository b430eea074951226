// The lists of springs and faces of a System, which store equal numbers once.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/model/system.h"

namespace hooke {
namespace {

std::vector<Spring> springs_of(std::uint32_t count, std::uint32_t first_id) {
  std::vector<Spring> springs;
  for (std::uint32_t s = 0; s < count; ++s)
    springs.push_back({.id = SpringId{first_id + s},
                       .first = PointId{s},
                       .second = PointId{s + 1},
                       .family = static_cast<SpringFamily>(s % spring_families),
                       .stiffness = 100.0 + s % 3,
                       .damping = s % 2 == 0 ? 0.0 : 0.1,
                       .rest_length = std::sqrt(1.0 + s),
                       .break_strain = s % 5 == 0 ? 0.5 : never_breaks});
  return springs;
}

TEST(SpringList, HoldsTheSpringsThatItWasMadeOf) {
  for (const std::uint32_t first_id : {0u, 3u}) {
    const std::vector<Spring> springs = springs_of(1000, first_id);
    const SpringList list = springs;
    EXPECT_EQ(std::vector<Spring>(list), springs);
    EXPECT_EQ(list.front(), springs.front());
    EXPECT_EQ(list.back(), springs.back());
  }
}

TEST(SpringList, SelectsSpringsWithTheirIds) {
  for (const std::uint32_t first_id : {0u, 3u}) {
    const std::vector<Spring> springs = springs_of(1000, first_id);
    const SpringList list = springs;
    for (const std::vector<Index>& indices : {std::vector<Index>{0, 1, 2}, {0, 1, 3, 700}, {999, 0, 5}, {}}) {
      std::vector<Spring> selected;
      for (const Index s : indices) selected.push_back(springs[static_cast<std::size_t>(s)]);
      EXPECT_EQ(std::vector<Spring>(list.select(indices)), selected);
    }
  }
}

TEST(SpringList, ChangesThePropertiesOfOneSpring) {
  std::vector<Spring> springs = springs_of(10, 0);
  SpringList list = springs;
  SpringEdit(list, 4)->damping = springs[4].damping = 7.0;
  SpringEdit(list, 5)->break_strain = springs[5].break_strain = 0.1;
  EXPECT_EQ(std::vector<Spring>(list), springs);
}

TEST(SpringList, OfACloth_TakesFewBytesPerSpring) {
  std::vector<Spring> springs = springs_of(100'000, 0);
  for (Spring& spring : springs) {
    spring.rest_length = static_cast<std::uint32_t>(spring.first) % 2 == 0 ? 0.1 : std::sqrt(0.02);
    spring.break_strain = never_breaks;
  }
  EXPECT_LT(SpringList(springs).bytes(), 13 * springs.size());
}

TEST(FaceList, HoldsTheFacesThatItWasMadeOf) {
  std::vector<Face> faces;
  for (std::uint32_t f = 0; f < 100; ++f)
    faces.push_back({{PointId{f}, PointId{f + 1}, PointId{f + 2}}, {0.0, -0.0, f % 7 == 0 ? 0.1 : 0.0}});
  FaceList list = faces;
  EXPECT_EQ(std::vector<Face>(list), faces);
  const std::vector<Index> indices{99, 7, 8};
  EXPECT_EQ(std::vector<Face>(list.select(indices)), (std::vector<Face>{faces[99], faces[7], faces[8]}));
  list.truncate(40);
  faces.resize(40);
  EXPECT_EQ(std::vector<Face>(list), faces);
  EXPECT_TRUE(std::signbit(list[39].rest_angle[1]));
}

TEST(System, FindsItemsByIdsThatAreNotTheirIndices) {
  System system;
  std::vector<Point> points;
  for (const std::uint32_t id : {0u, 1u, 2u}) points.push_back({.id = PointId{id}});
  system.set_points(points);
  EXPECT_EQ(system.index_of(PointId{2}), 2);
  EXPECT_EQ(system.index_of(PointId{3}), no_index);
  system.append_point({.id = PointId{5}});
  EXPECT_EQ(system.index_of(PointId{1}), 1);
  EXPECT_EQ(system.index_of(PointId{5}), 3);
  EXPECT_EQ(system.index_of(PointId{3}), no_index);
  EXPECT_EQ(system.next_point_id(), 6u);
  system.append_spring({.id = SpringId{1}, .first = PointId{0}, .second = PointId{5}});
  EXPECT_EQ(system.index_of(SpringId{1}), 0);
  EXPECT_EQ(system.index_of(SpringId{0}), no_index);
  system.append_spring({.id = SpringId{0}, .first = PointId{5}, .second = PointId{1}});
  EXPECT_EQ(system.index_of(SpringId{0}), 1);
  system.set_points({});
  EXPECT_EQ(system.index_of(PointId{0}), no_index);
  EXPECT_EQ(system.next_point_id(), 6u);
}

}  // namespace
}  // namespace hooke
