#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "analyzer/check/jump_map.h"

namespace isocnc::check {

/// A set of values of one register. A value that is assigned stands for all that the program's conditions cannot tell
/// from it: the constants that the register is compared with cut the real line into cells, below the first, the first
/// itself, between first and second, and so on. Sets themselves know no constants, so they mean the same when some
/// other condition is edited.
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
  /// From the first number to the last, both in it: of numbers, open ranges are closed ones, too.
  struct Range {
    double first, last;
    friend bool operator==(const Range&, const Range&) = default;
  };

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  ValueSet() = default;
  ValueSet(double first, double last) : head_{first, last} {}

  std::size_t count() const { return empty() ? 0 : 1 + tail_.size(); }
  const Range& range(std::size_t index) const { return index == 0 ? head_ : tail_[index - 1]; }
  /// Adds a range above all others, joined to the last when nothing lies between them.
  void append(Range range);

  /// Further ranges. Nearly always there are none, and then copying them costs nothing.
  class Tail {
   public:
    Tail() = default;
    Tail(const Tail& other) : ranges_(other.ranges_ ? std::make_unique<std::vector<Range>>(*other.ranges_) : nullptr) {}
    Tail(Tail&&) noexcept = default;
    Tail& operator=(Tail other) noexcept {
      ranges_ = std::move(other.ranges_);
      return *this;
    }
    ~Tail() = default;

    std::size_t size() const { return ranges_ ? ranges_->size() : 0; }
    const Range& operator[](std::size_t index) const { return (*ranges_)[index]; }
    Range& back() { return ranges_->back(); }
    void push_back(Range range) {
      if (!ranges_) ranges_ = std::make_unique<std::vector<Range>>();
      ranges_->push_back(range);
    }

    friend bool operator==(const Tail& a, const Tail& b) {
      if (!a.ranges_ || !b.ranges_) return !a.ranges_ && !b.ranges_;
      return *a.ranges_ == *b.ranges_;
    }

   private:
    std::unique_ptr<std::vector<Range>> ranges_;  // Null when there are none.
  };

  // Ascending, apart by at least one number.
  Range head_{1, 0};
  Tail tail_;
};

/// What is known together of some registers, in ascending order; of all others nothing is.
using Valuation = std::vector<ValueSet>;

/// The valuations that are possible at some point. Between registers nothing is lost (if V1 is 1 then V2 is 3), so that
/// a path is followed only where its conditions agree with each other (D52).
class Valuations {
 public:
  /// Nothing is known of any register.
  static Valuations unknown();

  void assign(int reg, double value, const JumpMap& jumps);
  /// What remains of it where the condition of a jump on a register holds, or does not.
  Valuations where(const syntax::Jump& jump, bool holds) const;
  void unite(Valuations other);
  /// Forgets the registers that are not in `read`: no IF will see their values, so no two states differ in them.
  void keep_only(RegisterSet read);
  bool possible() const { return !all_.empty(); }
  std::size_t size() const { return all_.size(); }
  /// Drops all but the first `limit`: what the others would lead to is not followed.
  void reduce_to(std::size_t limit);

  friend bool operator==(const Valuations& a, const Valuations& b);

 private:
  void add(Valuation valuation);
  /// Joins valuations again that one register less may have made alike.
  void add_all_again();
  void add_registers(RegisterSet registers);
  void forget(RegisterSet registers);
  /// Of the registers that are known, those that some valuation restricts.
  RegisterSet restricted() const;

  std::vector<Valuation> all_;
  RegisterSet known_ = 0;  ///< The registers that each valuation holds.
};

}  // namespace isocnc::check
