#include "lab/apply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lab/parameters.h"
#include "lab/tears.h"
#include "lab/texture.h"

namespace hooke {
namespace {

using Inverse = std::vector<Command>;

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_sound(const Point& point) {
  return point.mass > 0.0 && std::isfinite(point.mass) && point.radius >= 0.0 && std::isfinite(point.radius);
}
bool is_sound(const Spring& spring) {
  return spring.first != spring.second && spring.stiffness >= 0.0 && std::isfinite(spring.stiffness) && spring.damping >= 0.0 &&
         std::isfinite(spring.damping) && spring.rest_length >= 0.0 && std::isfinite(spring.rest_length) && spring.break_strain > 0.0;
}

bool is_share(double share) { return share >= 0.0 && std::isfinite(share); }

bool is_sound(const Force& force) {
  return force.term != nullptr && std::all_of(force.values.begin(), force.values.end(), [](double value) { return std::isfinite(value); });
}

// What it has hold of.
std::vector<PointId> points_of(const Grab& grab) {
  if (!grab.patch) return {grab.point};
  return {grab.patch->points.begin(), grab.patch->points.end()};
}

bool is_sound(const Grab& grab) {
  if (!is_finite(grab.target) || !(grab.stiffness >= 0.0) || !std::isfinite(grab.stiffness)) return false;
  if (!grab.patch) return true;
  const auto& [a, b, c] = grab.patch->points;
  const auto& shares = grab.patch->shares;
  const bool is_between = a != b && b != c && c != a && (grab.point == a || grab.point == b || grab.point == c);
  const bool is_whole = std::all_of(shares.begin(), shares.end(), [](double share) { return share >= 0.0; }) &&
                        std::abs(shares[0] + shares[1] + shares[2] - 1.0) < 1e-9;
  return is_between && is_whole && grab.kind == GrabKind::Pull;
}

// Puts each (place, item), places ascending, where it was before it was taken out; no_index and beyond: at the end.
template <class Item>
std::vector<Item> merged(const std::vector<Item>& list, const std::vector<std::pair<Index, Item>>& coming) {
  std::vector<Item> result;
  result.reserve(list.size() + coming.size());
  auto next = coming.begin();
  for (const Item& item : list) {
    while (next != coming.end() && next->first == static_cast<Index>(result.size())) result.push_back((next++)->second);
    result.push_back(item);
  }
  while (next != coming.end()) result.push_back((next++)->second);
  return result;
}

// The items whose flag is not set.
template <class Item>
std::vector<Item> kept(const std::vector<Item>& list, const std::vector<bool>& gone) {
  std::vector<Item> result;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!gone[i]) result.push_back(list[i]);
  return result;
}

Vec3 in_plane(const System& system, Vec3 v) {
  if (system.dimensions == 2) v.z = 0.0;
  return v;
}

struct Apply {
  Scene& scene;
  Effect& effect;

  Inverse operator()(const Insert& insert) {
    System& system = scene.system;
    State& state = scene.state;
    Remove inverse;
    SheetEdit sheet(scene.sheet);

    std::vector<std::pair<Index, Point>> points;
    std::vector<std::pair<Index, Vec3>> positions, velocities;
    for (const PlacedPoint& placed : insert.points) {
      if (system.index_of(placed.point.id) != no_index || !is_sound(placed.point) || !is_finite(placed.position) ||
          !is_finite(placed.velocity))
        continue;
      points.emplace_back(placed.at, placed.point);
      positions.emplace_back(placed.at, in_plane(system, placed.position));
      velocities.emplace_back(placed.at, in_plane(system, placed.velocity));
      inverse.points.push_back(placed.point.id);
      if (is_share(placed.area)) sheet.set(placed.point.id, placed.area);
    }
    if (!points.empty()) {
      system.set_points(merged(system.points(), points));
      state.position = merged(state.position, positions);
      state.velocity = merged(state.velocity, velocities);
    }

    std::vector<std::pair<Index, Spring>> springs;
    for (const PlacedSpring& placed : insert.springs) {
      const Spring& spring = placed.spring;
      const bool has_ends = system.index_of(spring.first) != no_index && system.index_of(spring.second) != no_index;
      if (system.index_of(spring.id) != no_index || !has_ends || !is_sound(spring)) continue;
      springs.emplace_back(placed.at, spring);
      inverse.springs.push_back(spring.id);
      if (is_share(placed.share)) sheet.set(spring.id, placed.share);
    }
    if (!springs.empty()) system.set_springs(merged(system.springs(), springs));

    std::vector<std::pair<Index, Face>> faces;
    for (const PlacedFace& placed : insert.faces) {
      const auto& corners = placed.face.points;
      if (std::all_of(corners.begin(), corners.end(), [&](PointId id) { return system.index_of(id) != no_index; }))
        faces.emplace_back(placed.at, placed.face);
    }
    for (const auto& [at, face] : faces) inverse.faces.push_back(face);
    if (!faces.empty()) system.faces = merged(system.faces, faces);

    effect.structure = true;
    return {inverse};
  }

  Inverse operator()(const Remove& remove) {
    System& system = scene.system;
    State& state = scene.state;
    Insert inverse;
    const std::shared_ptr<const SheetShares> before = scene.sheet;
    SheetEdit sheet(scene.sheet);

    std::vector<bool> point_goes(system.points().size(), false), spring_goes(system.springs().size(), false);
    for (const PointId id : remove.points)
      if (const Index i = system.index_of(id); i != no_index) point_goes[i] = true;
    for (const SpringId id : remove.springs)
      if (const Index s = system.index_of(id); s != no_index) spring_goes[s] = true;
    const auto goes = [&](PointId id) { return point_goes[system.index_of(id)]; };

    for (Index s = 0; s < system.spring_count(); ++s) {
      const Spring& spring = system.springs()[s];
      spring_goes[s] = spring_goes[s] || goes(spring.first) || goes(spring.second);
      if (!spring_goes[s]) continue;
      inverse.springs.push_back({s, spring, share_of(before.get(), spring.id)});
      sheet.set(spring.id, 0.0);
    }
    // of equal faces the last ones go, as many as are named
    std::map<std::array<PointId, 3>, long> named;
    for (const Face& face : remove.faces) ++named[face.points];
    std::vector<bool> face_goes(system.faces.size(), false);
    for (std::size_t f = system.faces.size(); f-- > 0 && !named.empty();) {
      const auto found = named.find(system.faces[f].points);
      face_goes[f] = found != named.end() && found->second-- > 0;
    }
    for (std::size_t f = 0; f < system.faces.size(); ++f) {
      const auto& corners = system.faces[f].points;
      face_goes[f] = face_goes[f] || std::any_of(corners.begin(), corners.end(), goes);
      if (face_goes[f]) inverse.faces.push_back({static_cast<Index>(f), system.faces[f]});
    }
    for (Index i = 0; i < system.point_count(); ++i) {
      if (!point_goes[i]) continue;
      const Point& point = system.points()[i];
      inverse.points.push_back({i, point, state.position[i], state.velocity[i], area_of(before.get(), point.id)});
      sheet.set(point.id, 0.0);
    }

    if (system.grab && std::ranges::any_of(points_of(*system.grab), goes)) system.grab.reset();
    if (!inverse.faces.empty()) system.faces = kept(system.faces, face_goes);
    if (!inverse.springs.empty()) system.set_springs(kept(system.springs(), spring_goes));
    if (!inverse.points.empty()) {
      system.set_points(kept(system.points(), point_goes));
      state.position = kept(state.position, point_goes);
      state.velocity = kept(state.velocity, point_goes);
    }

    effect.structure = true;
    return {inverse};
  }

  Inverse operator()(const SetNailed& set) {
    SetNailed inverse;
    for (const SetNailed::Item& item : set.items) {
      const Index i = scene.system.index_of(item.point);
      if (i == no_index || scene.system.points()[i].nailed == item.nailed) continue;
      inverse.items.push_back({item.point, !item.nailed, scene.state.velocity[i]});
      scene.system.point(i).nailed = item.nailed;
      scene.state.velocity[i] = item.nailed || !is_finite(item.velocity) ? Vec3(0.0) : in_plane(scene.system, item.velocity);
    }
    std::reverse(inverse.items.begin(), inverse.items.end());
    effect.values = true;
    return {inverse};
  }

  Inverse operator()(const Move& move) {
    Move inverse;
    for (const Move::Item& item : move.items) {
      const Index i = scene.system.index_of(item.point);
      if (i == no_index || !is_finite(item.position) || !is_finite(item.velocity)) continue;
      inverse.items.push_back({item.point, scene.state.position[i], scene.state.velocity[i]});
      scene.state.position[i] = in_plane(scene.system, item.position);
      scene.state.velocity[i] = in_plane(scene.system, item.velocity);
    }
    std::reverse(inverse.items.begin(), inverse.items.end());
    return {inverse};
  }

  Inverse operator()(const SetPointColor& set) {
    SetPointColor inverse;
    for (const auto& [id, color] : set.values) {
      const Index i = scene.system.index_of(id);
      if (i == no_index) continue;
      inverse.values.emplace_back(id, scene.system.points()[i].color);
      scene.system.point(i).color = color;
    }
    std::reverse(inverse.values.begin(), inverse.values.end());
    return {inverse};
  }

  Inverse operator()(const SetPointProperty& set) {
    double Point::*const property = set.property == PointProperty::Mass ? &Point::mass : &Point::radius;
    SetPointProperty inverse{set.property, {}};
    // where mass goes along with the radius, it is put back after the radius is
    SetPointProperty masses{PointProperty::Mass, {}};
    const bool follows = set.property == PointProperty::Radius && scene.defaults.mass_follows_radius;
    for (const auto& [id, value] : set.values) {
      const Index i = scene.system.index_of(id);
      if (i == no_index) continue;
      const Point now = scene.system.points()[i];
      Point changed = now;
      changed.*property = value;
      if (follows) changed.mass = mass_at_radius(now, value);
      if (!is_sound(changed)) continue;
      inverse.values.emplace_back(id, now.*property);
      if (follows) masses.values.emplace_back(id, now.mass);
      scene.system.point(i) = changed;
    }
    std::reverse(inverse.values.begin(), inverse.values.end());
    std::reverse(masses.values.begin(), masses.values.end());
    effect.values = true;
    if (follows) return {inverse, masses};
    return {inverse};
  }

  Inverse operator()(const SetSpringProperty& set) {
    constexpr double Spring::*properties[] = {&Spring::stiffness, &Spring::damping, &Spring::rest_length, &Spring::break_strain};
    double Spring::*const property = properties[static_cast<int>(set.property)];
    SetSpringProperty inverse{set.property, {}};
    inverse.values.reserve(set.values.size());
    for (const auto& [id, value] : set.values) {
      const Index s = scene.system.index_of(id);
      if (s == no_index) continue;
      Spring changed = scene.system.springs()[s];
      changed.*property = value;
      if (!is_sound(changed)) continue;
      inverse.values.emplace_back(id, scene.system.springs()[s].*property);
      scene.system.spring(s) = changed;
    }
    std::reverse(inverse.values.begin(), inverse.values.end());
    effect.values = true;
    return {inverse};
  }

  Inverse operator()(const SetParameter& set) {
    const Inverse inverse = inverse_of(*set.parameter);
    set.parameter->write(scene, clamp_to(*set.parameter, set.value));
    effect.values = true;
    return inverse;
  }

  // What a parameter's write is about to overwrite.
  Inverse inverse_of(const Parameter& parameter) const {
    const auto all_springs = [&](SpringProperty property, double Spring::*member) {
      SetSpringProperty set{property, {}};
      for (const Spring& spring : scene.system.springs()) set.values.emplace_back(spring.id, spring.*member);
      return Inverse{set};
    };
    const auto all_points = [&](PointProperty property, double Point::*member) {
      SetPointProperty set{property, {}};
      for (const Point& point : scene.system.points()) set.values.emplace_back(point.id, point.*member);
      return set;
    };
    switch (parameter.scope) {
      case Parameter::Scope::Gravity:
        return {SetGravity{scene.system.gravity}};
      case Parameter::Scope::Colliders:
        return {SetColliders{scene.system.colliders}};
      case Parameter::Scope::SpringStiffness:
        return all_springs(SpringProperty::Stiffness, &Spring::stiffness);
      case Parameter::Scope::SpringDamping:
        return all_springs(SpringProperty::Damping, &Spring::damping);
      case Parameter::Scope::PointMass:
        return {all_points(PointProperty::Mass, &Point::mass)};
      case Parameter::Scope::PointSize:
        return {all_points(PointProperty::Radius, &Point::radius), all_points(PointProperty::Mass, &Point::mass)};
      case Parameter::Scope::Number:
        break;
    }
    return {RestoreParameter{&parameter, parameter.read(scene)}};
  }

  Inverse operator()(const RestoreParameter& restore) {
    const RestoreParameter inverse{restore.parameter, restore.parameter->read(scene)};
    restore.parameter->write(scene, restore.value);
    effect.values = true;
    return {inverse};
  }

  Inverse operator()(const SetIntegrator& set) {
    const SetIntegrator inverse{scene.settings.integrator};
    scene.settings.integrator = set.integrator;
    return {inverse};
  }

  Inverse operator()(const GrabPoint& grab) {
    if (!is_sound(grab.grab)) return {};
    Move back;
    for (const PointId id : points_of(grab.grab)) {
      const Index i = scene.system.index_of(id);
      if (i == no_index) return {};
      back.items.push_back({id, scene.state.position[i], scene.state.velocity[i]});
    }
    scene.system.grab = grab.grab;
    scene.system.grab->target = in_plane(scene.system, grab.grab.target);
    scene.state.hand = grab.grab.kind == GrabKind::Hold ? back.items[0].position : scene.system.grab->target;
    effect.values = true;
    return {ReleaseHand{}, back};
  }

  Inverse operator()(const GrabCollider& grab) {
    const Index c = grab.grab.collider;
    if (c < 0 || c >= static_cast<Index>(scene.system.colliders.size()) || !is_finite(grab.grab.target)) return {};
    scene.system.collider_grab = grab.grab;
    effect.values = true;
    return {ReleaseHand{}, SetColliders{scene.system.colliders}};
  }

  Inverse operator()(const MoveHand& move) {
    if (scene.system.collider_grab && is_finite(move.target)) scene.system.collider_grab->target = move.target;
    if (scene.system.grab && is_finite(move.target)) scene.system.grab->target = in_plane(scene.system, move.target);
    return {};
  }

  Inverse operator()(const ReleaseHand&) {
    effect.values = effect.values || scene.system.collider_grab;
    scene.system.collider_grab.reset();
    if (!scene.system.grab) return {};
    const Index i = scene.system.index_of(scene.system.grab->point);
    if (scene.system.points()[i].nailed) scene.state.velocity[i] = Vec3(0.0);
    scene.system.grab.reset();
    effect.values = true;
    return {};
  }

  Inverse operator()(const SetGravity& set) {
    const SetGravity inverse{scene.system.gravity};
    if (is_finite(set.gravity)) scene.system.gravity = set.gravity;
    effect.values = true;
    return {inverse};
  }

  Inverse operator()(const SetColliders& set) {
    const SetColliders inverse{scene.system.colliders};
    scene.system.colliders = set.colliders;
    if (scene.system.collider_grab && scene.system.collider_grab->collider >= static_cast<Index>(set.colliders.size()))
      scene.system.collider_grab.reset();
    effect.values = true;
    return {inverse};
  }

  Inverse operator()(const SetForces& set) {
    const SetForces inverse{scene.system.forces};
    scene.system.forces.clear();
    for (const Force& force : set.forces)
      if (is_sound(force)) scene.system.forces.push_back(force);
    effect.values = true;
    return {inverse};
  }

  Inverse operator()(const SetTexture& set) {
    const SetTexture inverse{scene.view.texture, scene.view.texture_size, scene.print.picture};
    scene.view.texture = set.texture;
    scene.view.texture_size = set.size;
    scene.print.picture = set.picture;
    lay_out_print(scene);
    return {inverse};
  }

  // The time moves with the points: it is another moment of the same run.
  Inverse operator()(const GoToState& go) {
    const State& there = *go.state;
    const auto fits = [&](const std::vector<Vec3>& list) {
      return list.size() == scene.system.points().size() && std::ranges::all_of(list, is_finite);
    };
    if (!fits(there.position) || !fits(there.velocity) || !std::isfinite(there.time) || there.torn > scene.tears.size()) return {};
    const GoToState inverse{std::make_shared<const State>(scene.state)};
    const EnergyLedger ledger = scene.state.ledger;
    make_torn(there.torn);
    scene.state = there;
    scene.state.ledger = ledger;
    scene.system.grab.reset();
    effect.values = true;
    return {inverse};
  }

  Inverse operator()(const SetTorn& set) {
    if (set.torn > scene.tears.size()) return {};
    const SetTorn inverse{scene.state.torn};
    make_torn(set.torn);
    return {inverse};
  }

  // Mends and tears what lies between.
  void make_torn(std::uint32_t torn) {
    const TearPath path = path_between(scene, scene.state.torn, torn);
    for (const std::uint32_t tear : path.mended) (*this)(mending_of(*scene.tears[tear - 1]));
    for (const std::uint32_t tear : path.torn) (*this)(tearing_of(*scene.tears[tear - 1]));
    scene.state.torn = torn;
  }

  Inverse operator()(const Replace& replace) {
    const Replace inverse{std::make_shared<const Scene>(scene)};
    // tears of the same run stay known: what came of them may be gone back to
    auto tears = std::move(scene.tears);
    scene = *replace.scene;
    const bool goes_on = tears.size() > scene.tears.size() && std::equal(scene.tears.begin(), scene.tears.end(), tears.begin());
    if (goes_on) scene.tears = std::move(tears);
    effect.structure = true;
    return {inverse};
  }
};

}  // namespace

std::vector<Command> apply(Scene& scene, const Command& command, Effect& effect) { return std::visit(Apply{scene, effect}, command); }

}  // namespace hooke
