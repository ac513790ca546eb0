#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/comparison/alignment.h"

namespace isocnc::comparison {

/// Ranges of both runs; the ends are exclusive.
struct ActionRanges {
  std::size_t a_begin = 0;
  std::size_t a_end = 0;
  std::size_t b_begin = 0;
  std::size_t b_end = 0;
};

/// What becomes of the next motions of a block.
struct MotionStep {
  enum class Kind : std::uint8_t {
    Same,     ///< The same path, also in different parts.
    Pair,     ///< One motion of each, of which one takes the place of the other. Their ways may differ.
    OnlyInA,  ///< One motion that the second run does not have.
    OnlyInB,
  };

  Kind kind = Kind::Same;
  ActionRanges motions;                           ///< Numbers of motions in the block.
  bool is_in_place = false;                       ///< Both end in the same place, but for `shift`. Always for Same.
  geometry::Vec3 shift = geometry::Vec3::Zero();  ///< Where it is not in place: the shift before it.
};

/// The motions of a part of both runs, without what the machine does between them.
struct MotionBlock {
  RecordedRun a;  ///< Only actions, arcs, tools and the machine.
  RecordedRun b;
  /// The index of each motion in the whole run; of the last part of a line that is joined from parts.
  std::vector<std::size_t> a_actions;
  std::vector<std::size_t> b_actions;
  std::vector<std::size_t> a_firsts;  ///< The index of its first part.
  std::vector<std::size_t> b_firsts;
  std::vector<MotionStep> steps;  ///< Through all motions of both, in their order.

  bool is_same_path() const;
  /// How many steps are not in place.
  std::size_t difference_count() const;
};

/// A part of both runs in which they differ.
struct DifferentPart {
  ActionRanges actions;
  geometry::Vec3 before = geometry::Vec3::Zero();  ///< The shift at its start.
  geometry::Vec3 after = geometry::Vec3::Zero();   ///< And at its end.
  bool is_closed = false;  ///< Its last actions are motions that end in the same place, but for `after`.
};

/// The part that begins with a piece that is not Same, together with the motions that close it. Those may be the next
/// piece: `index` becomes that of the part's last piece.
DifferentPart part_at(const std::vector<AlignedPiece>& pieces, std::size_t& index);

/// The motions of a part, step by step. Lines that only one run has in parts are joined where that leaves fewer
/// differences: beside a place that is moved, the parts end where nothing is in the other run. None for a part that is
/// too large, or if the budget is used up, also for what stands between the motions (effect_steps).
std::optional<MotionBlock> motion_block(const RunPair& runs, const DifferentPart& part);

}  // namespace isocnc::comparison
