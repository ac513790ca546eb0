#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/tool_library/library_tool.h"
#include "interpreter/tool_library/tool_map.h"

namespace isocnc::tool_library {

/// What a library would change in the tools of a machine. A tool of the machine keeps the keys that the library does
/// not know, and tools that the library does not have stay.
struct ToolImport {
  /// A key with its values as JSON; empty for none.
  struct Value {
    std::string key;
    std::string before;
    std::string after;
  };
  /// A tool that comes in, or changes.
  struct ImportedTool {
    configuration::Tool tool;  ///< As it will be.
    bool is_new = false;
    std::vector<Value> values;
    dialect::Text left_out;  ///< What the library says of it that cannot be told, and why; empty for nothing. {0} is
                             ///< `left_out_name`.
    std::string left_out_name;
  };
  /// A holder that comes in. Those of the machine stay as they are.
  struct NewHolder {
    configuration::NamedRows holder;
  };
  /// A tool of the library that does not come in.
  struct Refused {
    std::string number;
    std::string name;
    dialect::Text why;                        ///< Empty with mistakes.
    std::vector<configuration::Named> names;  ///< For the placeholders of `why`.
    std::vector<std::string> mistakes;        ///< What is wrong with its entry in the library, with file and place.
  };

  std::vector<ImportedTool> changes;  ///< In the order of T.
  std::vector<NewHolder> holders;
  std::size_t unchanged = 0;
  std::vector<configuration::Tool> kept;  ///< Of the machine, unknown to the library.
  std::vector<Refused> refused;           ///< In the order of the library.
  std::vector<std::string> unused;        ///< Keys of the map that no tool of the library has.
};

/// How a library comes in.
struct ImportOptions {
  ToolMap map;
  /// Keys that stay as the machine has them, where it has them: `length`, which is measured there. Names of
  /// tool_key_names().
  std::vector<std::string> kept;
  dialect::Language language = dialect::Language::English;
};

/// What to change, or why that is not clear, one message a line: two tools at one place, or a key of the map that means
/// two tools.
std::variant<ToolImport, std::string> import_tools(const configuration::MachineConfiguration& machine,
                                                   const Library& library, const ImportOptions& options);

/// The keys of a tool besides its place, in the order of their table.
std::vector<std::string> tool_key_names();

/// Whether an entry of the library is mistaken, and so not taken.
bool has_mistaken_entry(const ToolImport& import);

/// The difference, for people.
std::string shown_import(const ToolImport& import, dialect::Language language);

/// The text of an isocnc.json, or of a machine's file, with the import done; comments and layout stay. An empty text
/// becomes a new file. None if the result would be no valid configuration, as one that is too large to be read again.
std::optional<std::string> with_import(std::string_view text, const std::filesystem::path& folder,
                                       const ToolImport& import);

}  // namespace isocnc::tool_library
