#include "cli/commands/replay.h"

#include <cstdio>
#include <iostream>

#include "base/printable.h"
#include "cli/progress_bar.h"
#include "lab/lab.h"
#include "lab/recording.h"
#include "sim/hash.h"

namespace hooke {
namespace {

struct ReplayOptions {
  std::string log;
  bool verify = false, quiet = false;
};

int replay(const ReplayOptions& options) {
  const auto recording = std::make_shared<const Recording>(read_recording(options.log));
  if (recording->is_truncated && !options.quiet)
    std::cerr << "warning: " << printable(options.log) << ": its last line is incomplete; replaying up to there\n";

  Lab lab(*recording->start, KeepStart::No);
  lab.submit(Play{recording});
  long frames = 0;
  {
    ProgressBar progress(recording->frames, !options.quiet);
    lab.advance(0.0, [] { return true; });
    while (lab.is_playing()) {
      lab.step();
      progress.show(++frames);
    }
  }

  const bool is_same = lab.difference().empty();
  if (!options.quiet) {
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(hash_state(lab.scene().state)));
    std::cout << frames << " frames to " << format_exact(lab.scene().state.time) << " s, hash " << hash
              << (options.verify && is_same ? ": every frame as recorded\n" : "\n");
  }
  if (is_same) return exit_code::success;
  std::cerr << (options.verify ? "" : "warning: ") << printable(options.log) << ": " << lab.difference() << "\n";
  return options.verify ? exit_code::check_failed : exit_code::success;
}

}  // namespace

std::function<int()> declare_replay(CLI::App& app) {
  auto options = std::make_shared<ReplayOptions>();
  app.add_option("LOG", options->log, "A recording (" + std::string(recording_extension) + ")")->required();
  app.add_flag("--verify", options->verify, "Exit with code 1 if a frame differs from the recorded one in any bit");
  app.add_flag("-q,--quiet", options->quiet, "Print no warnings, progress or summary");
  return [options] { return replay(*options); };
}

}  // namespace hooke
