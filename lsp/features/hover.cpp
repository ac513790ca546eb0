#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analyzer/formats/rendering.h"
#include "interpreter/dialect/codes.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/letters.h"
#include "interpreter/execution/machine_move.h"
#include "interpreter/kinematics/travel.h"
#include "interpreter/text/unicode.h"
#include "interpreter/timing/timing.h"
#include "lsp/features/feature.h"
#include "lsp/queries/assignments.h"
#include "lsp/queries/line_run.h"
#include "lsp/queries/obstacles.h"

/// Hover: the meaning of a word in its place, the state there, and the findings on it.
namespace isocnc::features {
namespace {

using dialect::Text;
using documents::LandmarkKind;
using queries::LineRun;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::Word;

/// The maximum number of places listed before "and others".
constexpr std::size_t kMaxPlaces = 10;

struct Hover {
  Json contents;
  ClientRange range;
};

void to_json(Json& json, const Hover& hover) { json = {{"contents", hover.contents}, {"range", hover.range}}; }

/// Describes one word, paragraph by paragraph.
class HoverWriter {
 public:
  /// A word of the line.
  HoverWriter(const Snapshot& snapshot, std::size_t line_number, const syntax::LineTree& line, const Word& word)
      : snapshot_(snapshot), line_number_(line_number), line_(line), word_(word), language_(snapshot.language()) {}

  std::string describe() {
    describe_meaning();
    describe_findings();
    return fmt::format("{}", fmt::join(paragraphs_, "\n\n"));
  }

 private:
  template <class... Values>
  std::string text(const Text& text, const Values&... values) const {
    return dialect::format(text, language_, values...);
  }
  void add(std::string paragraph) { paragraphs_.push_back(std::move(paragraph)); }
  void title(std::string_view meaning) {
    add(fmt::format("**{}** {}", as_written(line_.text_of(word_.span())), meaning));
  }
  /// Words of the program or its configuration, as Markdown.
  static std::string as_written(std::string_view words) { return protocol::in_markdown(text::printable(words)); }

  const Instruction* instruction() const {
    const auto mine = [&](const Instruction& each) {
      return &line_.command(each) == &word_ || each.number == word_.owner;
    };
    const auto found = std::find_if(line_.instructions.begin(), line_.instructions.end(), mine);
    return found == line_.instructions.end() ? nullptr : &*found;
  }

  void describe_meaning() {
    switch (word_.letter) {
      case 'G':
        return describe_g();
      case 'M':
        return describe_m();
      case 'T':
        return describe_tool();
      case 'N':
        return describe_label();
      case 'V':
        return describe_register();
      case syntax::kIf:
      case syntax::kGoto:
        return describe_jump();
      case syntax::kVgpl:
        return describe_vgpl();
      case syntax::kAssign:
      case syntax::kNumber:
        return describe_value();
      case syntax::kOperator:
        return describe_operator();
      default:
        return describe_letter();
    }
  }

  void describe_letter() {
    const std::string_view meaning = dialect::meaning_of(word_.letter).in(language_);
    if (!meaning.empty()) title(meaning);
    const Instruction* const owner = instruction();
    if (owner && owner->is_motion()) describe_motion();
  }

  void describe_g() {
    const Instruction* const owner = instruction();
    const dialect::GCode* const code = owner ? owner->g() : nullptr;
    if (!code) return;
    title(fmt::format("{} ({})", code->name.in(language_), code->section));
    if (code->is_motion()) describe_motion();
    if (code->role == dialect::GRole::Dwell) describe_dwell();
  }

  /// Formats values that all paths agree on, and `?` for those on which they differ.
  class Agreement {
   public:
    explicit Agreement(const std::vector<LineRun>& runs) : runs_(runs) {}

    template <class Value>
    std::string of(Value value) {
      std::string first = dialect::format_value(value(runs_.front()));
      for (const LineRun& run : runs_)
        if (dialect::format_value(value(run)) != first) {
          is_partial = true;
          return "?";
        }
      return first;
    }

    bool is_partial = false;

   private:
    const std::vector<LineRun>& runs_;
  };

  void describe_motion() {
    static constexpr Text kFace = {"face frame", "s.d.r. di faccia"};
    static constexpr Text kWorkpiece = {"workpiece frame", "s.d.r. di pezzo"};
    static constexpr Text kMachine = {"machine frame", "s.d.r. di macchina"};
    static constexpr Text kArc = {"center X{0} Y{1} Z{2}, radius {3} {6}, sweep {4}°, length {5} {6}",
                                  "centro X{0} Y{1} Z{2}, raggio {3} {6}, ampiezza {4}°, lunghezza {5} {6}"};
    static constexpr Text kTime = {"at the programmed feed {} s", "alla velocità programmata {} s"};
    static constexpr Text kRapid = {"at full rapid speed {} s", "alla massima velocità di rapido {} s"};
    static constexpr Text kMotionLength = {"length {} {}", "lunghezza {} {}"};
    static constexpr Text kPartial = {"`?`: that depends on the jumps before", "`?`: dipende dai salti precedenti"};
    const std::vector<LineRun> runs = queries::run_line_on_all_paths(snapshot_, line_number_);
    const auto is_unclear = [](const LineRun& run) {
      return !run.move || run.after.unknown != 0 || !run.moved_in.is_frame_known();
    };
    if (runs.empty() || std::any_of(runs.begin(), runs.end(), is_unclear)) return;
    const auto all = [&](auto holds) { return std::all_of(runs.begin(), runs.end(), holds); };
    Agreement agreement(runs);
    // As the program has it.
    is_in_inches_ = all([](const LineRun& run) { return run.after.in_inches(); });
    const double mm_per_unit = dialect::mm_per_unit(is_in_inches_);
    std::vector<std::string> rows;
    const auto row = [&](const Text& name, auto tip) {
      const auto coordinate = [&](int axis) {
        return agreement.of([&](const LineRun& run) { return tip(run)[axis] / mm_per_unit; });
      };
      rows.push_back(fmt::format("- {}{}: X{} Y{} Z{} B{} C{}", name.in(language_),
                                 dialect::inches_note(is_in_inches_, language_), coordinate(0), coordinate(1),
                                 coordinate(2), agreement.of([](const LineRun& run) { return run.move->to.b; }),
                                 agreement.of([](const LineRun& run) { return run.move->to.c; })));
    };
    if (all([](const LineRun& run) { return run.moved_in.face_mounted; }))
      row(kFace, [](const LineRun& run) { return run.move->to.tip; });
    row(kWorkpiece, [](const LineRun& run) -> geometry::Vec3 {
      const geometry::Vec3& tip = run.move->to.tip;
      return run.moved_in.face_mounted ? run.moved_in.face.to_outer(tip) : tip;
    });
    row(kMachine, [](const LineRun& run) -> geometry::Vec3 { return run.moved_in.to_machine(run.move->to.tip); });
    add(fmt::format("{}", fmt::join(rows, "\n")));
    const auto in_machine = [](const LineRun& run) { return execution::in_machine(*run.move, run.moved_in); };
    const std::string length =
        agreement.of([&](const LineRun& run) { return tip_length(in_machine(run), run) / mm_per_unit; });
    if (all([](const LineRun& run) { return run.move->kind == execution::MoveKind::Arc; })) {
      const auto center = [&](int axis) {
        return agreement.of([&](const LineRun& run) { return run.move->center[axis] / mm_per_unit; });
      };
      add(text(kArc, center(0), center(1), center(2),
               agreement.of([&](const LineRun& run) { return in_machine(run).radius / mm_per_unit; }),
               agreement.of([&](const LineRun& run) { return in_machine(run).sweep_deg; }), length, unit()));
    } else {
      add(text(kMotionLength, length, unit()));
    }
    if (all([](const LineRun& run) { return run.move->feed > 0; })) {
      const bool knows_feed = all(
          [](const LineRun& run) { return run.move->inverse_time || execution::feed_in_force(run.after).is_known; });
      if (!knows_feed) agreement.is_partial = true;
      add(text(kTime,
               knows_feed ? agreement.of([&](const LineRun& run) { return seconds_at_feed(in_machine(run)); }) : "?"));
    } else if (all([](const LineRun& run) { return run.move->kind == execution::MoveKind::Rapid; })) {
      add(text(kRapid, agreement.of([&](const LineRun& run) { return seconds_in_rapid(in_machine(run)); })));
    }
    if (agreement.is_partial) add(text(kPartial));
    describe_removed();
    describe_nearest(runs);
  }

  /// What the motion cuts from the blank.
  void describe_removed() {
    static constexpr Text kRemoves = {"removes {0} cm3, {1} {3} deep, width {2} {3}",
                                      "asporta {0} cm3, profondità {1} {3}, larghezza {2} {3}"};
    const auto removed = snapshot_.removed_on(line_number_);
    if (!removed) return;
    add(text(kRemoves, shown(rounded_gap(removed->volume / 1000)), shown_gap(removed->depth), shown_gap(removed->width),
             unit()));
  }

  /// What of the setup the motion hits or comes nearest to.
  void describe_nearest(const std::vector<LineRun>& runs) {
    static constexpr Text kNearest = {"nearest: {}, {} {}", "più vicino: {}, {} {}"};
    static constexpr Text kHits = {"hits {}, {} {} deep", "urta {}, entra di {} {}"};
    static constexpr Text kWithoutTool = {" (without the tool, which has no shape)",
                                          " (senza l'utensile, che non ha forma)"};
    const std::optional<queries::NearestObstacle> nearest = queries::nearest_obstacle(snapshot_, line_number_, runs);
    if (!nearest) return;
    const verification::Neighbor& neighbor = nearest->neighbor;
    const double amount = neighbor.is_contact() ? -neighbor.distance : neighbor.clearance;
    const std::string name = as_written(neighbor.whom.in(language_));
    add(text(neighbor.is_contact() ? kHits : kNearest, name, shown_gap(amount), unit()) +
        (nearest->is_without_tool ? std::string(kWithoutTool.in(language_)) : ""));
  }

  /// The unit of lengths of the motion.
  std::string_view unit() const { return dialect::unit_of_length(is_in_inches_, language_); }

  /// A length in this unit, as exactly as it is known.
  std::string shown_gap(double millimeters) const {
    const double per_unit = dialect::mm_per_unit(is_in_inches_);
    if (!is_in_inches_) return shown(rounded_gap(millimeters));
    const double steps = millimeters < 1 ? 10'000 : 1'000;
    return shown(std::max(1.0, std::round(millimeters / per_unit * steps)) / steps);
  }

  /// Millimeters as they are known: to a tenth, and to a hundredth close by.
  static double rounded_gap(double millimeters) {
    const double steps = millimeters < 1 ? 100 : 10;
    return std::max(0.01, std::round(millimeters * steps) / steps);
  }

  /// The length of the tip's path in mm. In a rapid that turns B or C the tip swings.
  double tip_length(const execution::MachineMove& move, const LineRun& run) const {
    const timing::TimedMachine& machine = snapshot_.configuration().machine.timed;
    return kinematics::tip_travel(machine.motion,
                                  timing::planned_move(move, machine, machine.tool_length(run.after.tool)))
        .length;
  }

  /// The duration of a feed move in seconds, without the machine's accelerations.
  static double seconds_at_feed(const execution::MachineMove& move) {
    const double turned = std::hypot(move.to.b - move.from.b, move.to.c - move.from.c);
    const double way = move.inverse_time ? 1 : (move.length > 0 ? move.length : turned);
    return std::round(60 * way / move.feed * 100) / 100;
  }

  /// The duration of a rapid in seconds, by the axis that takes longest, without accelerations.
  double seconds_in_rapid(const execution::MachineMove& move) const {
    const geometry::Vec3 way = move.to.tip - move.from.tip;
    const std::array<double, execution::kAxisCount> ways = {way.x(), way.y(), way.z(), move.to.b - move.from.b,
                                                            move.to.c - move.from.c};
    double minutes = 0;
    for (std::size_t axis = 0; axis < ways.size(); ++axis)
      minutes = std::max(minutes, std::abs(ways[axis]) / snapshot_.configuration().machine.rapids[axis]);
    return std::round(60 * minutes * 100) / 100;
  }

  static std::string shown(double value) { return dialect::format_value(value); }

  void describe_dwell() {
    static constexpr Text kWaits = {"waits {} s", "attende {} s"};
    const std::vector<LineRun> runs = queries::run_line_on_all_paths(snapshot_, line_number_);
    if (!runs.empty() && runs.front().dwell > 0) add(text(kWaits, shown(runs.front().dwell)));
  }

  void describe_jump() {
    static constexpr Text kJump = {"jumps down to the line of the label after GOTO where the condition holds (I.5)",
                                   "salta alla riga dell'etichetta dopo GOTO, più in basso, se la condizione è vera "
                                   "(I.5)"};
    title(kJump.in(language_));
  }

  void describe_vgpl() {
    static constexpr Text kVgpl = {"variable that the machine's own program sets, Var_IF[1] (I.5)",
                                   "variabile impostata dal programma GPL della macchina, Var_IF[1] (I.5)"};
    title(kVgpl.in(language_));
  }

  /// Describes a value: what a register, or a parameter of an M, is set to or compared with.
  void describe_value() {
    static constexpr Text kCompared = {"what it is compared with", "valore di confronto"};
    static constexpr Text kSet = {"what it is set to", "valore assegnato"};
    title((line_.jump ? kCompared : kSet).in(language_));
  }

  void describe_operator() {
    static constexpr std::array<Text, 6> kComparisons = {{{"is equal to", "è uguale a"},
                                                          {"is not equal to", "è diverso da"},
                                                          {"is less than", "è minore di"},
                                                          {"is at most", "è minore o uguale a"},
                                                          {"is greater than", "è maggiore di"},
                                                          {"is at least", "è maggiore o uguale a"}}};
    if (word_.digits < kComparisons.size()) title(kComparisons[word_.digits].in(language_));
  }

  void describe_m() {
    static constexpr Text kTakes = {"takes {} s", "richiede {} s"};
    static constexpr Text kTakesWhereItChanges = {"takes {} s where it changes what the spindle does",
                                                  "richiede {} s se cambia ciò che fa il mandrino"};
    for (const dialect::MCode& code : dialect::kMCodes) {
      if (word_.value != code.number) continue;
      title(fmt::format("{} ({})", code.name.in(language_), code.section));
      const timing::Durations& durations = snapshot_.configuration().machine.timed.durations;
      if (code.number == dialect::kToolChange) add(text(kTakes, shown(durations.tool_change)));
      if (code.number >= 3 && code.number <= 5) add(text(kTakesWhereItChanges, shown(durations.spindle)));
      return;
    }
    static constexpr Text kUser = {"user function", "funzione dell'utente"};
    title(kUser.in(language_));
    const auto* const function = snapshot_.configuration().machine.find_function(word_.value);
    if (!function) return;
    add(as_written(function->name));
    if (function->seconds > 0) add(text(kTakes, shown(function->seconds)));
  }

  void describe_tool() {
    static constexpr Text kTool = {"head {}, holder {}, tool {}", "testa {}, portautensile {}, utensile {}"};
    static constexpr Text kLength = {"length {} mm", "lunghezza {} mm"};
    static constexpr Text kRadius = {"radius {} mm", "raggio {} mm"};
    const std::optional<int> number = word_.tool_number();
    if (!number) return;
    const execution::ToolCode code = execution::tool_code(*number);
    title(text(kTool, code.head, code.holder, code.tool));
    const configuration::Tool* const tool = snapshot_.configuration().machine.find_tool(code);
    if (!tool) return;
    std::vector<std::string> data;
    if (!tool->name.empty()) data.push_back(as_written(tool->name));
    if (tool->length) data.push_back(text(kLength, shown(*tool->length)));
    if (tool->radius) data.push_back(text(kRadius, shown(*tool->radius)));
    if (!data.empty()) add(fmt::format("{}", fmt::join(data, ", ")));
  }

  struct Texts {
    Text one;
    Text many;
  };

  /// Writes `name: 3, 7, 12 ...`, with line numbers from 1.
  void list_places(const Texts& names, const std::vector<documents::Landmark>& places) {
    if (places.empty()) return;
    std::vector<std::size_t> lines;
    for (std::size_t i = 0; i < std::min(places.size(), kMaxPlaces); ++i) lines.push_back(places[i].line + 1u);
    const Text& name = lines.size() == 1 ? names.one : names.many;
    add(fmt::format("{} {}{}", name.in(language_), fmt::join(lines, ", "), places.size() > kMaxPlaces ? " ..." : ""));
  }

  void describe_label() {
    static constexpr Text kTarget = {"target of a jump", "destinazione di un salto"};
    static constexpr Text kNumber = {"line number", "numero di riga"};
    static constexpr Texts kJumps = {{"jump to it: line", "salto da: riga"}, {"jumps to it: lines", "salti da: righe"}};
    const bool is_target = line_.jump && line_.jump->target_span == word_.span();
    const std::uint64_t label = is_target ? line_.jump->target : line_.label;
    const auto jumps = snapshot_.index().landmarks(documents::kinds(LandmarkKind::Jump), label);
    title((is_target ? kTarget : kNumber).in(language_));
    list_places(kJumps, jumps);
  }

  void describe_register() {
    static constexpr Text kRegister = {"register", "registro"};
    static constexpr Texts kAssigned = {{"assigned: line", "assegnato: riga"}, {"assigned: lines", "assegnato: righe"}};
    static constexpr Texts kCompared = {{"compared: line", "confrontato: riga"},
                                        {"compared: lines", "confrontato: righe"}};
    title(kRegister.in(language_));
    const auto number = static_cast<std::uint64_t>(word_.register_number());
    if (number == 0) return;
    describe_values();
    list_places(kAssigned, snapshot_.index().landmarks(documents::kinds(LandmarkKind::Assignment), number));
    list_places(kCompared, snapshot_.index().landmarks(documents::kinds(LandmarkKind::Comparison), number));
  }

  /// The values that a compared register may have there.
  void describe_values() {
    static constexpr Text kMayBe = {"here it may be {}", "qui può valere {}"};
    static constexpr Text kValue = {"{} (line {})", "{} (riga {})"};
    const auto read = queries::name_at(snapshot_, {line_number_, word_.begin});
    if (!read || read->is_definition) return;
    std::vector<std::string> values;
    for (const queries::Occurrence& each : queries::assignments_reaching(snapshot_, *read)) {
      if (values.size() == kMaxPlaces) break;
      const syntax::DocumentLine assigning = snapshot_.document().line(each.line);
      const syntax::LineTree& line = *assigning;
      const Word* const value = value_after(line, each.span);
      if (value && value->known()) values.push_back(text(kValue, shown(value->value), each.line + 1));
    }
    if (!values.empty()) add(text(kMayBe, fmt::format("{}", fmt::join(values, ", "))));
  }

  /// The value in `V1 = 2`, where `command` is the span of the V.
  static const Word* value_after(const syntax::LineTree& line, syntax::Span command) {
    const auto is_value = [&](const Word& word) { return word.letter == syntax::kAssign && word.begin >= command.end; };
    const auto value = std::find_if(line.words.begin(), line.words.end(), is_value);
    return value == line.words.end() ? nullptr : &*value;
  }

  void describe_findings() {
    for (const check::LocatedFinding& located : snapshot_.findings_on(line_number_)) {
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
  bool is_in_inches_ = false;  ///< The motion is under G70.
  std::vector<std::string> paragraphs_;
};

std::optional<Hover> answer_hover(const Snapshot& snapshot, const protocol::PositionParams& params) {
  const syntax::Position place = snapshot.from_client(params.position);
  const syntax::DocumentLine read = snapshot.document().line(place.line);
  const syntax::LineTree& line = *read;
  const Word* const word = line.word_at(static_cast<std::uint32_t>(place.column));
  if (!word) return std::nullopt;
  std::string text = HoverWriter(snapshot, place.line, line, *word).describe();
  if (text.empty()) return std::nullopt;
  return Hover{.contents = snapshot.client().in_format({std::move(text)}, "/textDocument/hover/contentFormat"),
               .range = snapshot.to_client(place.line, word->span())};
}

Json hover_capabilities(const Client&) { return {{"hoverProvider", true}}; }

}  // namespace

extern const Feature hover = {.capabilities = hover_capabilities, .methods = {on<&answer_hover>("textDocument/hover")}};

}  // namespace isocnc::features
