#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "debugger/expressions/expression.h"

namespace isocnc::expressions {

/// Values that data breakpoints watch, at moments that follow one another.
struct ValueTrail {
  std::size_t width = 0;  ///< Values of each moment.
  std::vector<double> values;
};

/// What a data breakpoint watches: a value that becomes another one, that passes a threshold, or that of the
/// surroundings where it comes to be beyond a limit.
struct WatchedValue {
  Expression value;
  std::string name;                 ///< As the client wrote it.
  std::optional<double> threshold;  ///< `Z = 0`: crossed when the value comes to it or passes it.

  std::optional<debuggee::SurroundingsLimit> limit;  ///< `CLEARANCE < 5`: found within blocks, on no trail.

  /// `V3`, `Z`, `Z = 0`, `CLEARANCE < 5`.
  static std::variant<WatchedValue, ExpressionProblem> compile(std::string_view text, dialect::Language language);

  /// The values before and after the first change on the trail, where this value has the given place in each moment.
  /// Without a threshold only the ends of the trail count.
  std::optional<std::pair<double, double>> find_change(const ValueTrail& trail, std::size_t place) const;

 private:
  bool is_change(double before, double after) const;
};

}  // namespace isocnc::expressions
