// Hostile files are harmless: whatever path a file contains, no file outside its own folder is opened. System calls are traced with strace;
// files that are also opened for a harmless input are allowed.

#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

#include "campaign/check.h"
#include "support/process.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// A file of some format whose only reference is the path.
struct HostileFile {
  std::string_view extension;
  std::string_view before, after;  // the text around the path
};
constexpr HostileFile scene_file{".json", R"({"hooke": 1, "points": [{"position": [0, 0, 0]}], "view": {"texture": ")", "\"}}\n"};
constexpr HostileFile material_file{".obj", "mtllib ", "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"};
constexpr HostileFile material_name{".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl ", "\nf 1 2 3\n"};
constexpr HostileFile recorded_scene{
    ".hookelog",
    "{\"hooke_recording\": 1}\n"
    R"({"hooke": 1, "points": [{"position": [0, 0, 0]}], "view": {"texture": ")",
    "\"}}\n"
    R"({"rest": {"point_ids": null, "spring_ids": null, "next_point_id": 1, "next_spring_id": 0, "grab": null, )"
    R"("collider_grab": null, "hand": [0, 0, 0], "ledger": {"given": 0, "scale": 0, "hand_stretch": 0}, )"
    R"("memory": {"step": 0, "error": 0}, "torn": 0, "tears": []}})"
    "\n"};
constexpr HostileFile recorded_edit{
    ".hookelog",
    "{\"hooke_recording\": 1}\n"
    R"({"hooke": 1, "points": [{"position": [0, 0, 0]}]})"
    "\n"
    R"({"rest": {"point_ids": null, "spring_ids": null, "next_point_id": 1, "next_spring_id": 0, "grab": null, )"
    R"("collider_grab": null, "hand": [0, 0, 0], "ledger": {"given": 0, "scale": 0, "hand_stretch": 0}, )"
    R"("memory": {"step": 0, "error": 0}, "torn": 0, "tears": []}})"
    "\n"
    R"({"set_texture": {"texture": ")",
    "\", \"size\": null, \"picture\": null}}\n"};
constexpr std::array files{&scene_file, &material_file, &material_name, &recorded_scene, &recorded_edit};

// OUTSIDE stands for a folder other than that of the file. The names lead to existing files, so that opening them would succeed.
constexpr std::array<std::string_view, 32> paths{
    "../outside/secret.png",
    "OUTSIDE/secret.png",
    "/OUTSIDE/secret.png",
    "sub/../../outside/secret.png",
    "sub/./../..//outside/secret.png",
    "./inside.png",
    "link.png",
    "chain.png",
    "inner/secret.png",
    "sub/up/outside/secret.png",
    "dangling.png",
    "loop.png",
    "root.png",
    "self.png",
    "/proc/self/environ",
    "/proc/self/root/OUTSIDE/secret.png",
    "/dev/zero",
    "/dev/zero.png",
    "pipe.png",
    "folder.png",
    "~/secret.png",
    "file://OUTSIDE/secret.png",
    "%2e%2e/outside/secret.png",
    "..\\\\outside\\\\secret.png",
    "../outside/secret.png\\u0000.png",
    "inside.png\\u0000../outside/secret.png",
    "linen/../../outside/secret.png",
    "../textures/linen.png",
    ".../secret.png",
    "$HOME/secret.png",
    "`cat OUTSIDE/secret.png`.png",
    "inside.png/../../outside/secret.png",
};

// A folder with the files that the paths lead to.
struct Trap {
  ScratchFolder scratch;
  fs::path outside = scratch.folder / "outside", inside = scratch.folder / "inside";

  Trap() {
    fs::create_directories(outside);
    fs::create_directories(inside / "sub");
    fs::create_directory(inside / "folder.png");
    for (const fs::path& file : {outside / "secret.png", outside / "secret.mtl", inside / "inside.png"})
      std::ofstream(file) << "not a picture";
    fs::create_symlink(outside / "secret.png", inside / "link.png");
    fs::create_symlink("link.png", inside / "chain.png");
    fs::create_directory_symlink(outside, inside / "inner");
    fs::create_directory_symlink("../..", inside / "sub" / "up");
    fs::create_symlink("nowhere.png", inside / "dangling.png");
    fs::create_symlink("loop.png", inside / "loop.png");
    fs::create_symlink("/etc/passwd", inside / "root.png");
    fs::create_symlink("/proc/self/environ", inside / "self.png");
    mkfifo((inside / "pipe.png").c_str(), 0600);
  }

  // The files that the program opens when it reads a file that contains this path.
  std::set<std::string> opened(const HostileFile& format, std::string path) const {
    for (std::size_t at = path.find("OUTSIDE"); at != std::string::npos; at = path.find("OUTSIDE", at))
      path.replace(at, 7, outside.string());
    const fs::path file = inside / ("file" + std::string(format.extension)), log = scratch.folder / "calls";
    std::ofstream(file) << format.before << path << format.after;
    std::vector<std::string> words{"/usr/bin/timeout",
                                   "60",
                                   "/usr/bin/strace",
                                   "-f",
                                   "-y",
                                   "-qq",
                                   "-s",
                                   "4096",
                                   "-e",
                                   "trace=open,openat,openat2,creat",
                                   "-o",
                                   log.string(),
                                   HOOKE_HEADLESS};
    if (format.extension == ".hookelog")
      words.insert(words.end(), {"replay", file.string()});
    else
      words.insert(words.end(), {"run", file.string(), "--seconds", "0.05", "--json", "-"});
    const Outcome outcome = run_process(words);
    expect(outcome.code >= 0 && outcome.code < 124, "the program does not end on " + path + ": " + outcome.err);
    return opened_in(log);
  }

  // A sanitizer opens files of its own process, whose number differs in each run.
  static std::string without_process(const std::string& name) {
    static const std::regex process("^(/proc/|/tmp/tsan\\.rodata\\.)[0-9]+");
    return std::regex_replace(name, process, "$1self");
  }

  // The results of successful calls: "... = 5</a/file>".
  static std::set<std::string> opened_in(const fs::path& log) {
    std::set<std::string> names;
    std::ifstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t result = line.rfind(") = "), begin = line.find('<', result), end = line.rfind('>');
      if (result == std::string::npos || begin == std::string::npos || end == std::string::npos || line[result + 4] == '-') continue;
      names.insert(without_process(line.substr(begin + 1, end - begin - 1)));
    }
    return names;
  }
};

long run(std::uint64_t number) {
  const HostileFile& format = *files[number % files.size()];
  const std::string path(paths[number / files.size() % paths.size()]);
  const Trap trap;
  const std::set<std::string> allowed = trap.opened(format, "inside.png"), opened = trap.opened(format, path);
  expect(!allowed.empty(), "strace saw no file opened");
  const std::string folder = fs::canonical(trap.inside).string();
  for (const std::string& name : opened)
    expect(allowed.contains(name) || name == folder || name.starts_with(folder + "/"),
           path + " in a " + std::string(format.extension) + " opens " + name);
  return 1;
}

}  // namespace

const Check hostile_paths{"hostile_paths", "paths", 200, run};

}  // namespace hooke
