#pragma once

#include <optional>
#include <string_view>

#include "analyzer/transforming/refusal.h"
#include "analyzer/transforming/transformation.h"
#include "interpreter/running/runner.h"

namespace isocnc::transforming {

/// Runs a program and its transformed text side by side, with the VGPL of `options`, and compares what the machine does
/// event by event: ends, centers and sweeps of motions, sides of compensation and feeds mapped, all else the same.
/// Nothing if all of it is as it must be; else the first line where it is not.
///
/// Until a program has given an axis, that axis is where the machine stood when it started, in both programs. Rapids
/// may come from there and leave it there; feed moves may not. What the error of a new program says is in `language`.
std::optional<TransformationRefusal> find_difference(std::string_view program, std::string_view transformed,
                                                     const ProgramMap& map, const running::RunOptions& options,
                                                     dialect::Language language);

/// The same for a part of a new program, which `new_run` has reached: it begins on the line `first_line` of that one,
/// and goes on to the end of both, or to before the line `end_line` of the old program. Where the machine does not come
/// from its home but from another part, `free_height` is the Z (machine frame, mm) from which on its rapids may start
/// elsewhere than those of the old program.
std::optional<TransformationRefusal> find_difference(running::Runner& old_run, running::Runner& new_run,
                                                     std::size_t first_line, std::optional<std::size_t> end_line,
                                                     const ProgramMap& map, dialect::Language language,
                                                     std::optional<double> free_height = {});

/// The error with which a run has ended: its code and its message in a language.
std::string error_text(const running::RunResult& result, dialect::Language language);

}  // namespace isocnc::transforming
