#include "interpreter/simulation/run_findings.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "interpreter/geometry/arc.h"
#include "interpreter/simulation/machine_course.h"
#include "interpreter/simulation/programmed_speeds.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::simulation {

using namespace dialect::literals;
using execution::MoveKind;

RunFindings::RunFindings(const timing::TimedMachine& machine)
    : machine_(&machine),
      checks_travel_(
          std::any_of(machine.motion.axes.begin(), machine.motion.axes.end(),
                      [](const auto& axis) { return std::isfinite(axis.minimum) || std::isfinite(axis.maximum); })),
      checks_speeds_(std::isfinite(machine.motion.feed_speed) || std::isfinite(machine.motion.feed_turn)) {}

void RunFindings::report(std::size_t line, dialect::DiagnosticId id,
                         const std::array<double, dialect::kMaxArguments>& values, std::int32_t mistake) {
  findings_.push_back({.line = line, .finding = {.id = id, .values = values}, .mistake = mistake});
}

void RunFindings::take(const running::Block& block) {
  if (std::exchange(has_jumped_, false)) taken_.executed.emplace_back(block.line, block.line);
  taken_.executed.back().second = block.line;
  if (block.tree.feed < 0) return;
  const syntax::Word& word = block.tree.words[static_cast<std::size_t>(block.tree.feed)];
  feed_ = {.line = block.line, .value = word.value, .is_reported = false};
}

/// Whether an F of this value gives this feed in mm/min, in millimeters or in inches.
static bool gives_feed(double value, double feed) {
  return std::abs(value - feed) <= 1e-9 * feed || std::abs(value * dialect::mm_per_unit(true) - feed) <= 1e-9 * feed;
}

void RunFindings::take(const running::Event& event) {
  if (const auto* const spindle = std::get_if<running::SpindleSpeedEvent>(&event.what)) {
    if (exceeds(Limit::SpindleSpeed, spindle->speed, *machine_))
      report(event.line, "spindle-speed-above-machine"_diag, {limit_of(Limit::SpindleSpeed, *machine_)});
    return;
  }
  if (const auto* const jump = std::get_if<running::JumpEvent>(&event.what)) {
    has_jumped_ = jump->taken;
    taken_.decisions.push_back({event.line, jump->taken});
  }
  const auto* const move = std::get_if<running::MoveEvent>(&event.what);
  if (!move || !checks_speeds_ || move->kind == MoveKind::Rapid || move->inverse_time) return;
  if (move->length <= geometry::kEqualCoordinate || !exceeds(Limit::Feed, move->feed, *machine_)) return;
  // One F drives many motions; it is the mistake, wherever it stands.
  const bool is_of_last_word = gives_feed(feed_.value, move->feed);
  if (is_of_last_word && std::exchange(feed_.is_reported, true)) return;
  report(is_of_last_word ? feed_.line : event.line, "feed-above-machine"_diag,
         {move->feed, limit_of(Limit::Feed, *machine_)});
}

void RunFindings::take(const RunWarning& warning) {
  findings_.push_back({.line = warning.line, .finding = finding_of(warning)});
}

void RunFindings::take(const running::Event& event, kinematics::MadeMove& made) {
  if (checks_travel_) look_at_travel(event, made);
  if (checks_speeds_) look_at_speeds(event.line, made);
}

static bool is_linear(std::size_t axis) { return axis < kinematics::kB; }

/// A position of a joint as a message shows it.
static double shown_position(std::size_t axis, double position, bool is_in_inches) {
  return is_linear(axis) ? position / dialect::mm_per_unit(is_in_inches) : position;
}

syntax::Finding travel_finding(const kinematics::Overtravel& found, bool is_in_inches) {
  const auto axis = static_cast<std::size_t>(found.axis);
  return {.id = "joint-travel"_diag,
          .is_in_inches = is_in_inches && is_linear(axis),
          .values = {static_cast<double>(axis), shown_position(axis, found.position, is_in_inches),
                     shown_position(axis, found.limit, is_in_inches)}};
}

void RunFindings::look_at_travel(const running::Event& event, kinematics::MadeMove& made) {
  const kinematics::Move& move = made.move();
  std::array<bool, 2 * kinematics::kAxisCount> is_passed{};
  for (const kinematics::Overtravel& found : made.overtravels()) {
    const bool is_above = found.position > found.limit;
    const auto beyond = [&](double joint) { return is_above ? joint - found.limit : found.limit - joint; };
    const auto joint_at = [&](const geometry::Pose& tip) {
      return kinematics::inverse(machine_->motion.kinematics, kinematics::coordinates(tip),
                                 move.tool_length)[found.axis];
    };
    const auto index = 2 * static_cast<std::size_t>(found.axis) + (is_above ? 1 : 0);
    is_passed[index] = true;
    TravelEnd& end = ends_[index];
    // The way back inside is no mistake of its own, nor is a home outside the travel.
    const double start = std::max(0.0, beyond(joint_at(move.from)));
    const bool goes_out = beyond(found.position) > start + kinematics::kTravelSlack;
    const bool stays_out = end.is_passed && beyond(joint_at(move.to)) > kinematics::kTravelSlack;
    if (!goes_out && !stays_out) continue;
    if (!end.is_passed) {
      end = {.is_passed = true, .mistake = static_cast<std::int32_t>(farthest_.size())};
      farthest_.push_back(found.position);
    }
    double& farthest = farthest_[static_cast<std::size_t>(end.mistake)];
    if (beyond(found.position) > beyond(farthest)) farthest = found.position;
    // The farthest position is known at the end.
    findings_.push_back(
        {.line = event.line, .finding = travel_finding(found, event.is_in_inches), .mistake = end.mistake});
  }
  for (std::size_t i = 0; i < ends_.size(); ++i) ends_[i].is_passed = ends_[i].is_passed && is_passed[i];
}

void RunFindings::look_at_speeds(std::size_t line, kinematics::MadeMove& made) {
  const kinematics::Move& move = made.move();
  if (move.feed.kind == kinematics::FeedKind::Rapid) return;
  const ProgrammedSpeeds speeds = programmed_speeds(move, made.tip_travel().length);
  const bool is_timed = move.feed.kind == kinematics::FeedKind::Duration;  // Other feeds are judged as programmed.
  if (is_timed && exceeds(Limit::Feed, speeds.feed, *machine_))
    report(line, "feed-above-machine"_diag, {speeds.feed, limit_of(Limit::Feed, *machine_)});
  if (exceeds(Limit::RotarySpeed, speeds.rotary, *machine_))
    report(line, "rotary-speed-above-machine"_diag,
           {std::round(speeds.rotary), limit_of(Limit::RotarySpeed, *machine_)});
}

syntax::Span motion_span(const syntax::LineTree& line) {
  const syntax::Instruction* const motion = line.motion();
  if (!motion && line.words.empty()) return {0, static_cast<std::uint32_t>(line.text.size())};
  if (!motion) return syntax::hull(line.words.front().span(), line.words.back().span());
  syntax::Span span = line.command(*motion).span();
  for (std::size_t i = motion->begin; i < motion->end; ++i)
    if (line.words[i].owner == motion->number) span = syntax::hull(span, line.words[i].span());
  return span;
}

/// The part of its line that a finding is about: its S or F, or the words of its motion.
static syntax::Span span_of(dialect::DiagnosticId id, const syntax::LineTree& line) {
  const auto at = [&](std::int32_t word) { return line.words[static_cast<std::size_t>(word)].span(); };
  if (id == "spindle-speed-above-machine"_diag && line.spindle >= 0) return at(line.spindle);
  if (id == "feed-above-machine"_diag && line.feed >= 0) return at(line.feed);
  return motion_span(line);
}

/// The findings with their places, sorted, each once on its line.
std::vector<RunFinding> RunFindings::marked(std::string_view text) const {
  std::vector<RunFinding> found = findings_;
  const auto by_line = [](const RunFinding& a, const RunFinding& b) { return a.line < b.line; };
  std::stable_sort(found.begin(), found.end(), by_line);  // Warnings come later than their lines.
  syntax::LineFinder lines(text);
  for (RunFinding& each : found) {
    each.finding.span = span_of(each.finding.id, syntax::ParsedLine(lines.line(each.line)).tree());
    if (each.mistake < 0) continue;
    const syntax::Finding& finding = each.finding;
    const auto axis = static_cast<std::size_t>(finding.values[0]);
    each.finding.values[1] =
        shown_position(axis, farthest_[static_cast<std::size_t>(each.mistake)], finding.is_in_inches);
  }
  const auto place = [](const RunFinding& each) {
    return std::tuple(each.line, each.finding.span.begin, each.finding.id, each.mistake);
  };
  // An F is judged as it is read, and where it counts by its time as its motion is made. Of both the greatest value
  // stays: which one is told first depends on how far the run reads ahead.
  const auto value = [](const RunFinding& each) {
    return each.finding.id == "feed-above-machine"_diag ? each.finding.values[0] : 0;
  };
  std::stable_sort(found.begin(), found.end(), [&](const RunFinding& a, const RunFinding& b) {
    return std::pair(place(a), value(b)) < std::pair(place(b), value(a));
  });
  const auto is_same = [&](const RunFinding& a, const RunFinding& b) { return place(a) == place(b); };
  found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
  return found;
}

bool TakenPath::has_executed(std::size_t line) const {
  const auto after = std::partition_point(executed.begin(), executed.end(),
                                          [&](const auto& stretch) { return stretch.second < line; });
  return after != executed.end() && after->first <= line;
}

bool TakenPath::has_made(const RunDecision& decision) const {
  const auto is_above = [&](const RunDecision& each) { return each.line < decision.line; };
  const auto place = std::partition_point(decisions.begin(), decisions.end(), is_above);
  return place != decisions.end() && *place == decision;
}

RunOutcome RunFindings::outcome(std::string_view text, const running::RunResult& result) const {
  RunOutcome outcome{.findings = marked(text), .runs = {taken_}, .paths = {}};
  TakenPath& taken = outcome.runs.front();
  // A program without M02 has been run to its end.
  const bool has_stopped = result.ending == running::Ending::Error && result.error.id != "m02-missing"_diag;
  if (!has_stopped) return outcome;
  if (result.error.id == "label-not-found"_diag || result.error.id == "backward-jump"_diag)
    taken.decisions.push_back({result.line, true});
  // A block with an error has no effect.
  if (!taken.executed.empty() && taken.executed.back().first == result.line) {
    taken.executed.pop_back();
  } else if (!taken.executed.empty()) {
    taken.executed.back().second = result.line - 1;
  }
  const RunFinding stop{.line = result.line, .finding = {.id = "not-verified"_diag, .span = result.error.span}};
  const auto is_before = [](const RunFinding& a, const RunFinding& b) {
    return std::pair(a.line, a.finding.span.begin) < std::pair(b.line, b.finding.span.begin);
  };
  std::vector<RunFinding>& found = outcome.findings;
  found.insert(std::upper_bound(found.begin(), found.end(), stop, is_before), stop);
  return outcome;
}

RunOutcome outcome_of_run(std::string_view text, running::RunOptions options, const timing::TimedMachine& machine) {
  RunFindings findings(machine);
  MachineCourse course(machine, machine.home);
  const MachineCourse::Listeners listeners{.move =
                                               [&](const running::Event& event, const kinematics::Move& move) {
                                                 kinematics::MadeMove made(machine.motion, move);
                                                 findings.take(event, made);
                                               },
                                           .warning = [&](const RunWarning& warning) { findings.take(warning); }};
  options.before_block = [&](const running::Block& block) { findings.take(block); };
  const running::RunResult result = run(text, options, [&](const running::Event& event) {
    findings.take(event);
    course.take(event, listeners);
  });
  course.finish(listeners);
  return findings.outcome(text, result);
}

}  // namespace isocnc::simulation
