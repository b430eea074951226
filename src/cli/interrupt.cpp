#include "cli/interrupt.h"

#include <signal.h>

#include <atomic>
#include <chrono>
#include <iostream>

#include "base/number_text.h"
#include "base/printable.h"
#include "batch/run_frames.h"

namespace hooke {
namespace {

std::atomic<int> interrupted = 0;      // by this signal
std::atomic<long> interrupted_at = 0;  // [ms]

// The first signal asks to end in order: unfinished files are removed, other programs are ended. A later one ends the program at once. One
// that follows the first immediately is the same request: timeout(1) signals the program and then its process group.
void handle(int signal) {
  using namespace std::chrono;
  const long now = duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
  long never = 0;
  interrupted_at.compare_exchange_strong(never, now);
  int none = 0;
  if (interrupted.compare_exchange_strong(none, signal)) return;
  if (now - interrupted_at < 1000) return;
  ::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = handle;
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool was_interrupted() { return interrupted != 0; }

int exit_interrupted() { return 128 + interrupted; }

int report_interrupted(const std::string& what, const std::vector<std::optional<std::string>>& files, double time) {
  std::string names;
  for (const std::optional<std::string>& file : files)
    if (file && *file != "-") names += (names.empty() ? " in " : ", ") + printable(*file);
  std::cerr << "Interrupted: the " << what << names << " end at t = " << number_text(time) << " s.\n";
  return exit_interrupted();
}

void throw_if_interrupted() {
  if (was_interrupted()) throw Interrupted();
}

void catch_interrupts(Lab& lab) {
  catch_interrupts();
  lab.watch_substeps(&throw_if_interrupted);
}

}  // namespace hooke
