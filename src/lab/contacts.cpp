// The partner of each contact, which the impulses of a frame do not tell: what is nearest in the direction of the force.
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "lab/loads.h"
#include "sim/contact/closest.h"

namespace hooke {
namespace {

// What a point may touch: a face, a spring with its second point twice, or a point three times.
struct Feature {
  Contact::Partner kind;
  Index number = 0;
  std::array<Index, 3> points{};
  double x = 0.0;  // [m], of the first point
};

struct Features {
  std::vector<Feature> all;  // in ascending order of x
  double reach = 0.0;        // [m], in x, between points that touch

  Features(const Scene& scene, const SurfacePlan& surface) {
    const System& system = scene.system;
    double size = 0.0, radius = 0.0;
    for (const Point& point : system.points()) radius = std::max(radius, point.radius);
    const auto add = [&](Contact::Partner kind, Index number, std::initializer_list<PointId> ids) {
      Feature feature{.kind = kind, .number = number};
      std::ranges::transform(ids, feature.points.begin(), [&](PointId id) { return system.index_of(id); });
      const std::vector<Vec3>& x = scene.state.position;
      for (const Index i : feature.points) size = std::max(size, glm::length(x[i] - x[feature.points[0]]));
      feature.x = x[feature.points[0]].x;
      all.push_back(feature);
    };
    if (system.contact.faces && system.dimensions == 3)
      for (Index n = 0; const Face& face : system.faces) add(Contact::Partner::Face, n++, {face.points[0], face.points[1], face.points[2]});
    if (system.contact.springs)
      for (Index n = 0; const Spring& each : system.springs()) add(Contact::Partner::Spring, n++, {each.first, each.second, each.second});
    const auto add_point = [&](Index n) {
      const PointId id = system.points()[n].id;
      add(Contact::Partner::Point, n, {id, id, id});
    };
    for (Index n = 0; system.contact.points && n < system.point_count(); ++n) add_point(n);
    for (const SurfacePiece& piece : surface.pieces)
      if (piece.is_sphere() && !system.contact.points) add_point(surface.points[piece.points[0]]);
    reach = 2.0 * (size + radius + system.contact.thickness);
    std::ranges::sort(all, {}, &Feature::x);
  }
};

void find_partner(const Scene& scene, const PairPlan& pairs, const Features& features, Contact& contact) {
  const System& system = scene.system;
  const auto radius_of = [&](Index i) { return system.points()[i].radius; };
  const Vec3 x = scene.state.position[contact.point];
  double nearest = std::numeric_limits<double>::infinity();  // [m], along the force
  const auto note = [&](double gap, Contact::Partner kind, Index number, const Vec3& normal) {
    const double along = glm::dot(normal, contact.force) / glm::length(contact.force);
    if (!(along > 0.0) || !(std::max(0.0, gap) / along < nearest)) return;
    nearest = std::max(0.0, gap) / along;
    contact.partner = kind, contact.number = number, contact.normal = normal;
  };
  for (std::size_t c = 0; c < system.colliders.size(); ++c) {
    const Collider collider = current_collider(system, scene.state, c);
    const Gap gap = gap_to(collider, radius_of(contact.point), x);
    if (collider.solid) note(gap.distance, Contact::Partner::Collider, static_cast<Index>(c), gap.normal);
  }
  auto feature = std::ranges::lower_bound(features.all, x.x - features.reach, {}, &Feature::x);
  for (; feature != features.all.end() && feature->x <= x.x + features.reach; ++feature) {
    if (std::ranges::count(feature->points, contact.point) > 0) continue;
    const auto corner = [&](std::size_t i) { return scene.state.position[feature->points[i]]; };
    const bool is_point = feature->kind == Contact::Partner::Point;
    const auto [first, second] = std::minmax(contact.point, feature->number);
    if (is_point && pairs.excludes(first, second)) continue;
    const Vec3 apart = is_point ? x - corner(0) : closest_points(FeaturePair::PointFace, {x, corner(0), corner(1), corner(2)}).separation;
    const double distance = glm::length(apart), radii = is_point ? radius_of(contact.point) + radius_of(feature->number) : 0.0;
    if (distance > 0.0) note(distance - radii, feature->kind, feature->number, apart / distance);
  }
}

}  // namespace

std::vector<Contact> find_contacts(const Lab& lab) {
  std::vector<Contact> contacts;
  const std::vector<Vec3> forces = contact_forces(lab);
  const Features features(lab.scene(), lab.plan().surface);
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (forces[i] != Vec3(0.0))
      find_partner(lab.scene(), lab.plan().pairs, features,
                   contacts.emplace_back(Contact{.point = static_cast<Index>(i), .force = forces[i]}));
  return contacts;
}

}  // namespace hooke
