#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analyzer/jump_map.h"

namespace isocnc::analyzer {

/// A set of values of one register, as far as the program's conditions can tell values apart. The constants that it is
/// compared with cut the real line into cells: below the first, the first itself, between first and second, ... Cell 2i+1
/// is the i-th constant, cell 2i what lies before it.
class ValueSet {
 public:
  static ValueSet everything(std::size_t constants) { return ValueSet{{{0, static_cast<std::uint32_t>(2 * constants)}}}; }
  static ValueSet of(double value, const std::vector<double>& constants);
  /// The values for which `value comparison constant` holds.
  static ValueSet satisfying(syntax::Comparison comparison, double constant, const std::vector<double>& constants);

  bool empty() const { return ranges_.empty(); }
  ValueSet intersected(const ValueSet& other) const;
  ValueSet united(const ValueSet& other) const;

  friend bool operator==(const ValueSet&, const ValueSet&) = default;

 private:
  struct Range {
    std::uint32_t first, last;
    friend bool operator==(const Range&, const Range&) = default;
  };

  ValueSet() = default;
  explicit ValueSet(std::vector<Range> ranges) : ranges_(std::move(ranges)) {}

  std::vector<Range> ranges_;  // Ascending, apart by at least one cell.
};

/// What is known together of all registers that some IF compares, in the order of JumpMap::compared_registers().
using Valuation = std::vector<ValueSet>;

/// The valuations that are possible at some point. Between registers nothing is lost (if V1 is 1 then V2 is 3), so that a
/// path is followed only where its conditions agree with each other (D52).
class Valuations {
 public:
  /// Nothing is known of any register.
  static Valuations unknown(const JumpMap& jumps);

  void assign(int reg, double value, const JumpMap& jumps);
  /// What remains of it where the condition of a jump on a register holds, or does not.
  Valuations where(const syntax::Jump& jump, bool holds, const JumpMap& jumps) const;
  void unite(const Valuations& other);
  /// Forgets registers that no IF from `jump` on compares: they tell no two states apart.
  void forget_unread(std::uint32_t jump, const JumpMap& jumps);
  bool possible() const { return !all_.empty(); }
  std::size_t size() const { return all_.size(); }
  /// Gives up what is known between registers, when there are too many valuations to keep apart.
  void blur();

  friend bool operator==(const Valuations&, const Valuations&) = default;

 private:
  void add(Valuation valuation);

  std::vector<Valuation> all_;
};

}  // namespace isocnc::analyzer
