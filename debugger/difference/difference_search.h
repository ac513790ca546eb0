#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "debugger/difference/first_difference.h"
#include "lsp/rpc/loop.h"
#include "lsp/rpc/strand.h"

namespace isocnc::difference {

/// Compares the program that is debugged with another one, on a thread of its own.
class DifferenceSearch {
 public:
  /// Keeps a reference to the loop.
  explicit DifferenceSearch(rpc::Loop& loop) : loop_(loop), pool_(loop, 1) {}
  DifferenceSearch(const DifferenceSearch&) = delete;
  DifferenceSearch& operator=(const DifferenceSearch&) = delete;
  ~DifferenceSearch() { forget(); }

  /// `take` gets the result, on the loop's thread, unless the search is forgotten before.
  void start(const ReferenceComparison& comparison, const std::function<void(const FirstDifference&)>& take);
  /// Ends a search that is under way.
  void forget();

 private:
  rpc::Loop& loop_;
  std::shared_ptr<std::atomic<bool>> is_forgotten_ = std::make_shared<std::atomic<bool>>(false);
  rpc::Pool pool_;  ///< Last, so that its thread ends before the rest is destroyed.
};

}  // namespace isocnc::difference
