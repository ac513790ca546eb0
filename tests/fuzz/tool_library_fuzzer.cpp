#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "interpreter/configuration/read.h"
#include "interpreter/tool_library/columns.h"
#include "interpreter/tool_library/read_library.h"
#include "interpreter/tool_library/tool_import.h"
#include "require.h"

namespace isocnc::fuzz {

/// A file that the import goes into, with comments, and a tool at a place of the map.
static constexpr std::string_view kConfiguration =
    "{\n  // The shop\n  \"machine\": {\n    \"tools\": [\n      {\"head\": 1, \"holder\": 1, \"tool\": 1, \"length\": "
    "100} // one\n"
    "    ]\n  }\n}\n";

/// Every library is read or refused, and what is read makes a valid file that has the comments, and in which a second
/// import changes nothing.
static void import(const std::string& name, const std::string& bytes) {
  using dialect::Language;
  const tool_library::Library library =
      tool_library::read_library_text(name, bytes, bytes.size() % 2 == 1, Language::Italian);
  if (!library.mistakes.empty()) return;
  tool_library::ToolMap map;
  int tool = 0;
  for (const tool_library::LibraryTool& each : library.tools)
    if (!each.number.empty() && tool < 900) map.places.try_emplace(each.number, execution::ToolCode{1, 1, ++tool});
  const configuration::ReadConfiguration before = configuration::read_configuration(kConfiguration, "/shop");
  const auto planned = tool_library::import_tools(before.configuration.machine, library, {.map = map});
  if (std::holds_alternative<std::string>(planned)) return;
  const auto& import = std::get<tool_library::ToolImport>(planned);
  require(!shown_import(import, Language::Italian).empty(), "an import is shown");
  const std::optional<std::string> changed = tool_library::with_import(kConfiguration, "/shop", import);
  require(changed.has_value(), "what is imported is valid");
  require(changed->find("// The shop") != std::string::npos, "comments stay");
  const configuration::ReadConfiguration after = configuration::read_configuration(*changed, "/shop");
  const auto again = tool_library::import_tools(after.configuration.machine, library, {.map = map});
  require(std::get<tool_library::ToolImport>(again).changes.empty(), "a second import changes nothing");
  const std::string table = tool_library::columns_of(*after.configuration.machine.tools, Language::Italian);
  const tool_library::Library read = tool_library::read_library_text("t.csv", table, false, Language::English);
  require(read.mistakes.empty() &&
              std::all_of(read.tools.begin(), read.tools.end(), [](const auto& tool) { return tool.mistakes.empty(); }),
          "a table that is written can be read");
  const auto same = tool_library::import_tools(after.configuration.machine, read, {});
  require(std::get<tool_library::ToolImport>(same).changes.empty(), "a table says all of the tools");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr std::array<const char*, 6> kNames{"t.json", "t.tools", "t.fctb", "t.tbl", "t.csv", "t.camotics"};
  const std::string_view text = isocnc::fuzz::as_text(data, size);
  if (text.empty()) return 0;
  const std::string name = kNames[static_cast<unsigned char>(text.front()) % kNames.size()];
  isocnc::fuzz::import(name, std::string(text.substr(1)));
  return 0;
}
