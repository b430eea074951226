// Saves a copy of unsaved work in the session's folder, in a background thread, so that a crash loses only the last changes.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "app/document/session.h"
#include "lab/lab_thread.h"

namespace hooke {

class Autosave {
 public:
  explicit Autosave(const Session& session) : session_(session) {}
  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  // The maximum time that a change remains without an autosave [s].
  void set_interval(double seconds) { interval_ = seconds; }
  // Once per frame, at `now` [s]. `add_view_settings` adds the view of the window to a copy of the scene.
  void follow(const Status& status, LabThread& lab, double now, const std::function<void(Scene&)>& add_view_settings);
  // Deletes the copy: the changes were saved or discarded.
  void discard();
  // The last error, once.
  std::string take_error() { return std::exchange(error_, {}); }

 private:
  void start_writing(const std::function<void(Scene&)>& add_view_settings);
  void finish_writing();

  const Session& session_;
  double interval_ = 30.0;
  long saved_ = 0;                       // number of the edits in the copy
  std::optional<double> changed_since_;  // [s]
  long asked_ = 0;                       // of those in the copy being written
  std::future<std::shared_ptr<const Scene>> copying_;
  std::future<std::string> writing_;  // an error text, or empty
  std::string error_;
};

}  // namespace hooke
