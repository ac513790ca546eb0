#include "interpreter/tool_library/tool_import.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "interpreter/configuration/json_value.h"
#include "interpreter/configuration/keys.h"
#include "interpreter/configuration/read.h"
#include "interpreter/configuration/show.h"
#include "interpreter/configuration/tool_bodies.h"
#include "interpreter/dialect/format.h"
#include "interpreter/running/event.h"
#include "interpreter/text/unicode.h"
#include "interpreter/tool_library/json_edits.h"
#include "interpreter/tool_library/library_reader.h"

namespace isocnc::tool_library {

using configuration::JsonValue;
using configuration::MachineConfiguration;
using configuration::NamedRows;
using configuration::Tool;
using dialect::Language;
using dialect::Text;
using execution::ToolCode;
using nlohmann::ordered_json;
using running::tool_name;

namespace {

constexpr Text kSeveralTools{"the map's {0} means {1} tools of the library: {2}; map them by their names",
                             "{0} della mappa indica {1} utensili della libreria: {2}; vanno indicati per nome"};
constexpr Text kSeveralOfOneName{"the map's {0} means {1} tools of the library; map them by their numbers: {2}",
                                 "{0} della mappa indica {1} utensili della libreria; vanno indicati per numero: {2}"};
constexpr Text kSeveralAlike{
    "the map's {0} means {1} tools of the library: {2}; give them other names or numbers in the library",
    "{0} della mappa indica {1} utensili della libreria: {2}; dare loro altri nomi o numeri nella libreria"};
constexpr Text kTwoAtPlace{"two tools of the library stand at {0}: {1} and {2}",
                           "due utensili della libreria stanno a {0}: {1} e {2}"};
constexpr Text kUnmapped{"the map gives it no place", "la mappa non gli dà un posto"};
constexpr Text kNeedsLength{"its shape is left out, since its length from the spindle nose is not known",
                            "la forma è omessa: non si sa la lunghezza dal naso del mandrino"};
constexpr Text kKindWithoutShape{"no shape is known for what the library calls {0}",
                                 "non c'è una forma per ciò che la libreria chiama {0}"};

constexpr std::string_view kNameless = "?";

/// What a tool of the library is called in messages.
std::string label_of(const LibraryTool& tool) {
  if (tool.tool.name.empty() && tool.number.empty() && tool.has_place) return tool_name(tool.tool.code);
  if (tool.tool.name.empty()) return tool.number.empty() ? std::string(kNameless) : tool.number;
  return text::printable(tool.tool.name);
}

/// The tools as their keys in JSON, in the order of the table of keys.
std::vector<ordered_json> in_json(std::vector<Tool> tools) {
  configuration::Configuration configuration;
  configuration.machine.tools = std::move(tools);
  const ordered_json all = ordered_json::parse(configuration::to_json(configuration));
  return all.at("machine").at("tools").get<std::vector<ordered_json>>();
}

ordered_json in_json(const configuration::NumberRows& rows) {
  configuration::Configuration configuration;
  configuration.machine.holders = {{"holder", rows}};
  return ordered_json::parse(configuration::to_json(configuration)).at("machine").at("holders").at("holder");
}

/// Overwrites what the library knows.
Tool merged(Tool tool, const Tool& read) {
  const auto take = [&](auto Tool::*key) {
    if (read.*key) tool.*key = read.*key;
  };
  if (!read.name.empty()) tool.name = read.name;
  if (!read.body.empty()) tool.body = read.body;
  if (!read.shape.empty() || read.profile) {  // These go together.
    tool.shape = read.shape;
    tool.profile = read.profile;
    const bool means_nothing = tool.corner_radius == 0 && read.shape != "bull";  // It may stay.
    if (!means_nothing) tool.corner_radius = read.corner_radius;
    tool.tip_angle = read.tip_angle;
  }
  take(&Tool::corner_radius);
  take(&Tool::tip_angle);
  take(&Tool::length);
  take(&Tool::radius);
  take(&Tool::cut_length);
  take(&Tool::max_depth);
  take(&Tool::shank);
  return tool;
}

/// Leaves out what may not stand without a key that the library does not know. Returns whether that was a shape.
bool drop_what_needs_more(Tool& tool) {
  const bool has_shape = !tool.shape.empty() || tool.profile;
  bool dropped = false;
  if (!tool.length || (!tool.shape.empty() && !tool.radius)) {
    dropped = has_shape && !tool.length;
    if (tool.shape == "bull") tool.corner_radius.reset();
    tool.shape.clear();
    tool.profile.reset();
  }
  if (!tool.length) tool.body.clear();
  if (!tool.length || (!tool.profile && !tool.cut_length)) tool.shank.reset();
  if (tool.shape != "bull" && tool.corner_radius.value_or(0) > 0) tool.corner_radius.reset();
  return dropped;
}

/// Takes the keys of these names back from the tool as it was, where it had them.
void keep(const Tool& old, const std::vector<std::string>& names, Tool& tool) {
  configuration::Configuration before;
  configuration::Configuration after;
  before.machine.tools = {old};
  after.machine.tools = {tool};
  for (const std::string& name : names) {
    const configuration::Key* const key = tool_key(name);
    if (key == nullptr) continue;
    const configuration::ValueSlot from = key->slot(before, {0, 0});
    const configuration::ValueSlot to = key->slot(after, {0, 0});
    if (const auto* const number = std::get_if<std::optional<double>*>(&from)) {
      if (**number) *std::get<std::optional<double>*>(to) = **number;
    } else if (const auto* const text = std::get_if<std::string*>(&from)) {
      if (!(*text)->empty()) *std::get<std::string*>(to) = **text;
    } else if (const auto* const rows = std::get_if<std::optional<configuration::NumberRows>*>(&from)) {
      if (**rows) *std::get<std::optional<configuration::NumberRows>*>(to) = **rows;
    }
  }
  tool = after.machine.tools->front();
}

class Importer {
 public:
  Importer(const MachineConfiguration& machine, const Library& library, const ImportOptions& options)
      : before_(machine),
        machine_(machine),
        library_(library),
        map_(options.map),
        kept_(options.kept),
        language_(options.language) {
    if (!machine_.tools) machine_.tools.emplace();
    for (std::size_t i = 0; i < machine_.tools->size(); ++i) index_.emplace((*machine_.tools)[i].code, i);
  }

  std::variant<ToolImport, std::string> run() {
    find_places();
    name_holders();
    if (!mistakes_.empty()) return fmt::format("{}", fmt::join(mistakes_, "\n"));
    for (const LibraryTool& tool : library_.tools) take(tool);
    find_kept();
    std::sort(import_.changes.begin(), import_.changes.end(),
              [](const auto& a, const auto& b) { return a.tool.code < b.tool.code; });
    return std::move(import_);
  }

 private:
  template <class... Values>
  void fail(const Text& why, const Values&... values) {
    mistakes_.push_back(dialect::format(why, language_, values...));
  }

  /// Says by what the tools that a key of the map means can be told apart.
  void report_several(const std::string& key, const std::vector<const LibraryTool*>& tools) {
    const auto listed = [&](auto&& text_of_tool) {
      constexpr std::size_t kShown = 4;
      std::string texts;
      for (std::size_t i = 0; i < std::min(tools.size(), kShown); ++i)
        texts += (i == 0 ? "" : ", ") + text_of_tool(*tools[i]);
      return tools.size() > kShown ? texts + ", ..." : texts;
    };
    const auto tells_apart = [&](auto&& text_of_tool) {
      std::set<std::string> texts;
      for (const LibraryTool* tool : tools) texts.insert(text_of_tool(*tool));
      return texts.size() == tools.size() && !texts.contains("");
    };
    const auto name = [](const LibraryTool& tool) { return std::string(trimmed(tool.tool.name)); };
    const auto number = [](const LibraryTool& tool) { return text::printable(tool.number); };
    const std::string shown = configuration::shortened(key);
    if (tells_apart(name)) return fail(kSeveralTools, shown, tools.size(), listed(label_of));
    if (tells_apart(number)) return fail(kSeveralOfOneName, shown, tools.size(), listed(number));
    fail(kSeveralAlike, shown, tools.size(), listed(label_of));
  }

  /// Finds the place of each tool that has one, and what makes that unclear.
  void find_places() {
    std::map<std::string, std::vector<const LibraryTool*>> by_key;
    for (const LibraryTool& tool : library_.tools) {
      if (!tool.number.empty()) by_key[tool.number].push_back(&tool);
      const std::string name(trimmed(tool.tool.name));
      if (!name.empty() && name != tool.number) by_key[name].push_back(&tool);
    }
    for (const auto& entry : map_.places) {
      const std::string& key = entry.first;
      const auto found = by_key.find(key);
      if (found == by_key.end()) {
        import_.unused.push_back(key);
        continue;
      }
      std::vector<const LibraryTool*> tools = found->second;
      // A name of the map means a tool whatever its number is.
      if (tools.size() > 1)
        std::erase_if(tools, [&](const LibraryTool* tool) {
          const std::string name(trimmed(tool->tool.name));
          return name != key && map_.places.contains(name);
        });
      if (tools.size() > 1) {
        report_several(key, tools);
      } else if (!tools.empty()) {
        places_[tools.front()] = entry.second;
      }
    }
    std::map<ToolCode, const LibraryTool*> at;
    for (const LibraryTool& tool : library_.tools) {
      if (tool.has_place) places_.try_emplace(&tool, tool.tool.code);
      const auto place = places_.find(&tool);
      if (place == places_.end()) continue;
      const auto [other, is_first] = at.emplace(place->second, &tool);
      if (!is_first) fail(kTwoAtPlace, tool_name(place->second), label_of(*other->second), label_of(tool));
    }
  }

  void take(const LibraryTool& read) {
    const auto place = places_.find(&read);
    if (place != places_.end()) taken_.push_back(place->second);
    if (!read.mistakes.empty()) {
      import_.refused.push_back({read.number, label_of(read), {}, {}, read.mistakes});
      return;
    }
    if (place == places_.end()) {
      import_.refused.push_back({read.number, label_of(read), kUnmapped, {}, {}});
      return;
    }
    const auto index = index_.find(place->second);
    const Tool* const old = index == index_.end() ? nullptr : &(*machine_.tools)[index->second];
    Tool tool = read.tool;
    const std::optional<ToolImport::NewHolder> holder = holder_of(read, tool);
    if (holder) set_holder(holder->holder);
    Tool whole = merged(old == nullptr ? Tool() : *old, tool);
    whole.code = place->second;
    if (old != nullptr) keep(*old, kept_, whole);
    const bool lacks_length = drop_what_needs_more(whole);
    const auto bodies = configuration::tool_bodies(machine_, whole);
    if (const auto* const objection = std::get_if<configuration::Objection>(&bodies)) {
      const configuration::Mistake mistake{.at = 0,
                                           .key = std::string(objection->member),
                                           .text = objection->text,
                                           .names = objection->names,
                                           .meant = {}};
      import_.refused.push_back(
          {read.number, label_of(read), Text{"{0}", "{0}"}, {configuration::Named(mistake.message(language_))}, {}});
      machine_.holders = before_.holders;
      for (const auto& each : import_.holders) set_holder(each.holder);
      return;
    }
    // A holder comes in with the first tool that is in it.
    const bool uses_holder = holder && whole.body == holder->holder.name;
    if (uses_holder) import_.holders.push_back(*holder);
    add_change(whole, old, lacks_length, read);
  }

  /// The holder of a tool, where the machine lacks it or has another of this name; names it in the tool.
  std::optional<ToolImport::NewHolder> holder_of(const LibraryTool& read, Tool& tool) {
    if (!read.holder) return std::nullopt;
    const std::string& name = holder_names_.at({read.holder->name, read.holder->rows});
    tool.body = name;
    if (std::any_of(import_.holders.begin(), import_.holders.end(),
                    [&](const auto& each) { return each.holder.name == name; }))
      return std::nullopt;  // With another tool.
    const auto known = std::find_if(before_.holders.begin(), before_.holders.end(),
                                    [&](const NamedRows& each) { return each.name == name; });
    if (known != before_.holders.end()) return std::nullopt;
    return ToolImport::NewHolder{{name, read.holder->rows}};
  }

  /// A holder of the machine never changes, since other tools may be in it: one of the library with its name but
  /// another shape gets a number behind the name, the same each time.
  void name_holders() {
    std::set<std::string> of_library;
    for (const LibraryTool& tool : library_.tools)
      if (tool.holder) of_library.insert(tool.holder->name);
    std::map<std::string, configuration::NumberRows> taken;
    for (const NamedRows& holder : before_.holders) taken.emplace(holder.name, holder.rows);
    for (const LibraryTool& tool : library_.tools) {
      if (!tool.holder) continue;
      const auto [place, is_new] = holder_names_.try_emplace({tool.holder->name, tool.holder->rows});
      if (!is_new) continue;
      std::string name = tool.holder->name;
      for (int copy = 2;; ++copy) {
        const bool is_of_another = copy > 2 && of_library.contains(name);
        const auto known = taken.find(name);
        if (!is_of_another && (known == taken.end() || known->second == tool.holder->rows)) break;
        name = fmt::format("{} {}", tool.holder->name, copy);
      }
      taken.emplace(name, tool.holder->rows);
      place->second = std::move(name);
    }
  }

  void set_holder(const NamedRows& holder) {
    const auto known = std::find_if(machine_.holders.begin(), machine_.holders.end(),
                                    [&](const NamedRows& each) { return each.name == holder.name; });
    if (known == machine_.holders.end()) {
      machine_.holders.push_back(holder);
    } else {
      known->rows = holder.rows;
    }
  }

  void add_change(const Tool& tool, const Tool* old, bool lacks_length, const LibraryTool& read) {
    ToolImport::ImportedTool change{
        .tool = tool, .is_new = old == nullptr, .values = {}, .left_out = {}, .left_out_name = {}};
    const ordered_json after = in_json({tool}).front();
    const ordered_json before = old == nullptr ? ordered_json::object() : in_json({*old}).front();
    const auto shown = [](const ordered_json& object, const std::string& key) {
      const auto found = object.find(key);
      return found == object.end() ? std::string() : in_one_line(*found);
    };
    const auto compare = [&](const std::string& key) {
      if (key == "head" || key == "holder" || key == "tool") return;
      ToolImport::Value value{key, shown(before, key), shown(after, key)};
      if (value.before != value.after) change.values.push_back(std::move(value));
    };
    for (const auto& item : after.items()) compare(item.key());
    for (const auto& item : before.items())
      if (!after.contains(item.key())) compare(item.key());
    if (lacks_length) {
      change.left_out = kNeedsLength;
    } else if (!read.kind_without_shape.empty() && tool.shape.empty() && !tool.profile) {
      change.left_out = kKindWithoutShape;
      change.left_out_name = configuration::shortened(read.kind_without_shape);
    }
    if (!change.is_new && change.values.empty()) {
      ++import_.unchanged;
    } else {
      import_.changes.push_back(std::move(change));
    }
  }

  void find_kept() {
    std::sort(taken_.begin(), taken_.end());
    for (const Tool& tool : *machine_.tools)
      if (!std::binary_search(taken_.begin(), taken_.end(), tool.code)) import_.kept.push_back(tool);
  }

  const MachineConfiguration& before_;
  MachineConfiguration machine_;  // With the holders that have come in.
  const Library& library_;
  const ToolMap& map_;
  const std::vector<std::string>& kept_;
  Language language_;
  std::map<ToolCode, std::size_t> index_;  // Of the tools of the machine.
  std::map<const LibraryTool*, ToolCode> places_;
  std::map<std::pair<std::string, configuration::NumberRows>, std::string> holder_names_;
  std::vector<ToolCode> taken_;
  ToolImport import_;
  std::vector<std::string> mistakes_;
};

}  // namespace

std::variant<ToolImport, std::string> import_tools(const MachineConfiguration& machine, const Library& library,
                                                   const ImportOptions& options) {
  return Importer(machine, library, options).run();
}

bool has_mistaken_entry(const ToolImport& import) {
  return std::any_of(import.refused.begin(), import.refused.end(),
                     [](const ToolImport::Refused& refused) { return !refused.mistakes.empty(); });
}

std::vector<std::string> tool_key_names() {
  std::vector<std::string> names;
  for (const configuration::Key* key : tool_keys())
    if (!key->is_required) names.emplace_back(key->name());
  return names;
}

namespace {

constexpr Text kSummary{
    "{0} new, {1} changed, {2} as before, {3} of the machine not in the library, {4} of the library not taken",
    "{0} nuovi, {1} cambiati, {2} come prima, {3} della macchina non nella libreria, {4} della libreria non presi"};
constexpr Text kHolder{"holder {}", "portautensile {}"};
constexpr Text kStays{"stays as it is", "resta com'è"};
constexpr Text kNotTaken{"not taken: {}", "non preso: {}"};
constexpr Text kUnusedKey{"the map's {} is in no tool of the library",
                          "{} della mappa non è in nessun utensile della libreria"};

std::string quoted(const std::string& name) {
  return name.empty()
             ? ""
             : " " + ordered_json(text::printable(name)).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::string shown_import(const ToolImport& import, Language language) {
  std::string shown;
  const auto line = [&](char sign, const std::string& text) { shown += fmt::format("{} {}\n", sign, text); };
  for (const ToolImport::NewHolder& change : import.holders)
    line('+', dialect::format(kHolder, language, quoted(change.holder.name).substr(1)) + ": " +
                  in_one_line(in_json(change.holder.rows)));
  std::size_t fresh = 0;
  for (const ToolImport::ImportedTool& change : import.changes) {
    fresh += change.is_new ? 1 : 0;
    std::string values;
    for (const ToolImport::Value& value : change.values) {
      if (value.key == "name" && change.is_new) continue;  // It stands before.
      values += values.empty() ? ": " : ", ";
      values += value.key + ' ';
      if (!value.before.empty()) values += value.before + " -> ";
      values += value.after.empty() ? "-" : value.after;
    }
    line(change.is_new ? '+' : '~', tool_name(change.tool.code) + quoted(change.tool.name) + values);
    if (!change.left_out.en.empty()) line(' ', "  " + dialect::format(change.left_out, language, change.left_out_name));
  }
  for (const Tool& tool : import.kept)
    line('=', tool_name(tool.code) + quoted(tool.name) + ": " + std::string(kStays.in(language)));
  for (const ToolImport::Refused& refused : import.refused) {
    const std::string why =
        !refused.mistakes.empty() ? refused.mistakes.front()
        : refused.names.empty()
            ? std::string(refused.why.in(language))
            : dialect::format(refused.why, language,
                              language == Language::Italian ? refused.names[0].it : refused.names[0].en);
    std::string who =
        refused.number.empty() || refused.number == refused.name ? refused.name : refused.number + " " + refused.name;
    who = who == kNameless && !refused.mistakes.empty() ? "" : who + ": ";  // The place in the file says which one.
    line('!', who + dialect::format(kNotTaken, language, why));
    for (std::size_t i = 1; i < refused.mistakes.size(); ++i) line(' ', "  " + refused.mistakes[i]);
  }
  for (const std::string& key : import.unused)
    line('!', dialect::format(kUnusedKey, language, configuration::shortened(key)));
  shown += dialect::format(kSummary, language, fresh, import.changes.size() - fresh, import.unchanged,
                           import.kept.size(), import.refused.size());
  return shown + '\n';
}

namespace {

/// Writes an import into the text of a configuration.
class ImportWriter {
 public:
  ImportWriter(std::string_view text, const JsonValue& root, const ToolImport& import)
      : edits_(text), root_(root), import_(import) {}

  std::string write() {
    const JsonValue* const machine = member_of(root_, "machine");
    const JsonValue* const tools = machine == nullptr ? nullptr : member_of(*machine, "tools");
    const JsonValue* const holders = machine == nullptr ? nullptr : member_of(*machine, "holders");
    // The indentation of the members of the machine.
    std::string indentation = "    ";
    if (machine != nullptr && !machine->members.empty())
      indentation = edits_.indentation_at(machine->members.front().at);
    std::vector<NewMember> added;
    if (holders != nullptr) {
      change_holders(*holders);
    } else if (!import_.holders.empty()) {
      std::vector<std::string> lines;
      for (const auto& change : import_.holders)
        lines.push_back(ordered_json(change.holder.name).dump() + ": " + in_one_line(in_json(change.holder.rows)));
      added.push_back({"holders", on_lines('{', lines, '}', indentation)});
    }
    if (tools != nullptr) {
      change_tools(*tools);
    } else if (!import_.changes.empty()) {
      added.push_back({"tools", on_lines('[', new_tools(), ']', indentation)});
    }
    if (machine != nullptr) {
      edits_.add_members(*machine, added);
    } else if (!added.empty()) {
      std::vector<std::string> lines;
      for (const NewMember& member : added) lines.push_back(ordered_json(member.key).dump() + ": " + member.value);
      edits_.add_members(root_, {{"machine", on_lines('{', lines, '}', "  ")}});
    }
    return edits_.apply();
  }

 private:
  std::string on_lines(char open, const std::vector<std::string>& lines, char close,
                       const std::string& indentation) const {
    std::string text(1, open);
    for (const std::string& line : lines) {
      if (&line != &lines.front()) text += ',';
      text += std::string(edits_.line_end()) + indentation + "  " + line;
    }
    return text + std::string(edits_.line_end()) + indentation + close;
  }

  std::vector<std::string> new_tools() const {
    std::vector<std::string> lines;
    for (const ToolImport::ImportedTool& change : import_.changes)
      if (change.is_new) lines.push_back(in_one_line(in_json({change.tool}).front()));
    return lines;
  }

  void change_holders(const JsonValue& holders) {
    std::vector<NewMember> added;
    for (const ToolImport::NewHolder& each : import_.holders)
      added.push_back({each.holder.name, in_one_line(in_json(each.holder.rows))});
    edits_.add_members(holders, added);
  }

  static int number_of(const JsonValue& tool, std::string_view key) {
    const JsonValue* const value = member_of(tool, key);
    return value == nullptr ? 0 : static_cast<int>(value->number);
  }

  void change_tools(const JsonValue& tools) {
    std::map<ToolCode, const JsonValue*> written;
    for (const JsonValue& tool : tools.elements)
      written[{number_of(tool, "head"), number_of(tool, "holder"), number_of(tool, "tool")}] = &tool;
    for (const ToolImport::ImportedTool& change : import_.changes)
      if (!change.is_new) change_tool(*written.at(change.tool.code), change);
    edits_.add_elements(tools, new_tools());
  }

  void change_tool(const JsonValue& tool, const ToolImport::ImportedTool& change) {
    // Members go with the comma before them. Where that cannot be, the tool is written anew.
    const auto is_lost = [&](const std::string& key) {
      return std::any_of(change.values.begin(), change.values.end(),
                         [&](const ToolImport::Value& value) { return value.key == key && value.after.empty(); });
    };
    const bool adds_keys = std::any_of(change.values.begin(), change.values.end(),
                                       [](const ToolImport::Value& value) { return value.before.empty(); });
    if (is_lost(tool.members.front().key) || (adds_keys && is_lost(tool.members.back().key)))
      return edits_.replace(tool, in_one_line(in_json({change.tool}).front()));
    for (std::size_t i = 1; i < tool.members.size(); ++i)
      if (is_lost(tool.members[i].key)) edits_.remove(tool.members[i - 1].value.end, tool.members[i].value.end);
    std::vector<NewMember> added;
    for (const ToolImport::Value& value : change.values) {
      if (value.after.empty()) continue;
      if (const JsonValue* const known = member_of(tool, value.key)) {
        edits_.replace(*known, value.after);
      } else {
        added.push_back({value.key, value.after});
      }
    }
    edits_.add_members(tool, added);
  }

  JsonEdits edits_;
  const JsonValue& root_;
  const ToolImport& import_;
};

}  // namespace

std::optional<std::string> with_import(std::string_view text, const std::filesystem::path& folder,
                                       const ToolImport& import) {
  const std::string_view whole = text.empty() ? "{}\n" : text;
  const auto parsed = configuration::parse_json(whole);
  const auto* const root = std::get_if<JsonValue>(&parsed);
  if (root == nullptr || root->kind != JsonValue::Kind::Object) return std::nullopt;
  std::string changed = ImportWriter(whole, *root, import).write();
  if (changed.size() > configuration::kLongestFile) return std::nullopt;
  const configuration::ReadConfiguration read = configuration::read_configuration(changed, folder);
  if (!read.mistakes.empty()) return std::nullopt;
  for (const ToolImport::ImportedTool& change : import.changes) {
    const Tool* const tool = read.configuration.machine.find_tool(change.tool.code);
    if (tool == nullptr || in_json({*tool}) != in_json({change.tool})) return std::nullopt;
  }
  return changed;
}

}  // namespace isocnc::tool_library
