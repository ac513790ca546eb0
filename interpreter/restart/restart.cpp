#include "interpreter/restart/restart.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/text/characters.h"

namespace isocnc::restart {

using dialect::Language;
using dialect::ModalGroup;
using dialect::Text;
using execution::State;

static constexpr Text kNoSuchLine{"there is no line {}: the last one is {}", "la riga {} non esiste: l'ultima è la {}"};
static constexpr Text kAfterProgramEnd{"line {} is not run: the program ends at line {}",
                                       "la riga {} non viene eseguita: il programma termina alla riga {}"};
static constexpr Text kJumpedOver{"line {} is not run: the IF of line {} jumps over it",
                                  "la riga {} non viene eseguita: la scavalca l'IF della riga {}"};
static constexpr Text kChoice{" (--vgpl and --set choose the way)", " (--vgpl e --set scelgono il percorso)"};
static constexpr Text kUnsafe{"no safe restart before line {}: {}", "nessuna ripresa sicura dalla riga {}: {}"};
static constexpr Text kCompensation{"cutter compensation (G{}) is in force",
                                    "è in presa la correzione raggio fresa (G{})"};
static constexpr Text kOnContour{
    "after G40 the tool still stands beside the contour, and from there the program would not go on as it does",
    "dopo la G40 l'utensile è ancora accanto al profilo, e da lì il programma non proseguirebbe allo stesso modo"};
static constexpr Text kRadiusUnknown{
    "after G40 the tool still stands beside the contour, and how far is not known without its radius (machine.tools)",
    "dopo la G40 l'utensile è ancora accanto al profilo, e senza il suo raggio (machine.tools) non si sa quanto"};
static constexpr Text kOffProgram{
    "the tool change has left the tip off the programmed place, and from there the program would not go on as it does",
    "il cambio utensile ha lasciato la punta fuori dalla quota programmata, e da lì il programma non proseguirebbe "
    "allo "
    "stesso modo"};
static constexpr Text kTipUnknown{
    "a tool before this one has no length (machine.tools), so it is not known where the tip is until Z has a "
    "coordinate",
    "un utensile prima di questo non ha lunghezza (machine.tools), quindi non si sa dove sia la punta finché Z non ha "
    "una quota"};
static constexpr Text kChangedLow{
    "the frame has changed with the tool in the cut, and no rapid has followed",
    "il sistema di riferimento è cambiato con l'utensile nel pezzo, senza un rapido dopo"};
static constexpr Text kLooksDown{"the face in force looks down and cannot be reached from above",
                                 "la faccia in presa guarda in basso e non si raggiunge dall'alto"};
static constexpr Text kPointsUp{"the tool points up and cannot be brought there from above",
                                "l'utensile punta in alto e non ci si arriva dall'alto"};
static constexpr Text kExactStop{"the G09 that comes next belongs to the motion above",
                                 "la G09 che segue appartiene al movimento che precede"};
static constexpr Text kArcContinues{"it goes on with the G{:02} above it, which only an arc can bring into force",
                                    "prosegue con la G{:02} che precede, che solo un arco può mettere in presa"};
static constexpr Text kBeyondTravel{"on the way there {} would go to {:.3f} (limit {:.3f})",
                                    "sul percorso {} arriverebbe a {:.3f} (limite {:.3f})"};
static constexpr Text kNotProved{"a trial of the restart program does not come to the same state",
                                 "la prova del programma di ripresa non arriva allo stesso stato"};
static constexpr Text kNearest{"nearest safe line: {}", "riga sicura più vicina: {}"};
static constexpr Text kNearestTwo{"nearest safe lines: {} before it, {} after it",
                                  "righe sicure più vicine: {} prima, {} dopo"};

namespace {

/// The start of a line, and the number of lines before it.
struct LineStart {
  std::size_t offset = 0;
  std::size_t line = 0;
  bool is_there = false;
};

LineStart find_line(std::string_view text, std::size_t line) {
  const char* p = text.data();
  const char* const end = text.data() + text.size();
  std::size_t count = 0;
  for (; count < line && p != end; ++count) p = text::next_line(p, end);
  return {static_cast<std::size_t>(p - text.data()), count, p != end};
}

/// The line end of the program's first line.
std::string_view line_end_of(std::string_view text) {
  const char* const end = text.data() + text.size();
  const char* const p = text::find_line_end(text.data(), end);
  if (p == end) return "\n";
  return {p, static_cast<std::size_t>(text::skip_line_end(p, end) - p)};
}

std::size_t count_lines(std::string_view text) { return find_line(text, std::numeric_limits<std::size_t>::max()).line; }

bool is_near(const geometry::Vec3& a, const geometry::Vec3& b) {
  return (a - b).cwiseAbs().maxCoeff() <= geometry::kEqualCoordinate;
}

bool has_same_frames(const State& a, const State& b) {
  return is_near(a.workpiece_origin, b.workpiece_origin) && a.face_mounted == b.face_mounted &&
         is_near(a.face.origin, b.face.origin) && (a.face.axes - b.face.axes).cwiseAbs().maxCoeff() < 1e-9;
}

/// Whether the modes are the same. G28 counts as G24, and a motion G that is written again before its next use does not
/// count.
bool has_same_modes(const State& a, const State& b, bool needs_motion) {
  for (std::size_t i = 0; i < dialect::kModalGroupCount; ++i) {
    const auto group = static_cast<ModalGroup>(i);
    const bool matters = group != ModalGroup::Face && (group != ModalGroup::Motion || needs_motion);
    if (matters && a.mode(group) != b.mode(group)) return false;
  }
  return true;
}

/// Whether both spindles turn in the same direction, or neither is known to turn.
bool has_same_spindle(const State& a, const State& b) {
  return a.spindle == b.spindle || (!a.spindle_turns() && !b.spindle_turns());
}

/// Whether the rest of the program runs alike from `a` and `b` if the tip is in the same position.
bool is_same_but_for_tip(const State& a, const State& b, bool needs_motion) {
  return std::abs(a.position.b - b.position.b) <= geometry::kEqualCoordinate &&
         std::abs(a.position.c - b.position.c) <= geometry::kEqualCoordinate && has_same_frames(a, b) &&
         has_same_modes(a, b, needs_motion) && a.tool == b.tool && a.tool_selected == b.tool_selected &&
         a.feed_per_minute == b.feed_per_minute && feed_in_force(a) == feed_in_force(b) &&
         a.spindle_speed == b.spindle_speed && has_same_spindle(a, b);
}

/// The result of a trial run of a restart program.
struct RestartTrial {
  bool is_proved = false;  ///< It reaches the line in the same state, and ends like the original.
  std::optional<kinematics::Overtravel> overtravel;  ///< The first one before the line.
};

/// Runs the restart program as the control would, from home. `wanted_end` is the state at its end, or where the rest
/// of the original breaks off.
RestartTrial try_program(std::string_view program, std::size_t preamble_lines, const RestartPoint& point,
                         const State& wanted_end, const RestartOptions& options) {
  // If the tip is off the program, the restart starts from another programmed position; runs_alike() checks the rest.
  const auto is_same = [&](const State& a, const State& b) {
    return is_same_but_for_tip(a, b, point.continues_motion) &&
           (point.is_off_program || is_near(a.position.tip, b.position.tip));
  };
  RestartTrial trial;
  simulation::MachineCourse course(options.machine, options.run.setup.home);
  bool comes_to_state = false;
  bool comes_to_end = false;
  running::RunOptions run_options = options.run;
  run_options.before_block = [&](const running::Block& block) {
    if (options.end && block.line == preamble_lines + (*options.end - options.line))
      comes_to_end = is_same(block.state, wanted_end);
    if (block.line == preamble_lines)
      comes_to_state = is_same(block.state, point.state) && block.registers == point.registers &&
                       is_near(course.tip().tip, point.machine_tip.tip);
  };
  const simulation::MachineCourse::Listeners approach = {.move =
                                                             [&](const running::Event&, const kinematics::Move& move) {
                                                               if (trial.overtravel) return;
                                                               const auto found = kinematics::overtravels(
                                                                   options.machine.motion, move);
                                                               if (!found.empty()) trial.overtravel = found.front();
                                                             },
                                                         .frame = {}};
  const running::RunResult result = run(program, run_options, [&](const running::Event& event) {
    if (event.line < preamble_lines) course.take(event, approach);
  });
  if (!options.end) comes_to_end = is_same(result.state, wanted_end);
  trial.is_proved = comes_to_state && comes_to_end && result.ending == running::Ending::ProgramEnd;
  return trial;
}

/// The motions of the machine from a line on.
class RemainingRun {
 public:
  struct RemainingMotion {
    std::size_t line = 0;  // Counted from the start line.
    execution::MoveKind kind = execution::MoveKind::Rapid;
    kinematics::Move move;
  };

  RemainingRun(std::string_view text, const RestartOptions& options, std::size_t line)
      : line_(line), program_(text), runner_(program_, options.run), course_(options.machine, options.run.setup.home) {
    while (!runner_.has_ended() && runner_.place().line < line) step();
  }
  RemainingRun(const RemainingRun&) = delete;
  RemainingRun& operator=(const RemainingRun&) = delete;

  /// The next motion with a length or a turn.
  std::optional<RemainingMotion> next() {
    while (motions_.empty() && !runner_.has_ended()) step();
    if (motions_.empty()) return std::nullopt;
    const RemainingMotion first = motions_.front();
    motions_.pop_front();
    return first;
  }

 private:
  void step() {
    runner_.step();
    for (const running::Event& event : runner_.events()) course_.take(event, listeners_);
    if (runner_.has_ended()) course_.finish(listeners_);
  }
  void add(const running::Event& event, const kinematics::Move& move) {
    const bool goes =
        move.is_arc || !is_near(move.from.tip, move.to.tip) || move.from.b != move.to.b || move.from.c != move.to.c;
    if (event.line >= line_ && goes)
      motions_.push_back({event.line - line_, std::get<running::MoveEvent>(event.what).kind, move});
  }

  const std::size_t line_;
  const running::Program program_;
  running::Runner runner_;
  simulation::MachineCourse course_;
  const simulation::MachineCourse::Listeners listeners_{
      .move = [this](const running::Event& event, const kinematics::Move& move) { add(event, move); }, .frame = {}};
  std::deque<RemainingMotion> motions_;
};

bool is_near(const kinematics::Feed& a, const kinematics::Feed& b) {
  constexpr double kRounding = 1e-6;
  return a.kind == b.kind && std::abs(a.value - b.value) <= kRounding * std::abs(a.value);
}

bool is_near(const geometry::Pose& a, const geometry::Pose& b) {
  return is_near(a.tip, b.tip) && std::abs(a.b - b.b) <= geometry::kEqualCoordinate &&
         std::abs(a.c - b.c) <= geometry::kEqualCoordinate;
}

bool is_same(const RemainingRun::RemainingMotion& a, const RemainingRun::RemainingMotion& b) {
  if (a.line != b.line || a.kind != b.kind || a.move.is_arc != b.move.is_arc) return false;
  if (!is_near(a.move.from, b.move.from) || !is_near(a.move.to, b.move.to)) return false;
  if (!is_near(a.move.feed, b.move.feed) || a.move.splits_arcs != b.move.splits_arcs) return false;
  return !a.move.is_arc || (is_near(a.move.center, b.move.center) && is_near(a.move.normal, b.move.normal) &&
                            std::abs(a.move.sweep_deg - b.move.sweep_deg) <= geometry::kEqualCoordinate);
}

/// Whether the machine makes the same motions in a restart program as in the original.
bool runs_alike(std::string_view text, std::string_view program, std::size_t preamble_lines,
                const RestartOptions& options) {
  RemainingRun original(text, options, options.line);
  RemainingRun restarted(program, options, preamble_lines);
  const auto next_of = [&](RemainingRun& run) {
    auto motion = run.next();
    if (motion && options.end && motion->line >= *options.end - options.line) motion.reset();
    return motion;
  };
  for (;;) {
    const auto wanted = next_of(original);
    const auto found = next_of(restarted);
    if (!wanted || !found) return !wanted && !found;
    if (!is_same(*wanted, *found)) return false;
  }
}

/// A restart program, or the obstacle to it.
struct RestartAttempt {
  std::string program;
  RestartObstacle obstacle = RestartObstacle::None;
  std::optional<kinematics::Overtravel> overtravel;
};

RestartAttempt attempt(std::string_view text, const RestartOptions& options, const RestartSurvey& survey) {
  RestartAttempt made{.program = {}, .obstacle = survey.obstacle(options.line), .overtravel = {}};
  if (made.obstacle != RestartObstacle::None) return made;
  const RestartPoint& point = survey.point();
  made.program = restart_preamble(point, options, line_end_of(text));
  const std::size_t preamble_lines = count_lines(made.program);
  const std::size_t begin = find_line(text, options.line).offset;
  State wanted_end = survey.run().state;
  if (options.end) {
    made.program += text.substr(begin, find_line(text, *options.end).offset - begin);
    wanted_end = RestartSurvey(text, options.run, options.machine, *options.end).point().state;
    const std::string_view line_end = line_end_of(text);
    made.program +=
        fmt::format("{1}M02{0}", line_end, wanted_end.spindle_turns() ? fmt::format("M05{}", line_end) : "");
  } else {
    made.program += text.substr(begin);
  }
  const RestartTrial trial = try_program(made.program, preamble_lines, point, wanted_end, options);
  if (point.is_off_program && !(trial.is_proved && runs_alike(text, made.program, preamble_lines, options))) {
    made.obstacle = point.is_beside_contour ? RestartObstacle::OnContour : RestartObstacle::OffProgram;
  } else if (!trial.is_proved) {
    made.obstacle = RestartObstacle::NotProved;
  } else if (trial.overtravel) {
    made.obstacle = RestartObstacle::BeyondTravel;
    made.overtravel = trial.overtravel;
  }
  return made;
}

/// Searches a line from which a restart is possible, candidate by candidate. Where the machine is off the program only
/// a trial run can prove it; the number of trials is limited.
class Proposals {
 public:
  Proposals(std::string_view text, const RestartOptions& options, const RestartSurvey& survey)
      : text_(text), options_(options), survey_(survey) {}

  bool fits(std::size_t line) {
    if (!survey_.is_safe(line)) return false;
    if (!survey_.is_off_program(line)) return true;
    constexpr int kMaxTrials = 4;
    if (trials_ == kMaxTrials) return false;
    ++trials_;
    RestartOptions there = options_;
    there.line = line;
    const RestartSurvey survey(text_, there.run, there.machine, line);
    return attempt(text_, there, survey).obstacle == RestartObstacle::None;
  }

 private:
  const std::string_view text_;
  const RestartOptions& options_;
  const RestartSurvey& survey_;
  int trials_ = 0;
};

void propose_lines(std::string_view text, const RestartOptions& options, const RestartSurvey& survey,
                   RestartRefusal& refusal) {
  Proposals above(text, options, survey);
  for (std::size_t line = std::min(refusal.line, survey.end()); line-- > 0 && !refusal.before;)
    if (above.fits(line)) refusal.before = line;
  Proposals below(text, options, survey);
  for (std::size_t line = refusal.line + 1; line < survey.end() && !refusal.after; ++line)
    if (below.fits(line)) refusal.after = line;
}

/// The reason alone, without other lines.
RestartRefusal refuse(const RestartAttempt& made, const RestartOptions& options, const RestartSurvey& survey) {
  const RestartObstacle obstacle = made.obstacle;
  RestartRefusal refusal{.obstacle = obstacle, .line = options.line};
  refusal.cause = survey.line_of_cause(options.line);
  refusal.run = survey.run();
  refusal.has_choices = survey.has_choices();
  const State& state = survey.point().state;
  refusal.g =
      state.mode(obstacle == RestartObstacle::Compensation ? ModalGroup::CutterCompensation : ModalGroup::Motion);
  if (made.overtravel) refusal.overtravel = *made.overtravel;
  return refusal;
}

RestartRefusal refuse(const RestartAttempt& made, std::string_view text, const RestartOptions& options,
                      const RestartSurvey& survey) {
  RestartRefusal refusal = refuse(made, options, survey);
  // Only a trial of each line would show whether the travel suffices.
  if (made.obstacle != RestartObstacle::ProgramError && made.obstacle != RestartObstacle::BeyondTravel)
    propose_lines(text, options, survey, refusal);
  return refusal;
}

const Text& reason(RestartObstacle obstacle) {
  switch (obstacle) {
    case RestartObstacle::Compensation:
      return kCompensation;
    case RestartObstacle::OnContour:
      return kOnContour;
    case RestartObstacle::RadiusUnknown:
      return kRadiusUnknown;
    case RestartObstacle::OffProgram:
      return kOffProgram;
    case RestartObstacle::TipUnknown:
      return kTipUnknown;
    case RestartObstacle::FrameChangedLow:
      return kChangedLow;
    case RestartObstacle::FaceLooksDown:
      return kLooksDown;
    case RestartObstacle::ToolPointsUp:
      return kPointsUp;
    case RestartObstacle::ExactStop:
      return kExactStop;
    case RestartObstacle::ArcContinues:
      return kArcContinues;
    default:
      return kNotProved;
  }
}

std::string problem(const RestartRefusal& refusal, Language language) {
  const auto say = [&](const Text& text, auto... values) { return dialect::format(text, language, values...); };
  switch (refusal.obstacle) {
    case RestartObstacle::NoSuchLine:
      return say(kNoSuchLine, refusal.line + 1, refusal.cause);
    case RestartObstacle::AfterProgramEnd:
      return say(kAfterProgramEnd, refusal.line + 1, refusal.cause + 1);
    case RestartObstacle::JumpedOver:
      return say(kJumpedOver, refusal.line + 1, refusal.cause + 1);
    case RestartObstacle::BeyondTravel:
      return say(kUnsafe, refusal.line + 1,
                 say(kBeyondTravel, dialect::kAxisLetters[refusal.overtravel.axis], refusal.overtravel.position,
                     refusal.overtravel.limit));
    default:
      return say(kUnsafe, refusal.line + 1, say(reason(refusal.obstacle), refusal.g));
  }
}

}  // namespace

std::variant<std::string, RestartRefusal> restart_program(std::string_view text, const RestartOptions& options) {
  if (!find_line(text, options.line).is_there)
    return RestartRefusal{.obstacle = RestartObstacle::NoSuchLine, .line = options.line, .cause = count_lines(text)};
  const RestartSurvey survey(text, options.run, options.machine, options.line);
  RestartAttempt made = attempt(text, options, survey);
  if (made.obstacle != RestartObstacle::None) return refuse(made, text, options, survey);
  return std::move(made.program);
}

namespace {

/// What a tool does from an M06 to the next one, or to the end of the program. Lines from 0.
struct ToolOperation {
  std::size_t change = 0;     ///< Of the M06.
  std::size_t end = 0;        ///< Of the next M06, or of the block that ends the program.
  std::size_t first_cut = 0;  ///< The first feed move; `end` without one.
};

/// The operations of a tool on the path that the run takes.
std::vector<ToolOperation> operations_of(std::string_view text, const RestartOptions& options,
                                         const execution::ToolCode& tool, running::RunResult& result) {
  std::vector<ToolOperation> all;
  bool is_open = false;
  bool has_cut = false;
  const auto close = [&](std::size_t line) {
    if (is_open) {
      all.back().end = line;
      if (!has_cut) all.back().first_cut = line;
    }
    is_open = false;
  };
  result = run(text, options.run, [&](const running::Event& event) {
    if (const auto* const change = std::get_if<running::ToolEvent>(&event.what)) {
      close(event.line);
      if (change->tool != tool) return;
      all.push_back({.change = event.line});
      is_open = true;
      has_cut = false;
    } else if (const auto* const move = std::get_if<running::MoveEvent>(&event.what)) {
      if (!is_open || has_cut || move->kind == execution::MoveKind::Rapid) return;
      has_cut = true;
      all.back().first_cut = event.line;
    }
  });
  close(result.line);
  return all;
}

}  // namespace

std::variant<std::string, OperationRefusal> operation_program(std::string_view text, const RestartOptions& options,
                                                              const execution::ToolCode& tool,
                                                              std::optional<std::size_t> change) {
  OperationRefusal refusal;
  running::RunResult result;
  std::vector<ToolOperation> all = operations_of(text, options, tool, result);
  if (result.ending != running::Ending::ProgramEnd) {
    refusal.restart = RestartRefusal{.obstacle = RestartObstacle::ProgramError};
    refusal.restart->run = result;
    return refusal;
  }
  for (const ToolOperation& each : all) refusal.changes.push_back(each.change);
  if (change) std::erase_if(all, [&](const ToolOperation& each) { return each.change != *change; });
  if (all.size() != 1) return refusal;
  const ToolOperation& operation = all.front();
  RestartOptions part = options;
  part.end = operation.end;
  // The first rapids may begin where only the tool change has left the tip.
  constexpr std::size_t kMaxTrials = 20;
  const std::size_t last = std::min(operation.first_cut, operation.change + kMaxTrials);
  for (part.line = operation.change + 1; part.line <= last; ++part.line) {
    const RestartSurvey survey(text, part.run, part.machine, part.line);
    RestartAttempt made = attempt(text, part, survey);
    if (made.obstacle == RestartObstacle::None) return std::move(made.program);
    refusal.restart = refuse(made, part, survey);
  }
  return refusal;
}

std::string message(const RestartRefusal& refusal, Language language) {
  std::string text = problem(refusal, language);
  const bool is_not_run =
      refusal.obstacle == RestartObstacle::AfterProgramEnd || refusal.obstacle == RestartObstacle::JumpedOver;
  if (is_not_run && refusal.has_choices) text += kChoice.in(language);
  const auto add = [&](const Text& nearest, auto... lines) {
    text += "; " + dialect::format(nearest, language, (lines + 1)...);
  };
  if (refusal.before && refusal.after) {
    add(kNearestTwo, *refusal.before, *refusal.after);
  } else if (refusal.before || refusal.after) {
    add(kNearest, refusal.before ? *refusal.before : *refusal.after);
  }
  return text;
}

}  // namespace isocnc::restart
