#include "interpreter/comparison/alignment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/comparison/action_path.h"
#include "interpreter/comparison/anchors.h"
#include "interpreter/comparison/gap_steps.h"

namespace isocnc::comparison {

using geometry::Pose;
using geometry::Vec3;

/// Maximum number of motions that take the path of one motion.
static constexpr std::size_t kMaxParts = 10'000;
/// Points of a curve that are compared.
static constexpr int kSamples = 8;

bool WorkBudget::take_cells(std::size_t a_count, std::size_t b_count) {
  constexpr std::size_t kFree = 2500;
  const std::size_t cells = a_count * b_count;
  if (cells <= kFree) return true;
  if (cells > gap_cells) return false;
  gap_cells -= cells;
  return true;
}

static bool turns_together(const Pose& a, const Pose& b, double tolerance) {
  return std::abs(a.b - b.b) <= tolerance && std::abs(a.c - b.c) <= tolerance;
}

static bool is_near(const Pose& a, const Pose& b, const Vec3& shift, double tolerance) {
  return (b.tip - a.tip - shift).squaredNorm() <= tolerance * tolerance && turns_together(a, b, tolerance);
}

bool ends_together(const RunPair& runs, const MachineAction& a, const MachineAction& b, const Vec3& shift) {
  return is_near(a.to, b.to, shift, runs.tolerance);
}

bool ends_where_it_did(const RunPair& runs, const MachineAction& a, const MachineAction& b, const Vec3& before,
                       const Vec3& after) {
  constexpr double kFarApart = 4;  // Of a row of short motions, each moved otherwise, one may end in place by chance.
  const bool is_clear = (a.is_rapid && b.is_rapid) ||
                        std::min(before.squaredNorm(), after.squaredNorm()) > std::pow(kFarApart * runs.tolerance, 2);
  return is_clear && ends_together(runs, a, b, Vec3::Zero());
}

bool ends_in_place(const RunPair& runs, const MachineAction& a, const MachineAction& b, const Vec3& before,
                   const Vec3& after) {
  return ends_together(runs, a, b, before) || ends_together(runs, a, b, after) ||
         ends_where_it_did(runs, a, b, before, after);
}

bool is_same_effect(const RunPair& runs, const MachineAction& a, const MachineAction& b) {
  if (a.kind != b.kind) return false;
  constexpr double kSameValue = 1e-6;
  switch (a.kind) {
    case ActionKind::Tool:
      return runs.a.tools[a.tool].code == runs.b.tools[b.tool].code;
    case ActionKind::Function: {
      const running::FunctionEvent& left = runs.a.functions[a.number];
      const running::FunctionEvent& right = runs.b.functions[b.number];
      const auto is_same = [](const execution::FunctionParameter& one, const execution::FunctionParameter& other) {
        return one.number == other.number && std::abs(one.value - other.value) <= kSameValue;
      };
      // Each has a name: their order says nothing.
      return left.number == right.number &&
             std::is_permutation(left.parameters.begin(), left.parameters.end(), right.parameters.begin(),
                                 right.parameters.end(), is_same);
    }
    default:
      return a.number == b.number && std::abs(a.value - b.value) <= kSameValue;
  }
}

namespace {

/// A motion that is followed, up to a part of it.
struct Followed {
  std::size_t index = 0;
  double part = 0;
};

/// Whether the rest of a motion, up to `until`, stays beside another one, and goes forward there. `shift` leads from
/// the first to the second. Returns how far the second one has been followed.
std::optional<double> beside(const ActionPath& path, double from, double until, const ActionPath& other,
                             double other_part, const Vec3& shift, double tolerance) {
  const int samples = path.is_straight() && other.is_straight() ? 1 : kSamples;
  for (int i = 1; i <= samples; ++i) {
    Pose pose = path.at(from + (until - from) * i / samples);
    pose.tip += shift;
    const std::optional<double> part = other.nearest(pose, other_part);
    if (!part) return std::nullopt;
    const Pose there = other.at(*part);
    if ((there.tip - pose.tip).squaredNorm() > tolerance * tolerance || !turns_together(there, pose, tolerance))
      return std::nullopt;
    other_part = *part;
  }
  return other_part;
}

}  // namespace

/// Whether two arcs have the same circle and go around it in the same way. Their ends are compared elsewhere.
static bool is_same_arc(const RunPair& runs, const MachineAction& a, const MachineAction& b, const Vec3& shift) {
  if (a.arc == MachineAction::kNone || b.arc == MachineAction::kNone) return false;
  constexpr double kSameNormal = 1e-9;
  const ActionArc& left = runs.a.arcs[a.arc];
  const ActionArc& right = runs.b.arcs[b.arc];
  const double radius = (a.from.tip - left.center).norm();
  const double turn = std::abs(left.sweep_deg - right.sweep_deg) / 180 * std::numbers::pi;
  return (left.normal - right.normal).squaredNorm() <= kSameNormal && turn * radius <= runs.tolerance &&
         (right.center - left.center - shift).squaredNorm() <= runs.tolerance * runs.tolerance / 4;
}

/// Whether the joints of two machines go together in the same way.
static bool has_same_rapids(const kinematics::Machine& left, const kinematics::Machine& right) {
  if (left.rapid_motion != right.rapid_motion) return false;
  if (left.rapid_motion == kinematics::RapidMotion::Interpolated) return true;
  const auto is_same = [](const kinematics::AxisLimits& one, const kinematics::AxisLimits& other) {
    return one.speed == other.speed && one.acceleration == other.acceleration && one.jerk == other.jerk;
  };
  return std::equal(left.axes.begin(), left.axes.end(), right.axes.begin(), is_same);
}

/// Whether the joints lead the tip in the same way: one machine, with tools of the same length.
static bool has_same_head(const RunPair& runs, const MachineAction& a, const MachineAction& b) {
  const kinematics::Kinematics& left = runs.a.machine.kinematics;
  const kinematics::Kinematics& right = runs.b.machine.kinematics;
  const auto length = [](const RecordedRun& run, const MachineAction& motion) {
    return motion.tool == MachineAction::kNone ? 0 : run.tools[motion.tool].length;
  };
  return has_same_rapids(runs.a.machine, runs.b.machine) && left.kind == right.kind && left.pivot == right.pivot &&
         left.b_from_c == right.b_from_c && left.spindle_from_b == right.spindle_from_b &&
         left.b_point == right.b_point && left.c_point == right.c_point && length(runs.a, a) == length(runs.b, b);
}

/// Whether a motion goes where the rest of the other one does, to the end of both.
static bool is_same_rest(const RunPair& runs, const Followed& a, const Followed& b, const Vec3& shift) {
  const MachineAction& left = runs.a.actions[a.index];
  const MachineAction& right = runs.b.actions[b.index];
  if (left.is_line() && right.is_line()) return true;
  const bool is_whole = a.part == 0 && b.part == 0;
  if (is_whole && left.is_by_joints && right.is_by_joints && shift.isZero(0) && has_same_head(runs, left, right))
    return true;
  if (is_whole && is_same_arc(runs, left, right, shift)) return true;
  const ActionPath a_path(runs.a, left);
  const ActionPath b_path(runs.b, right);
  return beside(a_path, a.part, 1, b_path, b.part, shift, runs.tolerance) &&
         beside(b_path, b.part, 1, a_path, a.part, -shift, runs.tolerance);
}

/// Where both have rested for the same time, also in different parts, without a motion between them.
static std::optional<PlaceInBoth> same_dwell(const RunPair& runs, PlaceInBoth place) {
  constexpr double kSameSeconds = 1e-6;
  double ahead = 0;  // By how much longer a has rested.
  const auto rest = [](const RecordedRun& run, std::size_t& i) -> std::optional<double> {
    if (i == run.actions.size() || run.actions[i].kind != ActionKind::Dwell) return std::nullopt;
    return run.actions[i++].value;
  };
  do {
    const bool is_a_next = ahead <= 0;
    const std::optional<double> seconds = is_a_next ? rest(runs.a, place.a) : rest(runs.b, place.b);
    if (!seconds) return std::nullopt;
    ahead += is_a_next ? *seconds : -*seconds;
  } while (std::abs(ahead) > kSameSeconds);
  return place;
}

bool goes_same_way(const RunPair& runs, const MachineAction& a, const MachineAction& b) {
  if (a.is_line() && b.is_line()) return true;
  if (a.is_by_joints || b.is_by_joints) {
    if (a.is_by_joints != b.is_by_joints) return false;
    // Between other ends they go where these lead them.
    const Vec3 moved = (b.to.tip - a.to.tip) - (b.from.tip - a.from.tip);
    if (moved.norm() > runs.tolerance || !turns_together(a.from, b.from, runs.tolerance) ||
        !turns_together(a.to, b.to, runs.tolerance))
      return true;
  }
  const Vec3 at_start = b.from.tip - a.from.tip;
  const Vec3 at_end = b.to.tip - a.to.tip;
  const double square = runs.tolerance * runs.tolerance;
  const ActionPath a_path(runs.a, a);
  const ActionPath b_path(runs.b, b);
  if ((at_end - at_start).squaredNorm() <= square) {
    const Vec3 shift = (at_start + at_end) / 2;
    return is_same_arc(runs, a, b, shift) || (beside(a_path, 0, 1, b_path, 0, shift, runs.tolerance) &&
                                              beside(b_path, 0, 1, a_path, 0, -shift, runs.tolerance));
  }
  constexpr int kPoints = 2 * kSamples;
  for (int i = 1; i < kPoints; ++i) {
    const double part = static_cast<double>(i) / kPoints;
    const Vec3 there = a_path.at(part).tip + at_start + part * (at_end - at_start);
    if ((b_path.at(part).tip - there).squaredNorm() > square) return false;
  }
  return true;
}

bool is_other_way_around(const RunPair& runs, const MachineAction& a, const MachineAction& b) {
  if (a.arc == MachineAction::kNone || b.arc == MachineAction::kNone) return false;
  const ActionArc& left = runs.a.arcs[a.arc];
  const ActionArc& right = runs.b.arcs[b.arc];
  return left.normal.dot(right.normal) * left.sweep_deg * right.sweep_deg < 0;
}

bool is_same_action(const RunPair& runs, const MachineAction& a, const MachineAction& b, const Vec3& shift) {
  if (a.kind != b.kind) return false;
  if (!a.is_motion()) return is_same_effect(runs, a, b);
  if (!ends_together(runs, a, b, shift)) return false;
  if ((a.is_line() && b.is_line()) || (a.is_by_joints && b.is_by_joints)) return true;
  return (b.from.tip - a.from.tip - shift).norm() <= runs.tolerance && goes_same_way(runs, a, b);
}

std::optional<PlaceInBoth> same_step(const RunPair& runs, const PlaceInBoth& place, const Vec3& shift,
                                     const OverlapListener& overlap) {
  Followed a{place.a};
  Followed b{place.b};
  bool is_rapid_alone = false;
  for (std::size_t parts = 0; parts < kMaxParts; ++parts) {
    if (a.index >= runs.a.actions.size() || b.index >= runs.b.actions.size()) return std::nullopt;
    const MachineAction& left = runs.a.actions[a.index];
    const MachineAction& right = runs.b.actions[b.index];
    if (!left.is_motion() || !right.is_motion()) {
      if (parts > 0) return std::nullopt;
      const bool is_same = is_same_effect(runs, left, right);
      if (!is_same && left.kind == ActionKind::Dwell && right.kind == ActionKind::Dwell) return same_dwell(runs, place);
      return is_same ? std::optional(PlaceInBoth{a.index + 1, b.index + 1}) : std::nullopt;
    }
    if (parts == 0 && !is_near(left.from, right.from, shift, runs.tolerance)) return std::nullopt;
    if (overlap) overlap(a.index, b.index);
    is_rapid_alone = is_rapid_alone || left.is_rapid != right.is_rapid;
    if (ends_together(runs, left, right, shift)) {
      // Where both go from rapid to feed, they do so in different places.
      if (is_rapid_alone && a.index > place.a && b.index > place.b) return std::nullopt;
      if (!is_same_rest(runs, a, b, shift)) return std::nullopt;
      return PlaceInBoth{a.index + 1, b.index + 1};
    }
    // One of them ends beside the other.
    const ActionPath a_path(runs.a, left);
    const ActionPath b_path(runs.b, right);
    if (const auto part = beside(a_path, a.part, 1, b_path, b.part, shift, runs.tolerance)) {
      a = {a.index + 1};
      b.part = *part;
    } else if (const auto a_part = beside(b_path, b.part, 1, a_path, a.part, -shift, runs.tolerance)) {
      b = {b.index + 1};
      a.part = *a_part;
    } else {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

namespace {

/// Finds the pieces from the start of two runs to their ends.
class Aligner {
 public:
  Aligner(const RunPair& runs, const Vec3& shift)
      : runs_(runs), shift_(shift), budget_(runs.budget == nullptr ? own_budget_ : *runs.budget) {}

  std::vector<AlignedPiece> pieces() {
    while (place_.a < runs_.a.actions.size() || place_.b < runs_.b.actions.size()) {
      if (const auto next = same_step(runs_, place_, shift_)) {
        go_on(*next, AlignedPiece::Kind::Same);
        continue;
      }
      if (!find_again()) go_on({runs_.a.actions.size(), runs_.b.actions.size()}, AlignedPiece::Kind::Gap);
    }
    return std::move(pieces_);
  }

 private:
  /// Number of actions among which a difference is looked for in all ways.
  static constexpr std::size_t kWindow = 40;
  /// Number of steps that have to be the same after a place for it to count.
  static constexpr int kConfirmations = 3;
  /// Maximum number of anchors tried in a row.
  static constexpr int kMaxAnchors = 64;

  /// A place from which both do the same again, after one action each that ends in the same place or, with a new
  /// shift, in another one.
  struct Again {
    PlaceInBoth place;
    Vec3 shift = Vec3::Zero();
  };

  void go_on(const PlaceInBoth& next, AlignedPiece::Kind kind) {
    const bool goes_on = !pieces_.empty() && pieces_.back().kind == kind && kind == AlignedPiece::Kind::Same;
    if (!goes_on) pieces_.push_back({.kind = kind, .a_begin = place_.a, .b_begin = place_.b, .shift = shift_});
    pieces_.back().a_end = next.a;
    pieces_.back().b_end = next.b;
    place_ = next;
  }

  bool find_again() {
    std::optional<Again> again = in_window(false);
    const bool is_large = !again || std::max(again->place.a - place_.a, again->place.b - place_.b) > 1;
    if (is_large) {
      const std::optional<Again> shifted = in_window(true);
      // What another tool cuts elsewhere has not been moved.
      const bool is_of_other = shifted && again && has_same_tool(again->place) && !has_same_tool(shifted->place);
      if (shifted && !is_of_other && (!again || same_steps(*shifted) > same_steps(*again))) again = shifted;
    }
    if (again && is_large && is_new(again->shift)) again = or_anchor(*again);
    if (!again) again = at_anchor();
    if (!again) return false;
    if (again->place.a > place_.a || again->place.b > place_.b) go_on(again->place, AlignedPiece::Kind::Gap);
    shift_ = again->shift;
    const bool is_closing = runs_.a.actions[place_.a].is_motion();
    go_on({place_.a + 1, place_.b + 1}, is_closing ? AlignedPiece::Kind::Closing : AlignedPiece::Kind::Same);
    return true;
  }

  /// A place with a new shift, or else the nearest anchor without one, if that explains far more and leaves out motions
  /// of one run alone: neighbors of short motions are the same with a shift for a while, wherever one compares them.
  Again or_anchor(const Again& shifted) {
    constexpr std::size_t kFarMore = 4;
    const std::size_t steps = same_steps(shifted);
    if (steps >= kWindow || place_.a < declined_.a || place_.b < declined_.b) return shifted;
    const std::optional<Again> anchor = at_anchor();
    if (!anchor) {
      declined_ = {runs_.a.actions.size(), runs_.b.actions.size()};
      return shifted;
    }
    const std::size_t a_count = anchor->place.a - place_.a;
    const std::size_t b_count = anchor->place.b - place_.b;
    const bool is_section = kFarMore * std::min(a_count, b_count) <= std::max(a_count, b_count);
    if (is_section && !is_new(anchor->shift) && !is_too_large(a_count, b_count) &&
        same_steps(*anchor) > kFarMore * steps)
      return *anchor;
    declined_ = anchor->place;
    return shifted;
  }

  /// How many steps are the same after a place, up to a maximum: of two places where the runs may meet again, that with
  /// more of them explains more.
  std::size_t same_steps(const Again& again) const {
    constexpr std::size_t kMaxSteps = 500;
    std::size_t steps = 0;
    PlaceInBoth place{again.place.a + 1, again.place.b + 1};
    while (steps < kMaxSteps) {
      const auto next = same_step(runs_, place, again.shift);
      if (!next) break;
      place = *next;
      ++steps;
    }
    return steps;
  }

  bool has_same_tool(const PlaceInBoth& place) const {
    const std::uint32_t of_a = runs_.a.actions[place.a].tool;
    const std::uint32_t of_b = runs_.b.actions[place.b].tool;
    constexpr std::uint32_t kNone = MachineAction::kNone;
    if (of_a == kNone || of_b == kNone) return of_a == of_b;
    return runs_.a.tools[of_a].code == runs_.b.tools[of_b].code;
  }

  /// The shift between the ends of two motions, if both turn to the same B and C. The present shift and none are kept
  /// where the tolerance allows it.
  std::optional<Vec3> shift_between(const MachineAction& a, const MachineAction& b) const {
    if (!turns_together(a.to, b.to, runs_.tolerance)) return std::nullopt;
    const Vec3 shift = b.to.tip - a.to.tip;
    const double square = runs_.tolerance * runs_.tolerance;
    if ((shift - shift_).squaredNorm() <= square) return shift_;
    if (shift.squaredNorm() <= square) return Vec3(Vec3::Zero());
    return shift;
  }

  bool is_new(const Vec3& shift) const { return shift != shift_ && !shift.isZero(0); }

  /// Whether both do the same from a place on. A motion has to be among it, if there is one soon, since what is no
  /// motion is the same wherever the machine stands; for a new shift in any case.
  bool is_confirmed(PlaceInBoth place, const Vec3& shift) const {
    constexpr int kMaxWithoutMotion = 12;
    bool has_motion = false;
    for (int i = 0; i < kConfirmations || (!has_motion && i < kMaxWithoutMotion); ++i) {
      if (place.a == runs_.a.actions.size() && place.b == runs_.b.actions.size()) break;
      const auto next = same_step(runs_, place, shift);
      if (!next) return false;
      has_motion = has_motion || runs_.a.actions[place.a].is_motion();
      place = *next;
    }
    return has_motion || !is_new(shift);
  }

  std::optional<Again> again_at(const PlaceInBoth& place, bool with_new_shift) const {
    const MachineAction& a = runs_.a.actions[place.a];
    const MachineAction& b = runs_.b.actions[place.b];
    if (a.kind != b.kind) return std::nullopt;
    Vec3 shift = shift_;
    if (a.is_motion()) {
      const std::optional<Vec3> between = shift_between(a, b);
      if (!between || is_new(*between) != with_new_shift) return std::nullopt;
      shift = *between;
    } else if (with_new_shift || !is_same_effect(runs_, a, b)) {
      return std::nullopt;
    }
    if (!is_confirmed({place.a + 1, place.b + 1}, shift)) return std::nullopt;
    return Again{place, shift};
  }

  std::optional<Again> in_window(bool with_new_shift) {
    const std::size_t a_left = runs_.a.actions.size() - place_.a;
    const std::size_t b_left = runs_.b.actions.size() - place_.b;
    for (std::size_t larger = 0; larger < kWindow; ++larger)
      for (std::size_t smaller = 0; smaller <= larger; ++smaller) {
        if (budget_.window_pairs < 2) return std::nullopt;
        budget_.window_pairs -= 2;
        if (larger < a_left && smaller < b_left)
          if (const auto again = again_at({place_.a + larger, place_.b + smaller}, with_new_shift)) return again;
        if (smaller < a_left && larger < b_left && smaller != larger)
          if (const auto again = again_at({place_.a + smaller, place_.b + larger}, with_new_shift)) return again;
      }
    return std::nullopt;
  }

  /// At the nearest anchor; from there backward as far as both do the same.
  std::optional<Again> at_anchor() {
    if (!anchors_) anchors_.emplace(runs_);
    std::optional<Again> best;
    std::size_t best_size = 0;
    for (const Anchors::AnchorRow row :
         {Anchors::AnchorRow::Numbers, Anchors::AnchorRow::Place, Anchors::AnchorRow::Shape}) {
      PlaceInBoth after = place_;
      for (int i = 0; i < kMaxAnchors; ++i) {
        const std::optional<PlaceInBoth> anchor = anchors_->next(after, row);
        if (!anchor) break;
        after = {anchor->a + 1, anchor->b + 1};
        std::optional<Again> again = again_at(*anchor, false);
        if (!again && row == Anchors::AnchorRow::Shape) again = again_at(*anchor, true);
        if (!again) continue;
        const Again extended = backward(*again);
        const std::size_t size = std::max(extended.place.a - place_.a, extended.place.b - place_.b);
        if (!best || size < best_size) {
          best = extended;
          best_size = size;
        }
        break;
      }
    }
    return best;
  }

  Again backward(Again again) const {
    while (again.place.a > place_.a && again.place.b > place_.b) {
      const PlaceInBoth before{again.place.a - 1, again.place.b - 1};
      const MachineAction& a = runs_.a.actions[before.a];
      const MachineAction& b = runs_.b.actions[before.b];
      if (a.kind != b.kind) break;
      if (a.is_motion() ? !ends_together(runs_, a, b, again.shift) : !is_same_effect(runs_, a, b)) break;
      // The step from there has to be the same; the anchor's own one counts as confirmed by its end.
      if (!same_step(runs_, again.place, again.shift)) break;
      again.place = before;
    }
    return again;
  }

  const RunPair& runs_;
  PlaceInBoth place_;
  Vec3 shift_;
  std::vector<AlignedPiece> pieces_;
  WorkBudget own_budget_;
  WorkBudget& budget_;
  std::optional<Anchors> anchors_;
  PlaceInBoth declined_;  ///< Up to there, shifts are not held against anchors again.
};

}  // namespace

std::vector<AlignedPiece> align(const RunPair& runs, const Vec3& shift) { return Aligner(runs, shift).pieces(); }

}  // namespace isocnc::comparison
