#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "interpreter/solids/clearance.h"

namespace isocnc::solids {

/// How closely a motion is examined. All lengths in mm.
struct AdvanceOptions {
  /// What is reported: approaches that are nearer than `contact` / 2 are always found, and none that stays further away
  /// than `contact` is ever reported. At least kMinContact.
  double contact = 0.01;
  /// The smallest distance of the motion is determined if it is below this, to within `tolerance`; if it is not, it is
  /// proven to be not below. 0: only contacts matter.
  double clearance = 0;
  double tolerance = 0.1;        ///< At least kMinContact.
  int max_evaluations = 10'000;  ///< Of the distance.
};

inline constexpr double kMinContact = 1e-4;  ///< mm; smaller values are raised to it.

/// A motion of a body past an obstacle, examined from its start to the first contact, or to its end.
struct AdvanceResult {
  enum class Verdict : std::uint8_t {
    Clear,      ///< No contact, proven for the whole motion.
    Contact,    ///< At `s`, the distance is at most `contact`; before `s`, there is no contact, proven.
    Undecided,  ///< Proven up to `s` only: see first_contact().
  };

  Verdict verdict = Verdict::Undecided;
  double s = 0;         ///< Parameter of the contact, or up to which it is proven that there is none.
  int evaluations = 0;  ///< Of the distance.
  /// Proven lower bound on the distance everywhere before `s`, mm. Infinite if nothing is before `s`.
  double proven = std::numeric_limits<double>::infinity();
  /// The smallest distance that was found, and where: above the smallest one of the motion by `tolerance` at most where
  /// it is below `clearance`. Infinite or rough where all distances were larger than mattered.
  double nearest = std::numeric_limits<double>::infinity();
  double nearest_s = 0;
  Clearance clearance;  ///< Where it is `nearest`; for a contact, that is `s`.
};

/// A contact from first touch to last.
struct ContactSpan {
  double first = 0;      ///< Parameter of the first touch.
  double last = 0;       ///< Largest parameter found at which the contact lasts.
  bool is_over = false;  ///< Whether the body was seen free after `last`; false where the motion ends in contact.
  double free = 0;       ///< If it is over: a parameter after `last` at which the body is free.
  double deepest_s = 0;  ///< Where the depth is largest; the first such place.
  Clearance deepest;     ///< The distance there.
  int evaluations = 0;
};

/// Finds the first contact of a motion by conservative advancement, or proves that there is none.
///
/// - `distance(s, sufficient)` returns the Clearance at the parameter s, as clearance() does.
/// - `speed(s)` returns an upper bound, mm per unit of s, on the speed of every point of the body relative to the
///   obstacle, at all parameters from s to `end`.
///
/// From s on, the distance falls by at most speed(s) per unit of s. So with a lower bound d at s there is no distance
/// below a floor until s + (d - floor) / speed. The floor is half of `contact`, or, if that is higher, what the
/// smallest distance still needs. The body either comes nearer than `contact`, or each step covers at
/// least contact / 2 or the tolerance, less rounding: the number of evaluations is at most 2 + speed (end - begin) /
/// (0.9 min(contact / 2, tolerance)), also where the body grazes the obstacle, and at most max_evaluations.
///
/// Undecided is returned where that number is reached, or the speed is infinite or NaN, or negative, or a distance is
/// not known well enough to go on (a placement that is not finite). Where the speed is 0, the rest is at rest: one
/// distance decides. An interval of one point is one distance; one that ends before it begins is Undecided.
template <class Distance, class Speed>
requires std::invocable<Distance, double, double> && std::invocable<Speed, double> AdvanceResult
first_contact(double begin, double end, Distance&& distance, Speed&& speed, const AdvanceOptions& options = {});

/// Follows a contact that starts at `first` to its end, in steps of `resolution` mm of the fastest point, or longer
/// ones where that would take more than kMaxContactSteps. A gap of the contact that is shorter than a step may remain
/// unseen; `last` is accurate to a thousandth of a step if none does. The depth is the largest at these steps: a deeper
/// place between them is deeper by less than a step.
template <class Distance, class Speed>
requires std::invocable<Distance, double, double> && std::invocable<Speed, double> ContactSpan
follow_contact(double first, double end, Distance&& distance, Speed&& speed, double contact, double resolution = 0.1);

inline constexpr int kMaxContactSteps = 256;

namespace detail {

/// The state of first_contact() between two evaluations.
class Advancement {
 public:
  Advancement(double begin, double end, const AdvanceOptions& options);

  /// The distance at which `rate` lets the rest of the motion pass in one step.
  double sufficient(double rate) const;
  double s() const { return result_.s; }
  /// Takes the distance at s, and goes on. Returns whether there is more to do.
  bool take(const Clearance& found, double rate);
  const AdvanceResult& result() const { return result_; }

 private:
  double floor() const;
  bool finish(AdvanceResult::Verdict verdict);

  double end_;
  AdvanceOptions options_;
  AdvanceResult result_;
};

}  // namespace detail

template <class Distance, class Speed>
requires std::invocable<Distance, double, double> && std::invocable<Speed, double> AdvanceResult
first_contact(double begin, double end, Distance&& distance, Speed&& speed, const AdvanceOptions& options) {
  detail::Advancement advancement(begin, end, options);
  if (!(begin <= end)) return advancement.result();
  for (bool goes_on = true; goes_on;) {
    const double rate = speed(advancement.s());
    goes_on = advancement.take(distance(advancement.s(), advancement.sufficient(rate)), rate);
  }
  return advancement.result();
}

template <class Distance, class Speed>
requires std::invocable<Distance, double, double> && std::invocable<Speed, double> ContactSpan
follow_contact(double first, double end, Distance&& distance, Speed&& speed, double contact, double resolution) {
  ContactSpan span{.first = first, .last = first, .deepest_s = first};
  const auto touches = [&](double s) {
    const Clearance found = distance(s, kExact);
    ++span.evaluations;
    if (!(found.upper <= contact)) return false;
    if (found.upper < span.deepest.upper) {
      span.deepest = found;
      span.deepest_s = s;
    }
    return true;
  };
  touches(first);
  const double rate = speed(first);
  const double step = std::max(rate > 0 ? resolution / rate : 0.0, (end - first) / kMaxContactSteps);
  while (span.last < end && !span.is_over) {
    const double next = std::min(end, std::max(span.last + step, std::nextafter(span.last, end)));
    if (touches(next)) {
      span.last = next;
    } else {
      span.free = next;
      span.is_over = true;
    }
  }
  constexpr int kHalvings = 10;
  for (int i = 0; i < kHalvings && span.is_over; ++i) {
    const double middle = span.last + (span.free - span.last) / 2;
    (touches(middle) ? span.last : span.free) = middle;
  }
  return span;
}

}  // namespace isocnc::solids
