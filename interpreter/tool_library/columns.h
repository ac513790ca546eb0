#pragma once

#include <string>
#include <vector>

#include "interpreter/configuration/configuration.h"

/// Tables of tools with named columns, as spreadsheets read and write them.
namespace isocnc::tool_library {

/// The tools as a table that columns of this name read again: T, then the keys of `machine.tools`. In Italian with
/// semicolons and decimal commas, as spreadsheets of that language have them.
std::string columns_of(const std::vector<configuration::Tool>& tools, dialect::Language language);

/// A list for the presetter: of each tool its place and name, the lengths that are expected, and empty columns for
/// those that are measured. Filled in, the importer takes it.
std::string presetter_list(const std::vector<configuration::Tool>& tools, dialect::Language language);

}  // namespace isocnc::tool_library
