#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analyzer/fixes/fix.h"
#include "interpreter/execution/setup.h"

namespace isocnc::fixing {

/// Another way to write what a program does.
enum class Rewrite : std::uint8_t {
  ArcByRadius,  ///< R in the place of I, J, K: arcs of at most half a turn.
  ArcByCenter,  ///< I, J, K in the place of R.
  Incremental,  ///< Coordinates under G91.
  Absolute,     ///< Coordinates under G90.
  Inches,       ///< Lengths and feed rates under G70.
  Millimeters,  ///< Lengths and feed rates under G71.
};

/// Ends of motions agree within so many mm or degrees after a rewrite.
inline constexpr double kSamePlace = 1e-5;
/// Arcs agree within so many mm: their centers, their radii and the lengths of their ways.
inline constexpr double kSameArc = 1e-4;

/// The edits that write lines `first` to `last` (from 0) so, in the order of the program. They have been tried:
/// executed line by line from the state before the first, the new lines make the same motions at the same feed rates as
/// the old ones, and leave the machine in the same state. Nothing where that is not so, where nothing changes, where
/// the state before a line is not the same on all paths, or where a line has an error. Modes (the last four) are set
/// before the lines and set back behind them; there, no jump may lead out of the lines or into them.
std::optional<std::vector<fixes::Edit>> rewrite(Rewrite how, fixes::Program& program, const execution::Setup& setup,
                                                std::uint64_t first, std::uint64_t last);

}  // namespace isocnc::fixing
