#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "lsp/rpc/strand.h"

namespace isocnc::rpc {

/// Tells a task whether others wait for it.
using OthersWait = std::function<bool()>;

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

  /// The same for a task that may take long: it is called as `task(value, others_wait)`, and as long as it returns
  /// false, once more after the tasks that have been posted meanwhile.
  template <class Task>
  void post_in_parts(Task task) {
    post_part(strand_, value_, std::make_shared<Task>(std::move(task)));
  }

 private:
  template <class Task>
  static void post_part(Strand strand, std::shared_ptr<Value> value, std::shared_ptr<Task> task) {
    Strand same = strand;
    strand.post([same = std::move(same), value = std::move(value), task = std::move(task)] {
      const OthersWait others_wait = [&same] { return same.has_waiting(); };
      if (!(*task)(*value, others_wait)) post_part(same, value, task);
    });
  }

  std::shared_ptr<Value> value_;
  Strand strand_;
};

}  // namespace isocnc::rpc
