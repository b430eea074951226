// Names of scenes and files that do not exist.
#include <gtest/gtest.h>

#include <fstream>

#include "base/errors.h"
#include "formats/scene_file.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

std::string refusal_of_name(const std::string& name, std::span<const std::string_view> commands = {}) {
  try {
    find_scene(name, commands);
    return "found";
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(UnknownScenes, AreAnsweredWithAllNames) {
  const std::string text = refusal_of_name("no_such_scene");
  EXPECT_TRUE(text.starts_with("no_such_scene: no such file or shipped scene: must be one of cloth, ")) << text;
}

TEST(UnknownScenes, AreAnsweredWithSimilarNamesFirst) {
  const std::string scene = refusal_of_name("trampolin"), file = refusal_of_name("marble.json");
  EXPECT_TRUE(scene.starts_with("trampolin: no such file or shipped scene; did you mean trampoline? All names: cloth, ")) << scene;
  EXPECT_TRUE(file.starts_with("marble.json: no such file; did you mean marbles or marble_run?")) << file;
  const std::string_view commands[] = {"run", "capture"};
  const std::string command = refusal_of_name("captur", commands);
  EXPECT_TRUE(command.starts_with("captur: no such command, file or shipped scene; did you mean capture? All names: run, capture, cloth, "))
      << command;
}

TEST(UnknownScenes, AreComparedWithTheFilesOfTheirFolder) {
  const ScratchFolder scratch;
  std::ofstream(scratch.folder / "my_clock.json").close();
  const std::string typed = (scratch.folder / "my_clok.json").string(), text = refusal_of_name(typed);
  EXPECT_TRUE(text.starts_with(typed + ": no such file; did you mean my_clock.json?")) << text;
}

}  // namespace
}  // namespace hooke
