#include "interpreter/comparison/effect_steps.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "interpreter/comparison/action_path.h"

namespace isocnc::comparison {

namespace {

/// An action between motions.
struct Effect {
  std::size_t index = 0;
  std::size_t motions = 0;  ///< Number of motions of the part before it.
};

/// `motions` are the indices of the motions of the part.
std::vector<Effect> effects_of(const RecordedRun& run, std::size_t begin, std::size_t end,
                               const std::vector<std::size_t>& motions) {
  std::vector<Effect> effects;
  for (std::size_t i = begin; i < end; ++i) {
    if (run.actions[i].is_motion()) continue;
    const auto next = std::lower_bound(motions.begin(), motions.end(), i);
    effects.push_back({i, static_cast<std::size_t>(next - motions.begin())});
  }
  return effects;
}

/// The length of the way up to each motion, and to the end.
std::vector<double> lengths_of(const RecordedRun& motions) {
  double length = 0;
  std::vector<double> lengths = {length};
  for (const MachineAction& motion : motions.actions) {
    length += ActionPath(motions, motion).length();
    lengths.push_back(length);
  }
  return lengths;
}

/// Where the second run is on its way when the first one is between two motions.
class PlacesOnWay {
 public:
  PlacesOnWay(const MotionBlock& block, double tolerance)
      : tolerance_(2 * tolerance), b_lengths_(lengths_of(block.b)), places_(block.a_actions.size() + 1) {
    const std::vector<double> a_lengths = lengths_of(block.a);
    include(0, b_lengths_[0]);
    for (const MotionStep& step : block.steps) {
      const ActionRanges& at = step.motions;
      for (std::size_t i = at.a_begin + 1; i < at.a_end; ++i)
        include(i, b_lengths_[at.b_begin] + a_lengths[i] - a_lengths[at.a_begin]);
      include(at.a_begin, b_lengths_[at.b_begin]);
      include(at.a_end, b_lengths_[at.b_end]);
    }
  }

  double later(const Effect& a, const Effect& b) const {
    const double at = b_lengths_[b.motions];
    const WayRange& place = places_[a.motions];
    if (at < place.first - tolerance_) return at - place.first;
    return at > place.last + tolerance_ ? at - place.last : 0;
  }

 private:
  struct WayRange {
    double first = std::numeric_limits<double>::infinity();
    double last = -std::numeric_limits<double>::infinity();
  };

  void include(std::size_t motions, double length) {
    places_[motions].first = std::min(places_[motions].first, length);
    places_[motions].last = std::max(places_[motions].last, length);
  }

  double tolerance_;
  std::vector<double> b_lengths_;
  std::vector<WayRange> places_;
};

/// Finds the steps that change the least.
class StepFinder {
 public:
  StepFinder(const RunPair& runs, std::vector<Effect> a, std::vector<Effect> b, const PlacesOnWay& places)
      : runs_(runs), a_(std::move(a)), b_(std::move(b)), places_(places), best_((a_.size() + 1) * width()) {}

  std::vector<EffectStep> steps() {
    for (std::size_t i = 0; i <= a_.size(); ++i)
      for (std::size_t k = 0; k <= b_.size(); ++k)
        if (i + k > 0) at(i, k) = best_step(i, k);
    std::vector<EffectStep> steps;
    for (std::size_t i = a_.size(), k = b_.size(); i > 0 || k > 0;) {
      const Best& best = at(i, k);
      i -= best.a_count;
      k -= best.b_count;
      if (best.b_count == 0) {
        steps.push_back({a_[i].index, std::nullopt});
      } else if (best.a_count == 0) {
        steps.push_back({std::nullopt, b_[k].index});
      } else {
        const bool is_same = are_same(i, k, best.a_count, best.b_count);
        steps.push_back(
            {a_[i].index, b_[k].index, best.a_count, best.b_count, is_same, is_same ? places_.later(a_[i], b_[k]) : 0});
      }
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

 private:
  /// Maximum number of dwells that count together.
  static constexpr std::size_t kMaxTogether = 8;

  /// The step that leads to a place with the least changes up to there.
  struct Best {
    float cost = 0;
    std::uint8_t a_count = 0;
    std::uint8_t b_count = 0;
  };

  std::size_t width() const { return b_.size() + 1; }
  Best& at(std::size_t i, std::size_t k) { return best_[i * width() + k]; }

  Best best_step(std::size_t i, std::size_t k) {
    Best best{std::numeric_limits<float>::infinity()};
    const auto try_step = [&](std::size_t a_count, std::size_t b_count, float cost) {
      cost += at(i - a_count, k - b_count).cost;
      if (cost < best.cost) best = {cost, static_cast<std::uint8_t>(a_count), static_cast<std::uint8_t>(b_count)};
    };
    if (i > 0 && k > 0 && action(runs_.a, a_[i - 1]).kind == action(runs_.b, b_[k - 1]).kind)
      try_step(1, 1, cost(i - 1, k - 1, 1, 1));
    if (i > 0) try_step(1, 0, 1);
    if (k > 0) try_step(0, 1, 1);
    const std::size_t a_dwells = dwells_before(runs_.a, a_, i);
    const std::size_t b_dwells = dwells_before(runs_.b, b_, k);
    for (std::size_t m = 1; m <= a_dwells; ++m)
      for (std::size_t n = m == 1 ? 2 : 1; n <= b_dwells; ++n) try_step(m, n, cost(i - m, k - n, m, n));
    return best;
  }

  static const MachineAction& action(const RecordedRun& run, const Effect& effect) { return run.actions[effect.index]; }

  float cost(std::size_t i, std::size_t k, std::size_t a_count, std::size_t b_count) const {
    constexpr float kElsewhere = 0.6F;
    return (are_same(i, k, a_count, b_count) ? 0.F : 1.F) + (places_.later(a_[i], b_[k]) == 0 ? 0.F : kElsewhere);
  }

  bool are_same(std::size_t i, std::size_t k, std::size_t a_count, std::size_t b_count) const {
    if (a_count == 1 && b_count == 1) return is_same_effect(runs_, action(runs_.a, a_[i]), action(runs_.b, b_[k]));
    MachineAction left = action(runs_.a, a_[i]);
    MachineAction right = action(runs_.b, b_[k]);
    for (std::size_t m = 1; m < a_count; ++m) left.value += action(runs_.a, a_[i + m]).value;
    for (std::size_t n = 1; n < b_count; ++n) right.value += action(runs_.b, b_[k + n]).value;
    return is_same_effect(runs_, left, right);
  }

  /// How many dwells stand in a row before a place, without a motion between them.
  static std::size_t dwells_before(const RecordedRun& run, const std::vector<Effect>& effects, std::size_t end) {
    std::size_t count = 0;
    while (count < std::min(end, kMaxTogether)) {
      const Effect& effect = effects[end - 1 - count];
      if (action(run, effect).kind != ActionKind::Dwell || effect.motions != effects[end - 1].motions) break;
      ++count;
    }
    return count;
  }

  const RunPair& runs_;
  std::vector<Effect> a_;
  std::vector<Effect> b_;
  const PlacesOnWay& places_;
  std::vector<Best> best_;
};

}  // namespace

std::vector<EffectStep> effect_steps(const RunPair& runs, const ActionRanges& part, const MotionBlock& motions) {
  std::vector<Effect> a = effects_of(runs.a, part.a_begin, part.a_end, motions.a_actions);
  std::vector<Effect> b = effects_of(runs.b, part.b_begin, part.b_end, motions.b_actions);
  if (a.empty() && b.empty()) return {};
  const PlacesOnWay places(motions, runs.tolerance);
  return StepFinder(runs, std::move(a), std::move(b), places).steps();
}

}  // namespace isocnc::comparison
