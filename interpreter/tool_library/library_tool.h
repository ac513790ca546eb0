#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpreter/configuration/configuration.h"

namespace isocnc::tool_library {

/// A tool as the library of another program describes it. Lengths in mm, rounded to 10 nm where they were in another
/// unit.
struct LibraryTool {
  std::string number;  ///< By which the library counts it; empty: none.
  configuration::Tool
      tool;  ///< Its name and the keys of `machine.tools` that the library knows; the code only with `has_place`.
  bool has_place = false;                          ///< Whether the library itself says head, holder and tool.
  std::optional<configuration::NamedRows> holder;  ///< Named by `tool.body`, as in `machine.holders`.
  std::string kind_without_shape;  ///< What the library calls a tool that no key can describe, such as a thread mill.
  std::vector<std::string> mistakes;  ///< What is wrong with its entry, one a line, with file and place. Where there is
                                      ///< one, it does not come in, and its keys may be missing.
};

/// What a library holds, or what is wrong with it.
struct Library {
  std::vector<LibraryTool> tools;     ///< In the order of the file.
  std::vector<std::string> ignored;   ///< Columns of a table that nothing here is called by.
  std::vector<std::string> mistakes;  ///< Of the file as a whole, one a line, with file and place. Where there is one,
                                      ///< no tool counts.
};

}  // namespace isocnc::tool_library
