#include "interpreter/tool_library/new_machine.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <istream>
#include <ostream>
#include <vector>

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "interpreter/configuration/json_value.h"
#include "interpreter/configuration/keys.h"
#include "interpreter/configuration/read.h"
#include "interpreter/configuration/show.h"
#include "interpreter/dialect/format.h"
#include "interpreter/text/unicode.h"
#include "interpreter/tool_library/json_edits.h"
#include "interpreter/tool_library/library_reader.h"

namespace isocnc::tool_library {

using configuration::Key;
using configuration::KeyKind;
using dialect::Language;
using dialect::Text;
using nlohmann::ordered_json;

namespace {

constexpr Text kIntroduction{
    "Questions about the machine. An empty line leaves one open; what is in brackets then holds. < goes back to the "
    "question before.",
    "Domande sulla macchina. Una riga vuota lascia la risposta aperta; vale allora ciò che è fra parentesi quadre. < "
    "torna alla domanda precedente."};
constexpr std::string_view kBack = "<";
constexpr Text kNotChecked{"not checked", "non controllato"};
constexpr Text kNoAnswer{"{} is neither a number nor one of the words that are asked for",
                         "{} non è né un numero né una delle parole richieste"};

/// What is asked, in this order. Rotary axes only of machines that have them, the pivot only of heads.
constexpr std::string_view kQuestions[] = {
    "machine.kinematics.type", "machine.axes.X.min",      "machine.axes.X.max",      "machine.axes.Y.min",
    "machine.axes.Y.max",      "machine.axes.Z.min",      "machine.axes.Z.max",      "machine.axes.B.min",
    "machine.axes.B.max",      "machine.axes.C.min",      "machine.axes.C.max",      "machine.kinematics.pivot",
    "machine.axes.X.rapid",    "machine.axes.Y.rapid",    "machine.axes.Z.rapid",    "machine.maxFeed",
    "machine.maxRotarySpeed",  "machine.maxSpindleSpeed", "machine.clearance",       "machine.home.x",
    "machine.home.y",          "machine.home.z",          "machine.times.toolChange"};

const Key& key_at(std::string_view path) {
  const std::vector<Key>& keys = configuration::all_keys();
  return *std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.path == path; });
}

/// The parts of a path below `machine`: axes, X, min.
std::vector<std::string> parts_of(std::string_view path) {
  std::vector<std::string> parts;
  for (path.remove_prefix(std::string_view("machine.").size());;) {
    const std::size_t point = std::min(path.find('.'), path.size());
    parts.emplace_back(path.substr(0, point));
    if (point == path.size()) return parts;
    path.remove_prefix(point + 1);
  }
}

class Questionnaire {
 public:
  Questionnaire(std::istream& answers, std::ostream& questions, Language language)
      : answers_(answers), questions_(questions), language_(language) {}

  /// The machine with comments; none if the answers end early.
  std::optional<std::string> machine(const std::string& line_end) {
    questions_ << kIntroduction.in(language_) << '\n';
    std::vector<std::size_t> answered;
    for (std::size_t i = 0; i < std::size(kQuestions);) {
      const Reply reply = is_asked(kQuestions[i]) ? ask(key_at(kQuestions[i])) : Reply::NotAsked;
      if (reply == Reply::End) return std::nullopt;
      if (reply == Reply::Taken) answered.push_back(i);
      if (reply != Reply::Back) {
        ++i;
      } else if (!answered.empty()) {
        i = answered.back();
        answered.pop_back();
        forget(kQuestions[i]);
      }
    }
    return text_of(machine_, "machine", "  ", line_end);
  }

 private:
  enum class Reply { NotAsked, Taken, Back, End };

  bool is_asked(std::string_view path) const {
    const std::string kind = machine_.value(ordered_json::json_pointer("/kinematics/type"), "head");
    const bool is_rotary = path.find(".B.") != std::string_view::npos || path.find(".C.") != std::string_view::npos ||
                           path == "machine.maxRotarySpeed";
    if (is_rotary) return kind != "three-axis";
    return path != "machine.kinematics.pivot" || kind == "head";
  }

  Reply ask(const Key& key) {
    while (true) {
      questions_ << '\n'
                 << key.documentation.in(language_) << '\n'
                 << key.path.substr(std::string_view("machine.").size());
      if (!key.unit.en.empty()) questions_ << ", " << key.unit.in(language_);
      if (!key.choices.empty()) questions_ << ", " << fmt::format("{}", fmt::join(key.choices, " / "));
      questions_ << " [" << fallback_of(key) << "]: " << std::flush;
      std::string line;
      if (!std::getline(answers_, line)) return Reply::End;
      line.erase(0, std::min(line.find_first_not_of(" \t"), line.size()));
      line.resize(line.find_last_not_of(" \t\r") + 1);
      if (line == kBack) return Reply::Back;
      if (line.empty() || take(key, line)) return Reply::Taken;
    }
  }

  /// Takes an answer back, and the objects that held nothing else.
  void forget(std::string_view path) {
    ordered_json::json_pointer place;
    for (const std::string& part : parts_of(path)) place /= part;
    if (!machine_.contains(place)) return;
    do {
      machine_[place.parent_pointer()].erase(place.back());
      place.pop_back();
    } while (!place.empty() && machine_[place].empty());
  }

  /// What holds without an answer.
  std::string fallback_of(const Key& key) const {
    configuration::Configuration defaults;
    const auto all = ordered_json::parse(configuration::to_json(defaults));
    const ordered_json* value = &all.at("machine");
    for (const std::string& part : parts_of(key.path)) {
      const auto found = value->find(part);
      if (found == value->end()) return std::string(kNotChecked.in(language_));
      value = &*found;
    }
    return value->is_string() ? value->get<std::string>() : value->dump();
  }

  /// Whether the answer is one that the file may have; says why not.
  bool take(const Key& key, const std::string& answer) {
    const std::optional<ordered_json> value = value_of(key, answer);
    if (!value) {
      questions_ << dialect::format(kNoAnswer, language_, configuration::shortened(text::printable(answer))) << '\n';
      return false;
    }
    ordered_json changed = machine_;
    ordered_json* place = &changed;
    for (const std::string& part : parts_of(key.path)) place = &(*place)[part];
    *place = *value;
    const std::string text = ordered_json{{"machine", changed}}.dump();
    const configuration::ReadConfiguration read = configuration::read_configuration(text, std::filesystem::path());
    for (const configuration::Mistake& mistake : read.mistakes) questions_ << mistake.message(language_) << '\n';
    if (!read.mistakes.empty()) return false;
    machine_ = std::move(changed);
    return true;
  }

  static std::optional<ordered_json> value_of(const Key& key, std::string answer) {
    if (key.kind == KeyKind::Choice) {
      const auto found = std::find(key.choices.begin(), key.choices.end(), answer);
      return found == key.choices.end() ? std::nullopt : std::optional<ordered_json>(std::string(*found));
    }
    std::replace(answer.begin(), answer.end(), ',', '.');
    const char* const begin = answer.data() + (answer.starts_with('+') ? 1 : 0);
    double number = 0;
    const auto read = fast_float::from_chars(begin, answer.data() + answer.size(), number);
    if (read.ec != std::errc{} || read.ptr != answer.data() + answer.size() || !std::isfinite(number))
      return std::nullopt;
    // As it was written, 0.10 as 0.1, 5 as 5.
    return ordered_json::parse(fmt::format("{}", number), nullptr, false);
  }

  /// An object on lines, each key with its documentation as a comment.
  std::string text_of(const ordered_json& object, const std::string& path, const std::string& indentation,
                      const std::string& line_end) const {
    std::string text = "{" + line_end;
    for (auto member = object.begin(); member != object.end(); ++member) {
      const std::string inner = indentation + "  ";
      const std::string key_path = path + "." + member.key();
      const auto& keys = configuration::all_keys();
      const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& each) { return each.path == key_path; });
      if (key != keys.end() && !key->documentation.en.empty())
        text += inner + "// " + std::string(key->documentation.in(language_)) + line_end;
      text += inner + ordered_json(member.key()).dump() + ": ";
      text += member->is_object() ? text_of(*member, key_path, inner, line_end) : in_one_line(*member);
      if (std::next(member) != object.end()) text += ",";
      text += line_end;
    }
    return text + indentation + "}";
  }

  std::istream& answers_;
  std::ostream& questions_;
  Language language_;
  ordered_json machine_ = ordered_json::object();
};

}  // namespace

bool has_machine(std::string_view text) {
  const auto parsed = configuration::parse_json(text);
  const auto* const root = std::get_if<configuration::JsonValue>(&parsed);
  const auto* const machine = root == nullptr ? nullptr : member_of(*root, "machine");
  return machine != nullptr && !machine->members.empty();
}

std::optional<std::string> ask_for_machine(std::string_view text, std::istream& answers, std::ostream& questions,
                                           Language language) {
  const std::string_view whole = text.empty() ? "{}\n" : text;
  JsonEdits edits(whole);
  std::optional<std::string> machine =
      Questionnaire(answers, questions, language).machine(std::string(edits.line_end()));
  if (!machine) return std::nullopt;
  const auto parsed = configuration::parse_json(whole);
  const auto& root = std::get<configuration::JsonValue>(parsed);
  if (const auto* const known = member_of(root, "machine")) {
    edits.replace(*known, *std::move(machine));  // It is empty.
  } else {
    edits.add_members(root, {{"machine", *std::move(machine)}});
  }
  return edits.apply();
}

}  // namespace isocnc::tool_library
