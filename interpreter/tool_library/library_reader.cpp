#include "interpreter/tool_library/library_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace isocnc::tool_library {

using configuration::JsonValue;
using configuration::Tool;

void LibraryFile::fail(std::size_t at, std::string key, const dialect::Text& text,
                       std::vector<configuration::Named> names) {
  constexpr std::size_t kMost = 100;
  if (mistakes_.size() == kMost) return;
  const configuration::Mistake mistake{
      .at = at, .key = std::move(key), .text = text, .names = std::move(names), .meant = {}};
  mistakes_.push_back(configuration::located_message(name_, configuration::place_of(at, text_), mistake, language_));
}

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& letter : small) letter = static_cast<char>(letter >= 'A' && letter <= 'Z' ? letter + ('a' - 'A') : letter);
  return small;
}

double tidy(double length) { return std::round(length * 1e5) / 1e5; }

const JsonValue* member_of(const JsonValue& object, std::string_view key) {
  for (const configuration::JsonMember& member : object.members)
    if (member.key == key) return &member.value;
  return nullptr;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
}

std::string text_of(const JsonValue& object, std::string_view key) {
  const JsonValue* const value = member_of(object, key);
  if (value == nullptr || value->kind != JsonValue::Kind::String) return {};
  return std::string(trimmed(value->string));
}

/// Whether a library leaves a member open.
static bool says_nothing(const JsonValue* value) {
  return value == nullptr || value->kind == JsonValue::Kind::Null ||
         (value->kind == JsonValue::Kind::Number && value->number == 0);
}

/// The number of a member as the file has it, for messages.
static std::string shown(const JsonValue& value) {
  return value.kind == JsonValue::Kind::Number ? fmt::format("{:.7g}", value.number)
                                               : configuration::shortened(value.string);
}

std::optional<double> JsonTool::length(std::string_view key) const {
  const JsonValue* const value = member_of(object_, key);
  if (says_nothing(value)) return std::nullopt;
  const double length = tidy(value->number * millimeters_);
  if (value->kind == JsonValue::Kind::Number && length > 0 && length <= kLongest) return length;
  fail(key, *value, problems::kNeedsLength);
  return std::nullopt;
}

std::optional<double> JsonTool::angle(std::string_view key) const {
  const JsonValue* const value = member_of(object_, key);
  if (says_nothing(value)) return std::nullopt;
  if (value->kind == JsonValue::Kind::Number && value->number > 0 && value->number < 180) return value->number;
  fail(key, *value, problems::kNeedsAngle);
  return std::nullopt;
}

void JsonTool::fail(std::string_view key, const JsonValue& value, const dialect::Text& why) const {
  const bool is_text = value.kind == JsonValue::Kind::String;
  file_.fail(value.at, fmt::format("{}.{}", path_, key), is_text ? problems::kNeedsNumber : why, {shown(value)});
}

std::vector<const configuration::Key*> tool_keys() {
  const std::vector<configuration::Key>& all = configuration::all_keys();
  const auto tools =
      std::find_if(all.begin(), all.end(), [](const configuration::Key& key) { return key.path == "machine.tools"; });
  return configuration::keys_below(&*tools);
}

const configuration::Key* tool_key(std::string_view name) {
  const std::vector<const configuration::Key*> keys = tool_keys();
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const configuration::Key* key) { return key->name() == name; });
  return found == keys.end() ? nullptr : *found;
}

void set_end_mill(Tool& tool, std::optional<double> corner_radius) {
  tool.shape = "flat";
  if (!corner_radius || !tool.radius) return;
  tool.shape = *corner_radius < *tool.radius ? "bull" : "ball";
  if (tool.shape == "bull") tool.corner_radius = corner_radius;
}

void set_cone(Tool& tool, double tip_angle, double tip_radius) {
  if (tip_radius == 0) {
    tool.shape = "cone";
    tool.tip_angle = tip_angle;
    return;
  }
  if (!tool.radius || tip_radius >= *tool.radius) return;
  const double height = (*tool.radius - tip_radius) / std::tan(tip_angle / 2 * std::numbers::pi / 180);
  tool.profile = {{0, tip_radius}, {tidy(height), *tool.radius}};
  // What it cuts with ends where the outline ends.
  if (tool.cut_length && *tool.cut_length > height) tool.profile->push_back({*tool.cut_length, *tool.radius});
}

void set_taper(Tool& tool, double tip_radius, double side_angle) {
  if (!tool.cut_length) return;
  const double upper = tip_radius + *tool.cut_length * std::tan(side_angle * std::numbers::pi / 180);
  tool.profile = {{0, tip_radius}, {*tool.cut_length, tidy(upper)}};
  tool.radius = tidy(upper);
}

}  // namespace isocnc::tool_library
