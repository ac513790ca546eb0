#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "debugger/breakpoints/breakpoints.h"

namespace isocnc::breakpoints {

/// A breakpoint in a line as the client wants it. It lies on the first line from there on that does something.
struct SourceBreakpoint {
  std::int64_t id = 0;
  std::size_t wanted_line = 0;      ///< From 0.
  std::optional<std::size_t> line;  ///< Where it lies; none where no such line follows, or its rules are wrong.
  BreakpointRules rules;
  std::string problem;  ///< Mistake in its rules, for people; empty for none.
};

}  // namespace isocnc::breakpoints
