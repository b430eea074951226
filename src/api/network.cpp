// What a renderer or an analysis reads of a running network.
#include "api/library.h"
#include "base/overloaded.h"
#include "lab/loads.h"

namespace hooke::v1 {
namespace {

Vector to_vector(const Vec3& vector) { return {vector.x, vector.y, vector.z}; }

template <class Value, class Items, class Read>
std::vector<Value> values(const Items& items, Read read) {
  std::vector<Value> all;
  for (const auto& item : items) all.push_back(read(item));
  return all;
}

std::vector<double> components(const std::vector<Vec3>& vectors) {
  std::vector<double> all;
  for (const Vec3& vector : vectors) all.insert(all.end(), {vector.x, vector.y, vector.z});
  return all;
}

}  // namespace

std::int64_t Simulation::point_count() const { return data().system().point_count(); }

std::vector<std::int64_t> Simulation::springs() const {
  std::vector<std::int64_t> ends;
  for (const Spring& spring : data().system().springs())
    for (const PointId end : {spring.first, spring.second}) ends.push_back(data().system().index_of(end));
  return ends;
}

std::vector<std::int64_t> Simulation::faces() const {
  std::vector<std::int64_t> corners;
  for (const Face& face : data().system().faces)
    for (const PointId corner : face.points) corners.push_back(data().system().index_of(corner));
  return corners;
}

std::vector<double> Simulation::masses() const {
  return values<double>(data().system().points(), [](const Point& point) { return point.mass; });
}
std::vector<double> Simulation::radii() const {
  return values<double>(data().system().points(), [](const Point& point) { return point.radius; });
}
std::vector<bool> Simulation::nailed() const {
  return values<bool>(data().system().points(), [](const Point& point) { return point.nailed; });
}
std::vector<double> Simulation::stiffness() const {
  return values<double>(data().system().springs(), [&](const Spring& spring) { return data().system().stiffness_of(spring); });
}
std::vector<double> Simulation::rest_lengths() const {
  return values<double>(data().system().springs(), [](const Spring& spring) { return spring.rest_length; });
}
std::vector<double> Simulation::tensions() const { return compute_loads(data().lab).tension; }

std::vector<double> Simulation::reactions() const { return components(compute_loads(data().lab).reaction); }
std::vector<double> Simulation::contact_forces() const { return components(hooke::contact_forces(data().lab)); }

std::vector<std::int64_t> Simulation::contacts() const {
  const std::vector<Vec3> forces = hooke::contact_forces(data().lab);
  std::vector<std::int64_t> points;
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (forces[i] != Vec3(0.0)) points.push_back(static_cast<std::int64_t>(i));
  return points;
}
std::vector<Partner> Simulation::contact_partners() const {
  return values<Partner>(find_contacts(data().lab), [](const Contact& contact) {
    return Partner{static_cast<Partner::Kind>(contact.partner), contact.number, to_vector(contact.normal)};
  });
}

std::vector<Collider> Simulation::colliders() const {
  std::vector<Collider> all;
  for (std::size_t i = 0; i < data().system().colliders.size(); ++i)
    all.push_back(std::visit(Overloaded{[](const Plane& plane) {
                                          return Collider{Collider::Kind::Plane, to_vector(plane.point), to_vector(plane.normal), 0.0};
                                        },
                                        [](const Sphere& sphere) {
                                          return Collider{Collider::Kind::Sphere, to_vector(sphere.center), {}, sphere.radius};
                                        },
                                        [](const Box& box) {
                                          return Collider{Collider::Kind::Box, to_vector(box.min), to_vector(box.max), 0.0};
                                        }},
                             current_collider(data().system(), data().lab.scene().state, i).shape));
  return all;
}

}  // namespace hooke::v1
