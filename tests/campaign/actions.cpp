// Sequences of actions never corrupt the scene, and undo and redo are exact.

#include <algorithm>
#include <set>

#include "base/json_writer.h"
#include "campaign/check.h"
#include "campaign/random_commands.h"
#include "campaign/random_document.h"
#include "edit/command_text.h"
#include "edit/resume_state.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "support/valid_scene.h"

namespace hooke {
namespace {

constexpr int actions_per_session = 200;

// Everything that undo restores: the content of a scene file and the ids. The position of the hand and its work are not edits.
std::string text_of(const Scene& scene) {
  ResumeState rest = resume_state_of(scene);
  rest.supply = {};
  rest.hand = Vec3(0.0);
  rest.grab.reset();
  rest.collider_grab.reset();
  rest.next_point_id = rest.next_spring_id = 0;
  JsonWriter out;
  write_resume_state(out, rest);
  return format_scene(scene) + out.take();
}

// Excerpts of both texts from shortly before the first difference.
std::string difference(const std::string& expected, const std::string& found) {
  const auto at = static_cast<std::size_t>(std::ranges::mismatch(expected, found).in1 - expected.begin());
  const std::size_t from = at < 60 ? 0 : at - 60;
  return "\n  expected ..." + expected.substr(from, 160) + "\n  found    ..." + found.substr(from, 160);
}

class Session {
 public:
  explicit Session(std::uint64_t number) : commands_(number), random_(commands_.random()), lab_(start(number)) {}

  long run() {
    while (actions_ < actions_per_session) {
      switch (random_.below(4)) {
        case 0:
          control();
          break;
        case 1:
          frames();
          break;
        default:
          edit_and_undo();
      }
      expect(is_valid(*lab_.status()), "the scene is not valid after " + last_);
    }
    return actions_;
  }

 private:
  static Scene start(std::uint64_t number) {
    static const std::vector<Scene> shipped = [] {
      std::vector<Scene> scenes;
      for (const char* id : {"two_masses", "three_masses", "grid_4x4"}) scenes.push_back(load_scene(find_scene(id)).scene);
      return scenes;
    }();
    Random random(~number);
    if (random.one_in(2)) return random.one_of(shipped);
    Scene scene = random_document(random, Numbers::Ordinary);
    scene.settings.substeps = 1 + static_cast<int>(random.below(8));
    // an edit that nails a moving point also stops it
    for (Index i = 0; i < scene.system.point_count(); ++i)
      if (scene.system.points()[i].nailed) scene.state.velocity[i] = Vec3(0.0);
    return scene;
  }

  void apply() {
    lab_.advance(0.0, [] { return true; });
    ++actions_;
  }
  void submit(const Control& what) {
    lab_.submit(what);
    apply();
  }

  // Several edits without a frame between them, undone and redone one by one or all at once.
  void edit_and_undo() {
    const std::size_t done = lab_.status()->history.list->done;
    const std::string before = text_of(lab_.scene());
    std::string names;
    for (Index i = random_.below(5); i >= 0; --i) {
      const Command command = commands_.next(lab_);
      last_ = describe(command);
      names += last_ + ", ";
      lab_.submit(command);
      apply();
    }
    const std::string after = text_of(lab_.scene());
    const std::size_t made = lab_.status()->history.list->done;
    expect(made >= done, "the history lost steps after " + names);
    const bool at_once = random_.one_in(2);
    go_to_step(made, done, at_once);
    expect_text(before, "undo does not restore the scene before " + names);
    go_to_step(done, made, at_once);
    expect_text(after, "redo does not restore the scene after " + names);
    if (random_.one_in(2)) go_to_step(made, done, at_once);
  }

  void expect_text(const std::string& expected, const std::string& what) {
    const std::string found = text_of(lab_.scene());
    if (found != expected) throw Finding(what + difference(expected, found));
  }

  void go_to_step(std::size_t from, std::size_t to, bool at_once) {
    if (at_once) return submit(GoToHistoryStep{to});
    for (; from > to; --from) submit(Undo{});
    for (; from < to; ++from) submit(Redo{});
  }

  void control() {
    last_ = "a control";
    switch (random_.below(9)) {
      case 0:
        return submit(Undo{});
      case 1:
        return submit(Redo{});
      case 2:
        return submit(StepBack{});
      case 3:
        return submit(GoToTime{lab_.scene().state.time - random_.uniform(0.0, 0.2)});
      case 4:
        return submit(GoToStart{});
      case 5:
        return submit(GoToHistoryStep{static_cast<std::size_t>(random_.below(20))});
      case 6:
        return submit(MarkSaved{});
      case 7:
        return submit(SetRunning{random_.one_in(2)});
      default:
        return submit(StepOnce{});
    }
  }

  void frames() {
    last_ = "frames";
    // a random scene may take too long to simulate
    if (lab_.scene().settings.substeps > 20) lab_.submit(SetParameter{find_parameter("substeps"), 5.0});
    for (Index i = random_.below(4); i >= 0; --i, ++actions_) lab_.step();
    apply();
  }

  RandomCommands commands_;
  Random& random_;
  Lab lab_;
  long actions_ = 0;
  std::string last_;
};

// A kind of command that is added must be drawn too.
void expect_every_kind() {
  RandomCommands commands(0);
  Lab lab(load_scene(find_scene("grid_4x4")).scene);
  std::set<std::size_t> kinds;
  for (int i = 0; i < 2000; ++i) kinds.insert(commands.next(lab).index());
  expect(kinds.size() == RandomCommands::kinds, "not every kind of command is drawn");
}

}  // namespace

const Check actions{"actions", "actions", 120, [](std::uint64_t number) {
                      if (number == 0) expect_every_kind();
                      return Session(number).run();
                    }};

}  // namespace hooke
