#pragma once

#include <filesystem>

#include "interpreter/tool_library/library_tool.h"

namespace isocnc::tool_library {

/// Reads a library of tools by the ending of its name: `.json` and `.tools` of Fusion, `.fctb` and `.fctl` of FreeCAD
/// (whose tools are looked for beside it and in `../Bit`), `.json` and `.camotics` of CAMotics, `.tbl` of LinuxCNC,
/// `.csv`, `.tsv` and `.txt` with named columns. A library that names no unit counts in mm, or in inches.
Library read_library(const std::filesystem::path& file, bool is_in_inches, dialect::Language language);

/// The same, of the bytes of a file of this name that names no other; for fuzzing.
Library read_library_text(const std::string& name, std::string bytes, bool is_in_inches, dialect::Language language);

}  // namespace isocnc::tool_library
