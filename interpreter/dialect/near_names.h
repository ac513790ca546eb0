#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// The one of `names` that was probably meant by `typed`, in any case. Nothing when no name is near, or when several
/// are equally near: a guess would mislead. A prefix of a name is near it.
std::optional<std::string> nearest_name(std::string_view typed, std::span<const std::string> names);

/// `; did you mean ISO031?`, or nothing.
std::string did_you_mean(const std::optional<std::string>& name, Language language);

}  // namespace isocnc::dialect
