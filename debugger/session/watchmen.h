#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/timing.h"

namespace isocnc::debugger::session {

/// What the debugger can stop for by itself: the filters of exceptions.
enum class Watch : std::uint8_t { Errors, Warnings, Limits, ToolChange, FirstCut };
inline constexpr std::size_t kWatchCount = 5;

struct WatchDef {
  std::string_view name;  ///< In the protocol.
  dialect::Text label;
  dialect::Text description;
  bool is_default = false;
};
const WatchDef& definition(Watch watch);
std::optional<Watch> find_watch(std::string_view name);

/// What a run has been stopped for that is no breakpoint.
struct Exception {
  Watch watch = Watch::Errors;
  std::string code;         ///< `ISO031`, or the name of the watch.
  std::string message;      ///< One line.
  std::string explanation;  ///< All that is known of the code; may be empty.
};

/// A warning of the checker, at its line.
struct Warning {
  dialect::DiagnosticId id = dialect::kNoDiagnostic;
  std::string message;
};

/// Looks at each block before it is executed.
class Watchmen {
 public:
  /// Which watches are on.
  std::array<bool, kWatchCount> on{};
  /// Findings by line, when they have been looked for.
  std::multimap<std::uint64_t, Warning> warnings;

  bool is_on(Watch watch) const { return on[static_cast<std::size_t>(watch)]; }
  /// Whether look_at() can find anything: it is not called for nothing.
  bool looks_at_blocks() const;
  std::optional<Exception> look_at(const running::Block& block, const execution::Setup& setup,
                                   const simulation::TimedMachine& machine, dialect::Language language) const;

 private:
  std::optional<Exception> look_at_warnings(const running::Block& block, dialect::Language language) const;
};

}  // namespace isocnc::debugger::session
