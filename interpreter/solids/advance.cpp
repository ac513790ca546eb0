#include "interpreter/solids/advance.h"

namespace isocnc::solids::detail {

Advancement::Advancement(double begin, double end, const AdvanceOptions& options) : end_(end), options_(options) {
  options_.contact = std::max(options.contact, kMinContact);
  options_.tolerance = std::max(options.tolerance, kMinContact);
  result_.s = begin;
}

double Advancement::floor() const {
  return std::max(options_.contact / 2, std::min(options_.clearance, result_.nearest) - options_.tolerance);
}

/// A distance above the clearance is of no interest: where it is not yet known that the motion comes nearer, all of the
/// rest must stay above the clearance.
double Advancement::sufficient(double rate) const {
  const double rest = rate * (end_ - result_.s);
  const double limit = std::max(options_.contact, std::min(options_.clearance, result_.nearest)) + 2 * kRounding;
  return rest >= 0 ? limit + rest : kExact;
}

bool Advancement::finish(AdvanceResult::Verdict verdict) {
  result_.verdict = verdict;
  return false;
}

bool Advancement::take(const Clearance& found, double rate) {
  ++result_.evaluations;
  if (found.upper < result_.nearest) {
    result_.nearest = found.upper;
    result_.nearest_s = result_.s;
    result_.clearance = found;
  }
  if (found.upper <= options_.contact) return finish(AdvanceResult::Verdict::Contact);
  const double rest = end_ - result_.s;
  const double margin = found.lower - floor();
  const bool is_at_rest = rate == 0 || rest == 0;
  if (!(margin > 0) || !(rate >= 0)) return finish(AdvanceResult::Verdict::Undecided);
  const double step = is_at_rest ? rest : std::min(rest, margin / rate);
  const double next = step >= rest ? end_ : result_.s + step;
  if (next == result_.s && rest > 0) return finish(AdvanceResult::Verdict::Undecided);
  result_.proven = std::min(result_.proven, is_at_rest ? found.lower : found.lower - rate * step);
  result_.s = next;
  if (next == end_) return finish(AdvanceResult::Verdict::Clear);
  if (result_.evaluations >= options_.max_evaluations) return finish(AdvanceResult::Verdict::Undecided);
  return true;
}

}  // namespace isocnc::solids::detail
