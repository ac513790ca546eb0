#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "debugger/session/hit_condition.h"
#include "debugger/session/hit_counter.h"
#include "debugger/session/log_message.h"
#include "debugger/session/wanted_code.h"
#include "debugger/session/watched_value.h"

namespace isocnc::debugger::session {

/// When a breakpoint that has been reached counts, and what it does then.
struct BreakpointRules {
  std::string text;  ///< As the client has written them.
  std::optional<Expression> condition;
  std::optional<HitCondition> hits;
  std::optional<LogMessage> message;  ///< Reported in place of a stop.
};

/// A breakpoint of any kind.
struct Breakpoint {
  std::int64_t id = 0;
  BreakpointRules rules;
  HitCounter counter;
};

struct LineBreakpoint : Breakpoint {
  std::uint64_t line = 0;
};
struct FunctionBreakpoint : Breakpoint {
  WantedCode code;
};
struct DataBreakpoint : Breakpoint {
  WatchedValue watched;
};

}  // namespace isocnc::debugger::session
