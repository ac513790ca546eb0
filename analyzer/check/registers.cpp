#include "analyzer/check/registers.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace isocnc::check {

static double above(double value) { return std::nextafter(value, std::numeric_limits<double>::infinity()); }
static double below(double value) { return std::nextafter(value, -std::numeric_limits<double>::infinity()); }

ValueSet ValueSet::of(double value, const std::vector<double>& constants) {
  if (std::isnan(value)) return everything();
  const auto next = std::lower_bound(constants.begin(), constants.end(), value);
  if (next != constants.end() && *next == value) return {value, value};
  return {next == constants.begin() ? -kInfinity : above(next[-1]), next == constants.end() ? kInfinity : below(*next)};
}

ValueSet ValueSet::satisfying(syntax::Comparison comparison, double constant) {
  switch (comparison) {
    case syntax::Comparison::Equal:
      return {constant, constant};
    case syntax::Comparison::NotEqual: {
      ValueSet apart = satisfying(syntax::Comparison::Less, constant);
      apart.append({above(constant), kInfinity});
      return apart;
    }
    case syntax::Comparison::Less:
      return {-kInfinity, below(constant)};
    case syntax::Comparison::LessEqual:
      return {-kInfinity, constant};
    case syntax::Comparison::Greater:
      return {above(constant), kInfinity};
    case syntax::Comparison::GreaterEqual:
      return {constant, kInfinity};
    case syntax::Comparison::Invalid:
      break;
  }
  return everything();
}

void ValueSet::append(ValueInterval interval) {
  ValueInterval& last = tail_.size() == 0 ? head_ : tail_.back();
  if (empty()) {
    head_ = interval;
  } else if (interval.first <= above(last.last)) {
    last.last = std::max(last.last, interval.last);
  } else {
    tail_.push_back(interval);
  }
}

ValueSet ValueSet::intersected(const ValueSet& other) const {
  ValueSet result;
  for (std::size_t i = 0, j = 0; i < count() && j < other.count();) {
    const ValueInterval a = interval(i);
    const ValueInterval b = other.interval(j);
    const ValueInterval common{std::max(a.first, b.first), std::min(a.last, b.last)};
    if (common.first <= common.last) result.append(common);
    ++(a.last < b.last ? i : j);
  }
  return result;
}

ValueSet ValueSet::united(const ValueSet& other) const {
  ValueSet result;
  for (std::size_t i = 0, j = 0; i < count() || j < other.count();) {
    const bool take_mine = j == other.count() || (i < count() && interval(i).first < other.interval(j).first);
    result.append(take_mine ? interval(i++) : other.interval(j++));
  }
  return result;
}

Valuations Valuations::unknown() {
  Valuations result;
  result.all_.emplace_back();
  return result;
}

/// The index of the register among the others, or the index where it would be inserted.
static std::ptrdiff_t place_of(int reg, RegisterSet among) { return std::popcount(among & (register_bit(reg) - 1)); }

bool operator==(const Valuations& a, const Valuations& b) {
  if (a.known_ == b.known_) return a.all_ == b.all_;
  Valuations less_of_a = a;
  Valuations less_of_b = b;
  less_of_a.forget(a.known_ & ~a.restricted());
  less_of_b.forget(b.known_ & ~b.restricted());
  return less_of_a.known_ == less_of_b.known_ && less_of_a.all_ == less_of_b.all_;
}

RegisterSet Valuations::restricted() const {
  RegisterSet restricted = 0;
  for (RegisterSet left = known_; left != 0; left &= left - 1) {
    const int reg = std::countr_zero(left);
    const auto place = static_cast<std::size_t>(place_of(reg, known_));
    const auto restricts = [&](const Valuation& valuation) { return !valuation[place].is_everything(); };
    if (std::any_of(all_.begin(), all_.end(), restricts)) restricted |= register_bit(reg);
  }
  return restricted;
}

void Valuations::add_registers(RegisterSet registers) {
  for (RegisterSet left = registers & ~known_; left != 0; left &= left - 1) {
    const int reg = std::countr_zero(left);
    for (Valuation& valuation : all_)
      valuation.insert(valuation.begin() + place_of(reg, known_), ValueSet::everything());
    known_ |= register_bit(reg);
  }
}

void Valuations::forget(RegisterSet registers) {
  for (RegisterSet left = registers & known_; left != 0; left &= left - 1) {
    const int reg = std::countr_zero(left);
    known_ &= ~register_bit(reg);
    for (Valuation& valuation : all_) valuation.erase(valuation.begin() + place_of(reg, known_));
  }
}

/// Merges valuations that differ in one register only into one with the union of that register's values; this is exact.
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

void Valuations::add_all_again() {
  if (all_.size() < 2) return;
  std::vector<Valuation> before;
  before.swap(all_);
  for (Valuation& valuation : before) add(std::move(valuation));
}

void Valuations::assign(int reg, double value, const JumpMap& jumps) {
  const std::vector<double>& constants = jumps.constants(reg);
  if (constants.empty()) return;
  add_registers(register_bit(reg));
  const ValueSet assigned = ValueSet::of(value, constants);
  for (Valuation& valuation : all_) *(valuation.begin() + place_of(reg, known_)) = assigned;
  add_all_again();
}

Valuations Valuations::where(const syntax::Jump& jump, bool holds) const {
  using syntax::Comparison;
  static constexpr Comparison kOpposites[] = {Comparison::NotEqual, Comparison::Equal,     Comparison::GreaterEqual,
                                              Comparison::Greater,  Comparison::LessEqual, Comparison::Less,
                                              Comparison::Invalid};
  if (jump.variable <= 0 || !jump.condition_is_known()) return *this;
  const Comparison comparison = holds ? jump.comparison : kOpposites[static_cast<std::size_t>(jump.comparison)];
  const ValueSet wanted = ValueSet::satisfying(comparison, jump.value);
  const std::ptrdiff_t place = place_of(jump.variable, known_);
  Valuations result;
  result.known_ = known_ | register_bit(jump.variable);
  if (result.known_ != known_) {
    result.all_ = all_;
    for (Valuation& valuation : result.all_) valuation.insert(valuation.begin() + place, wanted);
    return result;
  }
  for (const Valuation& valuation : all_) {
    ValueSet remaining = (valuation.begin() + place)->intersected(wanted);
    if (remaining.empty()) continue;
    Valuation narrowed = valuation;
    *(narrowed.begin() + place) = std::move(remaining);
    result.add(std::move(narrowed));
  }
  return result;
}

void Valuations::unite(Valuations other) {
  add_registers(other.known_);
  other.add_registers(known_);
  for (Valuation& valuation : other.all_) add(std::move(valuation));
}

void Valuations::keep_only(RegisterSet read) {
  if ((known_ & ~read) == 0) return;
  forget(~read);
  add_all_again();
}

void Valuations::reduce_to(std::size_t limit) {
  if (all_.size() > limit) all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(limit), all_.end());
}

}  // namespace isocnc::check
