#include "campaign/random_commands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/texture.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

constexpr Index max_points = 40, max_springs = 120, max_colliders = 4;

bool is_nailed(const Scene& scene, PointId id) {
  const Index i = scene.system.index_of(id);
  return i != no_index && scene.system.points()[i].nailed;
}

}  // namespace

double RandomCommands::number() {
  constexpr double impossible[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0, 0.0, 1e300};
  if (random_.one_in(40)) return random_.one_of(impossible);
  return random_.one_in(2) ? random_.uniform(0.01, 2.0) : std::pow(10.0, random_.uniform(-3.0, 3.0));
}

Vec3 RandomCommands::vector() {
  const double x = random_.uniform(-2.0, 2.0), y = random_.uniform(-2.0, 2.0), z = random_.uniform(-2.0, 2.0);
  return {random_.one_in(100) ? number() : x, y, z};
}

// A point of the scene or, rarely, one that does not exist.
PointId RandomCommands::point(const Scene& scene) {
  if (scene.system.point_count() == 0 || random_.one_in(50)) return PointId{static_cast<std::uint32_t>(random_.below(200))};
  return scene.system.points()[random_.below(scene.system.point_count())].id;
}
SpringId RandomCommands::spring(const Scene& scene) {
  if (scene.system.spring_count() == 0 || random_.one_in(50)) return SpringId{static_cast<std::uint32_t>(random_.below(200))};
  return scene.system.springs()[random_.below(scene.system.spring_count())].id;
}

std::vector<PointId> RandomCommands::some_points(const Scene& scene) {
  std::vector<PointId> ids;
  for (Index i = random_.below(4); i >= 0; --i) ids.push_back(point(scene));
  return ids;
}
std::vector<SpringId> RandomCommands::some_springs(const Scene& scene) {
  std::vector<SpringId> ids;
  for (Index i = random_.below(4); i >= 0; --i) ids.push_back(spring(scene));
  return ids;
}

Insert RandomCommands::insert(Lab& lab) {
  const Scene& scene = lab.scene();
  Insert insert;
  const Index count = scene.system.point_count();
  std::vector<Index> places;
  if (count < max_points)
    for (Index i = random_.below(3); i > 0; --i) places.push_back(random_.one_in(2) ? no_index : random_.below(count + 1));
  std::ranges::sort(places, {}, [](Index at) { return at == no_index ? std::numeric_limits<Index>::max() : at; });
  for (const Index at : places) {
    const bool nailed = random_.one_in(4);
    const Point point{.id = lab.new_point_id(), .nailed = nailed, .mass = number(), .radius = 0.02};
    insert.points.push_back({at, point, vector(), nailed ? Vec3(0.0) : vector()});
  }
  const auto end = [&] { return insert.points.empty() || random_.one_in(2) ? point(scene) : insert.points[0].point.id; };
  if (scene.system.spring_count() < max_springs)
    for (Index s = random_.below(3); s > 0; --s)
      insert.springs.push_back({no_index,
                                {.id = lab.new_spring_id(),
                                 .first = end(),
                                 .second = end(),
                                 .family = static_cast<SpringFamily>(random_.below(4)),
                                 .stiffness = number(),
                                 .damping = random_.one_in(2) ? 0.0 : number(),
                                 .rest_length = number(),
                                 .break_strain = random_.one_in(6) ? number() : never_breaks}});
  if (random_.one_in(4)) insert.faces.push_back({no_index, {{point(scene), point(scene), point(scene)}}});
  return insert;
}

Remove RandomCommands::remove(const Scene& scene) {
  Remove remove;
  if (random_.one_in(2)) remove.points.push_back(point(scene));
  if (random_.one_in(2)) remove.springs = some_springs(scene);
  if (!scene.system.faces.empty() && random_.one_in(2)) remove.faces.push_back(random_.one_of(scene.system.faces));
  return remove;
}

GrabPoint RandomCommands::grab(const Scene& scene) {
  GrabPoint::Item grab{
      .point = point(scene), .kind = random_.one_in(2) ? GrabKind::Hold : GrabKind::Pull, .target = vector(), .stiffness = number()};
  if (random_.one_in(4) && !scene.system.faces.empty()) {
    const Face& face = random_.one_of(scene.system.faces);
    grab.point = face.points[0];
    grab.kind = GrabKind::Pull;
    grab.patch = Patch{face.points, {0.5, 0.25, 0.25}};
  }
  return {grab};
}

SetColliders RandomCommands::colliders(const Scene& scene) {
  SetColliders set{scene.system.colliders};
  if (!set.colliders.empty() && random_.one_in(2)) set.colliders.pop_back();
  if (std::ssize(set.colliders) < max_colliders) {
    Collider collider{.shape = Plane{{0.0, random_.uniform(-3.0, -1.0), 0.0}, {0.0, 1.0, 0.0}}};
    if (random_.one_in(2)) collider.shape = Sphere{vector(), random_.uniform(0.1, 1.0)};
    collider.restitution = random_.uniform(0.0, 1.0);
    collider.friction = random_.uniform(0.0, 1.0);
    if (random_.one_in(3)) collider.path.amplitude = vector();
    set.colliders.push_back(collider);
  }
  return set;
}

SetForces RandomCommands::forces() {
  SetForces set;
  for (Index f = random_.below(3); f > 0; --f) {
    const ForceTerm& term = random_.one_of(force_terms());
    Force force{&term, !random_.one_in(4), default_values(term)};
    if (!term.numbers.empty() && random_.one_in(2)) force.values[0] = random_.uniform(term.numbers[0].min, term.numbers[0].max);
    set.forces.push_back(force);
  }
  return set;
}

// A state in which everything is slightly displaced or, rarely, one that does not fit the scene.
GoToState RandomCommands::go_to(const Scene& scene) {
  State state = scene.state;
  state.time += random_.uniform(-1.0, 1.0);
  for (Vec3& x : state.position) x += 0.1 * vector() * (scene.system.dimensions == 2 ? Vec3(1.0, 1.0, 0.0) : Vec3(1.0));
  if (random_.one_in(20)) state.position.emplace_back(0.0);
  return {std::make_shared<const State>(std::move(state))};
}

Command RandomCommands::next(Lab& lab) {
  const Scene& scene = lab.scene();
  const Parameter& parameter = random_.one_of(parameters());
  switch (random_.below(20)) {
    case 0:
      return insert(lab);
    case 1:
      return random_.one_in(2) ? Command(remove(scene)) : Command(insert(lab));
    case 2: {
      SetNailed set;
      for (const PointId id : some_points(scene)) set.items.push_back({id, random_.one_in(3)});
      return set;
    }
    case 3: {
      if (random_.one_in(3)) {
        SetVelocity set;
        for (const PointId id : some_points(scene)) set.values.emplace_back(id, vector());
        return set;
      }
      Move move;
      for (const PointId id : some_points(scene)) move.items.push_back({id, vector(), is_nailed(scene, id) ? Vec3(0.0) : vector()});
      return move;
    }
    case 4: {
      if (random_.one_in(3)) {
        SetLoad set;
        for (const PointId id : some_points(scene)) set.values.emplace_back(id, vector());
        return set;
      }
      if (random_.one_in(3)) {
        SetFixedAxes set;
        for (const PointId id : some_points(scene)) set.values.emplace_back(id, static_cast<std::uint8_t>(random_.below(8)));
        return set;
      }
      SetPointColor set;
      for (const PointId id : some_points(scene))
        set.values.emplace_back(id, random_.one_in(2) ? std::optional(Color{1, 2, 3}) : std::nullopt);
      return set;
    }
    case 5: {
      SetPointProperty set{static_cast<PointProperty>(random_.below(2)), {}};
      for (const PointId id : some_points(scene)) set.values.emplace_back(id, number());
      return set;
    }
    case 6: {
      if (random_.one_in(3)) {
        SetSpringLaw set;
        for (const SpringId id : some_springs(scene))
          set.values.emplace_back(id, SpringLaw{.force = static_cast<SpringForce>(random_.below(4)), .amplitude = number()});
        return set;
      }
      SetSpringProperty set{static_cast<SpringProperty>(random_.below(4)), {}};
      for (const SpringId id : some_springs(scene)) set.values.emplace_back(id, number());
      return set;
    }
    case 7:
    case 8:
      // a frame of a thousand substeps would take too long
      return SetParameter{&parameter, parameter.name == "substeps" ? 1.0 + static_cast<double>(random_.below(10)) : number()};
    case 9:
      return RestoreParameter{&parameter, parameter.read(scene)};
    case 10:
      return SetIntegrator{random_.one_in(8) ? &automatic_method() : &random_.one_of(integrators())};
    case 11:
      return grab(scene);
    case 12:
      return GrabCollider{{static_cast<Index>(random_.below(4)) - 1, vector()}};
    case 13:
    case 14:
      return MoveHand{vector()};
    case 15:
      return ReleaseHand{};
    case 16:
      return SetGravity{vector()};
    case 17:
      return colliders(scene);
    case 18:
      if (random_.one_in(3))
        return random_.one_in(2)
                   ? Command(SetText{scene.name, random_.one_in(2) ? "A scene." : "", "Notes"})
                   : Command(SetPlots{random_.one_in(2) ? std::vector<std::string>{"y0", "kinetic"} : std::vector<std::string>{}});
      return random_.one_in(2) ? Command(forces()) : Command(SetTexture{random_.one_in(2) ? "linen" : "", std::nullopt, {}});
    default:
      return random_.one_in(2) ? Command(go_to(scene))
                               : Command(SetTorn{static_cast<std::uint32_t>(random_.below(static_cast<Index>(scene.tears.size()) + 2))});
  }
}

}  // namespace hooke
