#include "debugger/difference/difference_search.h"

namespace isocnc::difference {

void DifferenceSearch::start(const ReferenceComparison& comparison,
                             const std::function<void(const FirstDifference&)>& take) {
  forget();
  pool_.post([&loop = loop_, comparison, take, is_forgotten = is_forgotten_] {
    if (is_forgotten->load()) return;
    loop.post([take, is_forgotten, found = comparison.find([&] { return is_forgotten->load(); })] {
      if (!is_forgotten->load()) take(found);
    });
  });
}

void DifferenceSearch::forget() {
  is_forgotten_->store(true);
  is_forgotten_ = std::make_shared<std::atomic<bool>>(false);
}

}  // namespace isocnc::difference
