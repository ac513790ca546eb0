#pragma once

#include <string>

#include "interpreter/running/runner.h"

namespace isocnc::running {

/// The error that stopped a run, as text for a user.
std::string error_message(const RunResult& result, dialect::Language language);

}  // namespace isocnc::running
