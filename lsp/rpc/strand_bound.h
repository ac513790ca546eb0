#pragma once

#include <memory>
#include <utility>

#include "lsp/rpc/strand.h"

namespace isocnc::rpc {

/// A value that belongs to a strand: only tasks of the strand get at it, so it needs no lock. The value lives until the
/// last of its tasks has run or been dropped, even if the StrandBound has been destroyed before.
template <class Value>
class StrandBound {
 public:
  template <class... Arguments>
  explicit StrandBound(Pool& pool, Arguments&&... arguments)
      : value_(std::make_shared<Value>(std::forward<Arguments>(arguments)...)), strand_(pool) {}

  /// Calls `task(value)` on the strand, after the tasks posted before. May be called on any thread.
  template <class Task>
  void post(Task task) {
    strand_.post([value = value_, task = std::move(task)] { task(*value); });
  }

 private:
  std::shared_ptr<Value> value_;
  Strand strand_;
};

}  // namespace isocnc::rpc
