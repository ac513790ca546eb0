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
      return JsonKind::List;
    case KeyKind::Object:
    case KeyKind::Named:
    case KeyKind::Severities:
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

static std::optional<Fault> fault_of(TextKind kind, std::string_view text) {
  switch (kind) {
    case TextKind::Code:
      if (dialect::find_codes(text)) return std::nullopt;
      return Fault{mistakes::kUnknownCode, dialect::nearest_code(text)};
    case TextKind::Pattern:
      return pattern_fault(text);
    case TextKind::Extension:
      return extension_fault(text);
    case TextKind::Function:
      return function_number(text) ? std::nullopt : std::optional(Fault{mistakes::kBadFunction, {}});
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

static std::optional<std::string> meant_key(std::string_view written, const std::vector<const Key*>& keys) {
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const Key* key : keys) names.emplace_back(key->name());
  if (auto near = dialect::nearest_name(written, names)) return near;
  return same_name_elsewhere(written);
}

namespace {

/// Compares a tree of values with the table of keys, and stores the valid ones in their slots.
class ConfigurationReader {
 public:
  ConfigurationReader(std::string_view text, ReadConfiguration& result) : text_(text), result_(result) {}

  void read(const JsonValue& root) {
    if (root.kind == JsonKind::Object) return read_members(root, nullptr, "", 0);
    complain(root.at, "", mistakes::kWrongKind, {name_of(root.kind), name_of(JsonKind::Object)});
  }

 private:
  /// The keys of one object so far, with their offsets.
  using SeenKeys = std::unordered_map<std::string_view, std::size_t>;

  /// Limits the list to a hundred mistakes: users read no more, and searching corrections takes time.
  bool is_full() const { return result_.mistakes.size() >= 100; }

  void complain(std::size_t at, const std::string& key, const Text& text, std::vector<Named> names = {},
                std::optional<std::string> meant = {}) {
    if (is_full()) return;
    result_.mistakes.push_back({at, shortened(key), text, std::move(names), std::move(meant)});
  }

  void read_value(const Key& key, const JsonValue& value, const std::string& path, std::size_t index) {
    if (value.kind != json_of(key.kind))
      return complain(value.at, path, mistakes::kWrongKind, {name_of(value.kind), name_of(json_of(key.kind))});
    const ValueSlot slot = key.slot ? key.slot(result_.configuration, index) : ValueSlot();
    switch (key.kind) {
      case KeyKind::Object:
        if (const auto* const renumber = std::get_if<std::optional<Renumber>*>(&slot)) (*renumber)->emplace();
        return read_object(key, value, path, index);
      case KeyKind::Objects:
        return read_objects(key, value, path, slot);
      case KeyKind::Named:
        return read_named(key, value, path, slot);
      case KeyKind::Number:
      case KeyKind::Integer:
        return read_number(key, value, path, slot);
      case KeyKind::Boolean:
        *std::get<bool*>(slot) = value.boolean;
        return;
      case KeyKind::Text:
        if (is_right(key.text, value.string, value.at, path) && !std::holds_alternative<std::monostate>(slot))
          *std::get<std::string*>(slot) = value.string;
        return;
      case KeyKind::Choice:
        return read_choice(key, value, path, slot);
      case KeyKind::Texts:
        return read_texts(key, value, path, *std::get<std::vector<std::string>*>(slot));
      case KeyKind::Severities:
        return read_severities(key, value, path, *std::get<std::vector<std::pair<std::string, std::string>>*>(slot));
    }
  }

  /// Reads an object, a list element or a named object: first its keys, then conditions on several keys.
  void read_object(const Key& key, const JsonValue& object, const std::string& path, std::size_t index) {
    const std::size_t before = result_.mistakes.size();
    read_members(object, &key, path, index);
    if (result_.mistakes.size() != before || !key.objection) return;
    const std::optional<Objection> objection = key.objection(result_.configuration, index);
    if (!objection) return;
    const auto member = std::find_if(object.members.begin(), object.members.end(),
                                     [&](const JsonMember& each) { return each.key == objection->member; });
    const bool is_member = member != object.members.end();
    complain(is_member ? member->value.at : object.at, is_member ? path + "." + member->key : path, objection->text);
  }

  void read_members(const JsonValue& object, const Key* key, const std::string& path, std::size_t index) {
    const std::vector<const Key*> keys = keys_below(key);
    SeenKeys seen;
    for (const JsonMember& member : object.members) {
      if (is_full()) return;
      const std::string below = path + (path.empty() ? "" : ".") + member.key;
      const auto known =
          std::find_if(keys.begin(), keys.end(), [&](const Key* each) { return each->name() == member.key; });
      if (is_duplicate(member, seen, below)) continue;
      if (known == keys.end()) {
        complain(member.at, below, mistakes::kUnknownKey, {}, meant_key(member.key, keys));
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

  void read_objects(const Key& key, const JsonValue& list, const std::string& path, const ValueSlot& slot) {
    if (const auto* const tools = std::get_if<std::optional<std::vector<Tool>>*>(&slot)) (*tools)->emplace();
    for (std::size_t i = 0; i < list.elements.size() && !is_full(); ++i) {
      const JsonValue& element = list.elements[i];
      const std::string below = fmt::format("{}[{}]", path, i);
      if (element.kind != JsonKind::Object) {
        complain(element.at, below, mistakes::kWrongKind, {name_of(element.kind), name_of(JsonKind::Object)});
        continue;
      }
      read_object(key, element, below, add_element(slot));
    }
  }

  /// Adds an element to the list and returns its index.
  static std::size_t add_element(const ValueSlot& slot) {
    if (const auto* const tools = std::get_if<std::optional<std::vector<Tool>>*>(&slot)) {
      (*tools)->value().emplace_back();
      return (*tools)->value().size() - 1;
    }
    std::vector<FileOverrides>& files = *std::get<std::vector<FileOverrides>*>(slot);
    files.emplace_back();
    return files.size() - 1;
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
      read_object(key, member.value, below, functions.size() - 1);
    }
  }

  void read_number(const Key& key, const JsonValue& value, const std::string& path, const ValueSlot& slot) {
    const double number = value.number;
    const std::string written = fmt::format("{}", number);
    const auto limit = [&](double bound) -> Named {
      Named named(fmt::format("{}{}{}", bound, key.unit.en.empty() ? "" : " ", key.unit.en));
      named.it = fmt::format("{}{}{}", bound, key.unit.it.empty() ? "" : " ", key.unit.it);
      return named;
    };
    const NumberRange& range = key.range;
    if (key.kind == KeyKind::Integer && std::floor(number) != number)
      return complain(value.at, path, mistakes::kNotWhole, {written});
    if (range.exclusive_minimum && !(number > range.minimum))
      return complain(value.at, path, mistakes::kNotAbove, {written, limit(range.minimum)});
    if (!(number >= range.minimum))
      return complain(value.at, path, mistakes::kTooSmall, {written, limit(range.minimum)});
    if (!(number <= range.maximum)) return complain(value.at, path, mistakes::kTooBig, {written, limit(range.maximum)});
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
  ReadConfiguration& result_;
};

}  // namespace

/// Sets the members of the simulated machine, in its units.
static void derive_motion(MachineConfiguration& machine) {
  kinematics::Machine& motion = machine.timed.motion;
  motion.kinematics.kind = machine.kind == "head"    ? kinematics::MachineKind::Head
                           : machine.kind == "table" ? kinematics::MachineKind::Table
                                                     : kinematics::MachineKind::ThreeAxis;
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

/// Sets the members derived from others.
static void derive(Configuration& configuration, const std::filesystem::path& folder) {
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
  Lint& lint = configuration.lint;
  lint.excluded = PathPatterns(folder, lint.exclude);
  for (FileOverrides& files : lint.files) files.patterns = PathPatterns(folder, files.paths);
}

ReadConfiguration read_configuration(std::string_view text, const std::filesystem::path& folder) {
  ReadConfiguration result;
  const std::variant<JsonValue, Mistake> parsed = parse_json(text);
  if (const auto* const mistake = std::get_if<Mistake>(&parsed)) {
    result.mistakes.push_back(*mistake);
    return result;
  }
  ConfigurationReader(text, result).read(std::get<JsonValue>(parsed));
  std::stable_sort(result.mistakes.begin(), result.mistakes.end(),
                   [](const Mistake& a, const Mistake& b) { return a.at < b.at; });
  derive(result.configuration, folder);
  return result;
}

}  // namespace isocnc::configuration
