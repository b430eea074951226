// hooke: the window. Commands without a window are passed to hooke-headless in the same folder.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "app/app.h"
#include "app/document/files.h"
#include "app/window/loop.h"
#include "base/printable.h"
#include "device/gpu_device.h"
#include "formats/open_file.h"
#include "lab/recording.h"

namespace hooke {
namespace {

constexpr int exit_usage = 2, exit_refused = 3, exit_io = 5;
constexpr std::string_view commands[] = {"run", "capture", "bench", "check", "convert", "replay", "sweep"};
constexpr const char* start_scene = "cloth";

int print_error(int code, const std::string& line) {
  std::cerr << "hooke: " << without_middle(line) << "\n";
  return code;
}

// Replaces this process by hooke-headless with the same arguments. Returns only on failure.
int exec_hooke_cli(char** arguments) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "hooke-headless";
  arguments[0] = const_cast<char*>(program.c_str());
  ::execv(program.c_str(), arguments);
  return print_error(exit_io, program.string() + ": " + std::strerror(errno));
}

std::filesystem::path full_path(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::absolute(file, error).lexically_normal();
}

// Throws InputError or FileError.
std::unique_ptr<App> open_scene(const std::string& name) {
  const std::filesystem::path file = full_path(find_scene(name, commands));
  std::shared_ptr<const Recording> recording;
  LoadedScene loaded;
  if (file.extension() == recording_extension) {
    recording = std::make_shared<const Recording>(read_recording(file));
    loaded.scene = *recording->start;
  } else {
    loaded = load_fitting(file);
  }
  // a file of another format is imported: the document has no file
  const bool imported = recording || (find_readable_kind(file) != nullptr && !is_scene_file(file));
  const std::string notice = opening_notice(loaded.scene, loaded.warnings, file);
  auto app =
      std::make_unique<App>(std::make_shared<const Scene>(std::move(loaded.scene)), imported ? std::filesystem::path() : file, xdg_home());
  app->panels().banners.file_warnings = notice;
  if (recording) app->document().play(recording);
  return app;
}

int open_window(const std::string& name, bool from_desktop, bool on_gpu) {
  std::unique_ptr<App> app;
  try {
    app = open_scene(name);
  } catch (const std::runtime_error& refusal) {  // InputError or FileError
    if (!from_desktop) throw;
    print_error(exit_refused, refusal.what());
    app = open_scene(start_scene);
    app->document().open(full_path(name));  // is refused again, with a message in the window
  }
  Window window(app->title(), {1280, 800});
  app->use(window.clipboard());
  if (on_gpu) app->handle(Request(Action::SwitchDevice));
  run_loop(window, *app);
  return 0;
}

// In the words of hooke-headless.
std::string describe(const CLI::ParseError& error, const CLI::App& line) {
  std::string what = printable(error.what()), words;
  for (const std::string& word : line.remaining(true)) words += " " + word;
  if (!words.empty()) return "not expected:" + printable(words);
  return what.ends_with(" missing") ? what.substr(0, what.find(' ')) + " its value is missing" : what;
}

std::string check_device(const std::string& word) { return word == "cpu" || word == "gpu" ? "" : word + ": must be cpu or gpu"; }

int start(int count, char** arguments) {
  if (count > 1 && std::ranges::find(commands, arguments[1]) != std::end(commands)) return exec_hooke_cli(arguments);

  CLI::App line("A laboratory for networks of point masses and springs.", "hooke");
  std::string scene = start_scene;
  line.add_option("SCENE", scene, "Scene to open: a file, or the name of a shipped scene.");
  bool from_desktop = false, reset_settings = false;
  line.add_flag("--from-desktop", from_desktop, "Show in the window why SCENE cannot be opened, where no terminal would show it.");
  line.add_flag("--reset-settings", reset_settings, "Delete the saved settings and start with the defaults.");
  std::string device;
  line.add_option("--device", device, "Compute on cpu, the default, or gpu: what runs there.")->check(check_device);
  line.set_version_flag("--version", [] { return "hooke " HOOKE_VERSION "\n" + describe_gpu(); });
  line.footer("Without a window: hooke run|capture|convert ... (hooke run --help).");
  try {
    line.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return line.exit(error);  // help or version
    return print_error(exit_usage, describe(error, line) + " (see --help)");
  }
  if (reset_settings) std::filesystem::remove(xdg_home().config / "settings.json");
  return open_window(scene, from_desktop, device == "gpu");
}

}  // namespace
}  // namespace hooke

int main(int count, char** arguments) {
  try {
    return hooke::start(count, arguments);
  } catch (const hooke::InputError& refused) {
    return hooke::print_error(hooke::exit_refused, refused.what());
  } catch (const std::exception& error) {  // a file, no window, no graphics, out of memory
    return hooke::print_error(hooke::exit_io, error.what());
  }
}
