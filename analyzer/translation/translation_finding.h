#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::translation {

/// Why something of a program cannot be written in the dialect.
enum class UntranslatableReason : std::uint8_t {
  Unreadable,
  Formula,
  Assignment,
  Statement,
  SkippedBlock,
  WordTwice,
  NumberTooLarge,
  UnknownG,
  UnknownWord,
  UnnamedFunction,
  SavedModes,
  RotaryAxis,
  ZeroPointMissing,
  ToolUnmapped,
  ToolNumberMissing,
  NoTool,
  ToolOffsetOfOther,
  LengthOff,
  LengthGiven,
  CompensationGiven,
  PolarCoordinates,
  ScaledOrMirrored,
  TiltedPlane,
  Rotation,
  FeedPerTurn,
  SurfaceSpeed,
  DiameterMode,
  NoMotionInForce,
  FeedMissing,
  FeedNotPositive,
  SpeedNotPositive,
  CenterMissing,
  ArcStartUnknown,
  ArcMismatch,
  ArcTurns,
  LostPlace,
  ModeUnknown,
  PlaceUnknown,
  AxesAfterRotation,
  MachineCoordinates,
  ReferenceMissing,
  CycleUnknown,
  CycleIncomplete,
  CycleDepth,
  RetractUnstated,
  CycleTooManyMoves,
  DwellMissing,
  SubprogramMissing,
  SubprogramsTooDeep,
  SubprogramsTooLong,
  NoSubprogram,
  EndlessProgram,
  OtherProgram,
  WholeNumber,
};

/// The message of a reason, with {0} and {1} for the values of its finding.
const dialect::Text& text_of(UntranslatableReason reason);

/// A place of a program that stays as a comment, and why.
struct TranslationFinding {
  UntranslatableReason reason = UntranslatableReason::Unreadable;
  std::size_t line = 1;
  std::size_t column = 1;           ///< In code points, from 1.
  std::vector<std::string> values;  ///< For the message.
  std::size_t repeats = 0;          ///< Further places with the same reason and values, left out.
  std::size_t last_line = 0;        ///< The last of them.

  std::string message(dialect::Language language) const;
};

/// The findings of a program in the order of their first places; those that repeat one are counted there.
class FindingList {
 public:
  void add(TranslationFinding finding);
  std::vector<TranslationFinding> take() { return std::move(findings_); }

 private:
  std::vector<TranslationFinding> findings_;
  std::map<std::pair<UntranslatableReason, std::vector<std::string>>, std::size_t> first_;
};

}  // namespace isocnc::translation
