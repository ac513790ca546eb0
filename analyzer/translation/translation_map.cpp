#include "analyzer/translation/translation_map.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include "interpreter/configuration/json_value.h"
#include "interpreter/configuration/read.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/source_file.h"
#include "interpreter/text/unicode.h"
#include "interpreter/tool_library/tool_map.h"

namespace isocnc::translation {

namespace map_problems = tool_library::map_problems;

using configuration::JsonMember;
using configuration::JsonValue;
using configuration::Mistake;
using dialect::Text;
using geometry::Vec3;

namespace {

constexpr Text kNeedsPoint{"three numbers are needed here, [X, Y, Z] in mm",
                           "qui ci vogliono tre numeri, [X, Y, Z] in mm"};
constexpr Text kNeedsClearance{"a length above 0 is needed here, in mm", "qui ci vuole una lunghezza sopra 0, in mm"};
constexpr Text kNoToolNumber{"{0} is no tool number, such as \"1\"", "{0} non è un numero di utensile, come \"1\""};
constexpr Text kNoZeroName{"{0} is none of G54 to G59, G59.1 to G59.3", "{0} non è fra G54 e G59, o fra G59.1 e G59.3"};
constexpr Text kNoReferenceName{"{0} is neither G28 nor G30", "{0} non è né G28 né G30"};
constexpr Text kNoFunctionName{"{0} is no M that may be mapped: M00 to M999 but M02 to M06, M30, M98 and M99",
                               "{0} non è una M che si possa indicare: da M00 a M999 tranne da M02 a M06, M30, M98 e "
                               "M99"};
constexpr Text kNoShopFunction{"{0} is no M of the shop: M1 or M7 to M999, or null to leave it out",
                               "{0} non è una M dell'officina: M1 o da M7 a M999, o null per ometterla"};
constexpr Text kNoOffsetName{"{0} is neither H nor D", "{0} non è né H né D"};
constexpr Text kNeedsOffset{"a whole number from 0 to 999 is needed here", "qui ci vuole un numero intero da 0 a 999"};
constexpr double kMaxOffset = 999;
constexpr double kFarthest = 1e6;  // mm.

/// The whole number after a letter, `M08`; -1 if the text is none.
int number_after(char letter, std::string_view text) {
  if (text.size() < 2 || text.size() > 5 || (text.front() != letter && text.front() != letter + ('a' - 'A'))) return -1;
  int number = -1;
  const auto result = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  return result.ec == std::errc{} && result.ptr == text.data() + text.size() ? number : -1;
}

/// The G of a zero point in tenths; -1 if it is none.
int zero_name(std::string_view text) {
  const std::size_t point = std::min(text.find('.'), text.size());
  const int whole = number_after('G', text.substr(0, point));
  if (whole < 54 || whole > 59) return -1;
  if (point == text.size()) return whole * 10;
  const bool is_further = whole == 59 && text.size() == point + 2 && text.back() >= '1' && text.back() <= '3';
  return is_further ? whole * 10 + (text.back() - '0') : -1;
}

bool is_mappable_function(int number) {
  return number >= 0 && !(number >= 2 && number <= 6) && number != 30 && number != 98 && number != 99;
}

/// Reads the members of the map; what is wrong is collected.
class MapReader {
 public:
  std::variant<TranslationMap, std::vector<Mistake>> read(std::string_view text) {
    auto parsed = configuration::parse_json(text);
    if (const auto* mistake = std::get_if<Mistake>(&parsed)) return std::vector{*mistake};
    each_member(std::get<JsonValue>(parsed), "", [&](const JsonMember& member) { read_key(member); });
    if (!mistakes_.empty()) return std::move(mistakes_);
    return std::move(map_);
  }

 private:
  static constexpr std::size_t kMaxMistakes = 100;

  void fail(std::size_t at, std::string key, const Text& text, std::vector<configuration::Named> names = {}) {
    if (mistakes_.size() < kMaxMistakes) mistakes_.push_back({at, std::move(key), text, std::move(names), {}});
  }

  template <class Function>
  void each_member(const JsonValue& value, const std::string& key, Function&& read_member) {
    if (value.kind != JsonValue::Kind::Object) return fail(value.at, key, configuration::mistakes::kNeedsObject);
    std::map<std::string, std::size_t> seen;
    for (const JsonMember& member : value.members) {
      if (!seen.try_emplace(member.key, member.at).second)
        fail(member.at, key.empty() ? member.key : key + "." + member.key, map_problems::kTwiceInMap);
      else
        read_member(member);
    }
  }

  void read_key(const JsonMember& member) {
    const auto each = [&](auto read_member) { each_member(member.value, member.key, read_member); };
    if (member.key == "tools") return each([&](const JsonMember& tool) { read_tool(tool); });
    if (member.key == "zeros") return each([&](const JsonMember& zero) { read_zero(zero); });
    if (member.key == "references") return each([&](const JsonMember& point) { read_reference(point); });
    if (member.key == "functions") return each([&](const JsonMember& function) { read_function(function); });
    if (member.key == "offsets") return each([&](const JsonMember& offset) { read_offset(offset); });
    if (member.key == "start") {
      if (auto code = tool_place(member.value, member.key)) map_.start = std::move(*code);
      return;
    }
    if (member.key == "units")
      return read_choice(member, {"mm", "inch"}, [&](bool inch) { map_.starts_in_inches = inch; });
    if (member.key == "wholeNumbers")
      return read_choice(member, {"units", "thousandths"}, [&](bool small) { map_.counts_thousandths = small; });
    if (member.key == "peckClearance") return read_clearance(member);
    fail(member.at, member.key, configuration::mistakes::kUnknownKey);
  }

  static std::string path_of(std::string_view key, const JsonMember& member) {
    return fmt::format("{}.{}", key, configuration::shortened(member.key));
  }

  std::optional<std::string> tool_place(const JsonValue& value, const std::string& key) {
    if (value.kind != JsonValue::Kind::String) {
      fail(value.at, key, configuration::mistakes::kNeedsText);
      return std::nullopt;
    }
    const auto place = tool_library::read_tool_place(value.string);
    if (const Text* const why = std::get_if<Text>(&place)) {
      fail(value.at, key, *why, {configuration::shortened(value.string)});
      return std::nullopt;
    }
    const auto& code = std::get<execution::ToolCode>(place);
    return fmt::format("{}{:02}{:03}", code.head, code.holder, code.tool);
  }

  void read_tool(const JsonMember& member) {
    const std::string key = path_of("tools", member);
    int number = -1;
    const char* const end = member.key.data() + member.key.size();
    const auto result = std::from_chars(member.key.data(), end, number);
    if (result.ec != std::errc{} || result.ptr != end || number < 0)
      return fail(member.at, key, kNoToolNumber, {configuration::shortened(member.key)});
    if (map_.tools.contains(number)) return fail(member.at, key, map_problems::kTwiceInMap);  // "1" and "01".
    const auto code = tool_place(member.value, key);
    if (!code) return;
    for (const auto& [other, place] : map_.tools)
      if (place == *code && *code != "000000")
        return fail(member.value.at, key, map_problems::kTwoAtOnePlace, {std::to_string(other), *code});
    map_.tools[number] = *code;
  }

  std::optional<Vec3> point(const JsonValue& value, const std::string& key) {
    const auto is_number = [](const JsonValue& element) {
      return element.kind == JsonValue::Kind::Number && std::abs(element.number) <= kFarthest;
    };
    const bool is_point = value.kind == JsonValue::Kind::List && value.elements.size() == 3 &&
                          std::all_of(value.elements.begin(), value.elements.end(), is_number);
    if (!is_point) {
      fail(value.at, key, kNeedsPoint);
      return std::nullopt;
    }
    return Vec3(value.elements[0].number, value.elements[1].number, value.elements[2].number);
  }

  void read_zero(const JsonMember& member) {
    const std::string key = path_of("zeros", member);
    const int name = zero_name(member.key);
    if (name < 0) return fail(member.at, key, kNoZeroName, {configuration::shortened(member.key)});
    if (map_.zeros.contains(name)) return fail(member.at, key, map_problems::kTwiceInMap);  // "G54" and "g54".
    if (const auto at = point(member.value, key)) map_.zeros[name] = *at;
  }

  void read_reference(const JsonMember& member) {
    const std::string key = path_of("references", member);
    const int name = number_after('G', member.key);
    if (name != 28 && name != 30) return fail(member.at, key, kNoReferenceName, {configuration::shortened(member.key)});
    if (map_.references.contains(name * 10)) return fail(member.at, key, map_problems::kTwiceInMap);
    if (const auto at = point(member.value, key)) map_.references[name * 10] = *at;
  }

  void read_function(const JsonMember& member) {
    const std::string key = path_of("functions", member);
    const int name = number_after('M', member.key);
    if (!is_mappable_function(name))
      return fail(member.at, key, kNoFunctionName, {configuration::shortened(member.key)});
    if (map_.functions.contains(name)) return fail(member.at, key, map_problems::kTwiceInMap);  // "M8" and "M08".
    if (member.value.kind == JsonValue::Kind::Null) {
      map_.functions[name] = 0;
      return;
    }
    if (member.value.kind != JsonValue::Kind::String)
      return fail(member.value.at, key, configuration::mistakes::kNeedsText);
    const int number = number_after('M', member.value.string);
    if (number < 1 || number > 999 || (number >= 2 && number <= 6))
      return fail(member.value.at, key, kNoShopFunction, {configuration::shortened(member.value.string)});
    map_.functions[name] = number;
  }

  /// `"D": 30`: the radius of T1 is at D31.
  void read_offset(const JsonMember& member) {
    const std::string key = path_of("offsets", member);
    if (member.key != "H" && member.key != "D")
      return fail(member.at, key, kNoOffsetName, {configuration::shortened(member.key)});
    const JsonValue& value = member.value;
    const bool is_whole = value.kind == JsonValue::Kind::Number && value.number >= 0 && value.number <= kMaxOffset &&
                          value.number == std::floor(value.number);
    if (!is_whole) return fail(value.at, key, kNeedsOffset);
    (member.key == "H" ? map_.length_offset : map_.radius_offset) = static_cast<int>(value.number);
  }

  template <class Function>
  void read_choice(const JsonMember& member, std::array<std::string_view, 2> choices, Function&& set) {
    if (member.value.kind != JsonValue::Kind::String)
      return fail(member.value.at, member.key, configuration::mistakes::kNeedsText);
    if (member.value.string == choices[0]) return set(false);
    if (member.value.string == choices[1]) return set(true);
    fail(member.value.at, member.key, map_problems::kNoChoiceOf,
         {configuration::shortened(member.value.string), fmt::format("{}, {}", choices[0], choices[1])});
  }

  void read_clearance(const JsonMember& member) {
    const bool is_length =
        member.value.kind == JsonValue::Kind::Number && member.value.number > 0 && member.value.number <= kFarthest;
    if (!is_length) return fail(member.value.at, member.key, kNeedsClearance);
    map_.peck_clearance = member.value.number;
  }

  TranslationMap map_;
  std::vector<Mistake> mistakes_;
};

}  // namespace

std::variant<TranslationMap, std::vector<Mistake>> read_translation_map(std::string_view text) {
  return MapReader().read(text);
}

std::variant<TranslationMap, std::string> load_translation_map(const std::filesystem::path& file,
                                                               dialect::Language language) {
  const std::string name = text::printable(system::generic_name(file));
  auto bytes = system::read_bytes(file, configuration::kLongestFile, language);
  if (const auto* problem = std::get_if<system::FileBytesProblem>(&bytes))
    return "isofmt: " + tool_library::unread_message(file, *problem, configuration::mistakes::kTooLarge, language);
  const auto& text = std::get<std::string>(bytes);
  auto map = read_translation_map(text);
  if (auto* read = std::get_if<TranslationMap>(&map)) return std::move(*read);
  std::string messages;
  for (const Mistake& mistake : std::get<std::vector<Mistake>>(map)) {
    if (!messages.empty()) messages += '\n';
    messages += configuration::located_message(name, configuration::place_of(mistake.at, text), mistake, language);
  }
  return messages;
}

std::optional<std::pair<int, Vec3>> read_zero_option(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const int name = zero_name(text.substr(0, equals));
  if (name < 0) return std::nullopt;
  Vec3 at = Vec3::Zero();
  std::string_view rest = text.substr(equals + 1);
  for (int axis = 0; axis < 3; ++axis) {
    const auto result = fast_float::from_chars(rest.data(), rest.data() + rest.size(), at[axis]);
    if (result.ec != std::errc{} || !(std::abs(at[axis]) <= kFarthest)) return std::nullopt;
    rest.remove_prefix(static_cast<std::size_t>(result.ptr - rest.data()));
    const bool is_last = axis == 2;
    if (is_last ? !rest.empty() : rest.empty() || rest.front() != ',') return std::nullopt;
    if (!is_last) rest.remove_prefix(1);
  }
  return std::pair(name, at);
}

}  // namespace isocnc::translation
