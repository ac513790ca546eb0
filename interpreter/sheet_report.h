#pragma once

#include <string_view>

#include "analyzer/rules/check_setup.h"
#include "analyzer/selection/selection.h"
#include "interpreter/sheet/sheet.h"

namespace isocnc::interpreter {

/// Whether a file of this name can be a setup sheet: it ends in .html, .htm or .pdf, upper case too.
bool is_sheet_name(std::string_view file_name);

/// A setup sheet in the format that the name of its file asks for: what a run says of the program, and what a check and
/// runs on all paths find in it.
std::string sheet_file(std::string_view file_name, const sheet::SheetSubject& subject, const rules::CheckSetup& setup,
                       const selection::Selection& selection);

}  // namespace isocnc::interpreter
