#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/comparison/comparison.h"
#include "interpreter/comparison/comparison_text.h"

namespace isocnc::comparison {

/// A machine whose head turns and whose tools have lengths.
inline timing::TimedMachine machine_of_tests() {
  timing::TimedMachine machine{.motion = kinematics::head_router()};
  for (kinematics::AxisLimits& axis : machine.motion.axes) axis.minimum = -1e6, axis.maximum = 1e6;
  machine.tool_radii = {{execution::tool_code(101001), 3}};
  return machine;
}

inline RecordedRun recorded(std::string_view program, double vgpl = 0) {
  static const timing::TimedMachine machine = machine_of_tests();
  running::RunOptions options;
  options.vgpl = vgpl;
  return record(program, options, machine);
}

inline std::vector<BehaviorChange> changes_between(std::string_view old_program, std::string_view new_program,
                                                   const ComparisonOptions& options = {}) {
  return compare(recorded(old_program), recorded(new_program), options);
}

/// `moved 6-7|6-7: moved by X1`, a line for each change.
inline std::string shown(const std::vector<BehaviorChange>& changes) {
  std::string text;
  const auto lines = [](const std::optional<ChangedLines>& range) {
    if (!range) return std::string("-");
    std::string shown = std::to_string(range->first + 1);
    if (range->last != range->first) shown += "-" + std::to_string(range->last + 1);
    return shown;
  };
  for (const BehaviorChange& change : changes)
    text += std::string(name_of(change.kind)) + ' ' + lines(change.old_lines) + '|' + lines(change.new_lines) + ": " +
            in_words(change, dialect::Language::English) + '\n';
  return text;
}

}  // namespace isocnc::comparison
