#include "edit/command.h"

#include <cmath>

#include "base/bounds.h"
#include "scene/parameters.h"
#include "sim/integrator.h"

namespace hooke {
namespace {

// "3 points", "1 spring"
std::string count(std::size_t number, const std::string& noun) { return std::to_string(number) + " " + noun + (number == 1 ? "" : "s"); }

std::string count_all(std::size_t points, std::size_t springs) {
  if (springs == 0) return count(points, "point");
  if (points == 0) return count(springs, "spring");
  return count(points, "point") + " and " + count(springs, "spring");
}

struct Describe {
  std::string operator()(const Insert& insert) const {
    if (insert.points.empty() && insert.springs.size() == 1) return "attach";
    return "add " + count_all(insert.points.size(), insert.springs.size());
  }
  std::string operator()(const Remove& remove) const {
    if (remove.points.empty() && remove.springs.empty()) return "delete " + count(remove.faces.size(), "face");
    if (!remove.faces.empty()) return "cut";
    return "delete " + count_all(remove.points.size(), remove.springs.size());
  }
  std::string operator()(const SetNailed& nail) const {
    const bool nailed = !nail.items.empty() && nail.items.front().nailed;
    return (nailed ? "nail " : "release ") + count(nail.items.size(), "point");
  }
  std::string operator()(const Move& move) const { return "move " + count(move.items.size(), "point"); }
  std::string operator()(const SetPointColor& set) const { return "color of " + count(set.values.size(), "point"); }
  std::string operator()(const SetPointProperty& set) const {
    return std::string(set.property == PointProperty::Mass ? "mass of " : "radius of ") + count(set.values.size(), "point");
  }
  std::string operator()(const SetSpringProperty& set) const {
    constexpr const char* names[] = {"stiffness of ", "damping of ", "rest length of ", "break strain of "};
    return names[static_cast<int>(set.property)] + count(set.values.size(), "spring");
  }
  std::string operator()(const SetParameter& set) const { return "set " + std::string(set.parameter->label); }
  std::string operator()(const RestoreParameter& restore) const { return "set " + std::string(restore.parameter->label); }
  std::string operator()(const SetIntegrator& set) const { return "use " + std::string(set.integrator->label); }
  std::string operator()(const GrabPoint& grab) const { return grab.grab.patch ? "drag the cloth" : "drag a point"; }
  std::string operator()(const GrabCollider&) const { return "drag a collider"; }
  std::string operator()(const MoveHand&) const { return "move the hand"; }
  std::string operator()(const ReleaseHand&) const { return "release"; }
  std::string operator()(const SetGravity&) const { return "change gravity"; }
  std::string operator()(const SetColliders&) const { return "change the colliders"; }
  std::string operator()(const SetForces&) const { return "change the forces"; }
  std::string operator()(const SetTexture& set) const { return set.texture.empty() ? "remove the texture" : "set the texture"; }
  std::string operator()(const GoToState& go) const { return "go to " + format_exact(std::round(1000.0 * go.state->time) / 1000.0) + " s"; }
  std::string operator()(const SetTorn& set) const { return set.torn == 0 ? "undo tears" : "tear"; }
  std::string operator()(const MarkTorn&) const { return "tear"; }
  std::string operator()(const Replace&) const { return "return to the start"; }
};

template <class Item>
std::size_t bytes_in(const std::vector<Item>& list) {
  return list.capacity() * sizeof(Item);
}

// Images are shared with the scene and not counted; a whole scene is a copy.
struct Bytes {
  std::size_t operator()(const Insert& insert) const { return bytes_in(insert.points) + bytes_in(insert.springs) + bytes_in(insert.faces); }
  std::size_t operator()(const Remove& remove) const { return bytes_in(remove.points) + bytes_in(remove.springs) + bytes_in(remove.faces); }
  std::size_t operator()(const SetNailed& set) const { return bytes_in(set.items); }
  std::size_t operator()(const Move& move) const { return bytes_in(move.items); }
  std::size_t operator()(const SetPointColor& set) const { return bytes_in(set.values); }
  std::size_t operator()(const SetPointProperty& set) const { return bytes_in(set.values); }
  std::size_t operator()(const SetSpringProperty& set) const { return bytes_in(set.values); }
  std::size_t operator()(const SetColliders& set) const { return bytes_in(set.colliders); }
  std::size_t operator()(const SetForces& set) const { return bytes_in(set.forces); }
  std::size_t operator()(const GoToState& go) const { return sizeof(State) + bytes_in(go.state->position) + bytes_in(go.state->velocity); }
  std::size_t operator()(const Replace& replace) const {
    const Scene& scene = *replace.scene;
    const System& system = scene.system;
    constexpr std::size_t lookup_entry_bytes = sizeof(Index);
    return sizeof(Scene) + bytes_in(system.points()) + bytes_in(system.springs()) + bytes_in(system.faces) +
           bytes_in(scene.state.position) + bytes_in(scene.state.velocity) +
           lookup_entry_bytes * (system.points().size() + system.springs().size()) + scene.preserved_json.generators.size();
  }
  template <class Small>
  std::size_t operator()(const Small&) const {
    return 0;
  }
};

}  // namespace

std::string describe(const Command& command) { return std::visit(Describe{}, command); }

std::size_t bytes_of(const Command& command) { return sizeof(Command) + std::visit(Bytes{}, command); }

}  // namespace hooke
