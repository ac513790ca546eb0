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
  return ValueSet{{{cell, cell}}};
}

ValueSet ValueSet::satisfying(syntax::Comparison comparison, double constant, const std::vector<double>& constants) {
  const std::uint32_t cell = cell_of(constant, constants);
  const auto last = static_cast<std::uint32_t>(2 * constants.size());
  switch (comparison) {
    case syntax::Comparison::Equal: return ValueSet{{{cell, cell}}};
    case syntax::Comparison::NotEqual: return ValueSet{{{0, cell - 1}, {cell + 1, last}}};
    case syntax::Comparison::Less: return ValueSet{{{0, cell - 1}}};
    case syntax::Comparison::LessEqual: return ValueSet{{{0, cell}}};
    case syntax::Comparison::Greater: return ValueSet{{{cell + 1, last}}};
    case syntax::Comparison::GreaterEqual: return ValueSet{{{cell, last}}};
    case syntax::Comparison::Invalid: break;
  }
  return everything(constants.size());
}

ValueSet ValueSet::intersected(const ValueSet& other) const {
  ValueSet result;
  for (const Range& a : ranges_)
    for (const Range& b : other.ranges_) {
      const Range common{std::max(a.first, b.first), std::min(a.last, b.last)};
      if (common.first <= common.last) result.ranges_.push_back(common);
    }
  std::sort(result.ranges_.begin(), result.ranges_.end(), [](Range a, Range b) { return a.first < b.first; });
  return result;
}

ValueSet ValueSet::united(const ValueSet& other) const {
  std::vector<Range> all = ranges_;
  all.insert(all.end(), other.ranges_.begin(), other.ranges_.end());
  std::sort(all.begin(), all.end(), [](Range a, Range b) { return a.first < b.first; });
  ValueSet result;
  for (const Range& range : all) {
    if (!result.ranges_.empty() && range.first <= result.ranges_.back().last + 1) {
      result.ranges_.back().last = std::max(result.ranges_.back().last, range.last);
    } else {
      result.ranges_.push_back(range);
    }
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
  std::vector<Valuation> before;
  before.swap(all_);
  for (Valuation& valuation : before) {
    valuation[*index] = assigned;
    add(std::move(valuation));
  }
}

Valuations Valuations::where(const syntax::Jump& jump, bool holds, const JumpMap& jumps) const {
  using syntax::Comparison;
  static constexpr Comparison kOpposites[] = {Comparison::NotEqual, Comparison::Equal,       Comparison::GreaterEqual,
                                              Comparison::Greater,  Comparison::LessEqual,   Comparison::Less,
                                              Comparison::Invalid};
  const std::optional<std::size_t> index = index_of(jump.variable, jumps);
  if (!index || !jump.condition_is_known()) return *this;
  const Comparison comparison = holds ? jump.comparison : kOpposites[static_cast<std::size_t>(jump.comparison)];
  const ValueSet wanted = ValueSet::satisfying(comparison, jump.value, jumps.constants(jump.variable));
  Valuations result;
  for (const Valuation& valuation : all_) {
    ValueSet remaining = valuation[*index].intersected(wanted);
    if (remaining.empty()) continue;
    Valuation narrowed = valuation;
    narrowed[*index] = std::move(remaining);
    result.add(std::move(narrowed));
  }
  return result;
}

void Valuations::unite(const Valuations& other) {
  for (const Valuation& valuation : other.all_) add(valuation);
}

void Valuations::forget_unread(std::uint32_t jump, const JumpMap& jumps) {
  const std::vector<int>& compared = jumps.compared_registers();
  for (std::size_t k = 0; k < compared.size(); ++k)
    if (!jumps.is_read_from(compared[k], jump)) assign(compared[k], std::nan(""), jumps);
}

void Valuations::blur() {
  if (all_.empty()) return;
  Valuation joined = all_.front();
  for (const Valuation& valuation : all_)
    for (std::size_t k = 0; k < joined.size(); ++k) joined[k] = joined[k].united(valuation[k]);
  all_.assign(1, std::move(joined));
}

}  // namespace isocnc::analyzer
