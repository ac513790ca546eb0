#pragma once

#include <array>
#include <atomic>

namespace isocnc::system {

/// Entries that a signal handler, which may take no lock, can read; for any thread. One slot per thread is enough. An
/// entry that finds no free slot is not visible to the handler.
template <class T>
class HandlerTable {
 public:
  void add(const T* entry) { exchange(nullptr, entry); }
  void remove(const T* entry) { exchange(entry, nullptr); }

  /// Can be called in a signal handler.
  template <class Look>
  void for_each(Look&& look) const {
    for (const std::atomic<const T*>& place : places_)
      if (const T* const entry = place.load()) look(*entry);
  }

 private:
  void exchange(const T* before, const T* after) {
    for (std::atomic<const T*>& place : places_) {
      const T* expected = before;
      if (place.compare_exchange_strong(expected, after)) break;
    }
  }

  std::array<std::atomic<const T*>, 256> places_;
};

}  // namespace isocnc::system
