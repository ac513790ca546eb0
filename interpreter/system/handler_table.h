#pragma once

#include <array>
#include <atomic>

namespace isocnc::system {

/// What the handler of a signal, which may take no lock, has to know of; from any thread. One place for each thread is
/// enough: what finds none is not known to the handler.
template <class T>
class HandlerTable {
 public:
  void add(const T* entry) { exchange(nullptr, entry); }
  void remove(const T* entry) { exchange(entry, nullptr); }

  /// Also in a handler.
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
