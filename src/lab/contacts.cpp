// The partner of each contact, which the impulses of a frame do not tell: what is nearest in the direction of the force.
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "lab/loads.h"
#include "sim/contact/box_tree.h"
#include "sim/contact/closest.h"

namespace hooke {
namespace {

// What a point may touch: a face, a spring with its second point twice, or a point three times.
struct Feature {
  Contact::Partner kind;
  Index number;  // in its list
  std::array<Index, 3> points;
};

struct Search : Contact {
  double nearest = std::numeric_limits<double>::infinity();  // [m], along the force

  void note(double gap, Partner kind, Index its_number, const Vec3& direction) {
    const double along = glm::dot(direction, force) / glm::length(force);
    if (!(along > 0.0) || !(std::max(0.0, gap) / along < nearest)) return;
    nearest = std::max(0.0, gap) / along;
    partner = kind, number = its_number, normal = direction;
  }
};

std::vector<Feature> list_features(const System& system, const SurfacePlan& surface) {
  using Kind = Contact::Partner;
  std::vector<Feature> all;
  const auto at = [&](PointId id) { return system.index_of(id); };
  if (system.contact.faces && system.dimensions == 3)
    for (Index n = 0; const Face& f : system.faces) all.push_back({Kind::Face, n++, {at(f.points[0]), at(f.points[1]), at(f.points[2])}});
  if (system.contact.springs)
    for (Index n = 0; const Spring& s : system.springs()) all.push_back({Kind::Spring, n++, {at(s.first), at(s.second), at(s.second)}});
  for (Index n = 0; system.contact.points && n < system.point_count(); ++n) all.push_back({Kind::Point, n, {n, n, n}});
  for (const SurfacePiece& piece : surface.pieces)
    if (const Index n = surface.points[piece.points[0]]; piece.is_sphere() && !system.contact.points)
      all.push_back({Kind::Point, n, {n, n, n}});
  return all;
}

void compare(const Scene& scene, const PairPlan& pairs, const Feature& feature, Search& search) {
  if (std::ranges::count(feature.points, search.point) > 0) return;
  const bool is_point = feature.kind == Contact::Partner::Point;
  if (is_point && pairs.excludes(search.point, feature.number)) return;
  const auto place = [&](std::size_t i) { return scene.state.position[feature.points[i]]; };
  const auto radius_of = [&](Index i) { return scene.system.points()[i].radius; };
  const Vec3 x = scene.state.position[search.point];
  const Vec3 apart = is_point ? x - place(0) : closest_points(FeaturePair::PointFace, {x, place(0), place(1), place(2)}).separation;
  const double distance = glm::length(apart), radii = is_point ? radius_of(search.point) + radius_of(feature.number) : 0.0;
  if (distance > 0.0) search.note(distance - radii, feature.kind, feature.number, apart / distance);
}

void compare_near(const Lab& lab, std::vector<Search>& searches) {
  const System& system = lab.scene().system;
  const std::vector<Vec3>& x = lab.scene().state.position;
  const std::vector<Feature> features = list_features(system, lab.plan().surface);
  if (features.empty()) return;
  const auto box_of = [&](const Feature& feature) {
    SurfaceBox box{x[feature.points[0]], x[feature.points[0]]};
    for (const Index i : feature.points) box.include({x[i], x[i]});
    return box;
  };
  std::vector<Vec3> places;
  double size = 0.0, radius = 0.0;
  for (const Feature& feature : features) {
    const SurfaceBox box = box_of(feature);
    places.push_back(0.5 * (box.min + box.max));
    size = std::max(size, glm::length(box.max - box.min));
  }
  for (const Point& point : system.points()) radius = std::max(radius, point.radius);
  BoxTree tree;
  tree.build(places);
  tree.fit([&](const BoxRange& items) {
    SurfaceBox box = box_of(features[tree.order()[items.begin]]);
    for (Index k = items.begin; k < items.end; ++k) box.include(box_of(features[tree.order()[k]]));
    return box;
  });
  // what touched may have moved on since, by the size of a feature
  const double reach = size + 2.0 * radius + system.contact.thickness;
  for (Search& search : searches)
    tree.visit_near(x[search.point], reach, [&](Index n) { compare(lab.scene(), lab.plan().pairs, features[n], search); });
}

}  // namespace

std::vector<Contact> find_contacts(const Lab& lab) {
  const Scene& scene = lab.scene();
  std::vector<Search> searches;
  const std::vector<Vec3> forces = contact_forces(lab);
  for (Index i = 0; i < std::ssize(forces); ++i)
    if (forces[i] != Vec3(0.0)) searches.push_back({{.point = i, .force = forces[i]}});
  for (std::size_t c = 0; c < scene.system.colliders.size(); ++c) {
    const Collider collider = current_collider(scene.system, scene.state, c);
    if (!collider.solid) continue;
    for (Search& search : searches) {
      const Gap gap = gap_to(collider, scene.system.points()[search.point].radius, scene.state.position[search.point]);
      search.note(gap.distance, Contact::Partner::Collider, static_cast<Index>(c), gap.normal);
    }
  }
  compare_near(lab, searches);
  return {searches.begin(), searches.end()};
}

}  // namespace hooke
