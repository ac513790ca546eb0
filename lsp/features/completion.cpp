#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/dialect/codes.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/letters.h"
#include "interpreter/execution/block_recorder.h"
#include "interpreter/execution/plane.h"
#include "interpreter/running/event.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"
#include "interpreter/text/unicode.h"
#include "lsp/features/feature.h"

/// Completion: codes that are legal at the cursor, the missing arguments, labels, tools, registers. This file holds no
/// rules of legality: each code is tried on the line, and one that causes a new finding is not offered.
namespace isocnc::features {

using dialect::Language;
using dialect::Text;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineTree;
using syntax::Word;

namespace {

/// The protocol's CompletionItemKind.
enum class ItemKind { Method = 2, Function = 3, Field = 5, Variable = 6, Value = 12, Keyword = 14, Reference = 18 };

/// The maximum number of forward labels offered, and of lines searched for them.
constexpr std::size_t kMaxLabels = 200;
constexpr std::size_t kMaxLinesForLabels = 100'000;

/// A completion. `written` is inserted, with its placeholders if the client supports snippets.
struct CompletionCandidate {
  std::string label;
  ItemKind kind = ItemKind::Keyword;
  std::string written;  ///< The inserted text as a snippet: `P${1:1}`.
  std::string detail;
  std::string documentation;
  std::optional<std::string> code = std::nullopt;  ///< The code whose documentation is fetched by resolve: `G02`.
};

/// A snippet as plain text: `P${1:1} Q$0` becomes `P1 Q`.
std::string plain(std::string_view snippet) {
  std::string text;
  for (std::size_t i = 0; i < snippet.size(); ++i) {
    if (snippet[i] == '$' && i + 1 < snippet.size() && snippet[i + 1] == '{') {
      i = snippet.find(':', i);
    } else if (snippet[i] == '$') {
      ++i;
    } else if (snippet[i] != '}') {
      text += snippet[i];
    }
  }
  return text;
}

/// The kinds of findings that a line would have, sorted.
std::vector<dialect::DiagnosticId> wrong_with(const std::string& text, const execution::State* state,
                                              const Snapshot& snapshot) {
  syntax::TreeStore store;
  store.append_line(text.data(), text.data() + text.size());
  const LineTree tree = store.tree(0, text.data());
  std::vector<dialect::DiagnosticId> ids;
  const auto add = [&](const auto& findings) {
    for (const syntax::Finding& finding : findings) ids.push_back(finding.id);
  };
  if (state) {
    add(execution::BlockRecorder(tree, *state, snapshot.setup()).findings());
  } else {
    add(tree.findings);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The state in which a line is tried: a feed, a tool and the like count as given, since the user may still write them
/// above.
execution::State lenient(execution::State state) {
  state.feed_given = state.feed_reported = true;
  state.tool_selected = state.tool_reported = true;
  return state;
}

/// The arguments of an arc in the plane in force: a full circle, which is valid at any position.
std::string arguments_of_arc(const execution::State& state) {
  const execution::Plane& plane = execution::plane_in_force(state);
  const auto value = [&](int axis, double distance) {
    const double here = state.incremental() ? 0 : state.position.tip[axis];
    return dialect::format_value(here / state.mm_per_unit() + distance);
  };
  return fmt::format(" {}${{1:{}}} {}${{2:{}}} {}${{3:{}}} {}${{4:{}}}", plane.u_letter, value(plane.u, 0),
                     plane.v_letter, value(plane.v, 0), plane.u_center, value(plane.u, 10), plane.v_center,
                     value(plane.v, 0));
}

/// The initial value of an argument: a face has the axes of the frame below it, and a dwell a second.
int initial_value(const dialect::GCode& code, char letter) {
  const std::size_t at = code.axes.find(letter);
  if (at == std::string_view::npos) return code.is_frame() ? 0 : 1;
  return at / 3 == at % 3 ? 1 : 0;
}

/// Initial arguments for a code. The author chooses the coordinates of a straight motion.
std::string arguments_of(const dialect::GCode& code, const execution::State& state) {
  if (code.is_arc()) return arguments_of_arc(state);
  if (code.is_motion()) return {};
  std::string text;
  int count = 0;
  for (const char letter : dialect::kArgumentOrder)
    if (dialect::contains(code.arguments, letter))
      text += fmt::format(" {}${{{}:{}}}", letter, ++count, initial_value(code, letter));
  return text;
}

class Completer {
 public:
  Completer(const Snapshot& snapshot, const syntax::Position& place)
      : snapshot_(snapshot),
        place_(place),
        read_(snapshot.document().line(place.line)),
        line_(*read_),
        language_(snapshot.language()),
        start_(start_of_word()) {
    const auto before = snapshot.state_before(place.line);
    has_state_ = before.has_value();
    state_ = lenient(before.value_or(execution::initial_state(snapshot.setup())));
    base_ = wrong_with(with(""), &state_, snapshot);
    base_of_text_ = wrong_with(with(""), nullptr, snapshot);
  }

  Json complete(bool asked_by_blank) {
    if (!is_in_comment()) offer(asked_by_blank);
    return {{"isIncomplete", is_incomplete_}, {"items", std::move(items_)}};
  }

 private:
  /// The column where the word before the cursor starts: letters and then digits, such as `GOTO` or `G0`.
  std::size_t start_of_word() const {
    std::size_t start = place_.column;
    const auto is = [&](auto&& kind) { return start > 0 && kind(static_cast<unsigned char>(line_.text[start - 1])); };
    while (is([](unsigned char c) { return text::is_digit(static_cast<char>(c)); })) --start;
    const std::size_t digits = start;
    while (is([](unsigned char c) { return std::isalpha(c) != 0; })) --start;
    // In `X1G0` the word starts at the last letter.
    if (digits < place_.column && start < digits) return digits - 1;
    return start;
  }

  bool is_in_comment() const {
    const auto holds = [&](syntax::Span comment) {
      return comment.begin < place_.column &&
             (place_.column < comment.end || line_.text[comment.begin] == ';' || line_.text[comment.end - 1] != ')');
    };
    return std::any_of(line_.comments.begin(), line_.comments.end(), holds);
  }

  std::string_view typed() const { return line_.text.substr(start_, place_.column - start_); }
  bool types(char letter) const { return typed().empty() || text::upper(typed().front()) == letter; }
  bool types_digits() const { return !typed().empty() && text::is_digit(typed().back()); }

  /// The line with `text` instead of the word at the cursor.
  std::string with(std::string_view text) const {
    return fmt::format("{}{}{}{}", line_.text.substr(0, start_), text, text.empty() ? "" : " ",
                       line_.text.substr(place_.column));
  }

  /// Whether all kinds of findings in `ids` are also in `base`, so that the added text causes no new one.
  static bool brings_nothing(const std::vector<dialect::DiagnosticId>& base,
                             const std::vector<dialect::DiagnosticId>& ids) {
    return std::includes(base.begin(), base.end(), ids.begin(), ids.end());
  }
  bool is_legal(std::string_view text) const {
    return brings_nothing(base_, wrong_with(with(text), &state_, snapshot_));
  }
  bool is_well_written(std::string_view text) const {
    return brings_nothing(base_of_text_, wrong_with(with(text), nullptr, snapshot_));
  }

  void add(CompletionCandidate candidate) {
    const bool has_snippets = snapshot_.client().can("/textDocument/completion/completionItem/snippetSupport");
    const bool is_snippet = has_snippets && candidate.written.find('$') != std::string::npos;
    const ClientRange range = {snapshot_.to_client({place_.line, start_}), snapshot_.to_client(place_)};
    Json item = {{"label", candidate.label},
                 {"kind", static_cast<int>(candidate.kind)},
                 {"sortText", fmt::format("{:04}", items_.size())},
                 {"textEdit", protocol::TextEdit{range, is_snippet ? candidate.written : plain(candidate.written)}}};
    if (is_snippet) item["insertTextFormat"] = 2;
    if (!candidate.detail.empty()) item["detail"] = candidate.detail;
    if (!candidate.documentation.empty()) item["documentation"] = candidate.documentation;
    if (candidate.code) item["data"] = {{"uri", snapshot_.uri()}, {"code", *candidate.code}};
    items_.push_back(std::move(item));
  }

  /// The letter or sign of the last word before the one at the cursor; 0 if there is none.
  char sign_before() const {
    char sign = 0;
    for (const Word& word : line_.words)
      if (word.end <= start_) sign = word.letter;
    return sign;
  }
  bool has_before(char sign) const {
    return std::any_of(line_.words.begin(), line_.words.end(),
                       [&](const Word& word) { return word.letter == sign && word.end <= start_; });
  }

  void offer(bool asked_by_blank) {
    if (sign_before() == syntax::kGoto) return offer_labels();
    if (has_before(syntax::kIf)) return offer_condition();
    if (asked_by_blank && sign_before() != 'M') return;
    const Instruction* const owner = instruction_before();
    if (owner && owner->kind == InstructionKind::ToolChange) offer_tools();
    if (asked_by_blank) return;
    if (!types_digits()) offer_arguments(owner);
    if (types('G')) offer_g();
    if (types('M')) offer_m();
    if (types('T') && !(owner && owner->kind == InstructionKind::ToolChange)) offer_tools();
    if (types('V')) offer_registers(" = ${1:0}");
    if (types('I') && !types_digits() && is_well_written("IF V1 = 0 GOTO N1")) offer_jump();
  }

  /// The instruction that the word at the cursor continues.
  const Instruction* instruction_before() const {
    const Instruction* last = nullptr;
    for (const Instruction& each : line_.instructions) {
      const std::uint32_t begin = line_.words[each.begin].begin;
      if (begin < start_ && (!last || line_.words[last->begin].begin < begin)) last = &each;
    }
    return last;
  }

  /// If paths differ, the state is unknown, and only the notation is checked.
  bool may_be(std::string_view text) const { return has_state_ ? is_legal(text) : is_well_written(text); }

  /// Whether the next word has a letter of a dimension: then the G's arguments are already written.
  bool has_arguments_after() const {
    for (const Word& word : line_.words)
      if (word.begin >= place_.column) return dialect::contains(dialect::kDimensionLetters, word.letter);
    return false;
  }

  void offer_g() {
    for (const dialect::GCode& code : dialect::kGCodes) {
      const std::string label = fmt::format("G{:02}", code.number);
      const std::string written = label + arguments_of(code, state_);
      const CompletionCandidate candidate{label, ItemKind::Keyword, written, std::string(code.name.in(language_)), {},
                                          label};
      // G00 and G01 are tried with X0: the author will choose the coordinates.
      if (may_be(code.is_motion() && !code.is_arc() ? label + " X0" : plain(written))) {
        add(candidate);
      } else if (code.takes_arguments() && has_arguments_after() && is_well_written(label)) {
        add({label, candidate.kind, label, candidate.detail, {}, label});
      }
    }
  }

  void offer_m() {
    for (const dialect::MCode& code : dialect::kMCodes) {
      const std::string label = fmt::format("M{:02}", code.number);
      const std::string written = code.number == dialect::kToolChange ? label + " " + some_tool() : label;
      if (is_well_written(plain(written)))
        add({label, ItemKind::Function, written, std::string(code.name.in(language_)), {}, label});
    }
    const auto& functions = snapshot_.configuration().machine.functions;
    if (!functions) return;
    for (const configuration::NamedFunction& function : *functions) {
      const std::string label = fmt::format("M{}", function.number);
      if (dialect::is_user_function(function.number) && is_well_written(label))
        add({label, ItemKind::Function, label, text::printable(function.name), {}});
    }
  }

  /// An example for a T word: a tool that the machine has.
  std::string some_tool() const {
    const auto& tools = snapshot_.configuration().machine.tools;
    const std::string number = tools && !tools->empty() ? running::tool_name(tools->front().code).substr(1) : "101001";
    return fmt::format("T${{1:{}}}", number);
  }

  void offer_tools() {
    const auto& tools = snapshot_.configuration().machine.tools;
    if (!tools) return;
    for (const configuration::Tool& tool : *tools) {
      const std::string label = running::tool_name(tool.code);
      if (!is_well_written(label)) continue;
      static constexpr Text kLength = {"length {} mm", "lunghezza {} mm"};
      static constexpr Text kRadius = {"radius {} mm", "raggio {} mm"};
      std::string detail = text::printable(tool.name);
      const auto append = [&](const Text& text, const std::optional<double>& value) {
        if (!value) return;
        detail += detail.empty() ? "" : ", ";
        detail += dialect::format(text, language_, dialect::format_value(*value));
      };
      append(kLength, tool.length);
      append(kRadius, tool.radius);
      add({label, ItemKind::Value, label, detail, {}});
    }
  }

  /// The letters that the instruction takes; without an instruction, those of the motion in force.
  dialect::LetterSet letters_of(const Instruction* owner) const {
    if (owner && owner->kind == InstructionKind::G) return owner->g() ? owner->g()->arguments : 0;
    if (owner && owner->kind != InstructionKind::Continuation) return 0;
    return state_.motion() ? state_.motion()->arguments : 0;
  }

  void offer_arguments(const Instruction* owner) {
    const dialect::LetterSet letters = letters_of(owner);
    for (const char letter : dialect::kArgumentOrder)
      if (dialect::contains(letters, letter)) offer_letter(letter, value_there(letter));
    if (owner && owner->kind == InstructionKind::Function) offer_letter('P', "");
    const bool knows_feed = state_.last_feed.number > 0 && state_.last_feed.is_known;
    offer_letter('F', knows_feed ? dialect::format_value(state_.last_feed.number) : "");
    const bool knows_speed = state_.spindle_speed > 0 && state_.speed_known;
    offer_letter('S', knows_speed ? dialect::format_value(state_.spindle_speed) : "");
  }

  /// The position of the tool tip on this axis, in the units in force; empty if unknown.
  std::string value_there(char letter) const {
    if (!has_state_ || (letter < 'X' && letter != 'B' && letter != 'C')) return "";
    const geometry::Pose& pose = state_.position;
    if (letter == 'B') return dialect::format_value(pose.b);
    if (letter == 'C') return dialect::format_value(pose.c);
    return dialect::format_value(pose.tip[letter - 'X'] / state_.mm_per_unit());
  }

  void offer_letter(char letter, const std::string& now) {
    static constexpr Text kNow = {"{}; now {}", "{}; ora {}"};
    const bool is_parameter =
        letter == 'P' && instruction_before() && instruction_before()->kind == InstructionKind::Function;
    if (!types(letter) || !is_well_written(fmt::format("{}1{}", letter, is_parameter ? "=1" : ""))) return;
    std::string meaning(dialect::meaning_of(letter).in(language_));
    if (!now.empty()) meaning = dialect::format(kNow, language_, meaning, now);
    add({std::string(1, letter), ItemKind::Field, std::string(1, letter), meaning, {}});
  }

  void offer_registers(std::string_view after) {
    static constexpr Text kAssigned = {"assigned in line {}", "assegnato alla riga {}"};
    std::array<std::size_t, dialect::kRegisterCount + 1> lines{};
    for (const documents::Landmark& each :
         snapshot_.index().landmarks(documents::kinds(documents::LandmarkKind::Assignment)))
      if (std::size_t& line = lines[static_cast<std::size_t>(each.number)]; each.line < place_.line || line == 0)
        line = each.line + 1u;
    for (std::size_t number = 1; number < lines.size(); ++number) {
      const std::string label = fmt::format("V{}", number);
      const std::string written = fmt::format("{}{}", label, after);
      if (!after.empty() && !is_well_written(plain(written))) continue;
      add({label,
           ItemKind::Variable,
           written,
           lines[number] > 0 ? dialect::format(kAssigned, language_, lines[number]) : std::string(),
           {}});
    }
  }

  void offer_jump() {
    static constexpr Text kJump = {"jump forward where the condition holds", "salto in avanti se la condizione è vera"};
    add({"IF", ItemKind::Keyword, "IF ${1:VGPL} ${2:=} ${3:1} GOTO N$0", std::string(kJump.in(language_)), {}});
  }

  void offer_condition() {
    static constexpr Text kVgpl = {"the program's parameter", "parametro del programma"};
    switch (sign_before()) {
      case syntax::kIf:
        add({"VGPL", ItemKind::Variable, "VGPL", std::string(kVgpl.in(language_)), {}});
        return offer_registers("");
      case syntax::kVgpl:
      case 'V':
        for (const char* const sign : {"=", "<>", "<", "<=", ">", ">="}) add({sign, ItemKind::Keyword, sign, {}, {}});
        return;
      case syntax::kNumber:
      case syntax::kOperator:
      case syntax::kAssign:
        if (!typed().empty() && !types('G')) return;
        return add({"GOTO", ItemKind::Keyword, "GOTO N", {}, {}});
      default:
        return;
    }
  }

  /// Jumps lead forward only (I.5).
  void offer_labels() {
    const syntax::Document& document = snapshot_.document();
    const std::size_t end = std::min(document.line_count(), place_.line + 1 + kMaxLinesForLabels);
    is_incomplete_ = end < document.line_count();
    std::string_view digits = typed();
    while (!digits.empty() && !text::is_digit(digits.front())) digits.remove_prefix(1);
    for (std::size_t number = place_.line + 1; number < end; ++number) {
      if (number % 1024 == 0) snapshot_.throw_if_unwanted();
      const syntax::DocumentLine read = document.line(number);
      const syntax::LineTree& target = *read;
      if (!target.has_label()) continue;
      const std::string label = fmt::format("N{}", target.label);
      if (label.compare(1, digits.size(), digits) != 0) continue;
      if (items_.size() == kMaxLabels) {
        is_incomplete_ = true;
        return;
      }
      static constexpr Text kLine = {"line {}", "riga {}"};
      add({label, ItemKind::Reference, label, dialect::format(kLine, language_, number + 1),
           text::printable(target.text)});
    }
  }

  const Snapshot& snapshot_;
  const syntax::Position place_;
  const syntax::DocumentLine read_;
  const LineTree& line_;
  const Language language_;
  const std::size_t start_;
  execution::State state_;
  bool has_state_ = false;
  std::vector<dialect::DiagnosticId> base_;
  std::vector<dialect::DiagnosticId> base_of_text_;
  bool is_incomplete_ = false;
  Json items_ = Json::array();
};

struct CompletionParams : protocol::PositionParams {
  bool asked_by_blank = false;
};

void from_json(const Json& json, CompletionParams& params) {
  from_json(json, static_cast<protocol::PositionParams&>(params));
  const auto context = protocol::member<Json>(json, "context");
  if (context && context->is_object())
    params.asked_by_blank = protocol::member<Json>(*context, "triggerCharacter").value_or(Json()) == Json(" ");
}

Json answer_completion(const Snapshot& snapshot, const CompletionParams& params) {
  return Completer(snapshot, snapshot.from_client(params.position)).complete(params.asked_by_blank);
}

struct ItemResolveParams {
  Json item;
};

void from_json(const Json& json, ItemResolveParams& params) { params.item = json; }

std::string documentation_of(const std::string& code, Language language) {
  const char letter = code.empty() ? '\0' : code.front();
  for (const dialect::MCode& m : dialect::kMCodes)
    if (letter == 'M' && code == fmt::format("M{:02}", m.number))
      return fmt::format("**{}** {} ({})", code, m.name.in(language), m.section);
  for (const dialect::GCode& g : dialect::kGCodes) {
    if (letter != 'G' || code != fmt::format("G{:02}", g.number)) continue;
    std::string text = fmt::format("**{}** {} ({})", code, g.name.in(language), g.section);
    for (const dialect::LetterDef& def : dialect::kLetters)
      if (dialect::contains(g.arguments, def.letter))
        text += fmt::format("\n- `{}` {}", def.letter, def.meaning.in(language));
    return text;
  }
  return {};
}

Json resolve_item(const Snapshot& snapshot, const ItemResolveParams& params) {
  Json item = params.item;
  const std::string text = documentation_of(item.at("data").at("code"), snapshot.language());
  if (!text.empty())
    item["documentation"] =
        snapshot.client().in_format({text}, "/textDocument/completion/completionItem/documentationFormat");
  return item;
}

Json completion_capabilities(const Client&) {
  return {{"completionProvider", {{"triggerCharacters", {" "}}, {"resolveProvider", true}}}};
}

}  // namespace

extern const Feature completion = {
    .capabilities = completion_capabilities,
    .methods = {on<&answer_completion>("textDocument/completion"), on<&resolve_item>("completionItem/resolve")}};

}  // namespace isocnc::features
