#include "app/autosave.h"

#include <chrono>

#include "lab/scene_file.h"

namespace hooke {
namespace {

template <class Value>
bool is_ready(std::future<Value>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

// The writer uses the session.
Autosave::~Autosave() {
  if (writing_.valid()) writing_.wait();
}

void Autosave::follow(const Status& status, LabThread& lab, double now, const std::function<void(Scene&)>& dress) {
  if (is_ready(copying_)) start_writing(dress);
  if (is_ready(writing_)) finish_writing();
  if (!session_.keeps() || copying_.valid() || writing_.valid()) return;

  const Version version{status.edits, status.frames};
  if (!status.unsaved || version == kept_) {
    changed_since_.reset();
    return;
  }
  if (!changed_since_) changed_since_ = now;
  if (now - *changed_since_ < interval_) return;
  changed_since_.reset();
  asked_ = version;
  copying_ = lab.copy_scene();
}

void Autosave::start_writing(const std::function<void(Scene&)>& dress) {
  writing_ = std::async(std::launch::async, [&session = session_, scene = copying_.get(), dress] {
    try {
      Scene dressed = *scene;
      dress(dressed);
      session.keep(format_scene(dressed));
      return std::string();
    } catch (const std::exception& error) {  // FileError, or no memory
      return std::string(error.what());
    }
  });
}

void Autosave::finish_writing() {
  const std::string error = writing_.get();
  if (!error.empty() && trouble_.empty()) trouble_ = error;
  kept_ = asked_;
}

void Autosave::forget() {
  copying_ = {};
  if (writing_.valid()) writing_.get();
  changed_since_.reset();
  kept_ = {-1, -1};
  session_.forget();
}

}  // namespace hooke
