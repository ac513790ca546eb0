#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "interpreter/geometry/range.h"
#include "lsp/queries/timed_program.h"

namespace isocnc::queries {

/// The times of a tool section, from its M06 to the next, in a run with VGPL 0.
struct TimedSection {
  double start = 0;    ///< In seconds from the start of the program.
  double seconds = 0;  ///< The duration of the section in seconds.
  double mm = 0;       ///< The length of the tool tip's path in mm.
  bool has_feed_move = false;
  std::array<geometry::Range, 3> cut;  ///< Of the tip in feed moves, machine frame, mm; meaningless without any.
};

/// The completed tool sections by the line of their M06. Line 0, unless it has an M06, stands for the part before the
/// first.
using Sections = std::map<std::size_t, TimedSection>;

/// Text such as `1:02:03`, rounded to seconds.
std::string clock_text(double seconds);

/// The tool sections of one document, timed once for each version. May be used on any thread.
class SectionTimes {
 public:
  /// The times of the document, shared by all features that hold the pointer.
  static std::shared_ptr<SectionTimes> of(const documents::Snapshot& snapshot);

  /// The known times; null if this version has not been timed.
  std::shared_ptr<const Sections> known(const documents::Snapshot& snapshot);
  /// Runs the program, unless this version has been timed already. Throws like TimedProgram::run().
  std::shared_ptr<const Sections> time(const TimedProgram& program, const std::function<bool()>& stop);

 private:
  std::shared_ptr<const Sections> known(std::int64_t version, const configuration::MachineConfiguration& machine);

  std::mutex mutex_;  // Guards the members below.
  std::int64_t version_ = -1;
  const configuration::MachineConfiguration* machine_ = nullptr;
  std::shared_ptr<const Sections> sections_;
};

}  // namespace isocnc::queries
