#include "interpreter/tool_library/tool_map.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "interpreter/system/paths.h"
#include "interpreter/text/unicode.h"
#include "interpreter/tool_library/library_reader.h"

namespace isocnc::tool_library {

using configuration::JsonMember;
using configuration::JsonValue;
using dialect::Text;
using execution::ToolCode;

/// More than any shop writes.
static constexpr std::size_t kLargestMap = 1024 * 1024;  // Bytes.

static constexpr Text kNeedsWholePlace{"{0} has no tool: all of head, holder and tool are needed here",
                                       "{0} è senza utensile: qui ci vogliono testa, portautensile e utensile"};

std::variant<ToolCode, Text> read_tool_place(std::string_view text) {
  if (text.starts_with('T') || text.starts_with('t')) text.remove_prefix(1);
  int number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.size() != 6 || text.front() == '-' || read.ec != std::errc{} || read.ptr != text.data() + text.size())
    return map_problems::kNoToolPlace;
  const ToolCode code = execution::tool_code(number);
  if ((code.tool > 0 && code.holder == 0) || (code.holder > 0 && code.head == 0)) return map_problems::kPlaceIncomplete;
  return code;
}

std::string unread_message(const std::filesystem::path& file, const system::FileBytesProblem& problem,
                           const Text& too_large, dialect::Language language) {
  using Kind = system::FileBytesProblem::Kind;
  const std::string_view why = problem.kind == Kind::TooLarge     ? too_large.in(language)
                               : problem.kind == Kind::NotRegular ? configuration::mistakes::kNoFile.in(language)
                                                                  : std::string_view(problem.message);
  return fmt::format("{}: {}", text::printable(system::generic_name(file)), why);
}

static void read_tools(const JsonValue& tools, LibraryFile& file, ToolMap& map) {
  if (tools.kind != JsonValue::Kind::Object) return file.fail(tools.at, "tools", configuration::mistakes::kNeedsObject);
  for (const JsonMember& member : tools.members) {
    const std::string key = "tools." + configuration::shortened(member.key);
    if (map.places.contains(member.key)) {
      file.fail(member.at, key, map_problems::kTwiceInMap);
      continue;
    }
    if (member.value.kind != JsonValue::Kind::String) {
      file.fail(member.value.at, key, configuration::mistakes::kNeedsText);
      continue;
    }
    const std::string written = configuration::shortened(member.value.string);
    const auto place = read_tool_place(member.value.string);
    if (const Text* const why = std::get_if<Text>(&place)) {
      file.fail(member.value.at, key, *why, {written});
      continue;
    }
    const auto code = std::get<ToolCode>(place);
    if (code == ToolCode()) continue;  // T000000: the tool is put away.
    const auto other =
        std::find_if(map.places.begin(), map.places.end(), [&](const auto& each) { return each.second == code; });
    if (code.tool == 0) {
      file.fail(member.value.at, key, kNeedsWholePlace, {written});
    } else if (other != map.places.end()) {
      file.fail(member.value.at, key, map_problems::kTwoAtOnePlace, {other->first, written});
    } else {
      map.places.emplace(member.key, code);
    }
  }
}

std::variant<ToolMap, std::string> load_tool_map(const std::filesystem::path& path, dialect::Language language) {
  auto bytes = system::read_bytes(path, kLargestMap, language);
  if (const auto* problem = std::get_if<system::FileBytesProblem>(&bytes))
    return unread_message(path, *problem, configuration::mistakes::kTooLarge, language);
  LibraryFile file(text::printable(system::generic_name(path)), std::get<std::string>(std::move(bytes)), language);
  auto parsed = configuration::parse_json(file.text());
  ToolMap map;
  if (const auto* const mistake = std::get_if<configuration::Mistake>(&parsed)) {
    file.fail(mistake->at, mistake->key, mistake->text, mistake->names);
  } else if (const JsonValue& root = std::get<JsonValue>(parsed); root.kind != JsonValue::Kind::Object) {
    file.fail(root.at, {}, configuration::mistakes::kNeedsObject);
  } else {
    if (const JsonValue* const units = member_of(root, "units")) {
      map.is_in_inches = units->string == "inch";
      if (!map.is_in_inches && units->string != "mm")
        file.fail(units->at, "units", map_problems::kNoChoiceOf,
                  {configuration::shortened(units->string), std::string("mm, inch")});
    }
    if (const JsonValue* const tools = member_of(root, "tools")) read_tools(*tools, file, map);
  }
  if (file.mistakes().empty()) return map;
  return fmt::format("{}", fmt::join(file.mistakes(), "\n"));
}

}  // namespace isocnc::tool_library
