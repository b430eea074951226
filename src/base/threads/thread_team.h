// Threads that compute the parts of a job together: they wait for the next job briefly awake, then asleep. A job of some microseconds is
// worth it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace hooke {

// Whether a thread that gives a job waits, however late others are, or, where they have been late twice in a short time because other
// programs use their cores, computes the next thousands of jobs alone.
enum class WhenLate { ComputeAlone, Wait };

class ThreadTeam {
 public:
  // The calling thread of a job is one of the `threads`, at least 1.
  explicit ThreadTeam(int threads, WhenLate when_late = WhenLate::ComputeAlone);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return static_cast<int>(helpers_.size()) + 1; }

  // The right to give jobs. One thread has it at a time; another one that asks for it meanwhile does not wait but gets none, and computes
  // alone.
  class Turn {
   public:
    explicit Turn(ThreadTeam* team);
    explicit operator bool() const { return lock_.owns_lock(); }

    // Calls part(0), part(1), .. part(parts - 1), each on a thread of its own and the first one on this thread, and returns when all have
    // returned. At most as many parts as threads; none may throw.
    template <class Part>
    void run(int parts, const Part& part) const {
      team_->run({[](const void* context, int index) { (*static_cast<const Part*>(context))(index); }, &part}, parts);
    }

    // For a part: waits until another part has set the number to at least `min`, with its results. Only parts of the same job run at the
    // same time for certain.
    void wait_for(const std::atomic<int>& number, int min) const;
    // For that part.
    static void set(std::atomic<int>& number, int value) {
      number.store(value, std::memory_order_release);
      number.notify_all();
    }

    // Memory shared by the parts of a job, of unspecified contents. Allocates only if it has never been as large.
    double* scratch(std::size_t size) const;

   private:
    ThreadTeam* team_;
    std::unique_lock<std::mutex> lock_;
  };

 private:
  struct Job {
    void (*call)(const void* context, int part) = nullptr;
    const void* context = nullptr;
  };
  static constexpr std::size_t cache_line = 64;
  // A thread, and the number of jobs that it was given. The job is written before the number.
  struct alignas(cache_line) Helper {
    std::atomic<unsigned> jobs{0};
    Job job;
    std::jthread thread;
  };

  void run(Job job, int parts);
  void help(Helper& helper, int part);
  void note_lateness(bool is_late);

  std::mutex mutex_;
  std::vector<double> scratch_;
  bool have_cores_ = false;  // whether there is a core for each thread
  WhenLate when_late_;
  int lateness_ = 0;  // of the last jobs
  int rest_ = 0;      // jobs that are not given
  bool is_ending_ = false;
  alignas(cache_line) std::atomic<int> unfinished_{0};  // parts of other threads
  std::vector<std::unique_ptr<Helper>> helpers_;
};

}  // namespace hooke
