#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <shared_mutex>

namespace isocnc::dialect {

/// Values that are kept until the process ends, each once, and known by numbers from 1. All functions may be called by
/// any thread.
template <class Value>
class KeptValues {
 public:
  std::uint32_t number_of(const Value& value) {
    const std::unique_lock lock(mutex_);
    const auto [known, is_new] = numbers_.try_emplace(value, static_cast<std::uint32_t>(values_.size() + 1));
    if (is_new) values_.push_back(value);
    return known->second;
  }

  /// The value with this number, or an empty one.
  const Value& at(std::uint32_t number) const {
    static const Value kNone{};
    const std::shared_lock lock(mutex_);
    return number == 0 || number > values_.size() ? kNone : values_[number - 1];
  }

 private:
  mutable std::shared_mutex mutex_;
  std::deque<Value> values_;  // They stay where they are.
  std::map<Value, std::uint32_t> numbers_;
};

}  // namespace isocnc::dialect
