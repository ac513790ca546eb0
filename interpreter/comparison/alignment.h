#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "interpreter/comparison/machine_action.h"

namespace isocnc::comparison {

/// A part of two runs, as ranges of their actions; the ends are exclusive.
struct AlignedPiece {
  enum class Kind : std::uint8_t {
    Same,     ///< Both do the same, but for feeds and for a shift.
    Closing,  ///< One motion of each, which lead to the same place but not the same way.
    Gap,      ///< Nothing in it fits together; one range may be empty.
  };

  Kind kind = Kind::Same;
  std::size_t a_begin = 0;
  std::size_t a_end = 0;
  std::size_t b_begin = 0;
  std::size_t b_end = 0;
  geometry::Vec3 shift = geometry::Vec3::Zero();  ///< From a's place to b's at its end; mm. Exactly 0 for no shift.
};

/// What the differences of two runs may cost in all, so that no program takes longer than these: what is left of it.
/// Small differences cost nothing, as they take no longer than in proportion to the programs.
struct WorkBudget {
  std::size_t window_pairs =
      200'000'000;                      ///< Pairs of actions that are tried in windows; then anchors alone are asked.
  std::size_t gap_cells = 20'000'000;   ///< Pairs of actions of gaps that are looked into; then gaps are too large.
  std::size_t distances = 400'000'000;  ///< From points to lines; then distances are not known.

  /// Takes a number of cells, if there are as many.
  bool take_cells(std::size_t a_count, std::size_t b_count);
};

/// Two runs, of which one follows the other.
struct RunPair {
  const RecordedRun& a;
  const RecordedRun& b;
  double tolerance = 0;          ///< mm, and degrees for B and C.
  WorkBudget* budget = nullptr;  ///< Without it, each difference is limited by itself alone.
};

/// Called for two motions that go along each other.
using OverlapListener = std::function<void(std::size_t a, std::size_t b)>;

/// Where two runs stand after they have done the same once more: after one action each, or after motions that take the
/// same path in different parts, as an arc and its chords. `shift` leads from a's places to those of b. None if they
/// differ.
struct PlaceInBoth {
  std::size_t a = 0;
  std::size_t b = 0;
};
std::optional<PlaceInBoth> same_step(const RunPair& runs, const PlaceInBoth& place, const geometry::Vec3& shift,
                                     const OverlapListener& overlap = nullptr);

/// Whether both do the same, wherever they stand; not for motions.
bool is_same_effect(const RunPair& runs, const MachineAction& a, const MachineAction& b);

/// Whether two motions end in the same place.
bool ends_together(const RunPair& runs, const MachineAction& a, const MachineAction& b, const geometry::Vec3& shift);

/// Whether two motions between others that are shifted end in one place nevertheless, as a retract between two cuts
/// that are deeper.
bool ends_where_it_did(const RunPair& runs, const MachineAction& a, const MachineAction& b,
                       const geometry::Vec3& before, const geometry::Vec3& after);

/// Whether two motions between others end in place: with the shift of what comes before or after them, or where they
/// did.
bool ends_in_place(const RunPair& runs, const MachineAction& a, const MachineAction& b, const geometry::Vec3& before,
                   const geometry::Vec3& after);

/// Whether one motion goes where the other one does, from its start to its end, when it is shifted by what lies between
/// their starts and, more and more, by what lies between their ends. Where both are the same, that is the whole path. A
/// line goes the same way as any other one; an arc the other way around, of another radius or in place of a line does
/// not.
bool goes_same_way(const RunPair& runs, const MachineAction& a, const MachineAction& b);

/// Whether two arcs turn in opposite directions.
bool is_other_way_around(const RunPair& runs, const MachineAction& a, const MachineAction& b);

/// Whether two actions are the same but for what comes before them: a motion from elsewhere straight to the same
/// place is, an arc has to be the whole path.
bool is_same_action(const RunPair& runs, const MachineAction& a, const MachineAction& b, const geometry::Vec3& shift);

/// Aligns two runs, from their starts to their ends. `shift` leads from a's start to that of b. Takes time in
/// proportion to the actions and, for each difference, to the square of its size, up to a limit (docs/isodiff.md).
std::vector<AlignedPiece> align(const RunPair& runs, const geometry::Vec3& shift = geometry::Vec3::Zero());

}  // namespace isocnc::comparison
