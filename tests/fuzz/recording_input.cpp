#include "fuzz/recording_input.h"

#include <optional>

#include "base/json_text.h"
#include "edit/command_text.h"
#include "fuzz/invariants.h"
#include "lab/lab.h"
#include "support/command_text.h"
#include "support/valid_scene.h"

namespace hooke {
namespace {

constexpr int max_played_frames = 5;
constexpr std::size_t max_played_items = 100;

Command parse_command(const std::string& text) {
  std::optional<Command> command;
  JsonParser parser;
  walk_json(text, "again",
            {.is_list = [](std::string_view) { return false; },
             .item = {},
             .member = [&](std::string_view key,
                           std::string_view value) { command = read_command(JsonField("again", key, parser.parse(value))); },
             .is_one_line = true});
  require(command.has_value(), "a command that was written can be read");
  return *command;
}

// Scenes within all limits may still take too long to simulate: those of small recordings are.
bool is_small(const Scene& scene) {
  const System& system = scene.system;
  return system.point_count() < 200 && system.spring_count() < 1000 && scene.settings.substeps <= 20 && system.colliders.size() <= 10;
}

void play(const Recording& recording) {
  Lab lab(*recording.start);
  lab.submit(Play{std::make_shared<const Recording>(recording)});
  for (int frame = 0; frame < max_played_frames && is_small(lab.scene()); ++frame) {
    lab.step();
    lab.publish();
    require(is_valid(*lab.status()), "the scene is valid after a frame");
    if (!lab.is_playing() || lab.status()->snapshot->divergence) return;
  }
}

// Returns the recording that was read.
std::optional<Recording> read_and_write(std::string_view bytes) {
  Recording recording;
  try {
    recording = parse_recording(std::string(bytes), "fuzz.hookelog");
  } catch (const InputError& refused) {
    for (const char* c = refused.what(); *c != '\0'; ++c)
      require(static_cast<unsigned char>(*c) >= 0x20 && *c != 0x7f, "no control character in a message");
    return std::nullopt;
  }
  for (const Recording::Item& item : recording.items)
    if (const auto* command = std::get_if<Command>(&item)) {
      const std::string text = text_of(*command);
      require(text_of(parse_command(text)) == text, "an edit is read back as it was written");
    }
  return recording;
}

}  // namespace

void read_as_recording(std::string_view bytes) { read_and_write(bytes); }

void try_as_recording(std::string_view bytes) {
  const std::optional<Recording> recording = read_and_write(bytes);
  if (!recording) return;
  bool are_small = is_small(*recording->start) && recording->items.size() <= max_played_items;
  for (const Recording::Item& item : recording->items)
    if (const auto* scene = std::get_if<std::shared_ptr<const Scene>>(&item)) are_small = are_small && is_small(**scene);
  if (are_small) play(*recording);
}

}  // namespace hooke
