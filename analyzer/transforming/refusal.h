#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::transforming {

/// How often a program is run at most, with other values of VGPL and of registers that it does not set.
inline constexpr std::size_t kMaxRuns = 64;

/// What prevents a transformation, on a line.
enum class TransformObstacle : std::uint8_t {
  ProgramError,   ///< The program does not run to its M02.
  TooManyPaths,   ///< The values that IFs compare have more combinations than kMaxRuns.
  OnTwoPaths,     ///< Two paths lead there, and what would have to be written differs.
  FeedInMachine,  ///< A feed move in the machine frame of a program that has a workpiece frame.
  PlaneRotated,   ///< An arc in G18 or G19 would leave its plane.
  StartUnknown,   ///< A feed move from a place that the program has not given, such as home.
  FaceUnknown,    ///< A face would not be where the transformation puts it.
  PlaceDiffers,   ///< The motion would end elsewhere.
  ArcDiffers,     ///< It would have another center or sweep.
  SideDiffers,    ///< G41 and G42 would lead it beside the path on the wrong side.
  FeedDiffers,    ///< It would have another feed.
  EffectDiffers,  ///< Something else than a motion would be done.
  CopyStartsLow,  ///< A copy would begin with a rapid below the highest place of the program, or with B or C turned.
  JumpRepeated,   ///< An IF: the labels of jumps would be there several times.
  NewError,       ///< The new program would stop there.
};

/// Why a program is not transformed, and where.
struct TransformationRefusal {
  TransformObstacle obstacle = TransformObstacle::ProgramError;
  std::size_t line = 0;  ///< From 0.
  std::string detail;    ///< The error's code and message.

  /// As text for an operator, in one line without the name of the file.
  std::string message(dialect::Language language) const;
};

}  // namespace isocnc::transforming
