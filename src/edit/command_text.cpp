#include "edit/command_text.h"

#include <utility>

#include "edit/text_form.h"

namespace hooke {
namespace {

// Calls `visit` with the type of each command.
template <class Visit, std::size_t... i>
void for_each_command(const Visit& visit, std::index_sequence<i...>) {
  (visit(std::type_identity<std::variant_alternative_t<i, CommandVariant>>()), ...);
}
template <class Visit>
void for_each_command(const Visit& visit) {
  for_each_command(visit, std::make_index_sequence<std::variant_size_v<CommandVariant>>());
}

}  // namespace

void write_command(JsonWriter& out, const Command& command) {
  out.begin_object(JsonWriter::Layout::Line);
  std::visit(
      [&](const auto& each) {
        out.key(each.name);
        write(out, each);
      },
      command);
  out.end();
}

bool is_command(const JsonField& member) {
  bool found = false;
  for_each_command([&]<class T>(std::type_identity<T>) { found = found || member.is(T::name); });
  return found;
}

Command read_command(const JsonField& member) {
  std::optional<Command> command;
  for_each_command([&]<class T>(std::type_identity<T>) {
    if (!command && member.is(T::name)) command = read<T>(member);
  });
  if (!command) member.refuse("is unknown");
  return *std::move(command);
}

}  // namespace hooke
