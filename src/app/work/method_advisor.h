// Looks for better settings for the scene on screen in a background thread, while the panel of the accuracy is open.
#pragma once

#include <future>

#include "lab/status.h"
#include "study/cost_advice.h"

namespace hooke {

class MethodAdvisor {
 public:
  ~MethodAdvisor() { stop_ = true; }

  // Once per frame: takes a finished search, and starts another if the scene or its settings changed since.
  void follow(const Status& status, bool is_wanted);
  // None: not yet.
  const std::optional<CostAdvice>& newest() const { return newest_; }

 private:
  struct Key {
    long edits = -1;
    Settings settings;
    const System* system = nullptr;
    bool operator==(const Key&) const = default;
  };
  Key key_;
  std::optional<CostAdvice> newest_;
  std::atomic<bool> stop_ = false;
  std::future<CostAdvice> pending_;  // last: it is waited for before anything that it uses is destroyed
};

}  // namespace hooke
