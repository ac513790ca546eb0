#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "analyzer/fixes/fix.h"
#include "interpreter/execution/setup.h"

namespace isocnc::fixing {

/// Another notation for what a program does.
enum class Rewrite : std::uint8_t {
  ArcByRadius,  ///< R instead of I, J, K: arcs of at most half a turn.
  ArcByCenter,  ///< I, J, K instead of R.
  Incremental,  ///< Coordinates under G91.
  Absolute,     ///< Coordinates under G90.
  Inches,       ///< Lengths and feed rates under G70.
  Millimeters,  ///< Lengths and feed rates under G71.
};

/// The maximum difference between the ends of motions after a rewrite, in mm or degrees.
inline constexpr double kSamePlace = 1e-5;
/// The maximum difference between arcs after a rewrite, in mm: of their centers, radii and path lengths.
inline constexpr double kSameArc = 1e-4;

/// The edits that rewrite lines `first` to `last` (from 0), in the order of the program. They have been tried: executed
/// line by line from the state before the first, the new lines make the same motions at the same feed rates as the old
/// ones, and leave the machine in the same state. Nothing if that fails, if nothing changes, if the state before a line
/// differs between paths, or if a line has an error. Modes (the last four rewrites) are set before the lines and reset
/// after them; for these, no jump may lead out of the lines or into them.
std::optional<std::vector<fixes::Edit>> rewrite(Rewrite how, fixes::FixProgram& program, const execution::Setup& setup,
                                                std::size_t first, std::size_t last);

}  // namespace isocnc::fixing
