// Keeps a copy of unsaved work in the session's folder, written on a thread of its own, so that a killed Hooke costs no
// more than the last changes.
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

  // How long a change may wait [s].
  void set_interval(double seconds) { interval_ = seconds; }
  // Once a frame, at `now` [s]. `dress` adds to a scene what the window knows of it.
  void follow(const Status& status, LabThread& lab, double now, const std::function<void(Scene&)>& add_view_settings);
  // What was unsaved is saved, given up or replaced: nothing is to be kept of it.
  void forget();
  // Why nothing could be kept, once.
  std::string take_error() { return std::exchange(error_, {}); }

 private:
  struct Version {
    long edits = 0, frames = 0;
    bool operator==(const Version&) const = default;
  };
  void start_writing(const std::function<void(Scene&)>& add_view_settings);
  void finish_writing();

  const Session& session_;
  double interval_ = 30.0;
  Version saved_;                        // what the copy holds
  std::optional<double> changed_since_;  // [s]
  Version asked_;                        // what is being copied
  std::future<std::shared_ptr<const Scene>> copying_;
  std::future<std::string> writing_;  // an error, or empty
  std::string error_;
};

}  // namespace hooke
