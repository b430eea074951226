#include "formats/scene_json/listed_part.h"

#include "base/same_bits.h"
#include "formats/scene_json/shape_fields.h"

namespace hooke {
namespace {

bool matches_generated(const Scene& scene, const Network& generated, const ListedCounts& listed) {
  const System& system = scene.system;
  const State& state = scene.state;
  const auto id_of = [&](PointId generated_id) { return system.points()[listed.points + static_cast<Index>(generated_id)].id; };
  for (std::size_t i = 0; i < generated.points.size(); ++i) {
    const Index at = listed.points + static_cast<Index>(i);
    Point point = generated.points[i];
    point.id = system.points()[at].id;
    if (point != system.points()[at] || !same_bits(generated.position[i], state.position[at]) ||
        !same_bits(generated.velocity[i], state.velocity[at]) || scene.preserved_json.unknown_of_points.contains(point.id))
      return false;
  }
  for (std::size_t s = 0; s < generated.springs.size(); ++s) {
    Spring spring = generated.springs[s];
    const Spring& current = system.springs()[static_cast<std::size_t>(listed.springs) + s];
    spring.id = current.id;
    spring.first = id_of(spring.first);
    spring.second = id_of(spring.second);
    if (spring != current || scene.preserved_json.unknown_of_springs.contains(spring.id)) return false;
  }
  for (std::size_t f = 0; f < generated.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c)
      if (id_of(generated.faces[f].points[c]) != system.faces[listed.faces + f].points[c]) return false;
  return true;
}

}  // namespace

ListedCounts find_listed(const Scene& scene) {
  const System& system = scene.system;
  const ListedCounts all{system.point_count(), system.spring_count(), system.faces.size()};
  if (scene.preserved_json.generators.empty()) return all;

  const std::vector<Shape> shapes = parse_shapes(scene.preserved_json.generators);
  ElementCount count;
  for (const Shape& shape : shapes) {
    const ElementCount one = element_count_of(shape);
    count.points += one.points;
    count.springs += one.springs;
    count.faces += one.faces;
  }
  if (count.points == 0 || count.points > system.points().size() || count.springs > system.springs().size() ||
      count.faces > system.faces.size())
    return all;

  Network generated;
  for (const Shape& shape : shapes) generate(shape, generated);
  const ListedCounts listed{all.points - static_cast<Index>(count.points), all.springs - static_cast<Index>(count.springs),
                            all.faces - count.faces};
  return matches_generated(scene, generated, listed) ? listed : all;
}

}  // namespace hooke
