#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "debugger/breakpoints/hit_condition.h"
#include "debugger/breakpoints/hit_counter.h"
#include "debugger/breakpoints/wanted_code.h"
#include "debugger/expressions/log_message.h"
#include "debugger/expressions/watched_value.h"

namespace isocnc::breakpoints {

/// When a breakpoint that has been reached counts, and what it does then.
struct BreakpointRules {
  std::string text;  ///< As the client has written them.
  std::optional<expressions::Expression> condition;
  std::optional<HitCondition> hits;
  std::optional<expressions::LogMessage> message;  ///< Reported in place of a stop.
};

/// A breakpoint of any kind.
struct Breakpoint {
  std::int64_t id = 0;
  BreakpointRules rules;
  HitCounter counter;
};

struct LineBreakpoint : Breakpoint {
  std::size_t line = 0;
};
struct FunctionBreakpoint : Breakpoint {
  WantedCode code;
};
struct DataBreakpoint : Breakpoint {
  expressions::WatchedValue watched;
};

}  // namespace isocnc::breakpoints
