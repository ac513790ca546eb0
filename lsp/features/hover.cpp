#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analyzer/rendering.h"
#include "interpreter/dialect/argument_letters.h"
#include "interpreter/dialect/codes.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/format.h"
#include "interpreter/execution/machine_move.h"
#include "interpreter/syntax/unicode.h"
#include "lsp/documents/assignments.h"
#include "lsp/documents/line_run.h"
#include "lsp/features/feature.h"

/// What a word means where it stands, with the state there, and what is wrong with it.
namespace isocnc::lsp::features {
namespace {

using dialect::Text;
using documents::LandmarkKind;
using documents::LineRun;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::Word;

/// Places that are named before "and others".
constexpr std::size_t kMostPlaces = 10;

struct Hover {
  documents::Markdown contents;
  ClientRange range;
};

void to_json(Json& json, const Hover& hover) { json = {{"contents", hover.contents}, {"range", hover.range}}; }

/// Tells of one word, paragraph by paragraph.
class Teller {
 public:
  /// A word of the line.
  Teller(const Snapshot& snapshot, std::size_t line_number, const syntax::LineTree& line, const Word& word)
      : snapshot_(snapshot), line_number_(line_number), line_(line), word_(word), language_(snapshot.language()) {}

  std::string tell() {
    tell_meaning();
    tell_findings();
    return fmt::format("{}", fmt::join(paragraphs_, "\n\n"));
  }

 private:
  template <class... Values>
  std::string text(const Text& text, const Values&... values) const {
    return dialect::format(text, language_, values...);
  }
  void add(std::string paragraph) { paragraphs_.push_back(std::move(paragraph)); }
  void title(std::string_view meaning) {
    add(fmt::format("**{}** {}", syntax::printable(line_.text_of(word_.span())), meaning));
  }

  const Instruction* instruction() const {
    const auto mine = [&](const Instruction& each) {
      return &line_.command(each) == &word_ || each.number == word_.owner;
    };
    const auto found = std::find_if(line_.instructions.begin(), line_.instructions.end(), mine);
    return found == line_.instructions.end() ? nullptr : &*found;
  }

  void tell_meaning() {
    switch (word_.letter) {
      case 'G':
        return tell_g();
      case 'M':
        return tell_m();
      case 'T':
        return tell_tool();
      case 'N':
        return tell_label();
      case 'V':
        return tell_register();
      case syntax::kIf:
      case syntax::kVgpl:
      case syntax::kGoto:
      case syntax::kAssign:
      case syntax::kOperator:
        return;
      default:
        return tell_letter();
    }
  }

  void tell_letter() {
    const std::string_view meaning = dialect::meaning_of(word_.letter).in(language_);
    if (!meaning.empty()) title(meaning);
    const Instruction* const owner = instruction();
    const bool moves = owner && (owner->kind == InstructionKind::Continuation ||
                                 (owner->kind == InstructionKind::G && owner->g() && owner->g()->is_motion()));
    if (moves) tell_motion();
  }

  void tell_g() {
    const Instruction* const owner = instruction();
    const dialect::GCode* const code = owner ? owner->g() : nullptr;
    if (!code) return;
    title(fmt::format("{} ({})", code->name.in(language_), code->section));
    if (code->is_motion()) tell_motion();
  }

  void tell_motion() {
    static constexpr Text kFace = {"face frame", "s.d.r. di faccia"};
    static constexpr Text kWorkpiece = {"workpiece frame", "s.d.r. di pezzo"};
    static constexpr Text kMachine = {"machine frame", "s.d.r. di macchina"};
    static constexpr Text kArc = {"center X{} Y{} Z{}, radius {} mm, sweep {}°, length {} mm",
                                  "centro X{} Y{} Z{}, raggio {} mm, ampiezza {}°, lunghezza {} mm"};
    static constexpr Text kTime = {"at the programmed feed {} s", "alla velocità programmata {} s"};
    static constexpr Text kWay = {"length {} mm", "lunghezza {} mm"};
    const auto run = documents::run_line(snapshot_, line_number_);
    if (!run || !run->move || run->after.unknown != 0) return;
    const execution::State& state = run->moved_in;
    const geometry::Pose& to = run->move->to;
    std::vector<std::string> rows;
    const auto row = [&](const Text& name, const geometry::Vec3& tip) {
      rows.push_back(fmt::format("- {}: X{} Y{} Z{} B{} C{}", name.in(language_), shown(tip.x()), shown(tip.y()),
                                 shown(tip.z()), shown(to.b), shown(to.c)));
    };
    if (state.face_mounted) row(kFace, to.tip);
    row(kWorkpiece, state.face_mounted ? state.face.to_outer(to.tip) : to.tip);
    row(kMachine, state.to_machine(to.tip));
    add(fmt::format("{}", fmt::join(rows, "\n")));
    const execution::MachineMove move = execution::in_machine(*run->move, state);
    const geometry::Vec3& center = run->move->center;
    add(move.kind == execution::MoveKind::Arc ? text(kArc, shown(center.x()), shown(center.y()), shown(center.z()),
                                                     shown(move.radius), shown(move.sweep_deg), shown(move.length))
                                              : text(kWay, shown(move.length)));
    if (move.feed > 0) add(text(kTime, shown(seconds_at_feed(move))));
  }

  /// To the hundredth, without the machine's accelerations.
  static double seconds_at_feed(const execution::MachineMove& move) {
    const double turned = std::hypot(move.to.b - move.from.b, move.to.c - move.from.c);
    const double way = move.inverse_time ? 1 : (move.length > 0 ? move.length : turned);
    return std::round(60 * way / move.feed * 100) / 100;
  }

  static std::string shown(double value) { return dialect::format_value(value); }

  void tell_m() {
    for (const dialect::MCode& code : dialect::kMCodes)
      if (word_.value == code.number) return title(fmt::format("{} ({})", code.name.in(language_), code.section));
    static constexpr Text kUser = {"user function", "funzione dell'utente"};
    title(kUser.in(language_));
    const auto& functions = snapshot_.configuration().machine.functions;
    if (!functions) return;
    for (const configuration::NamedFunction& function : *functions)
      if (word_.value == function.number) add(syntax::printable(function.name));
  }

  void tell_tool() {
    static constexpr Text kTool = {"head {}, holder {}, tool {}", "testa {}, portautensile {}, utensile {}"};
    static constexpr Text kLength = {"length {} mm", "lunghezza {} mm"};
    static constexpr Text kRadius = {"radius {} mm", "raggio {} mm"};
    if (!word_.is_plain_integer() || word_.digits != 6) return;
    const execution::ToolCode code = execution::tool_code(static_cast<int>(word_.value));
    title(text(kTool, code.head, code.holder, code.tool));
    const auto& tools = snapshot_.configuration().machine.tools;
    if (!tools) return;
    for (const configuration::Tool& tool : *tools) {
      if (tool.code != code) continue;
      std::vector<std::string> data;
      if (!tool.name.empty()) data.push_back(syntax::printable(tool.name));
      if (tool.length) data.push_back(text(kLength, shown(*tool.length)));
      if (tool.radius) data.push_back(text(kRadius, shown(*tool.radius)));
      if (!data.empty()) add(fmt::format("{}", fmt::join(data, ", ")));
    }
  }

  /// `name: 3, 7, 12 ...`: line numbers as users count.
  void tell_places(const Text& name, const std::vector<documents::Landmark>& places) {
    if (places.empty()) return;
    std::vector<std::size_t> lines;
    for (std::size_t i = 0; i < std::min(places.size(), kMostPlaces); ++i) lines.push_back(places[i].line + 1u);
    add(fmt::format("{} {}{}", name.in(language_), fmt::join(lines, ", "), places.size() > kMostPlaces ? " ..." : ""));
  }

  void tell_label() {
    static constexpr Text kTarget = {"target of a jump", "destinazione di un salto"};
    static constexpr Text kNumber = {"line number", "numero di riga"};
    static constexpr Text kJumps = {"jumps to it: lines", "salti da: righe"};
    const bool is_target = line_.jump && line_.jump->target_span == word_.span();
    const std::uint64_t label = is_target ? line_.jump->target : line_.label;
    const auto jumps = snapshot_.index().landmarks(documents::kinds(LandmarkKind::Jump), label);
    title((is_target ? kTarget : kNumber).in(language_));
    tell_places(kJumps, jumps);
  }

  void tell_register() {
    static constexpr Text kRegister = {"register", "registro"};
    static constexpr Text kAssigned = {"assigned: lines", "assegnato: righe"};
    static constexpr Text kCompared = {"compared: lines", "confrontato: righe"};
    title(kRegister.in(language_));
    if (!word_.is_plain_integer() || !(word_.value >= 1 && word_.value <= dialect::kRegisterCount)) return;
    const auto number = static_cast<std::uint64_t>(word_.value);
    tell_values();
    tell_places(kAssigned, snapshot_.index().landmarks(documents::kinds(LandmarkKind::Assignment), number));
    tell_places(kCompared, snapshot_.index().landmarks(documents::kinds(LandmarkKind::Comparison), number));
  }

  /// What a register that is compared may hold there.
  void tell_values() {
    static constexpr Text kMayBe = {"here it may be {}", "qui può valere {}"};
    static constexpr Text kValue = {"{} (line {})", "{} (riga {})"};
    const auto read = documents::name_at(snapshot_, {line_number_, word_.begin});
    if (!read || read->is_definition) return;
    std::vector<std::string> values;
    for (const documents::Occurrence& each : documents::assignments_reaching(snapshot_, *read)) {
      if (values.size() == kMostPlaces) break;
      const syntax::DocumentLine read = snapshot_.document().line(each.line);
      const syntax::LineTree& line = *read;
      const Word* const value = value_behind(line, each.span);
      if (value && value->known()) values.push_back(text(kValue, shown(value->value), each.line + 1));
    }
    if (!values.empty()) add(text(kMayBe, fmt::format("{}", fmt::join(values, ", "))));
  }

  /// The value of `V1 = 2`, whose V stands at the span.
  static const Word* value_behind(const syntax::LineTree& line, syntax::Span command) {
    const auto is_value = [&](const Word& word) { return word.letter == syntax::kAssign && word.begin >= command.end; };
    const auto value = std::find_if(line.words.begin(), line.words.end(), is_value);
    return value == line.words.end() ? nullptr : &*value;
  }

  void tell_findings() {
    for (const analyzer::LocatedFinding& located : snapshot_.findings_on(line_number_)) {
      if (!located.finding.span.holds(word_.begin)) continue;
      const dialect::DiagnosticDef& def = dialect::definition(located.finding.id);
      add(fmt::format("**{}** {}", def.code, def.explanation.in(language_)));
    }
  }

  const Snapshot& snapshot_;
  const std::size_t line_number_;
  const syntax::LineTree& line_;
  const Word& word_;
  const dialect::Language language_;
  std::vector<std::string> paragraphs_;
};

std::optional<Hover> answer_hover(const Snapshot& snapshot, const documents::PositionParams& params) {
  const syntax::Position place = snapshot.from_client(params.position);
  const syntax::DocumentLine read = snapshot.document().line(place.line);
  const syntax::LineTree& line = *read;
  const Word* const word = line.word_at(static_cast<std::uint32_t>(place.column));
  if (!word) return std::nullopt;
  std::string text = Teller(snapshot, place.line, line, *word).tell();
  if (text.empty()) return std::nullopt;
  return Hover{.contents = {std::move(text)}, .range = snapshot.to_client(place.line, word->span())};
}

Json hover_capabilities(const Client&) { return {{"hoverProvider", true}}; }

}  // namespace

extern const Feature hover = {.capabilities = hover_capabilities, .methods = {on<&answer_hover>("textDocument/hover")}};

}  // namespace isocnc::lsp::features
