#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "interpreter/comparison/machine_action.h"

namespace isocnc::overlay {

/// A program with what the machine does in its run.
struct AlignedProgram {
  std::string_view text;
  const comparison::RecordedRun& run;
};

/// Lines of two programs that stand beside each other: so many of the old one beside so many of the new one, and that
/// `repeats` times. They do the same, or those of one program take the place of the others. Where a count is 0, only
/// the other program has such lines.
struct AlignedLines {
  std::size_t old_count = 0;
  std::size_t new_count = 0;
  std::size_t repeats = 1;

  friend bool operator==(const AlignedLines&, const AlignedLines&) = default;
};

/// All lines of both programs, in their order. Lines are aligned by what the machine does in them, as compare() aligns
/// it; those that do nothing, between these, by their text without block numbers. `tolerance` as for compare().
std::vector<AlignedLines> aligned_lines(const AlignedProgram& old_program, const AlignedProgram& new_program,
                                        double tolerance);

}  // namespace isocnc::overlay
