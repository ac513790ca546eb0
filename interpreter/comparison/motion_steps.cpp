#include "interpreter/comparison/motion_steps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "interpreter/comparison/gap_steps.h"

namespace isocnc::comparison {

using geometry::Vec3;

namespace {

/// The motions of a range of a run as a run of their own.
std::vector<std::size_t> take_motions(const RecordedRun& run, std::size_t begin, std::size_t end, RecordedRun& taken) {
  std::vector<std::size_t> indices;
  taken.tools = run.tools;
  taken.machine = run.machine;
  for (std::size_t i = begin; i < end; ++i) {
    if (!run.actions[i].is_motion()) continue;
    indices.push_back(i);
    MachineAction& motion = taken.actions.emplace_back(run.actions[i]);
    if (motion.arc == MachineAction::kNone) continue;
    taken.arcs.push_back(run.arcs[motion.arc]);
    motion.arc = static_cast<std::uint32_t>(taken.arcs.size() - 1);
  }
  return indices;
}

/// Joins lines of which the first ends on the way of both, with the same feed, where that leaves fewer differences.
class LineJoiner {
 public:
  LineJoiner(const RunPair& runs, const DifferentPart& part, MotionBlock& block)
      : runs_(runs), part_(part), block_(block), a_(block.a.actions.size()), b_(block.b.actions.size()) {
    find_joints(block.a, block.a_actions, a_);
    find_joints(block.b, block.b_actions, b_);
  }

  /// Says whether it has joined any.
  bool join() {
    if (!has_joint(a_) && !has_joint(b_)) return false;
    if (is_too_large(a_.size(), b_.size())) return false;
    if (runs_.budget != nullptr && !runs_.budget->take_cells(a_.size(), b_.size())) return false;
    choose();
    keep_others(block_.a, a_);
    keep_others(block_.b, b_);
    if (!has_joint(a_) && !has_joint(b_)) return false;
    join(block_.a, block_.a_actions, block_.a_firsts, a_);
    join(block_.b, block_.b_actions, block_.b_firsts, b_);
    return true;
  }

 private:
  /// The end of a motion.
  struct MotionEnd {
    bool is_joint = false;   ///< It may be left out, and in the end: it is.
    bool is_paired = false;  ///< It takes the place of one of the other run.
    bool is_line = false;    ///< So does its motion, and both are lines.
  };
  using MotionEnds = std::vector<MotionEnd>;
  enum class JoinStep : std::uint8_t { Pair, OnlyInA, OnlyInB };

  static bool has_joint(const MotionEnds& ends) {
    return std::any_of(ends.begin(), ends.end(), [](const MotionEnd& end) { return end.is_joint; });
  }

  /// Whether a place lies on the line between two others; while the tip rests, B and C are the line.
  bool is_between(const geometry::Pose& from, const geometry::Pose& place, const geometry::Pose& to) const {
    const Vec3 along = to.tip - from.tip;
    const double b_along = to.b - from.b;
    const double c_along = to.c - from.c;
    const bool rests = along.norm() <= runs_.tolerance / 2;
    const double square = rests ? b_along * b_along + c_along * c_along : along.squaredNorm();
    if (!(square > 0)) return false;
    const double part = rests ? (b_along * (place.b - from.b) + c_along * (place.c - from.c)) / square
                              : along.dot(place.tip - from.tip) / square;
    const double allowed = runs_.tolerance / 2;
    return part > 0 && part < 1 && (place.tip - from.tip - part * along).norm() <= allowed &&
           std::abs(place.b - from.b - part * b_along) <= allowed &&
           std::abs(place.c - from.c - part * c_along) <= allowed;
  }

  void find_joints(const RecordedRun& run, const std::vector<std::size_t>& actions, MotionEnds& ends) const {
    constexpr double kSameFeed = 1e-6;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const MachineAction& one = run.actions[i];
      const MachineAction& next = run.actions[i + 1];
      ends[i].is_joint = actions[i] + 1 == actions[i + 1] && one.is_line() && next.is_line() &&
                         one.is_rapid == next.is_rapid && !one.is_inverse_time && !next.is_inverse_time &&
                         std::abs(one.feed - next.feed) <= kSameFeed * one.feed &&
                         is_between(one.from, one.to, next.to);
    }
  }

  float pair_cost(const MachineAction& a, const MachineAction& b) const {
    if (ends_in_place(runs_, a, b, part_.before, part_.after)) return goes_same_way(runs_, a, b) ? 0.F : 0.5F;
    const double distance = (b.to.tip - a.to.tip - part_.before).norm();
    const double length = 1 + (a.to.tip - a.from.tip).norm() + (b.to.tip - b.from.tip).norm();
    return 1 + 0.1F * static_cast<float>(std::min(1.0, distance / length));
  }

  /// Decides which joints are left out: those without a place of the other run that takes theirs.
  void choose() {
    const auto only = [](const MotionEnd& end) { return end.is_joint ? 0.25F : 1.F; };
    const std::size_t width = b_.size() + 1;
    std::vector<JoinStep> steps((a_.size() + 1) * width, JoinStep::OnlyInB);
    std::vector<float> costs(width);
    for (std::size_t k = 1; k < width; ++k) costs[k] = costs[k - 1] + only(b_[k - 1]);
    for (std::size_t i = 1; i <= a_.size(); ++i) {
      float diagonal = costs[0];
      costs[0] += only(a_[i - 1]);
      steps[i * width] = JoinStep::OnlyInA;
      for (std::size_t k = 1; k < width; ++k) {
        const float pair = diagonal + pair_cost(block_.a.actions[i - 1], block_.b.actions[k - 1]);
        const float only_a = costs[k] + only(a_[i - 1]);
        const float only_b = costs[k - 1] + only(b_[k - 1]);
        diagonal = costs[k];
        costs[k] = std::min({pair, only_a, only_b});
        steps[i * width + k] = costs[k] == pair     ? JoinStep::Pair
                               : costs[k] == only_a ? JoinStep::OnlyInA
                                                    : JoinStep::OnlyInB;
      }
    }
    for (std::size_t i = a_.size(), k = b_.size(); i > 0 || k > 0;) {
      const JoinStep step = steps[i * width + k];
      if (step != JoinStep::OnlyInB) --i;
      if (step != JoinStep::OnlyInA) --k;
      if (step != JoinStep::Pair) continue;
      const bool are_lines = block_.a.actions[i].is_line() && block_.b.actions[k].is_line();
      a_[i] = {false, true, are_lines};
      b_[k] = {false, true, are_lines};
    }
  }

  /// Keeps the parts of what is no line as a whole, and of lines that the other run does not have.
  void keep_others(const RecordedRun& run, MotionEnds& ends) const {
    for (std::size_t begin = 0, end = 0; end < ends.size(); begin = ++end) {
      while (ends[end].is_joint) ++end;  // The last one is none.
      bool is_line = ends[end].is_line && (begin == 0 || ends[begin - 1].is_paired);
      for (std::size_t i = begin; i < end; ++i)
        is_line = is_line && is_between(run.actions[begin].from, run.actions[i].to, run.actions[end].to);
      for (std::size_t i = begin; i < end; ++i) ends[i].is_joint = is_line;
    }
  }

  static void join(RecordedRun& run, std::vector<std::size_t>& actions, std::vector<std::size_t>& firsts,
                   const MotionEnds& ends) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (ends[i].is_joint) {
        run.actions[i + 1].from = run.actions[i].from;
        firsts[i + 1] = firsts[i];
        continue;
      }
      run.actions[kept] = run.actions[i];
      actions[kept] = actions[i];
      firsts[kept++] = firsts[i];
    }
    run.actions.resize(kept);
    actions.resize(kept);
    firsts.resize(kept);
  }

  const RunPair& runs_;
  const DifferentPart& part_;
  MotionBlock& block_;
  MotionEnds a_;
  MotionEnds b_;
};

/// Goes through the pieces of a block.
class StepMaker {
 public:
  StepMaker(const RunPair& motions, const DifferentPart& part) : runs_(motions), part_(part), shift_(part.before) {}

  bool follow(const std::vector<AlignedPiece>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].kind == AlignedPiece::Kind::Same) {
        add_same(pieces[i]);
        continue;
      }
      const std::size_t first = steps_.size();
      AlignedPiece piece = pieces[i];
      if (piece.kind == AlignedPiece::Kind::Gap) {
        piece.shift = i + 1 < pieces.size() ? pieces[i + 1].shift : part_.after;
        if (!add_gap(piece)) return false;
        const bool is_closed = i + 1 < pieces.size() && pieces[i + 1].kind == AlignedPiece::Kind::Closing;
        if (is_closed) piece = pieces[++i];
      }
      if (piece.kind == AlignedPiece::Kind::Closing) add({MotionStep::Kind::Pair, ranges_of(piece)});
      place(first, piece.shift);
    }
    return true;
  }
  std::vector<MotionStep> take() { return std::move(steps_); }

 private:
  static ActionRanges ranges_of(const AlignedPiece& piece) {
    return {piece.a_begin, piece.a_end, piece.b_begin, piece.b_end};
  }

  void add(MotionStep step) {
    step.shift = shift_;
    steps_.push_back(step);
  }

  void add_same(const AlignedPiece& piece) {
    shift_ = piece.shift;
    for (PlaceInBoth at{piece.a_begin, piece.b_begin}; at.a < piece.a_end;) {
      const PlaceInBoth next = same_step(runs_, at, shift_).value_or(PlaceInBoth{at.a + 1, at.b + 1});
      add({MotionStep::Kind::Same, {at.a, next.a, at.b, next.b}, true});
      at = next;
    }
  }

  bool add_gap(const AlignedPiece& gap) {
    const auto steps = gap_steps(runs_, gap, shift_);
    if (!steps) return false;
    ActionRanges at{gap.a_begin, gap.a_begin, gap.b_begin, gap.b_begin};
    for (const GapStep step : *steps) {
      if (step != GapStep::OnlyInB) ++at.a_end;
      if (step != GapStep::OnlyInA) ++at.b_end;
      const auto only = step == GapStep::OnlyInA ? MotionStep::Kind::OnlyInA : MotionStep::Kind::OnlyInB;
      add({step == GapStep::Pair ? MotionStep::Kind::Pair : only, at});
      at.a_begin = at.a_end;
      at.b_begin = at.b_end;
    }
    return true;
  }

  bool ends_in_place(const MotionStep& step, const Vec3& shift) const {
    return step.kind == MotionStep::Kind::Pair &&
           ends_together(runs_, runs_.a.actions[step.motions.a_begin], runs_.b.actions[step.motions.b_begin], shift);
  }

  /// Decides which steps from `first` on are in place: with the shift before them, the last ones with that after, and
  /// the others where they end in one place, as a retract between two cuts that are deeper.
  void place(std::size_t first, const Vec3& after) {
    std::size_t last = steps_.size();
    while (last > first && ends_in_place(steps_[last - 1], after)) --last;
    for (std::size_t i = first; i < steps_.size(); ++i) {
      MotionStep& step = steps_[i];
      const Vec3 shift = i < last ? shift_ : after;
      step.is_in_place = ends_in_place(step, shift);
      if (step.is_in_place) {
        step.shift = shift;
      } else if (step.kind == MotionStep::Kind::Pair &&
                 ends_where_it_did(runs_, runs_.a.actions[step.motions.a_begin], runs_.b.actions[step.motions.b_begin],
                                   shift_, after)) {
        step.is_in_place = true;
        step.shift = Vec3::Zero();
      }
    }
    shift_ = after;
  }

  const RunPair& runs_;
  const DifferentPart& part_;
  Vec3 shift_;
  std::vector<MotionStep> steps_;
};

}  // namespace

bool MotionBlock::is_same_path() const {
  return std::all_of(steps.begin(), steps.end(),
                     [](const MotionStep& step) { return step.kind == MotionStep::Kind::Same; });
}

std::size_t MotionBlock::difference_count() const {
  return static_cast<std::size_t>(
      std::count_if(steps.begin(), steps.end(), [](const MotionStep& step) { return !step.is_in_place; }));
}

DifferentPart part_at(const std::vector<AlignedPiece>& pieces, std::size_t& index) {
  const AlignedPiece& piece = pieces[index];
  DifferentPart part{.actions = {piece.a_begin, piece.a_end, piece.b_begin, piece.b_end},
                     .before = index == 0 ? Vec3(Vec3::Zero()) : pieces[index - 1].shift,
                     .after = piece.shift,
                     .is_closed = piece.kind == AlignedPiece::Kind::Closing};
  if (part.is_closed || index + 1 == pieces.size()) return part;
  const AlignedPiece& next = pieces[index + 1];
  part.after = next.shift;
  part.is_closed = next.kind == AlignedPiece::Kind::Closing;
  if (!part.is_closed) return part;
  part.actions.a_end = next.a_end;
  part.actions.b_end = next.b_end;
  ++index;
  return part;
}

/// The steps through the motions of a block. `are_all` says that nothing else stands between them.
static std::optional<std::vector<MotionStep>> steps_of(const RunPair& motions, const DifferentPart& part,
                                                       bool are_all) {
  const std::size_t closing = part.is_closed ? 1 : 0;
  const std::size_t a_count = motions.a.actions.size();
  const std::size_t b_count = motions.b.actions.size();
  std::vector<AlignedPiece> pieces;
  if (!are_all) {
    // What stands between the motions has kept them apart.
    pieces = align(motions, part.before);
  } else {
    if (a_count + b_count > 2 * closing)
      pieces.push_back({AlignedPiece::Kind::Gap, 0, a_count - closing, 0, b_count - closing, part.before});
    if (part.is_closed)
      pieces.push_back({AlignedPiece::Kind::Closing, a_count - 1, a_count, b_count - 1, b_count, part.after});
  }
  StepMaker maker(motions, part);
  if (!maker.follow(pieces)) return std::nullopt;
  return maker.take();
}

std::optional<MotionBlock> motion_block(const RunPair& runs, const DifferentPart& part) {
  const ActionRanges& at = part.actions;
  const std::size_t closing = part.is_closed ? 1 : 0;
  if (is_too_large(at.a_end - at.a_begin - closing, at.b_end - at.b_begin - closing)) return std::nullopt;
  MotionBlock block;
  block.a_actions = block.a_firsts = take_motions(runs.a, at.a_begin, at.a_end, block.a);
  block.b_actions = block.b_firsts = take_motions(runs.b, at.b_begin, at.b_end, block.b);
  const RunPair motions{block.a, block.b, runs.tolerance, runs.budget};
  const std::size_t a_count = block.a_actions.size();
  const std::size_t b_count = block.b_actions.size();
  if (runs.budget != nullptr &&
      !runs.budget->take_cells(at.a_end - at.a_begin - a_count, at.b_end - at.b_begin - b_count))
    return std::nullopt;
  const bool are_all = a_count == at.a_end - at.a_begin && b_count == at.b_end - at.b_begin;
  auto steps = steps_of(motions, part, are_all);
  if (!steps) return std::nullopt;
  block.steps = std::move(*steps);
  if (block.is_same_path()) return block;
  MotionBlock joined = block;
  const RunPair joined_motions{joined.a, joined.b, runs.tolerance, runs.budget};
  if (!LineJoiner(joined_motions, part, joined).join()) return block;
  steps = steps_of(joined_motions, part, are_all);
  if (!steps) return block;
  joined.steps = std::move(*steps);
  return joined.difference_count() < block.difference_count() ? joined : block;
}

}  // namespace isocnc::comparison
