#include "interpreter/comparison/effect_steps.h"

#include <algorithm>
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

std::vector<Effect> effects_of(const RecordedRun& run, std::size_t begin, std::size_t end) {
  std::vector<Effect> effects;
  std::size_t motions = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!run.actions[i].is_motion()) effects.push_back({i, motions});
    if (run.actions[i].is_motion()) ++motions;
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

}  // namespace

std::vector<EffectStep> effect_steps(const RunPair& runs, const ActionRanges& part, const MotionBlock& motions) {
  constexpr float kElsewhere = 0.6F;
  constexpr float kNever = std::numeric_limits<float>::max() / 4;
  const std::vector<Effect> a = effects_of(runs.a, part.a_begin, part.a_end);
  const std::vector<Effect> b = effects_of(runs.b, part.b_begin, part.b_end);
  if (a.empty() && b.empty()) return {};
  const PlacesOnWay places(motions, runs.tolerance);
  const auto cost = [&](const Effect& left, const Effect& right) {
    const MachineAction& one = runs.a.actions[left.index];
    const MachineAction& other = runs.b.actions[right.index];
    if (one.kind != other.kind) return kNever;
    return (is_same_effect(runs, one, other) ? 0.F : 1.F) + (places.later(left, right) == 0 ? 0.F : kElsewhere);
  };
  const std::size_t width = b.size() + 1;
  std::vector<float> costs((a.size() + 1) * width);
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t k = 0; k <= b.size(); ++k) {
      if (i == 0 || k == 0) {
        costs[i * width + k] = static_cast<float>(i + k);
        continue;
      }
      const float with_both = costs[(i - 1) * width + k - 1] + cost(a[i - 1], b[k - 1]);
      costs[i * width + k] = std::min({with_both, costs[(i - 1) * width + k] + 1, costs[i * width + k - 1] + 1});
    }
  std::vector<EffectStep> steps;
  for (std::size_t i = a.size(), k = b.size(); i > 0 || k > 0;) {
    const float now = costs[i * width + k];
    if (i > 0 && k > 0 && now == costs[(i - 1) * width + k - 1] + cost(a[i - 1], b[k - 1])) {
      const Effect& left = a[--i];
      const Effect& right = b[--k];
      const bool is_same = is_same_effect(runs, runs.a.actions[left.index], runs.b.actions[right.index]);
      steps.push_back({left.index, right.index, is_same, is_same ? places.later(left, right) : 0});
    } else if (i > 0 && now == costs[(i - 1) * width + k] + 1) {
      steps.push_back({a[--i].index, std::nullopt});
    } else {
      steps.push_back({std::nullopt, b[--k].index});
    }
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

}  // namespace isocnc::comparison
