#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "debugger/breakpoints/breakpoints.h"
#include "debugger/breakpoints/exception_filters.h"
#include "debugger/debuggee/surroundings.h"

namespace isocnc::breakpoints {

/// A moment within a block at which a run may stop: a contact, or a limit of a data breakpoint.
struct InnerMoment {
  double time = 0;  ///< Seconds since the start.
  std::optional<verification::Contact> contact;
  std::size_t limit = 0;  ///< Without a contact: index among the limits of the data breakpoints.
};

/// What comes of a moment.
struct MomentVerdict {
  std::optional<Exception> exception;
  Breakpoints::BreakpointOutcome outcome;

  bool stops() const { return exception || !outcome.stopped.empty(); }
};

/// Finds and judges the moments within blocks at which a run may stop.
class BlockWatch {
 public:
  /// Keeps references to all.
  BlockWatch(const ExceptionFilters& filters, Breakpoints& breakpoints, const debuggee::Surroundings& surroundings)
      : filters_(filters), breakpoints_(breakpoints), surroundings_(surroundings) {}

  /// Whether a run may stop within a block at all. The rest need not be called otherwise.
  bool is_on() const;
  /// Another number after each change of what stops a run.
  std::uint64_t revision() const { return filters_.revision() + breakpoints_.revision(); }

  /// Takes a simulation to the end of the block in progress or, between two blocks, of the next one. Returns the
  /// moments on the way at which a run may stop, by time.
  std::vector<InnerMoment> pass_block(simulation::Simulation& simulation) const;

  /// Judges a moment in a block; `at` is the state there.
  MomentVerdict judge(const InnerMoment& moment, expressions::Moment at, std::uint64_t block, RunDirection direction,
                      dialect::Language language) const;

 private:
  bool wants_contacts() const { return filters_.is_on(ExceptionFilter::Contacts); }

  const ExceptionFilters& filters_;
  Breakpoints& breakpoints_;
  const debuggee::Surroundings& surroundings_;
};

}  // namespace isocnc::breakpoints
