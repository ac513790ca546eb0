#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "debugger/debuggee/debuggee.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::difference {

/// A program that the debugged one is compared with, and how it runs: with the registers and the VGPL of the launch.
struct ReferenceProgram {
  std::string name;  ///< For people: that of its file.
  std::string text;
  running::RunOptions options;
  timing::TimedMachine machine;
};

/// What a comparison has shown.
struct FirstDifference {
  /// Where the debugged program comes to do something else, from 0. None where it does the same, or where the other one
  /// does not run to its end.
  std::optional<std::size_t> line;
  std::string text;  ///< For people.
};

/// The program that is debugged, as it was launched, and its reference.
struct ReferenceComparison {
  std::shared_ptr<const debuggee::Debuggee> debuggee;
  running::RunOptions options;
  timing::TimedMachine machine;
  ReferenceProgram reference;
  dialect::Language language = dialect::Language::English;

  /// Runs both programs. Asks `stop` at intervals; the result has no meaning once that was true.
  FirstDifference find(const std::function<bool()>& stop) const;
};

}  // namespace isocnc::difference
