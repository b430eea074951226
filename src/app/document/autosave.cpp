#include "app/document/autosave.h"

#include <chrono>

#include "formats/scene_file.h"

namespace hooke {
namespace {

template <class Value>
bool is_ready(std::future<Value>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

// The writing thread uses the session, so wait for it.
Autosave::~Autosave() {
  if (writing_.valid()) writing_.wait();
}

void Autosave::follow(const Status& status, LabThread& lab, double now, const std::function<void(Scene&)>& add_view_settings) {
  if (is_ready(copying_)) start_writing(add_view_settings);
  if (is_ready(writing_)) finish_writing();
  if (!session_.is_enabled() || copying_.valid() || writing_.valid()) return;

  if (!status.history.unsaved || status.history.edits == saved_) {
    changed_since_.reset();
    return;
  }
  if (!changed_since_) changed_since_ = now;
  if (now - *changed_since_ < interval_) return;
  changed_since_.reset();
  asked_ = status.history.edits;
  copying_ = lab.copy_scene(LabThread::Moment::Start);
}

void Autosave::start_writing(const std::function<void(Scene&)>& add_view_settings) {
  writing_ = std::async(std::launch::async, [&session = session_, scene = copying_.get(), add_view_settings] {
    try {
      Scene scene_with_view = *scene;
      add_view_settings(scene_with_view);
      session.write_autosave(format_scene(scene_with_view));
      return std::string();
    } catch (const std::exception& error) {  // FileError, or out of memory
      return std::string(error.what());
    }
  });
}

void Autosave::finish_writing() {
  const std::string error = writing_.get();
  if (!error.empty() && error_.empty()) error_ = error;
  saved_ = asked_;
}

void Autosave::discard() {
  copying_ = {};
  if (writing_.valid()) writing_.get();
  changed_since_.reset();
  saved_ = -1;
  session_.delete_autosave();
}

}  // namespace hooke
