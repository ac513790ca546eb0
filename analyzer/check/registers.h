#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "analyzer/check/jump_map.h"

namespace isocnc::check {

/// A set of values of one register. A value that is assigned stands for all values that the program's conditions cannot
/// distinguish from it: the constants that the register is compared with divide the real line into cells (below the
/// first, the first itself, between first and second, and so on). A set stores no constants, so its meaning does not
/// change when another condition is edited.
class ValueSet {
 public:
  static ValueSet everything() { return {-kInfinity, kInfinity}; }
  /// The cell of a value among ascending constants.
  static ValueSet of(double value, const std::vector<double>& constants);
  /// The values for which `value comparison constant` holds.
  static ValueSet satisfying(syntax::Comparison comparison, double constant);

  bool is_everything() const { return head_.first == -kInfinity && head_.last == kInfinity; }
  bool empty() const { return head_.first > head_.last; }
  ValueSet intersected(const ValueSet& other) const;
  ValueSet united(const ValueSet& other) const;

  friend bool operator==(const ValueSet&, const ValueSet&) = default;

 private:
  /// The numbers from `first` to `last`, both included; an open interval ends at the next representable number.
  struct ValueInterval {
    double first, last;
    friend bool operator==(const ValueInterval&, const ValueInterval&) = default;
  };

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  ValueSet() = default;
  ValueSet(double first, double last) : head_{first, last} {}

  std::size_t count() const { return empty() ? 0 : 1 + tail_.size(); }
  const ValueInterval& interval(std::size_t index) const { return index == 0 ? head_ : tail_[index - 1]; }
  /// Adds an interval above all others; joins it to the last one if no number lies between them.
  void append(ValueInterval interval);

  /// The intervals after the first. Nearly always there are none, and copying is then free.
  class Tail {
   public:
    Tail() = default;
    Tail(const Tail& other)
        : intervals_(other.intervals_ ? std::make_unique<std::vector<ValueInterval>>(*other.intervals_) : nullptr) {}
    Tail(Tail&&) noexcept = default;
    Tail& operator=(Tail other) noexcept {
      intervals_ = std::move(other.intervals_);
      return *this;
    }
    ~Tail() = default;

    std::size_t size() const { return intervals_ ? intervals_->size() : 0; }
    const ValueInterval& operator[](std::size_t index) const { return (*intervals_)[index]; }
    ValueInterval& back() { return intervals_->back(); }
    void push_back(ValueInterval interval) {
      if (!intervals_) intervals_ = std::make_unique<std::vector<ValueInterval>>();
      intervals_->push_back(interval);
    }

    friend bool operator==(const Tail& a, const Tail& b) {
      if (!a.intervals_ || !b.intervals_) return !a.intervals_ && !b.intervals_;
      return *a.intervals_ == *b.intervals_;
    }

   private:
    std::unique_ptr<std::vector<ValueInterval>> intervals_;  // Null if there are none.
  };

  // The intervals, ascending, with at least one number between them.
  ValueInterval head_{1, 0};
  Tail tail_;
};

/// One joint possibility for the values of the known registers, in ascending order of register.
using Valuation = std::vector<ValueSet>;

/// The valuations that are possible at one point of the program. Relations between registers are kept (if V1 is 1 then
/// V2 is 3), so that a path is followed only if its conditions are consistent (D52).
class Valuations {
 public:
  /// No register is known.
  static Valuations unknown();

  void assign(int reg, double value, const JumpMap& jumps);
  /// The valuations that remain if the condition of a jump on a register holds, or does not.
  Valuations where(const syntax::Jump& jump, bool holds) const;
  void unite(Valuations other);
  /// Forgets the registers that are not in `read`: no later IF compares them, so they cannot distinguish two states.
  void keep_only(RegisterSet read);
  bool possible() const { return !all_.empty(); }
  std::size_t size() const { return all_.size(); }
  /// Drops all but the first `limit` valuations; the paths that need the others are not followed.
  void reduce_to(std::size_t limit);

  friend bool operator==(const Valuations& a, const Valuations& b);

 private:
  void add(Valuation valuation);
  /// Joins valuations that have become equal because a register was forgotten.
  void add_all_again();
  void add_registers(RegisterSet registers);
  void forget(RegisterSet registers);
  /// The known registers that some valuation restricts.
  RegisterSet restricted() const;

  std::vector<Valuation> all_;
  RegisterSet known_ = 0;  ///< The registers that each valuation holds.
};

}  // namespace isocnc::check
