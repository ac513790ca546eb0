#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "interpreter/configuration/mistake.h"
#include "interpreter/execution/setup.h"
#include "interpreter/system/source_file.h"

namespace isocnc::tool_library {

/// The place of a tool as shops write it, `101001` or `T101001`: head, holder and tool, of which `100000` and `101000`
/// have only the first. Otherwise why it is none, with {0} for what is written.
std::variant<execution::ToolCode, dialect::Text> read_tool_place(std::string_view text);

/// Why a file has no text for its reader, with its name: `map.json: not a file`. `too_large` says so of files beyond
/// the limit.
std::string unread_message(const std::filesystem::path& file, const system::FileBytesProblem& problem,
                           const dialect::Text& too_large, dialect::Language language);

/// Where the tools of a library stand in the machine.
struct ToolMap {
  std::map<std::string, execution::ToolCode> places;  ///< By the number or the name of the library.
  bool is_in_inches = false;                          ///< Whether a library that names no unit counts in inches.
};

/// The map in a file: `{"tools": {"1": "T101001", "ball 6": "T102003"}, "units": "mm"}`, which may also hold what
/// translations take. Or the messages of what is wrong with it, one a line.
std::variant<ToolMap, std::string> load_tool_map(const std::filesystem::path& file, dialect::Language language);

namespace map_problems {
inline constexpr dialect::Text kNoToolPlace{
    "{0} is no place of a tool: six digits for head, holder and tool, such as \"101001\"",
    "{0} non è un posto di utensile: sei cifre per testa, portautensile e utensile, come \"101001\""};
inline constexpr dialect::Text kPlaceIncomplete{
    "{0}: a tool needs a holder, and a holder a head",
    "{0}: un utensile vuole un portautensile, e un portautensile una testa"};
inline constexpr dialect::Text kTwoAtOnePlace{"tool {0} is at {1} already", "a {1} c'è già l'utensile {0}"};
inline constexpr dialect::Text kTwiceInMap{"this key is in the map already", "questa chiave è già nella mappa"};
inline constexpr dialect::Text kNoChoiceOf{"{0} is not one of {1}", "{0} non è fra {1}"};
}  // namespace map_problems

}  // namespace isocnc::tool_library
