#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "lsp/documents/timed_program.h"

namespace isocnc::lsp::documents {

/// A tool section, from its M06 to the next, as a run with VGPL 0 comes through it.
struct TimedSection {
  double start = 0;    ///< Seconds since the program's begin.
  double seconds = 0;  ///< That it takes.
  double mm = 0;       ///< Of the tool tip's path.
};

/// By the line of the M06; those that are whole. Line 0 without an M06 holds what comes before the first.
using Sections = std::map<std::uint64_t, TimedSection>;

/// `1:02:03`, to the second.
std::string clock_text(double seconds);

/// The tool sections of one document, timed once for each version. Any thread.
class SectionTimes {
 public:
  /// Those of the document; lives as long as somebody holds it.
  static std::shared_ptr<SectionTimes> of(const Snapshot& snapshot);

  /// What is known; null where that version has not been timed.
  std::shared_ptr<const Sections> known(const Snapshot& snapshot);
  /// Runs the program, unless that has been done. Throws as TimedProgram::run.
  std::shared_ptr<const Sections> time(const TimedProgram& program, const std::function<bool()>& stop);

 private:
  std::shared_ptr<const Sections> known(std::int64_t version, const configuration::Machine& machine);

  std::mutex mutex_;  // Guards all below.
  std::int64_t version_ = -1;
  const configuration::Machine* machine_ = nullptr;
  std::shared_ptr<const Sections> sections_;
};

}  // namespace isocnc::lsp::documents
