#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// The one of `names` that `typed` was most plausibly meant to be, capitals aside. None when none is near, or when
/// several are equally near: a guess would mislead. A name that was not written to its end is near.
std::optional<std::string> nearest_name(std::string_view typed, std::span<const std::string> names);

/// `; did you mean ISO031?`, or nothing.
std::string did_you_mean(const std::optional<std::string>& name, Language language);

}  // namespace isocnc::dialect
