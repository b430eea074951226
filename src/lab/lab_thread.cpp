#include "lab/lab_thread.h"

#include <algorithm>
#include <utility>

#include "base/threads/thread_team.h"
#include "lab/lab.h"

namespace hooke {
namespace {

using Clock = std::chrono::steady_clock;

// The maximum time between two publications while a frame is in progress.
constexpr auto max_publish_interval = std::chrono::milliseconds(50);

// Idle time that is not used, so that the next frame is not late.
constexpr auto idle_margin = std::chrono::milliseconds(1);

// On all cores but the one of the window.
std::unique_ptr<Lab> lab_on_other_cores(Scene scene) {
  auto lab = std::make_unique<Lab>(std::move(scene));
  if (const int threads = static_cast<int>(std::thread::hardware_concurrency()) - 1; threads > 1)
    lab->set_execution({.team = std::make_shared<ThreadTeam>(threads)});
  return lab;
}

}  // namespace

LabThread::LabThread(Scene scene) : lab_(lab_on_other_cores(std::move(scene))), status_(lab_->status()), thread_([this] { work(); }) {}

LabThread::~LabThread() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  posted_.notify_one();
  thread_.join();
}

void LabThread::post(Task task, bool urgent) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    ++posted_count_;
    if (urgent) urgent_ = true;
  }
  posted_.notify_one();
}

void LabThread::submit(Command command, Gesture gesture, std::string name) {
  const bool urgent = !std::holds_alternative<MoveHand>(command);
  post([command = std::move(command), gesture, name = std::move(name)](Lab& lab) { lab.submit(command, gesture, name); }, urgent);
}

void LabThread::submit(Control control, Gesture gesture) {
  post([control = std::move(control), gesture](Lab& lab) { lab.submit(control, gesture); }, true);
}

std::shared_ptr<const Status> LabThread::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

std::future<std::shared_ptr<const Scene>> LabThread::copy_scene(Moment moment) {
  auto promise = std::make_shared<std::promise<std::shared_ptr<const Scene>>>();
  auto future = promise->get_future();
  post(
      [promise, moment](Lab& lab) {
        lab.apply_pending();
        auto scene = std::make_shared<Scene>(moment == Moment::Start ? lab.scene_at_start() : lab.scene());
        scene->system.colliders = carried_colliders(scene->system, scene->state);
        promise->set_value(std::move(scene));
      },
      true);
  return future;
}

bool LabThread::settle(std::chrono::milliseconds max_wait) {
  std::unique_lock lock(mutex_);
  return published_.wait_for(lock, max_wait, [&, target = posted_count_] { return published_count_ >= target; });
}

PointId LabThread::new_point_id() {
  next_point_id_ = std::max(next_point_id_, status()->next_point_id);
  return PointId{next_point_id_++};
}

SpringId LabThread::new_spring_id() {
  next_spring_id_ = std::max(next_spring_id_, status()->next_spring_id);
  return SpringId{next_spring_id_++};
}

void LabThread::work() {
  auto last = Clock::now(), due = last;  // due: when the next frame is
  long taken_count = 0;
  bool showed = false;  // an edit, without computing
  while (!stopping_) {
    std::vector<Task> tasks;
    bool is_urgent = false;
    {
      std::unique_lock lock(mutex_);
      const auto has_work = [this] { return stopping_ || !tasks_.empty(); };
      if (status_->run.running)
        posted_.wait_until(lock, due, has_work);
      else if (!lab_->has_accuracy_to_measure() && !lab_->has_companions_to_compute())
        posted_.wait(lock, has_work);
      if (stopping_) return;
      tasks = std::exchange(tasks_, {});
      is_urgent = urgent_.exchange(false);
    }

    // paused time does not count
    const auto now = Clock::now();
    const double elapsed = lab_->status()->run.running ? std::chrono::duration<double>(now - last).count() : 0.0;
    last = now;
    for (const Task& task : tasks) task(*lab_);
    // An edit is shown before anything is computed, for a substep of a large net takes long. If others follow at once, a substep is
    // computed before each of them.
    showed = is_urgent && !showed && !lab_->must_wait_for_frame();
    if (showed)
      lab_->show_edits(elapsed);
    else
      lab_->advance(elapsed, [&] { return !stopping_ && !urgent_ && !is_urgent && Clock::now() - now < max_publish_interval; });

    {
      const std::lock_guard lock(mutex_);
      status_ = lab_->status();
      taken_count += static_cast<long>(tasks.size());
      if (!lab_->has_pending()) published_count_ = taken_count;
    }
    published_.notify_all();

    // the time that is left belongs to the measurement of the accuracy
    due = now + std::chrono::duration_cast<Clock::duration>(lab_->time_to_next_frame());
    const auto until = lab_->status()->run.running ? due : now + max_publish_interval;
    lab_->measure_accuracy([&] { return !stopping_ && !urgent_ && Clock::now() + idle_margin < until; });
  }
}

}  // namespace hooke
