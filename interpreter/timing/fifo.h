#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace isocnc::timing {

/// First in, first out, for items of some hundred bytes. Unlike std::deque it does not allocate and free memory for
/// each.
template <class Item>
class Fifo {
 public:
  bool empty() const { return first_ == items_.size(); }
  std::size_t size() const { return items_.size() - first_; }
  Item& front() { return items_[first_]; }
  Item& back() { return items_.back(); }

  Item& emplace_back() { return items_.emplace_back(); }
  void pop_front() {
    ++first_;
    constexpr std::size_t kForgotten = 64;
    if (empty() || (first_ >= kForgotten && first_ >= size())) forget_popped();
  }

  /// Frees popped items. pop_front() does so from time to time; call it before copying, so that the copy is small.
  void forget_popped() {
    items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(std::exchange(first_, 0)));
  }

 private:
  std::vector<Item> items_;
  std::size_t first_ = 0;  // Index of the first item that has not been popped.
};

}  // namespace isocnc::timing
