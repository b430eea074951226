#include "base/threads/thread_team.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace hooke {
namespace {

// Leaves the core to its other hardware thread for a moment.
void relax() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

using Clock = std::chrono::steady_clock;

// Of a thread that waits, before it sleeps: longer than from one pass of a step to the next one. To wake up takes longer still, on a busy
// machine by far.
constexpr auto awake_for = std::chrono::microseconds(200);

// The value once it is no longer `old`. `slept` is set if the thread has slept meanwhile.
template <class T>
T wait_for_change(const std::atomic<T>& value, T old, bool has_core, bool* slept = nullptr) {
  constexpr int looks_at_once = 32;  // between two looks at the clock
  Clock::time_point start{};
  while (has_core) {
    for (int look = 0; look < looks_at_once; ++look) {
      if (const T now = value.load(std::memory_order_acquire); now != old) return now;
      relax();
    }
    const Clock::time_point now = Clock::now();
    if (start == Clock::time_point{}) start = now;
    if (now - start > awake_for) break;
  }
  if (slept != nullptr) *slept = true;
  value.wait(old, std::memory_order_acquire);
  return value.load(std::memory_order_acquire);
}

}  // namespace

ThreadTeam::ThreadTeam(int threads, WhenLate when_late) : when_late_(when_late) {
  // with more threads than cores, the one that is waited for needs the core
  have_cores_ = threads <= static_cast<int>(std::thread::hardware_concurrency());
  for (int part = 1; part < threads; ++part) {
    helpers_.push_back(std::make_unique<Helper>());
    Helper& helper = *helpers_.back();
    helper.thread = std::jthread([this, &helper, part] { help(helper, part); });
  }
}

ThreadTeam::~ThreadTeam() {
  is_ending_ = true;
  for (const auto& helper : helpers_) {
    helper->jobs.fetch_add(1, std::memory_order_release);
    helper->jobs.notify_one();
  }
  for (const auto& helper : helpers_) helper->thread.join();
}

ThreadTeam::Turn::Turn(ThreadTeam* team) : team_(team) {
  if (team == nullptr) return;
  std::unique_lock lock(team->mutex_, std::try_to_lock);
  if (lock.owns_lock() && team->rest_ > 0)
    --team->rest_;
  else
    lock_ = std::move(lock);
}

void ThreadTeam::Turn::wait_for(const std::atomic<int>& number, int min) const {
  for (int now = number.load(std::memory_order_acquire); now < min;) now = wait_for_change(number, now, team_->have_cores_);
}

double* ThreadTeam::Turn::scratch(std::size_t size) const {
  if (team_->scratch_.size() < size) team_->scratch_.resize(size);
  return team_->scratch_.data();
}

void ThreadTeam::run(Job job, int parts) {
  unfinished_.store(parts - 1, std::memory_order_relaxed);
  for (int part = 1; part < parts; ++part) {
    Helper& helper = *helpers_[static_cast<std::size_t>(part - 1)];
    helper.job = job;
    helper.jobs.fetch_add(1, std::memory_order_release);
    helper.jobs.notify_one();
  }
  const Clock::time_point start = Clock::now();
  job.call(job.context, 0);
  const Clock::time_point end = Clock::now();
  bool is_late = false;
  for (int left = unfinished_.load(std::memory_order_acquire); left > 0;) left = wait_for_change(unfinished_, left, have_cores_, &is_late);
  // parts of a long job may be unequal
  is_late = is_late && Clock::now() - end > end - start;
  if (when_late_ == WhenLate::ComputeAlone) note_lateness(is_late);
}

// A thread that wakes up for the first job of a frame may be late once.
void ThreadTeam::note_lateness(bool is_late) {
  constexpr int forgotten_after = 50, jobs_alone = 2000;
  lateness_ = is_late ? lateness_ + forgotten_after : std::max(0, lateness_ - 1);
  if (lateness_ <= forgotten_after) return;
  lateness_ = 0;
  rest_ = jobs_alone;
}

void ThreadTeam::help(Helper& helper, int part) {
  for (unsigned done = 0;;) {
    done = wait_for_change(helper.jobs, done, have_cores_);
    if (is_ending_) return;
    helper.job.call(helper.job.context, part);
    // the thread that waits wakes up for every change, but sleeps only after a while
    unfinished_.fetch_sub(1, std::memory_order_acq_rel);
    unfinished_.notify_one();
  }
}

}  // namespace hooke
