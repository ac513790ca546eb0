#include "analyzer/registers.h"

#include <algorithm>
#include <cmath>

namespace isocnc::analyzer {

static std::uint32_t cell_of(double value, const std::vector<double>& constants) {
  const auto at = std::lower_bound(constants.begin(), constants.end(), value);
  const auto index = static_cast<std::uint32_t>(at - constants.begin());
  return at != constants.end() && *at == value ? 2 * index + 1 : 2 * index;
}

ValueSet ValueSet::of(double value, const std::vector<double>& constants) {
  if (std::isnan(value)) return everything(constants.size());
  const std::uint32_t cell = cell_of(value, constants);
  return {cell, cell};
}

ValueSet ValueSet::satisfying(syntax::Comparison comparison, double constant, const std::vector<double>& constants) {
  const std::uint32_t cell = cell_of(constant, constants);
  const auto last = static_cast<std::uint32_t>(2 * constants.size());
  switch (comparison) {
    case syntax::Comparison::Equal:
      return {cell, cell};
    case syntax::Comparison::NotEqual: {
      ValueSet apart(0, cell - 1);
      apart.append({cell + 1, last});
      return apart;
    }
    case syntax::Comparison::Less:
      return {0, cell - 1};
    case syntax::Comparison::LessEqual:
      return {0, cell};
    case syntax::Comparison::Greater:
      return {cell + 1, last};
    case syntax::Comparison::GreaterEqual:
      return {cell, last};
    case syntax::Comparison::Invalid:
      break;
  }
  return everything(constants.size());
}

void ValueSet::append(Range range) {
  Range& last = tail_.size() == 0 ? head_ : tail_.back();
  if (empty()) {
    head_ = range;
  } else if (range.first <= last.last + 1) {
    last.last = std::max(last.last, range.last);
  } else {
    tail_.push_back(range);
  }
}

ValueSet ValueSet::intersected(const ValueSet& other) const {
  ValueSet result;
  for (std::size_t i = 0, j = 0; i < count() && j < other.count();) {
    const Range a = range(i);
    const Range b = other.range(j);
    const Range common{std::max(a.first, b.first), std::min(a.last, b.last)};
    if (common.first <= common.last) result.append(common);
    ++(a.last < b.last ? i : j);
  }
  return result;
}

ValueSet ValueSet::united(const ValueSet& other) const {
  ValueSet result;
  for (std::size_t i = 0, j = 0; i < count() || j < other.count();) {
    const bool take_mine = j == other.count() || (i < count() && range(i).first < other.range(j).first);
    result.append(take_mine ? range(i++) : other.range(j++));
  }
  return result;
}

Valuations Valuations::unknown(const JumpMap& jumps) {
  Valuation valuation;
  for (const int reg : jumps.compared_registers())
    valuation.push_back(ValueSet::everything(jumps.constants(reg).size()));
  Valuations result;
  result.all_.push_back(std::move(valuation));
  return result;
}

static std::optional<std::size_t> index_of(int reg, const JumpMap& jumps) {
  const std::vector<int>& compared = jumps.compared_registers();
  const auto at = std::lower_bound(compared.begin(), compared.end(), reg);
  if (at == compared.end() || *at != reg) return std::nullopt;
  return static_cast<std::size_t>(at - compared.begin());
}

/// Two valuations that differ in one register only are one, with the union there; exactly so.
void Valuations::add(Valuation valuation) {
  for (std::size_t i = 0; i < all_.size();) {
    std::size_t different = 0;
    std::size_t where = 0;
    for (std::size_t k = 0; k < valuation.size() && different < 2; ++k) {
      if (all_[i][k] == valuation[k]) continue;
      ++different;
      where = k;
    }
    if (different == 0) return;
    if (different == 1) {
      valuation[where] = valuation[where].united(all_[i][where]);
      all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    } else {
      ++i;
    }
  }
  all_.push_back(std::move(valuation));
}

void Valuations::assign(int reg, double value, const JumpMap& jumps) {
  const std::optional<std::size_t> index = index_of(reg, jumps);
  if (!index) return;
  const ValueSet assigned = ValueSet::of(value, jumps.constants(reg));
  known_ |= register_bit(reg);
  if (all_.size() == 1) {
    all_.front()[*index] = assigned;
    return;
  }
  std::vector<Valuation> before;
  before.swap(all_);
  for (Valuation& valuation : before) {
    valuation[*index] = assigned;
    add(std::move(valuation));
  }
}

Valuations Valuations::where(const syntax::Jump& jump, bool holds, const JumpMap& jumps) const {
  using syntax::Comparison;
  static constexpr Comparison kOpposites[] = {Comparison::NotEqual, Comparison::Equal,     Comparison::GreaterEqual,
                                              Comparison::Greater,  Comparison::LessEqual, Comparison::Less,
                                              Comparison::Invalid};
  const std::optional<std::size_t> index = index_of(jump.variable, jumps);
  if (!index || !jump.condition_is_known()) return *this;
  const Comparison comparison = holds ? jump.comparison : kOpposites[static_cast<std::size_t>(jump.comparison)];
  const ValueSet wanted = ValueSet::satisfying(comparison, jump.value, jumps.constants(jump.variable));
  Valuations result;
  result.known_ = known_ | register_bit(jump.variable);
  for (const Valuation& valuation : all_) {
    ValueSet remaining = valuation[*index].intersected(wanted);
    if (remaining.empty()) continue;
    Valuation narrowed = valuation;
    narrowed[*index] = std::move(remaining);
    result.add(std::move(narrowed));
  }
  return result;
}

void Valuations::unite(Valuations other) {
  known_ |= other.known_;
  for (Valuation& valuation : other.all_) add(std::move(valuation));
}

void Valuations::keep_only(RegisterSet read, const JumpMap& jumps) {
  if ((known_ & ~read) == 0) return;
  const std::vector<int>& compared = jumps.compared_registers();
  bool changed = false;
  for (std::size_t k = 0; k < compared.size(); ++k) {
    if ((known_ & ~read & register_bit(compared[k])) == 0) continue;
    const std::size_t constants = jumps.constants(compared[k]).size();
    for (Valuation& valuation : all_) {
      if (valuation[k].is_everything(constants)) continue;
      valuation[k] = ValueSet::everything(constants);
      changed = true;
    }
  }
  known_ &= read;
  if (!changed || all_.size() < 2) return;
  std::vector<Valuation> before;
  before.swap(all_);
  for (Valuation& valuation : before) add(std::move(valuation));
}

void Valuations::reduce_to(std::size_t limit) {
  if (all_.size() > limit) all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(limit), all_.end());
}

}  // namespace isocnc::analyzer
