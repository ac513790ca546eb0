#include "interpreter/configuration/show.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "interpreter/configuration/keys.h"
#include "interpreter/configuration/machine_page_texts.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/locale.h"

namespace isocnc::configuration {

using dialect::Language;
using dialect::Text;
using nlohmann::ordered_json;

/// Whole numbers as 100, not 100.0.
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
static std::optional<ordered_json> value_in(const std::optional<bool>* flag) {
  return *flag ? std::optional<ordered_json>(**flag) : std::nullopt;
}
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
static ordered_json row_value(std::span<const double> row) {
  ordered_json list = ordered_json::array();
  for (const double each : row) list.push_back(number(each));
  return list;
}
static ordered_json rows_value(const NumberRows& rows) {
  ordered_json list = ordered_json::array();
  for (const std::vector<double>& row : rows) list.push_back(row_value(row));
  return list;
}
static std::optional<ordered_json> value_in(const std::optional<geometry::Vec3>* point) {
  return *point ? std::optional(row_value(std::span((*point)->data(), 3))) : std::nullopt;
}
static std::optional<ordered_json> value_in(const std::optional<NumberRows>* rows) {
  return *rows ? std::optional(rows_value(**rows)) : std::nullopt;
}
static std::optional<ordered_json> value_in(const std::vector<NamedRows>* all) {
  ordered_json object = ordered_json::object();
  for (const NamedRows& each : *all) object[each.name] = rows_value(each.rows);
  return object;
}
static std::optional<ordered_json> value_in(const std::optional<ShapeFile>* mesh) {
  return *mesh ? std::optional<ordered_json>((*mesh)->name) : std::nullopt;
}
static std::optional<ordered_json> value_in(const dialect::HouseWatch::BilingualText* message) {
  if (message->en == message->it) return message->en;
  return ordered_json{{"en", message->en}, {"it", message->it}};
}
/// Objects have their keys in the table; only their presence matters here.
template <typename T>
static std::optional<ordered_json> value_in(const T* /*objects*/) {
  return std::nullopt;
}

static ordered_json object_of(Configuration& configuration, const Key* key, ElementIndex index);

static std::optional<ordered_json> list_of(Configuration& configuration, const Key& key, const ValueSlot& slot,
                                           ElementIndex owner) {
  const std::optional<std::size_t> count = element_count(slot);
  if (!count) return std::nullopt;
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < *count; ++i) list.push_back(object_of(configuration, &key, element_index(key, owner, i)));
  return list;
}

static std::optional<ordered_json> named_of(Configuration& configuration, const Key& key, const ValueSlot& slot) {
  const auto& functions = *std::get<std::optional<std::vector<NamedFunction>>*>(slot);
  if (!functions) return std::nullopt;
  ordered_json object = ordered_json::object();
  for (std::size_t i = 0; i < functions->size(); ++i)
    object[fmt::format("M{}", (*functions)[i].number)] = object_of(configuration, &key, {i, 0});
  return object;
}

static std::optional<ordered_json> value_of(Configuration& configuration, const Key& key, ElementIndex index) {
  const ValueSlot slot = key.slot ? key.slot(configuration, index) : ValueSlot();
  if (is_absent(slot)) return std::nullopt;
  if (key.kind == KeyKind::Objects) return list_of(configuration, key, slot, index);
  if (key.kind == KeyKind::Named) return named_of(configuration, key, slot);
  if (key.kind == KeyKind::Texts && key.is_never_empty && std::get<std::vector<std::string>*>(slot)->empty())
    return std::nullopt;
  if (key.kind != KeyKind::Object) return std::visit([](const auto& place) { return value_in(place); }, slot);
  ordered_json object = object_of(configuration, &key, index);
  return object.empty() ? std::nullopt : std::optional(std::move(object));
}

static ordered_json object_of(Configuration& configuration, const Key* key, ElementIndex index) {
  ordered_json object = ordered_json::object();
  for (const Key* each : keys_below(key))
    if (std::optional<ordered_json> value = value_of(configuration, *each, index))
      object[std::string(each->name())] = std::move(*value);
  return object;
}

std::string to_json(const Configuration& configuration) {
  Configuration copy = configuration;  // A copy, since slots are writable.
  return object_of(copy, nullptr, {}).dump(2) + "\n";
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
    case TextKind::File:
      schema["pattern"] = R"(^(?!(.*[/\\])?\.\.([/\\]|$))(?!.:)[^/\\])";
      break;
    case TextKind::Name:
      schema["pattern"] = "^[A-Za-z0-9._-]+$";
      break;
    case TextKind::Event:
      schema["pattern"] = "^(M[0-9]{1,3}|G[0-9]{1,3}|toolChange|motion|rapid|cut|end)$";
      break;
    case TextKind::ModeOrM:
      schema["pattern"] = "^[GM][0-9]{1,3}$";
      break;
    case TextKind::Tool:
      schema["pattern"] = R"(^T([0-9]{6}|[0-9]{0,5}\*)$)";
      break;
    case TextKind::Any:
      schema["minLength"] = 1;
      break;
  }
  return schema;
}

/// The schema of codes and names, and of prefixes, which may be shorter than any code.
static ordered_json code_schema() {
  ordered_json names = {"ALL"};
  for (const dialect::DiagnosticDef& def : dialect::kDiagnostics) {
    names.push_back(def.code);
    names.push_back(def.name);
  }
  return {{"anyOf", {{{"enum", std::move(names)}}, {{"type", "string"}, {"pattern", "^[A-Za-z][A-Za-z0-9-]*$"}}}}};
}

static void add_range(const NumberRange& range, ordered_json& schema) {
  if (std::isfinite(range.minimum))
    schema[range.exclusive_minimum ? "exclusiveMinimum" : "minimum"] = number(range.minimum);
  if (std::isfinite(range.maximum)) schema["maximum"] = number(range.maximum);
}

/// The schema of a list with a number for each column.
static ordered_json row_schema(const Key& key, Language language) {
  ordered_json numbers = ordered_json::array();
  for (const Column& column : key.columns) {
    ordered_json number = {{"description", column.name.in(language)}, {"type", "number"}};
    add_range(column.range, number);
    numbers.push_back(std::move(number));
  }
  const std::size_t count = key.columns.size();
  return {{"type", "array"}, {"items", std::move(numbers)}, {"minItems", count}, {"maxItems", count}};
}

static ordered_json rows_schema(const Key& key, Language language) {
  return {{"type", "array"},
          {"items", row_schema(key, language)},
          {"minItems", key.has_all_rows ? key.maximum_rows : 1},
          {"maxItems", key.maximum_rows}};
}

static std::string description_of(const Key& key, Language language) {
  return std::string(key.documentation.in(language)) +
         (key.unit.en.empty() ? "" : fmt::format(" In {}.", key.unit.in(language)));
}

static ordered_json schema_of(const Key* key, Language language);

/// The schema of an object's members.
static ordered_json members_schema(const Key* key, Language language) {
  ordered_json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", ordered_json::object()}};
  ordered_json required = ordered_json::array();
  for (const Key* each : keys_below(key)) {
    schema["properties"][std::string(each->name())] = schema_of(each, language);
    if (each->is_required) required.push_back(std::string(each->name()));
  }
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

static ordered_json schema_of(const Key* key, Language language) {
  ordered_json schema = ordered_json::object();
  schema["description"] = description_of(*key, language);
  switch (key->kind) {
    case KeyKind::Object:
      schema.update(members_schema(key, language));
      break;
    case KeyKind::Objects:
      schema["type"] = "array";
      schema["items"] = members_schema(key, language);
      break;
    case KeyKind::Named:
      schema["type"] = "object";
      schema["propertyNames"] = text_schema(key->text);
      schema["additionalProperties"] = members_schema(key, language);
      break;
    case KeyKind::Number:
    case KeyKind::Integer:
      schema["type"] = key->kind == KeyKind::Integer ? "integer" : "number";
      add_range(key->range, schema);
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
    case KeyKind::Point:
      schema.update(row_schema(*key, language));
      break;
    case KeyKind::Rows:
      schema.update(rows_schema(*key, language));
      break;
    case KeyKind::NamedRows:
      schema["type"] = "object";
      schema["propertyNames"] = text_schema(key->text);
      schema["additionalProperties"] = rows_schema(*key, language);
      break;
    case KeyKind::Message: {
      ordered_json texts = {
          {"type", "object"}, {"additionalProperties", false}, {"properties", ordered_json::object()}};
      for (const std::string_view name : dialect::kLanguageNames) {
        texts["properties"][std::string(name)] = text_schema(TextKind::Any);
        texts["required"].push_back(std::string(name));
      }
      schema["anyOf"] = {text_schema(TextKind::Any), std::move(texts)};
      break;
    }
  }
  return schema;
}

std::string json_schema(Language language) {
  static constexpr Text kDescription{
      "What isolint, isofmt and isorun know about a machine, and the options of its shop.",
      "Ciò che isolint, isofmt e isorun sanno di una macchina, e le opzioni dell'officina."};
  ordered_json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                         {"title", "isocnc.json"},
                         {"description", kDescription.in(language)}};
  schema.update(members_schema(nullptr, language));
  schema["definitions"] = {{"code", code_schema()}};
  return schema.dump(2) + "\n";
}

std::string setup_schema(Language language) {
  static constexpr Text kDescription{"What stands around one program: an entry of setups in isocnc.json.",
                                     "Ciò che sta intorno a un programma: una voce di setups nell'isocnc.json."};
  const std::vector<Key>& keys = all_keys();
  const auto setups = std::find_if(keys.begin(), keys.end(), [](const Key& key) { return key.path == "setups"; });
  ordered_json members = members_schema(&*setups, language);
  members["properties"].erase("paths");
  members.erase("required");  // That are the paths.
  ordered_json properties = {{"$schema", schema_of(&keys.front(), language)}};
  properties.update(members["properties"]);
  members["properties"] = std::move(properties);
  ordered_json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                         {"title", "PROGRAM.setup.json"},
                         {"description", kDescription.in(language)}};
  schema.update(members);
  return schema.dump(2) + "\n";
}

/// The default of the key.
static std::string default_of(const Key& key) {
  if (key.path.find("[]") != std::string::npos || key.path.find('*') != std::string::npos) return "";
  Configuration none;
  none.format.renumber.emplace();
  const std::optional<ordered_json> value = key.kind == KeyKind::Object ? std::nullopt : value_of(none, key, {});
  return value && !value->empty() ? fmt::format("`{}`", value->dump()) : "";
}

/// The form of lists of numbers: `[[z, radius], ...]`.
static std::string rows_form(const Key& key, Language language) {
  std::vector<std::string_view> names;
  for (const Column& column : key.columns) names.push_back(column.name.in(language));
  const std::string row = fmt::format("[{}]", fmt::join(names, ", "));
  if (key.kind == KeyKind::Point) return fmt::format("`{}`", row);
  const std::string rows = key.has_all_rows ? fmt::format("`[{0}, {0}]`", row) : fmt::format("`[{}, ...]`", row);
  static constexpr Text kByName = {"{} by name", "{} con nome"};
  return key.kind == KeyKind::NamedRows ? dialect::format(kByName, language, rows) : rows;
}

static std::string kind_of(const Key& key, Language language) {
  static constexpr Text kNames[] = {{"object", "oggetto"},
                                    {"list of objects", "lista di oggetti"},
                                    {"objects by name", "oggetti con nome"},
                                    {"number", "numero"},
                                    {"whole number", "numero intero"},
                                    {"true, false", "true, false"},
                                    {"text", "testo"},
                                    {"", ""},
                                    {"list of texts", "lista di testi"},
                                    {"object of severities", "oggetto con i pesi"}};
  static constexpr Text kFromTo = {", {} to {}", ", da {} a {}"};
  static constexpr Text kAboveTo = {", above {} to {}", ", oltre {} fino a {}"};
  if (key.kind == KeyKind::Choice) {
    std::vector<std::string> choices;
    for (const std::string_view choice : key.choices) choices.push_back(fmt::format("`\"{}\"`", choice));
    return fmt::format("{}", fmt::join(choices, ", "));
  }
  static constexpr Text kMessage = {"text, or `{\"en\": text, \"it\": text}`",
                                    "testo, o `{\"en\": testo, \"it\": testo}`"};
  if (key.kind == KeyKind::Message) return std::string(kMessage.in(language));
  std::string kind = key.columns.empty() ? std::string(kNames[static_cast<std::size_t>(key.kind)].in(language))
                                         : rows_form(key, language);
  if (!key.unit.en.empty()) kind += fmt::format(", {}", key.unit.in(language));
  const NumberRange& range = key.range;
  if (std::isfinite(range.minimum))
    kind += dialect::format(range.exclusive_minimum ? kAboveTo : kFromTo, language, range.minimum, range.maximum);
  return kind;
}

static std::string table_head(Language language) {
  static constexpr Text kColumns = {"| Key | Value | Default | |\n", "| Chiave | Valore | Se manca | |\n"};
  return fmt::format("{}|---|---|---|---|\n", kColumns.in(language));
}

static std::string row_of(std::string_view names, const Key& key, std::string_view defaults, Language language) {
  return fmt::format("| {} | {} | {} | {} |\n", names, kind_of(key, language), defaults,
                     key.documentation.in(language));
}

std::string key_page(Language language) {
  static constexpr Text kMachineRow = {
      "| `machine` | object |  | The machine that programs are written for: [all its keys](machine.md). |\n",
      "| `machine` | oggetto |  | La macchina per cui i programmi sono scritti: [tutte le sue chiavi](macchina.md). "
      "|\n"};
  std::string page = table_head(language);
  for (const Key& key : all_keys()) {
    if (key.path.starts_with("machine.")) continue;
    if (key.path == "machine")
      page += kMachineRow.in(language);
    else if (key.kind != KeyKind::Object || key.slot)  // Other objects have rows for their keys only.
      page += row_of(fmt::format("`{}`", key.path), key, default_of(key), language);
  }
  return page;
}

/// The path without its last part: `machine.axes.X` of `machine.axes.X.min`.
static std::string_view parent_of(const Key& key) { return std::string_view(key.path).substr(0, key.path.rfind('.')); }

/// The rows of keys. Keys that differ only in their axis share a row, with each default if those differ.
static std::string rows_of(const std::vector<const Key*>& keys, std::size_t prefix, Language language) {
  static constexpr Text kRequired = {"required", "obbligatoria"};
  const auto alike = [](const Key& a, const Key& b) {
    return kind_of(a, Language::English) == kind_of(b, Language::English) && a.documentation.en == b.documentation.en &&
           a.is_required == b.is_required;
  };
  std::string rows;
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    const auto is_alike = [&](const Key* other) { return alike(**key, *other); };
    if (std::any_of(keys.begin(), key, is_alike)) continue;
    std::vector<std::string> names;
    std::vector<std::string> defaults;
    for (auto other = key; other != keys.end(); ++other) {
      if (!is_alike(*other)) continue;
      names.push_back(fmt::format("`{}`", (*other)->path.substr(prefix)));
      defaults.push_back(default_of(**other));
    }
    if (std::equal(defaults.begin() + 1, defaults.end(), defaults.begin())) defaults.resize(1);
    const std::string column =
        (*key)->is_required ? std::string(kRequired.in(language)) : fmt::format("{}", fmt::join(defaults, ", "));
    rows += row_of(fmt::format("{}", fmt::join(names, ", ")), **key, column, language);
  }
  return rows;
}

/// The key's section: its documentation, and the table of its keys that have no section.
static std::string section_of(const Key& section, Language language) {
  const std::string prefix = prefix_of(&section);
  std::vector<const Key*> keys;
  for (const Key& key : all_keys()) {
    const bool has_section = section.path == "machine" && parent_of(key) != "machine";
    if (key.path.starts_with(prefix) && key.kind >= KeyKind::Number && !has_section) keys.push_back(&key);
  }
  return fmt::format("\n## {}\n\n{}\n\n{}{}", section.path, section.documentation.in(language), table_head(language),
                     rows_of(keys, prefix.size(), language));
}

std::string machine_page(Language language) {
  std::string page(kMachineIntroduction.in(language));
  for (const Key& key : all_keys()) {
    if (key.path == "machine" || (key.kind < KeyKind::Number && parent_of(key) == "machine")) {
      page += section_of(key, language);
      if (key.path == "machine.kinematics") page += kMeasuringAHead.in(language);
    }
  }
  return page;
}

std::vector<CodeOption> options_of(std::string_view code, Language language) {
  std::vector<CodeOption> options;
  for (const Key& key : all_keys()) {
    if (key.documentation.en.find(code) == std::string_view::npos) continue;
    std::string fallback = default_of(key);
    std::erase(fallback, '`');
    if (!fallback.empty() && !key.unit.en.empty()) fallback += fmt::format(" {}", key.unit.in(language));
    options.push_back({.path = key.path, .fallback = std::move(fallback)});
  }
  return options;
}

}  // namespace isocnc::configuration
