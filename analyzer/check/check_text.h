#pragma once

#include <functional>
#include <string_view>

#include "analyzer/check/report.h"
#include "interpreter/execution/setup.h"

namespace isocnc::check {

/// Checks a whole program, reading it once from top to bottom; nothing of it is kept but its findings. With more than
/// one job, lines are parsed side by side while one thread at a time executes them in order; the report is the same.
/// `on_progress` is called now and then with the bytes that have been checked, by one thread at a time.
Report check_text(std::string_view text, const execution::Setup& setup, int jobs = 1,
                  const std::function<void(std::size_t)>& on_progress = {});

}  // namespace isocnc::check
