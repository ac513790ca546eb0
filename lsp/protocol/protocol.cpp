#include "lsp/protocol/protocol.h"

#include <algorithm>
#include <limits>

namespace isocnc::protocol {

std::string in_markdown(std::string_view text) {
  static constexpr std::string_view kMarks = R"(\`*_[]<&~#)";
  std::string escaped;
  for (const char c : text) {
    if (kMarks.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// Reads a line or column. Too large a number becomes the maximum, which is after every end.
static std::uint32_t place_number(const Json& json) {
  if (!json.is_number_integer()) throw Json::type_error::create(302, "a whole number is wanted", &json);
  if (!json.is_number_unsigned()) throw Json::out_of_range::create(401, "the number is negative", &json);
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(json.get<std::uint64_t>(), std::numeric_limits<std::uint32_t>::max()));
}

void to_json(Json& json, const ClientPosition& position) {
  json = {{"line", position.line}, {"character", position.character}};
}
void to_json(Json& json, const ClientRange& range) { json = {{"start", range.start}, {"end", range.end}}; }
void to_json(Json& json, const Location& location) { json = {{"uri", location.uri}, {"range", location.range}}; }
void to_json(Json& json, const TextEdit& edit) { json = {{"range", edit.range}, {"newText", edit.new_text}}; }
void to_json(Json& json, const Markdown& markdown) { json = {{"kind", "markdown"}, {"value", markdown.text}}; }

void from_json(const Json& json, ClientPosition& position) {
  position = {place_number(json.at("line")), place_number(json.at("character"))};
}

void from_json(const Json& json, ClientRange& range) {
  range = {json.at("start").get<ClientPosition>(), json.at("end").get<ClientPosition>()};
}

void from_json(const Json& json, DocumentParams& params) { params.uri = json.at("textDocument").at("uri"); }

void from_json(const Json& json, PositionParams& params) {
  from_json(json, static_cast<DocumentParams&>(params));
  params.position = json.at("position").get<ClientPosition>();
}

void from_json(const Json& json, RangeParams& params) {
  from_json(json, static_cast<DocumentParams&>(params));
  params.range = json.at("range").get<ClientRange>();
}

}  // namespace isocnc::protocol
