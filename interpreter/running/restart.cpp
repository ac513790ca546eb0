#include "interpreter/running/restart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interpreter/dialect/format.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/syntax/characters.h"

namespace isocnc::running {

using dialect::Language;
using dialect::ModalGroup;
using dialect::Text;
using execution::State;

static constexpr Text kNoSuchLine{"there is no line {}: the last one is {}", "la riga {} non esiste: l'ultima è la {}"};
static constexpr Text kBehindEnd{"line {} is not run: the program ends at line {}",
                                 "la riga {} non viene eseguita: il programma termina alla riga {}"};
static constexpr Text kJumpedOver{"line {} is not run: the IF of line {} jumps over it",
                                  "la riga {} non viene eseguita: la scavalca l'IF della riga {}"};
static constexpr Text kChoice{" (--vgpl and --set choose the way)", " (--vgpl e --set scelgono il percorso)"};
static constexpr Text kUnsafe{"no safe restart before line {}: {}", "nessuna ripresa sicura dalla riga {}: {}"};
static constexpr Text kCompensation{"cutter compensation (G{}) is in force",
                                    "è in presa la correzione raggio fresa (G{})"};
static constexpr Text kOnContour{"G40 has just ended the compensation, and the tool is still on the contour",
                                 "la G40 ha appena tolto la correzione e l'utensile è ancora sul profilo"};
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

/// Where a line begins, and how many there are before it.
struct LineStart {
  std::size_t offset = 0;
  std::uint64_t line = 0;
  bool is_there = false;
};

LineStart find_line(std::string_view text, std::uint64_t line) {
  const char* p = text.data();
  const char* const end = text.data() + text.size();
  std::uint64_t count = 0;
  for (; count < line && p != end; ++count) p = syntax::skip_line_end(syntax::find_line_end(p, end), end);
  return {static_cast<std::size_t>(p - text.data()), count, p != end};
}

/// As the program's first line ends.
std::string_view line_end_of(std::string_view text) {
  const char* const end = text.data() + text.size();
  const char* const p = syntax::find_line_end(text.data(), end);
  if (p == end) return "\n";
  return {p, static_cast<std::size_t>(syntax::skip_line_end(p, end) - p)};
}

std::uint64_t count_lines(std::string_view text) {
  return find_line(text, std::numeric_limits<std::uint64_t>::max()).line;
}

bool is_near(const geometry::Vec3& a, const geometry::Vec3& b) {
  return (a - b).cwiseAbs().maxCoeff() <= geometry::kEqualCoordinate;
}

bool has_same_frames(const State& a, const State& b) {
  return is_near(a.workpiece_origin, b.workpiece_origin) && a.face_mounted == b.face_mounted &&
         is_near(a.face.origin, b.face.origin) && (a.face.axes - b.face.axes).cwiseAbs().maxCoeff() < 1e-9;
}

/// G28 is written as G24, and a motion G that is written again before it is needed is left out.
bool has_same_modes(const State& a, const State& b, bool needs_motion) {
  for (std::size_t i = 0; i < dialect::kModalGroupCount; ++i) {
    const auto group = static_cast<ModalGroup>(i);
    const bool matters = group != ModalGroup::Face && (group != ModalGroup::Motion || needs_motion);
    if (matters && a.mode(group) != b.mode(group)) return false;
  }
  return true;
}

/// Whether all that follows is the same after `a` as after `b`.
bool is_same(const State& a, const State& b, bool needs_motion) {
  constexpr State::Knowledge kTurns = State::kClockwise | State::kCounterclockwise;
  return is_near(a.position.tip, b.position.tip) &&
         std::abs(a.position.b - b.position.b) <= geometry::kEqualCoordinate &&
         std::abs(a.position.c - b.position.c) <= geometry::kEqualCoordinate && has_same_frames(a, b) &&
         has_same_modes(a, b, needs_motion) && a.tool == b.tool && a.tool_selected == b.tool_selected &&
         a.feed_per_minute == b.feed_per_minute && feed_in_force(a) == feed_in_force(b) &&
         a.spindle_speed == b.spindle_speed && (a.knowledge & kTurns) == (b.knowledge & kTurns);
}

/// What a restart program does when it is tried.
struct Trial {
  bool is_proved = false;                        ///< It comes to the line in the same state, and ends as the original.
  std::optional<motion::Overtravel> overtravel;  ///< The first on the way to the line.
};

/// Runs the restart program as the control would, from home.
Trial try_program(std::string_view program, std::uint64_t preamble_lines, const RestartSurvey& survey,
                  const RestartOptions& options) {
  const RestartPoint& point = survey.point();
  Trial trial;
  bool comes_to_state = false;
  RunOptions run_options = options.run;
  run_options.before_block = [&](const Block& block) {
    if (block.line == preamble_lines)
      comes_to_state = is_same(block.state, point.state, point.continues_motion) && block.registers == point.registers;
  };
  Timing approach(options.machine, {.event = [&](const TimedEvent& timed) {
                    if (!timed.move || trial.overtravel) return;
                    const auto found = motion::overtravels(options.machine.motion, *timed.move);
                    if (!found.empty()) trial.overtravel = found.front();
                  }});
  const RunResult result = run(program, run_options, [&](const Event& event) {
    if (event.line < preamble_lines) approach.take(event);
  });
  approach.finish();
  trial.is_proved = comes_to_state && result.ending == Ending::ProgramEnd &&
                    is_same(result.state, survey.run().state, point.continues_motion);
  return trial;
}

void propose_lines(const RestartSurvey& survey, RestartRefusal& refusal) {
  for (std::uint64_t line = std::min(refusal.line, survey.end()); line-- > 0 && !refusal.before;)
    if (survey.is_safe(line)) refusal.before = line;
  for (std::uint64_t line = refusal.line + 1; line < survey.end() && !refusal.behind; ++line)
    if (survey.is_safe(line)) refusal.behind = line;
}

RestartRefusal refuse(Obstacle obstacle, const RestartSurvey& survey, std::uint64_t line) {
  RestartRefusal refusal{.obstacle = obstacle, .line = line};
  refusal.cause = survey.line_of_cause(line);
  refusal.run = survey.run();
  refusal.has_choices = survey.has_choices();
  const State& state = survey.point().state;
  refusal.g = state.mode(obstacle == Obstacle::Compensation ? ModalGroup::CutterCompensation : ModalGroup::Motion);
  // Whether the travel suffices for other lines, only a trial of each would tell.
  if (obstacle != Obstacle::ProgramError && obstacle != Obstacle::BeyondTravel) propose_lines(survey, refusal);
  return refusal;
}

const Text& reason(Obstacle obstacle) {
  switch (obstacle) {
    case Obstacle::Compensation:
      return kCompensation;
    case Obstacle::OnContour:
      return kOnContour;
    case Obstacle::FrameChangedLow:
      return kChangedLow;
    case Obstacle::FaceLooksDown:
      return kLooksDown;
    case Obstacle::ToolPointsUp:
      return kPointsUp;
    case Obstacle::ExactStop:
      return kExactStop;
    case Obstacle::ArcContinues:
      return kArcContinues;
    default:
      return kNotProved;
  }
}

std::string what_is_wrong(const RestartRefusal& refusal, Language language) {
  const auto say = [&](const Text& text, auto... values) { return dialect::format(text, language, values...); };
  switch (refusal.obstacle) {
    case Obstacle::NoSuchLine:
      return say(kNoSuchLine, refusal.line + 1, refusal.cause);
    case Obstacle::BehindEnd:
      return say(kBehindEnd, refusal.line + 1, refusal.cause + 1);
    case Obstacle::JumpedOver:
      return say(kJumpedOver, refusal.line + 1, refusal.cause + 1);
    case Obstacle::BeyondTravel:
      return say(kUnsafe, refusal.line + 1,
                 say(kBeyondTravel, dialect::kAxisLetters[refusal.overtravel.axis], refusal.overtravel.position,
                     refusal.overtravel.limit));
    default:
      return say(kUnsafe, refusal.line + 1, say(reason(refusal.obstacle), refusal.g));
  }
}

}  // namespace

std::variant<std::string, RestartRefusal> restart_program(std::string_view text, const RestartOptions& options) {
  const LineStart start = find_line(text, options.line);
  if (!start.is_there)
    return RestartRefusal{.obstacle = Obstacle::NoSuchLine, .line = options.line, .cause = count_lines(text)};
  const RestartSurvey survey(text, options.run, options.line);
  const Obstacle obstacle = survey.obstacle(options.line);
  if (obstacle != Obstacle::None) return refuse(obstacle, survey, options.line);
  std::string program = restart_preamble(survey.point(), options, line_end_of(text));
  const std::uint64_t preamble_lines = count_lines(program);
  program += text.substr(start.offset);
  const Trial trial = try_program(program, preamble_lines, survey, options);
  if (!trial.is_proved) return refuse(Obstacle::NotProved, survey, options.line);
  if (trial.overtravel) {
    RestartRefusal refusal = refuse(Obstacle::BeyondTravel, survey, options.line);
    refusal.overtravel = *trial.overtravel;
    return refusal;
  }
  return program;
}

std::string message(const RestartRefusal& refusal, Language language) {
  std::string text = what_is_wrong(refusal, language);
  const bool is_not_run = refusal.obstacle == Obstacle::BehindEnd || refusal.obstacle == Obstacle::JumpedOver;
  if (is_not_run && refusal.has_choices) text += kChoice.in(language);
  const auto add = [&](const Text& nearest, auto... lines) {
    text += "; " + dialect::format(nearest, language, (lines + 1)...);
  };
  if (refusal.before && refusal.behind) {
    add(kNearestTwo, *refusal.before, *refusal.behind);
  } else if (refusal.before || refusal.behind) {
    add(kNearest, refusal.before ? *refusal.before : *refusal.behind);
  }
  return text;
}

}  // namespace isocnc::running
