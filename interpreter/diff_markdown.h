#pragma once

#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::interpreter {

/// The changes between two programs, as `text` has them, below a heading: for the comments of a merge request. Nothing
/// in either is read as Markdown. A long text is folded; its last line remains to be seen.
std::string diff_markdown(std::string_view heading, std::string_view text);

}  // namespace isocnc::interpreter
