// A result about the scene that is computed in a background thread whenever its key changes: the window never waits for it.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <utility>

namespace hooke {

// `keeps_old`: until the next result; else a change of the key discards it, and stops the computation in progress.
template <class Key, class Result, bool keeps_old = false>
class FollowedResult {
 public:
  ~FollowedResult() { stop_ = true; }

  // Once per frame. Without a key no result is wanted. `make()` returns the computation, a function of a flag that ends it early.
  template <class Make>
  void follow(const std::optional<Key>& key, const Make& make) {
    if (!keeps_old && key != key_) clear();
    if (pending_.valid()) {
      if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
      Result made = pending_.get();
      if (!stop_) newest_ = std::move(made);
    }
    if (key == key_) return;
    key_ = key;
    stop_ = false;
    pending_ = std::async(std::launch::async, [this, compute = make()] { return compute(stop_); });
  }
  // Another scene replaces that of the result.
  void clear() {
    newest_ = {};
    key_.reset();
    stop_ = true;
  }
  const Result& newest() const { return newest_; }
  bool is_running() const { return pending_.valid(); }
  bool is_stopped() const { return stop_; }

 private:
  Result newest_{};
  std::optional<Key> key_;  // of the newest result or of the computation in progress
  std::atomic<bool> stop_ = false;
  std::future<Result> pending_;  // last: it is waited for before anything that it uses is destroyed
};

}  // namespace hooke
