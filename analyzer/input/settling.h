#pragma once

#include <chrono>
#include <optional>
#include <utility>

namespace isocnc::input {

/// A value that others change in several steps, such as the size of a file that is being written. It counts once it has
/// stayed the same for a moment.
template <class Value>
class Settling {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// A CAM system that writes a program, or copies it to a network drive, writes more often than that.
  static constexpr std::chrono::milliseconds kMoment{300};

  Settling() = default;
  /// `taken` counts already.
  explicit Settling(Value taken) : seen_(taken), taken_(std::move(taken)) {}

  void see(Value value, Time now) {
    if (seen_ && *seen_ == value) return;
    seen_ = std::move(value);
    since_ = now;
  }
  /// The value, once: when it has settled, and is another than the one taken before.
  std::optional<Value> take(Time now) {
    if (!is_unsettled() || now - since_ < kMoment) return std::nullopt;
    taken_ = seen_;
    return seen_;
  }
  /// Offers the same value again, after a moment.
  void repeat(Time now) {
    taken_.reset();
    since_ = now;
  }
  /// Whether there is a value that has not been taken.
  bool is_unsettled() const { return seen_ != taken_; }
  /// Whether this value has been taken, and is still the same.
  bool is_settled_as(const Value& value) const { return !is_unsettled() && seen_ && *seen_ == value; }

 private:
  std::optional<Value> seen_;
  std::optional<Value> taken_;
  Time since_;
};

}  // namespace isocnc::input
