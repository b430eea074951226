#include "app/work/file_task.h"

namespace hooke {

bool FileTask::start(std::string what, BackgroundTask::Work work) {
  if (task_.is_running()) {
    panels_.show_toast("Still busy: " + task_.what());
    return false;
  }
  task_.start(std::move(what), std::move(work));
  update(patience_);
  return true;
}

void FileTask::update(std::chrono::milliseconds max_wait) {
  if (!task_.is_running()) return;
  const bool is_over = task_.follow(max_wait);
  if (!is_over && panels_.dialog.kind == Dialog::Kind::None) panels_.open_dialog(Dialog::Kind::Working);
}

void FileTask::wait() {
  while (task_.is_running()) update(patience_);
}

FileWork FileTask::progress() const {
  if (!task_.is_running()) return {};
  return {.what = task_.what(),
          .fraction = task_.fraction(),
          .seconds = task_.seconds(),
          .is_running = true,
          .is_stopping = task_.was_stopped()};
}

}  // namespace hooke
