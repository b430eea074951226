// A recording of a random session replays with the same bits, frame by frame.

#include <filesystem>

#include "campaign/check.h"
#include "campaign/random_commands.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "sim/model/hash.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

constexpr int edits_per_session = 60;

std::uint64_t record(std::uint64_t number, const std::filesystem::path& file) {
  const std::vector<ShippedScene>& scenes = shipped_scenes();
  RandomCommands commands(number);
  Lab lab(load_scene(scenes[number % scenes.size()].file).scene);
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  const bool is_large = lab.scene().system.point_count() > 500;
  for (int edit = 0; edit < (is_large ? 5 : edits_per_session); ++edit) {
    lab.submit(commands.next(lab));
    if (commands.random().one_in(5)) lab.submit(Undo{});
    if (commands.random().one_in(10)) lab.submit(Redo{});
    if (commands.random().one_in(20)) lab.submit(GoToStart{});
    if (lab.scene().settings.substeps > 100) lab.submit(SetParameter{find_parameter("substeps"), 20.0});
    for (Index frame = commands.random().below(3); frame >= 0; --frame) lab.step();
  }
  lab.submit(Record{});
  lab.advance(0.0, [] { return true; });
  expect(lab.status()->recording.error.empty(), lab.status()->recording.error);
  return hash_state(lab.scene().state);
}

long run(std::uint64_t number) {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.folder / "session.hookelog";
  const std::uint64_t hash = record(number, file);

  auto recording = std::make_shared<const Recording>(read_recording(file));
  Lab lab(*recording->start, KeepStart::No);
  lab.submit(Play{recording});
  lab.advance(0.0, [] { return true; });
  // a frame that diverged is not recorded, and it also stops the replay
  for (long step = 0; lab.is_playing() && step < 10 * recording->frames + 10; ++step) lab.step();
  expect(lab.difference().empty(), lab.difference());
  expect(!lab.is_playing(), "the recording does not end");
  expect(hash_state(lab.scene().state) == hash, "the last state differs");
  return 1;
}

}  // namespace

const Check replays{"replays", "recordings", 300, run};

}  // namespace hooke
