#include "edit/command.h"

#include "edit/field_names.h"

namespace hooke {
namespace {

// What a member holds outside of itself. Images are shared with the scene and not counted; a whole scene is a copy.
template <class T>
std::size_t bytes_in(const T&) {
  return 0;
}
template <class Item>
std::size_t bytes_in(const std::vector<Item>& list) {
  return list.capacity() * sizeof(Item);
}
std::size_t bytes_in(const SpringList& list) { return list.bytes(); }
std::size_t bytes_in(const FaceList& list) { return list.bytes(); }
std::size_t bytes_in(const std::shared_ptr<const State>& state) {
  return sizeof(State) + bytes_in(state->position) + bytes_in(state->velocity);
}
std::size_t bytes_in(const std::shared_ptr<const Scene>& scene) {
  const System& system = scene->system;
  return sizeof(Scene) + bytes_in(system.points()) + bytes_in(system.springs()) + bytes_in(system.faces) + bytes_in(scene->state.position) +
         bytes_in(scene->state.velocity) + scene->preserved_json.generators.size();
}

// Whether both set the same property of the same points or springs.
template <class Set>
bool set_the_same(const Set& a, const Set& b) {
  if constexpr (requires { a.property; })
    if (a.property != b.property) return false;
  return std::ranges::equal(a.values, b.values, [](const auto& one, const auto& other) { return one.first == other.first; });
}

}  // namespace

Command::Command(const Command&) = default;
Command::Command(Command&&) noexcept = default;
Command& Command::operator=(const Command&) = default;
Command& Command::operator=(Command&&) noexcept = default;
Command::~Command() = default;

std::string describe(const Command& command) {
  return std::visit([](const auto& each) { return each.describe(); }, command);
}

bool is_undone_with(const Command& later, const Command& earlier) {
  return std::visit(
      []<class A, class B>(const A& a, const B& b) {
        if constexpr (requires { a.is_undone_with(b); })
          return a.is_undone_with(b);
        else if constexpr (std::is_same_v<A, B> && requires { a.values; })
          return set_the_same(a, b);
        else
          return false;
      },
      later, earlier);
}

bool is_grab(const Command& command) { return std::holds_alternative<GrabPoint>(command) || std::holds_alternative<GrabCollider>(command); }

std::size_t bytes_of(const Command& command) {
  const auto bytes_of_members = [](const auto& each) {
    return std::apply([](const auto&... members) { return (std::size_t{0} + ... + bytes_in(members)); }, members_of(each));
  };
  return sizeof(Command) + std::visit(bytes_of_members, command);
}

Inverse apply(Scene& scene, const Command& command, Effect& effect) {
  const std::uint64_t revision = scene.revision;
  Inverse inverse = std::visit([&](const auto& each) { return each.apply(scene, effect); }, command);
  const bool is_state_only =
      std::holds_alternative<Move>(command) || std::holds_alternative<SetVelocity>(command) || std::holds_alternative<MoveHand>(command);
  scene.revision = is_state_only ? revision : revision + 1;
  return inverse;
}

}  // namespace hooke
