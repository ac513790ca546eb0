#include "interpreter/configuration/show.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "interpreter/configuration/keys.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::configuration {

using nlohmann::ordered_json;

/// 100, not 100.0.
static ordered_json number(double value) {
  if (std::floor(value) == value && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
}

static std::optional<ordered_json> value_in(std::monostate) { return std::nullopt; }
static std::optional<ordered_json> value_in(const double* real) {
  return std::isfinite(*real) ? std::optional(number(*real)) : std::nullopt;
}
static std::optional<ordered_json> value_in(const std::optional<double>* real) {
  return *real ? std::optional(number(**real)) : std::nullopt;
}
static std::optional<ordered_json> value_in(const int* whole) { return *whole; }
static std::optional<ordered_json> value_in(const std::optional<int>* whole) {
  return *whole ? std::optional<ordered_json>(**whole) : std::nullopt;
}
static std::optional<ordered_json> value_in(const bool* flag) { return *flag; }
static std::optional<ordered_json> value_in(const std::string* text) {
  return text->empty() ? std::nullopt : std::optional<ordered_json>(*text);
}
static std::optional<ordered_json> value_in(const std::optional<dialect::Language>* language) {
  return *language ? std::optional<ordered_json>(std::string(name_of(**language))) : std::nullopt;
}
static std::optional<ordered_json> value_in(const std::vector<std::string>* texts) { return *texts; }
static std::optional<ordered_json> value_in(const std::vector<std::pair<std::string, std::string>>* severities) {
  ordered_json object = ordered_json::object();
  for (const auto& [code, severity] : *severities) object[code] = severity;
  return object;
}
/// Objects have their keys in the table; here it only matters whether they are there.
template <typename T>
static std::optional<ordered_json> value_in(const T* /*objects*/) {
  return std::nullopt;
}

static ordered_json object_of(Configuration& configuration, const Key* key, std::size_t index);

static std::optional<ordered_json> list_of(Configuration& configuration, const Key& key, const Slot& slot) {
  ordered_json list = ordered_json::array();
  if (const auto* const tools = std::get_if<std::optional<std::vector<Tool>>*>(&slot)) {
    if (!**tools) return std::nullopt;
    for (std::size_t i = 0; i < (**tools)->size(); ++i) list.push_back(object_of(configuration, &key, i));
  } else {
    const std::size_t count = std::get<std::vector<FileWishes>*>(slot)->size();
    for (std::size_t i = 0; i < count; ++i) list.push_back(object_of(configuration, &key, i));
  }
  return list;
}

static std::optional<ordered_json> named_of(Configuration& configuration, const Key& key, const Slot& slot) {
  const auto& functions = *std::get<std::optional<std::vector<NamedFunction>>*>(slot);
  if (!functions) return std::nullopt;
  ordered_json object = ordered_json::object();
  for (std::size_t i = 0; i < functions->size(); ++i)
    object[fmt::format("M{}", (*functions)[i].number)] = object_of(configuration, &key, i);
  return object;
}

static std::optional<ordered_json> value_of(Configuration& configuration, const Key& key, std::size_t index) {
  const Slot slot = key.slot ? key.slot(configuration, index) : Slot();
  if (const auto* const renumber = std::get_if<std::optional<Renumber>*>(&slot); renumber && !**renumber)
    return std::nullopt;
  if (key.kind == KeyKind::Objects) return list_of(configuration, key, slot);
  if (key.kind == KeyKind::Named) return named_of(configuration, key, slot);
  if (key.kind != KeyKind::Object) return std::visit([](const auto& place) { return value_in(place); }, slot);
  ordered_json object = object_of(configuration, &key, index);
  return object.empty() ? std::nullopt : std::optional(std::move(object));
}

static ordered_json object_of(Configuration& configuration, const Key* key, std::size_t index) {
  ordered_json object = ordered_json::object();
  for (const Key* each : keys_below(key))
    if (std::optional<ordered_json> value = value_of(configuration, *each, index))
      object[std::string(each->name())] = std::move(*value);
  return object;
}

std::string to_json(const Configuration& configuration) {
  Configuration copy = configuration;  // Slots are for writing as well.
  return object_of(copy, nullptr, 0).dump(2) + "\n";
}

static ordered_json text_schema(TextKind kind) {
  ordered_json schema = {{"type", "string"}};
  switch (kind) {
    case TextKind::Code:
      return {{"$ref", "#/definitions/code"}};
    case TextKind::Extension:
      schema["pattern"] = R"(^\.?[^./\\*?\[\]]([^/\\*?\[\]]*[^./\\*?\[\]])?$)";
      break;
    case TextKind::Function:
      schema["pattern"] = "^M(0{0,2}[17-9]|0?[1-9][0-9]|[1-9][0-9]{2})$";
      break;
    case TextKind::Pattern:
      schema["pattern"] = R"(^(?!(.*/)?\.\.(/|$))[^!])";
      break;
    case TextKind::Any:
      schema["minLength"] = 1;
      break;
  }
  return schema;
}

/// Codes and names to choose from, and beginnings of codes, which may be shorter than any.
static ordered_json code_schema() {
  ordered_json names = {"ALL"};
  for (const dialect::DiagnosticDef& def : dialect::kDiagnostics) {
    names.push_back(def.code);
    names.push_back(def.name);
  }
  return {{"anyOf", {{{"enum", std::move(names)}}, {{"type", "string"}, {"pattern", "^[A-Za-z][A-Za-z0-9-]*$"}}}}};
}

static void add_range(const Key& key, ordered_json& schema) {
  const Range& range = key.range;
  if (std::isfinite(range.least)) schema[range.above_least ? "exclusiveMinimum" : "minimum"] = number(range.least);
  if (std::isfinite(range.most)) schema["maximum"] = number(range.most);
}

static std::string description_of(const Key& key) {
  return std::string(key.documentation) + (key.unit.empty() ? "" : fmt::format(" In {}.", key.unit));
}

static ordered_json schema_of(const Key* key);

/// What an object may hold.
static ordered_json members_schema(const Key* key) {
  ordered_json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", ordered_json::object()}};
  ordered_json required = ordered_json::array();
  for (const Key* each : keys_below(key)) {
    schema["properties"][std::string(each->name())] = schema_of(each);
    if (each->is_required) required.push_back(std::string(each->name()));
  }
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

static ordered_json schema_of(const Key* key) {
  ordered_json schema = ordered_json::object();
  schema["description"] = description_of(*key);
  switch (key->kind) {
    case KeyKind::Object:
      schema.update(members_schema(key));
      break;
    case KeyKind::Objects:
      schema["type"] = "array";
      schema["items"] = members_schema(key);
      break;
    case KeyKind::Named:
      schema["type"] = "object";
      schema["propertyNames"] = text_schema(key->text);
      schema["additionalProperties"] = members_schema(key);
      break;
    case KeyKind::Number:
    case KeyKind::Integer:
      schema["type"] = key->kind == KeyKind::Integer ? "integer" : "number";
      add_range(*key, schema);
      break;
    case KeyKind::Boolean:
      schema["type"] = "boolean";
      break;
    case KeyKind::Text:
      schema.update(text_schema(key->text));
      break;
    case KeyKind::Choice:
      schema["enum"] = key->choices;
      break;
    case KeyKind::Texts:
      schema["type"] = "array";
      schema["items"] = text_schema(key->text);
      if (key->is_never_empty) schema["minItems"] = 1;
      break;
    case KeyKind::Severities:
      schema["type"] = "object";
      schema["propertyNames"] = text_schema(key->text);
      schema["additionalProperties"] = {{"enum", key->choices}};
      break;
  }
  return schema;
}

std::string json_schema() {
  ordered_json schema = {
      {"$schema", "http://json-schema.org/draft-07/schema#"},
      {"title", "isocnc.json"},
      {"description", "What isolint, isofmt and isorun know of a machine and of the wishes of its shop."}};
  schema.update(members_schema(nullptr));
  schema["definitions"] = {{"code", code_schema()}};
  return schema.dump(2) + "\n";
}

/// The value of the key without any file.
static std::string default_of(const Key& key) {
  if (key.path.find("[]") != std::string::npos || key.path.find('*') != std::string::npos) return "";
  Configuration none;
  none.format.renumber.emplace();
  const std::optional<ordered_json> value = key.kind == KeyKind::Object ? std::nullopt : value_of(none, key, 0);
  return value && !value->empty() ? fmt::format("`{}`", value->dump()) : "";
}

static std::string kind_of(const Key& key) {
  static constexpr std::string_view kNames[] = {
      "object", "list of objects", "objects by name",     "number", "whole number", "true, false", "text",
      "",       "list of texts",   "object of severities"};
  if (key.kind == KeyKind::Choice) {
    std::vector<std::string> choices;
    for (const std::string_view choice : key.choices) choices.push_back(fmt::format("`\"{}\"`", choice));
    return fmt::format("{}", fmt::join(choices, ", "));
  }
  std::string kind(kNames[static_cast<std::size_t>(key.kind)]);
  if (!key.unit.empty()) kind += fmt::format(", {}", key.unit);
  const Range& range = key.range;
  if (std::isfinite(range.least))
    kind += fmt::format(", {}{} to {}", range.above_least ? "above " : "", range.least, range.most);
  return kind;
}

std::string key_page() {
  std::string page = "| Key | Value | Default | |\n|---|---|---|---|\n";
  for (const Key& key : all_keys()) {
    if (key.kind == KeyKind::Object && !key.slot) continue;  // Only its keys mean anything.
    fmt::format_to(std::back_inserter(page), "| `{}` | {} | {} | {} |\n", key.path, kind_of(key), default_of(key),
                   key.documentation);
  }
  return page;
}

}  // namespace isocnc::configuration
