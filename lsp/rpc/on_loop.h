#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "lsp/rpc/loop.h"

namespace isocnc::rpc {

/// A callback that runs on the loop's thread, whichever thread calls it: the call posts a task with the arguments to
/// the loop, and returns. So it may use data that belongs to the loop's thread.
template <class... Arguments>
class OnLoop {
 public:
  OnLoop(Loop& loop, std::function<void(Arguments...)> callback)
      : loop_(&loop), callback_(std::make_shared<const std::function<void(Arguments...)>>(std::move(callback))) {}

  void operator()(Arguments... arguments) const {
    loop_->post([callback = callback_, ... arguments = std::move(arguments)]() mutable {
      (*callback)(std::move(arguments)...);
    });
  }

 private:
  Loop* loop_;
  std::shared_ptr<const std::function<void(Arguments...)>> callback_;
};

/// A callback that runs on the worker thread that calls it, usually on a strand. It must not touch data that belongs to
/// the loop's thread: it hands its results to an OnLoop.
template <class... Arguments>
class OnWorker {
 public:
  template <class Callback>
  explicit OnWorker(Callback callback) : callback_(std::move(callback)) {}

  void operator()(Arguments... arguments) const { callback_(std::move(arguments)...); }

 private:
  std::function<void(Arguments...)> callback_;
};

}  // namespace isocnc::rpc
