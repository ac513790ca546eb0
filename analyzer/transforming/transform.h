#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "analyzer/transforming/refusal.h"
#include "analyzer/transforming/transformation.h"

namespace isocnc::transforming {

/// The text of a program with its words changed, or repeated (Movement::Repeat), so that the machine does the
/// transformed of what it does by the original; all else in it stays byte for byte, and so do lines that no path
/// reaches. The result has been proved: both are run on every path that the IFs lead along, and each motion is compared
/// (find_difference). What cannot be right is refused, with the first line that shows it. A UTF-8 byte-order mark is
/// part of neither text. `language` is that of errors which a refusal quotes.
std::variant<std::string, TransformationRefusal> transform(std::string_view text, const Transformation& transformation,
                                                           const execution::Setup& setup, dialect::Language language);

}  // namespace isocnc::transforming
