#pragma once

#include <string>

#include "interpreter/running/runner.h"

namespace isocnc::running {

/// What stopped a run that ended in an error, for people.
std::string error_message(const RunResult& result, dialect::Language language);

}  // namespace isocnc::running
