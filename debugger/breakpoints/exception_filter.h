#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::breakpoints {

/// A reason to stop that is no breakpoint, which the client can turn on and off.
enum class ExceptionFilter : std::uint8_t { Errors, Warnings, Limits, Contacts, Run, ToolChange, FirstCut };
inline constexpr std::size_t kExceptionFilterCount = 7;

/// What the client learns about an exception filter.
struct ExceptionFilterDef {
  std::string_view name;  ///< In the protocol.
  dialect::Text label;
  dialect::Text description;
  bool is_default = false;
  bool takes_condition = false;  ///< Whether it may have a condition, judged where the run would stop.
};

const ExceptionFilterDef& definition(ExceptionFilter filter);

/// The filter with this name in the protocol; none where there is no such filter.
std::optional<ExceptionFilter> find_exception_filter(std::string_view name);

}  // namespace isocnc::breakpoints
