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
      [](const auto& a, const auto& b) {
        if constexpr (requires { a.is_undone_with(b); })
          return a.is_undone_with(b);
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

}  // namespace hooke
