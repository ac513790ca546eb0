#pragma once

#include <functional>
#include <string_view>

#include "analyzer/check/report.h"
#include "analyzer/rules/check_setup.h"

namespace isocnc::check {

/// Checks a whole program in one pass from top to bottom; keeps nothing but the findings. With more than one job,
/// threads execute portions of it ahead, from a state that is assumed; the report is the same. `on_progress` is called
/// now and then with the number of bytes checked, by one thread at a time.
Report check_text(std::string_view text, const rules::CheckSetup& setup, int jobs = 1,
                  const std::function<void(std::size_t)>& on_progress = {});

}  // namespace isocnc::check
