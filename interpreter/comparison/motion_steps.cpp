#include "interpreter/comparison/motion_steps.h"

#include <algorithm>

#include "interpreter/comparison/gap_steps.h"

namespace isocnc::comparison {

using geometry::Vec3;

namespace {

/// The motions of a range of a run as a run of their own.
std::vector<std::size_t> take_motions(const RecordedRun& run, std::size_t begin, std::size_t end, RecordedRun& taken) {
  std::vector<std::size_t> indices;
  taken.tools = run.tools;
  taken.kinematics = run.kinematics;
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
      const bool is_pair = step == GapStep::Same || step == GapStep::Replaced;
      const auto only = step == GapStep::OnlyInA ? MotionStep::Kind::OnlyInA : MotionStep::Kind::OnlyInB;
      add({is_pair ? MotionStep::Kind::Pair : only, at});
      at.a_begin = at.a_end;
      at.b_begin = at.b_end;
    }
    return true;
  }

  bool ends_in_place(const MotionStep& step, const Vec3& shift) const {
    return step.kind == MotionStep::Kind::Pair &&
           ends_together(runs_, runs_.a.actions[step.motions.a_begin], runs_.b.actions[step.motions.b_begin], shift);
  }

  /// Decides which steps from `first` on are in place: with the shift before them, and the last ones with that after.
  void place(std::size_t first, const Vec3& after) {
    for (std::size_t i = first; i < steps_.size(); ++i) steps_[i].is_in_place = ends_in_place(steps_[i], shift_);
    for (std::size_t i = steps_.size(); i > first && ends_in_place(steps_[i - 1], after); --i) {
      steps_[i - 1].is_in_place = true;
      steps_[i - 1].shift = after;
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

std::optional<MotionBlock> motion_block(const RunPair& runs, const DifferentPart& part) {
  const ActionRanges& at = part.actions;
  const std::size_t closing = part.is_closed ? 1 : 0;
  if (is_too_large(at.a_end - at.a_begin - closing, at.b_end - at.b_begin - closing)) return std::nullopt;
  MotionBlock block;
  block.a_actions = take_motions(runs.a, at.a_begin, at.a_end, block.a);
  block.b_actions = take_motions(runs.b, at.b_begin, at.b_end, block.b);
  const RunPair motions{block.a, block.b, runs.tolerance, runs.budget};
  const std::size_t a_count = block.a_actions.size();
  const std::size_t b_count = block.b_actions.size();
  if (runs.budget != nullptr &&
      !runs.budget->take_cells(at.a_end - at.a_begin - a_count, at.b_end - at.b_begin - b_count))
    return std::nullopt;
  std::vector<AlignedPiece> pieces;
  if (a_count < at.a_end - at.a_begin || b_count < at.b_end - at.b_begin) {
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
  block.steps = maker.take();
  return block;
}

}  // namespace isocnc::comparison
