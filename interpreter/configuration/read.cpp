#include "interpreter/configuration/read.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpreter/configuration/json_value.h"
#include "interpreter/configuration/keys.h"
#include "interpreter/dialect/code_set.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/dialect/near_names.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::configuration {

using dialect::Text;
using JsonKind = JsonValue::Kind;

static constexpr Text kKinds[] = {
    {"null", "null"},  {"true or false", "true o false"}, {"a number", "un numero"},
    {"text", "testo"}, {"a list [ ]", "una lista [ ]"},   {"an object { }", "un oggetto { }"},
};
static const Text& name_of(JsonKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

static JsonKind json_of(KeyKind kind) {
  switch (kind) {
    case KeyKind::Number:
    case KeyKind::Integer:
      return JsonKind::Number;
    case KeyKind::Boolean:
      return JsonKind::Boolean;
    case KeyKind::Text:
    case KeyKind::Choice:
      return JsonKind::String;
    case KeyKind::Objects:
    case KeyKind::Texts:
    case KeyKind::Point:
    case KeyKind::Rows:
      return JsonKind::List;
    case KeyKind::Object:
    case KeyKind::Named:
    case KeyKind::Severities:
    case KeyKind::NamedRows:
    case KeyKind::Message:
      break;
  }
  return JsonKind::Object;
}

/// The mistake in a text, with a suggested correction.
struct Fault {
  Text text;
  std::optional<std::string> meant;
};

static std::optional<Fault> pattern_fault(std::string_view text) {
  if (text.starts_with('!')) return Fault{mistakes::kNegatedGlob, {}};
  if (!PathPatterns::is_well_formed(text)) return Fault{mistakes::kBadGlob, {}};
  if (text == ".." || text.starts_with("../") || text.ends_with("/..") || text.find("/../") != std::string_view::npos)
    return Fault{mistakes::kLeavesFolder, {}};
  return std::nullopt;
}

static std::optional<Fault> extension_fault(std::string_view text) {
  const std::string_view name = text.substr(text.starts_with('.') ? 1 : 0);
  const bool is_name = !name.empty() && name.find_first_of("/\\*?[]") == std::string_view::npos &&
                       !name.starts_with('.') && !name.ends_with('.');
  return is_name ? std::nullopt : std::optional(Fault{mistakes::kBadExtension, {}});
}

/// A path that could leave its folder on any system.
static std::optional<Fault> file_fault(std::string_view text) {
  if (text.empty()) return Fault{mistakes::kEmpty, {}};
  static constexpr std::string_view kSlashes = "/\\";
  const bool is_absolute = kSlashes.find(text.front()) != std::string_view::npos || text.substr(1, 1) == ":";
  bool goes_up = false;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(kSlashes, begin), text.size());
    goes_up = goes_up || text.substr(begin, end - begin) == "..";
    begin = end + 1;
  }
  return is_absolute || goes_up ? std::optional(Fault{mistakes::kOutsideFolder, {}}) : std::nullopt;
}

static std::optional<Fault> event_fault(std::string_view text) {
  if (dialect::house_event(text)) return std::nullopt;
  const std::optional<int> g = dialect::code_number('G', text);
  const dialect::GCode* const code = g ? dialect::g_code(static_cast<std::size_t>(*g)) : nullptr;
  if (code && code->is_motion()) return Fault{mistakes::kMotionEvent, {}};
  static const std::vector<std::string> kNames = {"toolChange", "motion", "rapid", "cut", "end"};
  return Fault{mistakes::kBadEvent, dialect::nearest_name(text, kNames)};
}

static bool is_mode_or_m(std::string_view text) {
  return dialect::house_event(text) && (text.front() == 'G' || text.front() == 'M');
}

static bool is_rule_name(std::string_view text) {
  const auto may_stand = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' ||
           c == '_';
  };
  return std::all_of(text.begin(), text.end(), may_stand);
}

static std::optional<Fault> fault_of(TextKind kind, std::string_view text) {
  const auto unless = [](bool is_right, const Text& mistake) {
    return is_right ? std::nullopt : std::optional(Fault{mistake, {}});
  };
  if (text.empty() && kind > TextKind::File) return Fault{mistakes::kEmpty, {}};
  switch (kind) {
    case TextKind::Name:
      return unless(is_rule_name(text), mistakes::kBadRuleName);
    case TextKind::Event:
      return event_fault(text);
    case TextKind::ModeOrM:
      return unless(is_mode_or_m(text), mistakes::kBadModeOrM);
    case TextKind::Tool:
      return unless(dialect::tool_range(text).has_value(), mistakes::kBadTool);
    case TextKind::Code:
      if (dialect::find_codes(text)) return std::nullopt;
      return Fault{mistakes::kUnknownCode, dialect::nearest_code(text)};
    case TextKind::Pattern:
      return pattern_fault(text);
    case TextKind::Extension:
      return extension_fault(text);
    case TextKind::Function:
      return function_number(text) ? std::nullopt : std::optional(Fault{mistakes::kBadFunction, {}});
    case TextKind::File:
      return file_fault(text);
    case TextKind::Any:
      break;
  }
  return text.empty() ? std::optional(Fault{mistakes::kEmpty, {}}) : std::nullopt;
}

/// The path of the only key with this name, for users who wrote it in the wrong object. None if there is none or more
/// than one.
static std::optional<std::string> same_name_elsewhere(std::string_view name) {
  std::optional<std::string> found;
  for (const Key& key : all_keys()) {
    if (key.name() != name) continue;
    if (found) return std::nullopt;
    found = key.path;
  }
  return found;
}

/// A file of one setup has no other objects.
static std::optional<std::string> meant_key(std::string_view written, const std::vector<const Key*>& keys,
                                            bool is_of_setup_file) {
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const Key* key : keys) names.emplace_back(key->name());
  if (auto near = dialect::nearest_name(written, names)) return near;
  return is_of_setup_file ? std::nullopt : same_name_elsewhere(written);
}

namespace {

/// Compares a tree of values with the table of keys, and stores the valid ones in their slots.
class ConfigurationReader {
 public:
  ConfigurationReader(std::string_view text, ReadConfiguration& result) : text_(text), places_(text), result_(result) {}

  /// Reads the object of `key` that is a file of its own; null means an isocnc.json.
  void read(const JsonValue& root, const Key* key) {
    if (root.kind != JsonKind::Object)
      return complain(root.at, "", mistakes::kWrongKind, {name_of(root.kind), name_of(JsonKind::Object)});
    root_ = &root;
    is_of_setup_file_ = key != nullptr;
    read_members(root, key, "", {});
    if (!result_.mistakes.empty()) return;
    for (const Judged& each : judged_)
      object_to(each.key->final_objection(result_.configuration, each.index), *each.object, each.path);
  }

 private:
  /// The keys of one object so far, with their offsets.
  using SeenKeys = std::unordered_map<std::string_view, std::size_t>;

  /// An object with a final objection.
  struct Judged {
    const Key* key;
    const JsonValue* object;
    std::string path;
    ElementIndex index;
  };

  /// Limits the list to a hundred mistakes: users read no more, and searching corrections takes time.
  bool is_full() const { return result_.mistakes.size() >= 100; }

  void complain(std::size_t at, const std::string& key, const Text& text, std::vector<Named> names = {},
                std::optional<std::string> meant = {}) {
    if (is_full()) return;
    result_.mistakes.push_back({at, shortened(key), text, std::move(names), std::move(meant)});
  }

  void read_value(const Key& key, const JsonValue& value, const std::string& path, ElementIndex index) {
    if (key.kind == KeyKind::Message) return read_message(key, value, path, index);
    if (value.kind != json_of(key.kind))
      return complain(value.at, path, mistakes::kWrongKind, {name_of(value.kind), name_of(json_of(key.kind))});
    const ValueSlot slot = key.slot ? key.slot(result_.configuration, index) : ValueSlot();
    switch (key.kind) {
      case KeyKind::Object:
        create_object(slot, places_.of(value.at));
        return read_object(key, value, path, index);
      case KeyKind::Objects:
        return read_objects(key, value, path, index, slot);
      case KeyKind::Named:
        return read_named(key, value, path, slot);
      case KeyKind::Number:
      case KeyKind::Integer:
        return read_number(key, value, path, slot);
      case KeyKind::Boolean:
        if (bool* const* const flag = std::get_if<bool*>(&slot)) **flag = value.boolean;
        if (auto* const* const flag = std::get_if<std::optional<bool>*>(&slot)) **flag = value.boolean;
        return;
      case KeyKind::Text:
        if (is_right(key.text, value.string, value.at, path)) store_text(value, path, slot);
        return;
      case KeyKind::Choice:
        return read_choice(key, value, path, slot);
      case KeyKind::Texts:
        return read_texts(key, value, path, *std::get<std::vector<std::string>*>(slot));
      case KeyKind::Severities:
        return read_severities(key, value, path, *std::get<std::vector<std::pair<std::string, std::string>>*>(slot));
      case KeyKind::Point:
        return read_point(key, value, path, *std::get<std::optional<geometry::Vec3>*>(slot));
      case KeyKind::Rows:
        return read_rows(key, value, path, index, *std::get<std::optional<NumberRows>*>(slot));
      case KeyKind::NamedRows:
        return read_named_rows(key, value, path, *std::get<std::vector<NamedRows>*>(slot));
      case KeyKind::Message:
        return;
    }
  }

  /// Reads one text for both languages, or an object with a text for each.
  void read_message(const Key& key, const JsonValue& value, const std::string& path, ElementIndex index) {
    auto& message = *std::get<dialect::HouseWatch::BilingualText*>(key.slot(result_.configuration, index));
    if (value.kind == JsonKind::String) {
      if (is_right(TextKind::Any, value.string, value.at, path)) message = {value.string, value.string};
      return;
    }
    if (value.kind != JsonKind::Object)
      return complain(value.at, path, mistakes::kWrongKind, {name_of(value.kind), mistakes::kTextOrTexts});
    SeenKeys seen;
    for (const JsonMember& member : value.members) {
      const std::string below = path + "." + member.key;
      if (is_full() || is_duplicate(member, seen, below)) continue;
      const std::optional<dialect::Language> language = dialect::language_named(member.key);
      if (!language) {
        complain(member.at, below, mistakes::kUnknownKey);
      } else if (member.value.kind != JsonKind::String) {
        complain(member.value.at, below, mistakes::kWrongKind, {name_of(member.value.kind), name_of(JsonKind::String)});
      } else if (is_right(TextKind::Any, member.value.string, member.value.at, below)) {
        (*language == dialect::Language::Italian ? message.it : message.en) = member.value.string;
      }
    }
    for (const std::string_view language : dialect::kLanguageNames)
      if (!holds(value, language)) complain(value.at, path, mistakes::kKeyMissing, {std::string(language)});
  }

  void store_text(const JsonValue& value, const std::string& path, const ValueSlot& slot) {
    if (auto* const* const text = std::get_if<std::string*>(&slot)) **text = value.string;
    if (auto* const* const mesh = std::get_if<std::optional<ShapeFile>*>(&slot))
      **mesh = ShapeFile{.name = value.string, .key = shortened(path), .place = places_.of(value.at)};
  }

  /// Reads an object, a list element or a named object: first its keys, then conditions on several keys.
  void read_object(const Key& key, const JsonValue& object, const std::string& path, ElementIndex index) {
    const std::size_t before = result_.mistakes.size();
    read_members(object, &key, path, index);
    if (result_.mistakes.size() != before) return;
    if (key.final_objection) judged_.push_back({&key, &object, path, index});
    if (key.objection) object_to(key.objection(result_.configuration, index), object, path);
  }

  /// Reports an objection at the most exact place that it names.
  void object_to(const std::optional<Objection>& objection, const JsonValue& object, std::string path) {
    if (!objection) return;
    const JsonValue* marked = &object;
    for (const JsonMember& member : object.members) {
      if (member.key != objection->member) continue;
      marked = &member.value;
      path += (path.empty() ? "" : ".") + member.key;
      break;
    }
    for (const std::optional<std::size_t>& i : {objection->row, objection->column}) {
      if (!i || *i >= marked->elements.size()) break;
      marked = &marked->elements[*i];
      path += fmt::format("[{}]", *i);
    }
    complain(marked->at, path, objection->text, objection->names, objection->meant);
  }

  void read_members(const JsonValue& object, const Key* key, const std::string& path, ElementIndex index) {
    std::vector<const Key*> keys = keys_below(key);
    const bool is_setup_file = key != nullptr && &object == root_;
    if (is_setup_file) {
      std::erase_if(keys, [](const Key* each) { return each->name() == "paths"; });
      keys.push_back(&all_keys().front());  // $schema
    }
    SeenKeys seen;
    for (const JsonMember& member : object.members) {
      if (is_full()) return;
      const std::string below = path + (path.empty() ? "" : ".") + member.key;
      const auto known =
          std::find_if(keys.begin(), keys.end(), [&](const Key* each) { return each->name() == member.key; });
      if (is_duplicate(member, seen, below)) continue;
      if (known == keys.end()) {
        complain(member.at, below, mistakes::kUnknownKey, {}, meant_key(member.key, keys, is_of_setup_file_));
      } else {
        read_value(**known, member.value, below, index);
      }
    }
    for (const Key* each : keys)
      if (each->is_required && !holds(object, each->name()))
        complain(object.at, path, mistakes::kKeyMissing, {std::string(each->name())});
  }

  static bool holds(const JsonValue& object, std::string_view key) {
    return std::any_of(object.members.begin(), object.members.end(),
                       [&](const JsonMember& member) { return member.key == key; });
  }

  bool is_duplicate(const JsonMember& member, SeenKeys& seen, const std::string& path) {
    return is_duplicate(member, member.key, seen, path);
  }

  /// Reports a key that occurs twice, also under an equivalent name.
  bool is_duplicate(const JsonMember& member, std::string_view name, SeenKeys& seen, const std::string& path) {
    const auto [first, is_new] = seen.try_emplace(name, member.at);
    if (!is_new)
      complain(member.at, path, mistakes::kKeyTwice, {fmt::format("{}", place_of(first->second, text_).line)});
    return !is_new;
  }

  bool is_right(TextKind kind, const std::string& text, std::size_t at, const std::string& path) {
    const std::optional<Fault> fault = fault_of(kind, text);
    if (fault) complain(at, path, fault->text, {shortened(text)}, fault->meant);
    return !fault;
  }

  void read_objects(const Key& key, const JsonValue& list, const std::string& path, ElementIndex owner,
                    const ValueSlot& slot) {
    create_list(slot);
    for (std::size_t i = 0; i < list.elements.size() && !is_full(); ++i) {
      const JsonValue& element = list.elements[i];
      const std::string below = fmt::format("{}[{}]", path, i);
      if (element.kind != JsonKind::Object) {
        complain(element.at, below, mistakes::kWrongKind, {name_of(element.kind), name_of(JsonKind::Object)});
        continue;
      }
      read_object(key, element, below, element_index(key, owner, add_element(slot, places_.of(element.at))));
    }
  }

  void read_named(const Key& key, const JsonValue& object, const std::string& path, const ValueSlot& slot) {
    std::vector<NamedFunction>& functions = std::get<std::optional<std::vector<NamedFunction>>*>(slot)->emplace();
    SeenKeys seen;
    for (const JsonMember& member : object.members) {
      if (is_full()) return;
      const std::string below = path + "." + member.key;
      if (is_duplicate(member, seen, below) || !is_right(key.text, member.key, member.at, below)) continue;
      if (member.value.kind != JsonKind::Object) {
        complain(member.value.at, below, mistakes::kWrongKind, {name_of(member.value.kind), name_of(JsonKind::Object)});
        continue;
      }
      functions.push_back({.number = *function_number(member.key)});
      read_object(key, member.value, below, {functions.size() - 1, 0});
    }
  }

  /// Whether the number is in the range, which else is reported.
  bool is_within(const NumberRange& range, const Text& unit, const JsonValue& value, const std::string& path) {
    const double number = value.number;
    const bool is_above = range.exclusive_minimum ? number > range.minimum : number >= range.minimum;
    if (is_above && number <= range.maximum) return true;
    const double bound = is_above ? range.maximum : range.minimum;
    Named limit(fmt::format("{}{}{}", bound, unit.en.empty() ? "" : " ", unit.en));
    limit.it = fmt::format("{}{}{}", bound, unit.it.empty() ? "" : " ", unit.it);
    const Text& text = is_above                  ? mistakes::kTooBig
                       : range.exclusive_minimum ? mistakes::kNotAbove
                                                 : mistakes::kTooSmall;
    complain(value.at, path, text, {fmt::format("{}", number), std::move(limit)});
    return false;
  }

  /// The numbers of a list with one for each column; none, after a complaint, if it is another list.
  std::optional<std::vector<double>> read_columns(const Key& key, const JsonValue& list, const std::string& path) {
    if (list.elements.size() != key.columns.size()) {
      Named names{std::string()};
      for (const Column& column : key.columns) {
        names.en += fmt::format("{}{}", names.en.empty() ? "" : ", ", column.name.en);
        names.it += fmt::format("{}{}", names.it.empty() ? "" : ", ", column.name.it);
      }
      complain(list.at, path, mistakes::kRowLength, {fmt::format("{}", key.columns.size()), std::move(names)});
      return std::nullopt;
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < list.elements.size() && !is_full(); ++i) {
      const JsonValue& element = list.elements[i];
      const std::string below = fmt::format("{}[{}]", path, i);
      if (element.kind != JsonKind::Number) {
        complain(element.at, below, mistakes::kWrongKind, {name_of(element.kind), name_of(JsonKind::Number)});
      } else if (is_within(key.columns[i].range, key.unit, element, below)) {
        numbers.push_back(element.number);
      }
    }
    return numbers.size() == key.columns.size() ? std::optional(std::move(numbers)) : std::nullopt;
  }

  void read_point(const Key& key, const JsonValue& list, const std::string& path,
                  std::optional<geometry::Vec3>& point) {
    if (const auto numbers = read_columns(key, list, path))
      point = geometry::Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  }

  /// Whether the list has as many rows as the key wants, and all of them are right; else that is reported.
  bool are_right(const Key& key, const JsonValue& list, const std::string& path, NumberRows& rows) {
    const std::size_t count = list.elements.size();
    const std::size_t before = result_.mistakes.size();
    if (key.has_all_rows && count != key.maximum_rows) {
      complain(list.at, path, mistakes::kRowCount, {fmt::format("{}", key.maximum_rows)});
    } else if (count == 0) {
      complain(list.at, path, mistakes::kEmptyList);
    } else if (count > key.maximum_rows) {
      complain(list.at, path, mistakes::kManyRows, {fmt::format("{}", key.maximum_rows)});
    }
    for (std::size_t i = 0; i < std::min(count, key.maximum_rows) && !is_full(); ++i) {
      const JsonValue& element = list.elements[i];
      const std::string below = fmt::format("{}[{}]", path, i);
      if (element.kind != JsonKind::List) {
        complain(element.at, below, mistakes::kWrongKind, {name_of(element.kind), name_of(JsonKind::List)});
      } else if (auto row = read_columns(key, element, below)) {
        rows.push_back(*std::move(row));
      }
    }
    return !is_full() && result_.mistakes.size() == before;
  }

  void read_rows(const Key& key, const JsonValue& list, const std::string& path, ElementIndex index,
                 std::optional<NumberRows>& slot) {
    NumberRows rows;
    if (!are_right(key, list, path, rows)) return;
    slot = std::move(rows);
    if (key.objection) object_to(key.objection(result_.configuration, index), list, path);
  }

  void read_named_rows(const Key& key, const JsonValue& object, const std::string& path, std::vector<NamedRows>& all) {
    all.clear();
    SeenKeys seen;
    for (const JsonMember& member : object.members) {
      if (is_full()) return;
      const std::string below = path + "." + member.key;
      if (is_duplicate(member, seen, below) || !is_right(key.text, member.key, member.at, below)) continue;
      if (member.value.kind != JsonKind::List) {
        complain(member.value.at, below, mistakes::kWrongKind, {name_of(member.value.kind), name_of(JsonKind::List)});
        continue;
      }
      NamedRows named{.name = member.key, .rows = {}};
      if (!are_right(key, member.value, below, named.rows)) continue;
      all.push_back(std::move(named));
      object_to(key.objection(result_.configuration, {all.size() - 1, 0}), member.value, below);
    }
  }

  void read_number(const Key& key, const JsonValue& value, const std::string& path, const ValueSlot& slot) {
    const double number = value.number;
    if (key.kind == KeyKind::Integer && std::floor(number) != number)
      return complain(value.at, path, mistakes::kNotWhole, {fmt::format("{}", number)});
    if (!is_within(key.range, key.unit, value, path)) return;
    if (const auto* const real = std::get_if<double*>(&slot)) **real = number;
    if (const auto* const real = std::get_if<std::optional<double>*>(&slot)) **real = number;
    if (const auto* const whole = std::get_if<int*>(&slot)) **whole = static_cast<int>(number);
    if (const auto* const whole = std::get_if<std::optional<int>*>(&slot)) **whole = static_cast<int>(number);
  }

  bool is_chosen(const Key& key, const JsonValue& value, const std::string& path) {
    const std::vector<std::string> choices(key.choices.begin(), key.choices.end());
    if (std::find(choices.begin(), choices.end(), value.string) != choices.end()) return true;
    complain(value.at, path, mistakes::kNoChoice,
             {shortened(value.string), fmt::format("{}", fmt::join(choices, ", "))},
             dialect::nearest_name(value.string, choices));
    return false;
  }

  void read_choice(const Key& key, const JsonValue& value, const std::string& path, const ValueSlot& slot) {
    if (!is_chosen(key, value, path)) return;
    if (const auto* const language = std::get_if<std::optional<dialect::Language>*>(&slot)) {
      **language = dialect::language_named(value.string);
    } else {
      *std::get<std::string*>(slot) = value.string;
    }
  }

  void read_texts(const Key& key, const JsonValue& list, const std::string& path, std::vector<std::string>& texts) {
    if (list.elements.empty() && key.is_never_empty) complain(list.at, path, mistakes::kEmptyList);
    texts.clear();
    for (std::size_t i = 0; i < list.elements.size() && !is_full(); ++i) {
      const JsonValue& element = list.elements[i];
      const std::string below = fmt::format("{}[{}]", path, i);
      if (element.kind != JsonKind::String) {
        complain(element.at, below, mistakes::kWrongKind, {name_of(element.kind), name_of(JsonKind::String)});
      } else if (is_right(key.text, element.string, element.at, below)) {
        const bool lacks_point = key.text == TextKind::Extension && !element.string.starts_with('.');
        texts.push_back((lacks_point ? "." : "") + element.string);
      }
    }
  }

  void read_severities(const Key& key, const JsonValue& object, const std::string& path,
                       std::vector<std::pair<std::string, std::string>>& severities) {
    SeenKeys seen;
    for (const JsonMember& member : object.members) {
      if (is_full()) return;
      const std::string below = path + "." + member.key;
      // A diagnostic by code (ISO031) or name.
      const std::optional<dialect::DiagnosticId> id = dialect::find_diagnostic(member.key);
      const std::string_view name = id ? dialect::definition(*id).code : member.key;
      if (is_duplicate(member, name, seen, below) || !is_right(key.text, member.key, member.at, below)) continue;
      if (member.value.kind != JsonKind::String) {
        complain(member.value.at, below, mistakes::kWrongKind, {name_of(member.value.kind), name_of(JsonKind::String)});
      } else if (is_chosen(key, member.value, below)) {
        severities.emplace_back(member.key, member.value.string);
      }
    }
  }

  std::string_view text_;
  PlaceFinder places_;
  ReadConfiguration& result_;
  const JsonValue* root_ = nullptr;
  bool is_of_setup_file_ = false;
  std::vector<Judged> judged_;
};

}  // namespace

/// Sets the members of the simulated machine, in its units.
static void derive_motion(MachineConfiguration& machine) {
  kinematics::Machine& motion = machine.timed.motion;
  motion.kinematics.kind = machine.kind == "head"    ? kinematics::MachineKind::Head
                           : machine.kind == "table" ? kinematics::MachineKind::Table
                                                     : kinematics::MachineKind::ThreeAxis;
  motion.rapid_motion = machine.rapid_motion == "independent" ? kinematics::RapidMotion::Independent
                                                              : kinematics::RapidMotion::Interpolated;
  for (std::size_t i = 0; i < motion.axes.size(); ++i) {
    motion.axes[i].minimum = machine.setup.limits.travel[i].minimum;
    motion.axes[i].maximum = machine.setup.limits.travel[i].maximum;
    motion.axes[i].speed = machine.rapids[i] / kinematics::kSecondsPerMinute;
  }
  const execution::Limits& limits = machine.setup.limits;
  motion.feed_speed = limits.feed / kinematics::kSecondsPerMinute;
  motion.feed_turn = limits.rotary_speed / kinematics::kSecondsPerMinute;
  machine.timed.spindle_speed = limits.spindle_speed;
  machine.timed.home = machine.setup.home;
  for (const Tool& tool : machine.tools.value_or(std::vector<Tool>())) {
    if (tool.length) machine.timed.tool_lengths[tool.code] = *tool.length;
    if (tool.radius) machine.timed.tool_radii[tool.code] = *tool.radius;
  }
  for (const NamedFunction& function : machine.functions.value_or(std::vector<NamedFunction>()))
    machine.timed.durations.functions[function.number] = function.seconds;
}

static std::vector<dialect::HouseEvent> events_of(const std::vector<std::string>& names) {
  std::vector<dialect::HouseEvent> events;
  for (const std::string& name : names) events.push_back(*dialect::house_event(name));
  return events;
}

static dialect::Severity severity_named(std::string_view name) {
  for (const auto severity : {dialect::Severity::Error, dialect::Severity::Info})
    if (name == dialect::severity_name(severity, dialect::Language::English)) return severity;
  return dialect::Severity::Warning;
}

/// Adds a watch for each word of the head or the end.
static void add_words(const std::vector<std::string>& words, const dialect::HouseWatch& pattern,
                      std::vector<dialect::HouseWatch>& watches) {
  for (const std::string& word : words) {
    dialect::HouseWatch watch = pattern;
    watch.ended = events_of({word});
    if (words.size() > 1) {
      watch.message.en += ": " + word;
      watch.message.it += ": " + word;
    }
    watches.push_back(std::move(watch));
  }
}

/// Adds the watches of a rule without mistakes.
static void add_watches(const DescribedHouseRule& rule, std::vector<dialect::HouseWatch>& watches) {
  using dialect::HouseEvent;
  using Kind = dialect::HouseWatch::Kind;
  dialect::HouseWatch watch{.rule = rule.id, .message = rule.message, .severity = severity_named(rule.severity)};
  const auto add_range = [&](Kind kind, const std::optional<double>& from, const std::optional<double>& to) {
    if (!from && !to) return;
    watch.kind = kind;
    if (from) watch.minimum = *from;
    if (to) watch.maximum = *to;
    for (const std::string& tool : rule.tools) watch.tools.push_back(*dialect::tool_range(tool));
    watches.push_back(watch);
  };
  if (!rule.require.empty() || !rule.comment.empty()) {
    watch.reported = events_of(rule.before);
    watch.started = events_of(rule.since);
    watch.ended = events_of(rule.require);
    watch.comment = rule.comment;
    watch.is_on_first = rule.since.empty();
    watches.push_back(std::move(watch));
  } else if (!rule.forbid.empty()) {
    watch.reported = events_of(rule.forbid);
    watch.started = events_of(rule.after);
    watch.ended = events_of(rule.until);
    watch.is_on_first = watch.stays_on = rule.after.empty();
    watches.push_back(std::move(watch));
  } else if (!rule.head.empty()) {
    watch.reported = {{.kind = HouseEvent::Kind::Motion}};
    watch.is_on_first = true;
    add_words(rule.head, watch, watches);
  } else if (!rule.end.empty()) {
    watch.reported = {{.kind = HouseEvent::Kind::End}};
    watch.started = {{.kind = HouseEvent::Kind::Cut}};
    add_words(rule.end, watch, watches);
  }
  add_range(Kind::Speed, rule.speed_from, rule.speed_to);
  add_range(Kind::Feed, rule.feed_from, rule.feed_to);
  add_range(Kind::Depth, rule.lowest_z, std::nullopt);
}

/// Sets the members derived from others.
static void derive(Configuration& configuration, const std::filesystem::path& folder, bool is_right) {
  MachineConfiguration& machine = configuration.machine;
  if (machine.tools) {
    machine.setup.tools.emplace();
    for (const Tool& tool : *machine.tools) machine.setup.tools->push_back(tool.code);
  }
  if (machine.functions) {
    machine.setup.functions.emplace();
    for (const NamedFunction& function : *machine.functions) machine.setup.functions->push_back(function.number);
  }
  derive_motion(machine);
  if (is_right)
    for (const DescribedHouseRule& rule : configuration.lint.house_rules)
      add_watches(rule, configuration.lint.house_watches);
  Lint& lint = configuration.lint;
  lint.excluded = PathPatterns(folder, lint.exclude);
  for (FileOverrides& files : lint.files) files.patterns = PathPatterns(folder, files.paths);
  for (DescribedSetup& setup : configuration.setups) setup.patterns = PathPatterns(folder, setup.paths);
  configuration.folder = folder;
  machine.folder = folder;
}

/// Reads the text as the object of `key`; null means an isocnc.json.
static void read_text(std::string_view text, const Key* key, ReadConfiguration& result) {
  const std::variant<JsonValue, Mistake> parsed = parse_json(text);
  if (const auto* const mistake = std::get_if<Mistake>(&parsed)) {
    result.mistakes.push_back(*mistake);
    return;
  }
  ConfigurationReader(text, result).read(std::get<JsonValue>(parsed), key);
  std::stable_sort(result.mistakes.begin(), result.mistakes.end(),
                   [](const Mistake& a, const Mistake& b) { return a.at < b.at; });
}

ReadConfiguration read_configuration(std::string_view text, const std::filesystem::path& folder) {
  ReadConfiguration result;
  read_text(text, nullptr, result);
  derive(result.configuration, folder, result.mistakes.empty());
  return result;
}

ReadSetup read_setup(std::string_view text) {
  static const Key& kSetups =
      *std::find_if(all_keys().begin(), all_keys().end(), [](const Key& key) { return key.path == "setups"; });
  ReadConfiguration result;
  result.configuration.setups.emplace_back();
  read_text(text, &kSetups, result);
  return {.setup = std::move(result.configuration.setups.front()), .mistakes = std::move(result.mistakes)};
}

}  // namespace isocnc::configuration
