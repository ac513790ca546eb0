#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "analyzer/transforming/refusal.h"
#include "analyzer/transforming/transformation.h"

namespace isocnc::transforming {

/// A program that does the same once more for each place of a grid: the rows one after the other, each copy with all of
/// its tool changes. Before each copy after the first one stand a comment and what brings back the modes in force at
/// the start. `transformation` is Movement::Repeat. The result has been proved: it is run beside each copy, which is
/// the program shifted to its place (transform()), and each motion is compared. A program with jumps is refused.
std::variant<std::string, TransformationRefusal> repeated(std::string_view text, const Transformation& transformation,
                                                          const execution::Setup& setup, dialect::Language language);

}  // namespace isocnc::transforming
