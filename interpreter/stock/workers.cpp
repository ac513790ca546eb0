#include "interpreter/stock/workers.h"

#include <atomic>

namespace isocnc::stock {

void for_each_number(const Workers& workers, std::size_t count, const std::function<void(std::size_t)>& use) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) use(i);
  };
  if (workers && count > 1) {
    workers(work);
  } else {
    work();
  }
}

}  // namespace isocnc::stock
