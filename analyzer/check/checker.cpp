#include "analyzer/check/checker.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "analyzer/check/folding.h"
#include "analyzer/check/frontier_change.h"
#include "analyzer/rules/rule.h"
#include "interpreter/execution/line_parts.h"
#include "interpreter/execution/plain_run.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::check {

using namespace dialect::literals;
using execution::BlockStep;
using syntax::Finding;
using syntax::LineTree;
using syntax::PlainLine;

/// The maximum number of decisions in a path; longer paths keep the latest ones.
static constexpr std::size_t kLongestPath = 64;
/// The maximum number of labels that paths wait for at once.
static constexpr std::size_t kMaxWaiting = 16'384;

Checker::Checker(const rules::CheckSetup& setup, const JumpMap& jumps, bool suspects_centers)
    : frontier(start(setup)),
      setup_(setup),
      jumps_(jumps),
      house_(setup.house_rules.get()),
      checks_moves_(rules::checks_moves(setup)),
      suspects_centers_(suspects_centers) {}

Frontier Checker::start(const rules::CheckSetup& setup) {
  Frontier frontier;
  frontier.live.add({.state = execution::initial_state(setup.machine),
                     .house = setup.house_rules ? setup.house_rules->at_start() : rules::HouseMemory{},
                     .registers = Valuations::unknown()});
  return frontier;
}

static void sort_by_column(std::vector<LocatedFinding>& findings, std::size_t first) {
  if (findings.size() - first > 1)
    std::stable_sort(
        findings.begin() + static_cast<std::ptrdiff_t>(first), findings.end(),
        [](const LocatedFinding& a, const LocatedFinding& b) { return a.finding.span.begin < b.finding.span.begin; });
}

/// Whether a finding keeps the lint rules from judging its line: every error does, except M02 on a line with other
/// instructions, which ends the program all the same (D22).
static bool is_error(const Finding& finding) {
  return dialect::definition(finding.id).severity == dialect::Severity::Error && finding.id != "m02-not-alone"_diag;
}

/// Whether the line has a jump, reported as wrong, whose label cannot be read, or whose IF is missing.
static bool jumps_anywhere(const LineTree& line) {
  if (line.findings.empty()) return false;
  if (line.jump) return !line.jump->has_target;
  return std::any_of(line.words.begin(), line.words.end(),
                     [](const syntax::Word& word) { return word.letter == syntax::kGoto; });
}

/// Whether one of the findings from index `first` on is an error.
static bool has_error(const std::vector<LocatedFinding>& findings, std::size_t first) {
  return std::any_of(findings.begin() + static_cast<std::ptrdiff_t>(first), findings.end(),
                     [](const LocatedFinding& located) { return is_error(located.finding); });
}

/// T101001 on one line and M06 on a later one are one mistake, reported at the T.
static bool is_reported_above(const Finding& finding, const Groups& before) {
  return finding.id == "tool-change-without-tool"_diag &&
         std::all_of(before.begin(), before.end(), [](const Group& group) { return group.state.tool_prepared; });
}

/// What the block before lacks on some path; null if it lacks nothing.
static const execution::Lack* lack_of_any(const Groups& live) {
  const auto lacks = [](const Group& group) { return !group.state.lack.empty(); };
  const auto group = std::find_if(live.begin(), live.end(), lacks);
  return group == live.end() ? nullptr : &group->state.lack;
}

/// Records a line executed by a plain run. Under G91 only the words of an arc matter, under G90 its start as well.
/// `named` collects the letters of the arguments under G90: at the end of the run their axes are set.
[[gnu::always_inline]] static inline void note_plain_move(const execution::PlainRun& run, const execution::State& state,
                                                          PositionUse& use, dialect::LetterSet& named) {
  if (run.is_incremental()) {
    use.far |= is_far(state.position);
    return;
  }
  if (run.was_arc())
    use.read |= static_cast<execution::AxisSet>(execution::kLinearAxes & ~(use.set | execution::axes_of(named)));
  named = run.effects().letters;
}

/// Records the folds that a run of plain lines ends.
static void note_plain_feed(const execution::PlainRun& run, const execution::State& state, std::size_t line,
                            Outcome& outcome) {
  if (run.effects().has_taken_feed && state.inverse_time())
    outcome.end_folds(folds_ended_by(BlockStep::InverseTimeFeed), line);
}

/// Whether a finding is about the circle of an arc, which under G91 does not depend on where the arc starts.
static bool is_of_circle(const Finding& finding) {
  static constexpr dialect::DiagnosticId kOfCircle[] = {"arc-center-mismatch"_diag, "arc-radius-mismatch"_diag,
                                                        "arc-radius-too-small"_diag};
  return std::find(std::begin(kOfCircle), std::end(kOfCircle), finding.id) != std::end(kOfCircle);
}

/// Records that a depth is judged from where the tool is.
static void note_house_rules(const rules::HouseRules& house, PositionUse& use) {
  if (house.watches_depth())
    use.read |= static_cast<execution::AxisSet>(execution::axis_bit(execution::Axis::Z) & ~use.set);
}

template <class PlainLineAt, class ChangesNothingAt>
std::size_t Checker::check_plain(std::size_t count, std::size_t line_number, Outcome& outcome,
                                 PlainLineAt plain_line_at, ChangesNothingAt changes_nothing_at) {
  if (frontier.live.size() != 1 || checks_moves_) return 0;
  Group& group = frontier.live[0];
  const execution::State& state = group.state;
  if (group.memory.judges_plain_motions(state)) return 0;
  if (house_ && house_->judges_plain_motions(group.house, state)) return 0;
  const rules::PlainGuard guard = house_ ? house_->guard(group.house, state) : rules::PlainGuard{};
  execution::PlainRun run(group.state, setup_.machine, suspects_centers_);
  PositionUse use = outcome.positions;
  if (house_) note_house_rules(*house_, use);
  const bool may_be_target = !jumps_.empty();
  const bool may_skip = run.may_run() && !(house_ && house_->watches_comments());
  if (run.is_incremental()) use.far |= is_far(state.position);
  dialect::LetterSet named = 0;
  std::size_t done = 0;
  for (; done < count; ++done) {
    const PlainLine line = plain_line_at(done);
    if (guard.is_active && guard.stops_at(line.words, line.feed, state)) break;
    if (line.has_label && may_be_target && jumps_.names(line.label)) break;
    if (!run.run(line)) {
      if (may_skip && changes_nothing_at(done)) continue;
      break;
    }
    note_plain_move(run, state, use, named);
  }
  outcome.centers.open |= run.met_open_center();
  if (done == 0) return 0;
  use.set |= execution::axes_of(named);
  last_row_ = run.effects();
  group.memory.take(last_row_, state);
  if (house_) house_->take(last_row_, state, group.house);
  note_plain_feed(run, state, line_number, outcome);
  outcome.has_text = true;
  outcome.last_text_line = line_number + done - 1;
  use.by_several |= !frontier.waiting().empty();
  outcome.positions = use;
  frontier.reduce_spread(done);
  return done;
}

std::size_t Checker::check_plain_lines(const syntax::TreeStore& trees, std::size_t first, std::size_t line_number,
                                       Outcome& outcome) {
  const std::size_t done = check_plain(
      trees.size() - first, line_number, outcome, [&](std::size_t index) { return trees.plain(first + index); },
      [&](std::size_t index) { return trees.changes_nothing(first + index); });
  if (done == trees.size()) outcome.only_row = last_row_;
  return done;
}

void Checker::check_all(const syntax::ChunkTrees& trees, Outcome& outcome) {
  for (std::size_t line = 0; line < trees.size(); ++line) {
    line += check_plain_lines(trees.store(), line, line, outcome);
    if (line < trees.size()) check_any(trees[line], line, outcome);
  }
}

void Checker::check(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  const auto plain_line = [&](std::size_t) { return line.plain_arguments == 0 ? PlainLine{} : line.plain(); };
  const auto changes_nothing = [](std::size_t) { return false; };  // check_any() passes by such a line.
  if (check_plain(1, line_number, outcome, plain_line, changes_nothing) == 0) check_any(line, line_number, outcome);
}

/// Checks two blocks whose line break is lost, one after the other (D68).
void Checker::check_two_blocks(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  const std::size_t first = outcome.findings.size();
  bool is_read = false;
  std::uint32_t offset = 0;
  for (const std::string_view block : line.blocks()) {
    const syntax::ParsedLine parsed(block);
    const std::size_t first_of_block = outcome.findings.size();
    const std::size_t first_label = outcome.labels.size();
    is_read |= !frontier.live.empty() || frontier.waiting().contains(parsed.tree().label);
    check_any(parsed.tree(), line_number, outcome);
    const auto shift = [&](syntax::Span& span) { span = {span.begin + offset, span.end + offset}; };
    for (std::size_t i = first_of_block; i < outcome.findings.size(); ++i) {
      shift(outcome.findings[i].finding.span);
      shift(outcome.findings[i].finding.related);
    }
    for (std::size_t i = first_label; i < outcome.labels.size(); ++i) shift(outcome.labels[i].span);
    offset = static_cast<std::uint32_t>(block.size());
  }
  if (is_read) outcome.findings.push_back({line_number, line.findings.front()});
  sort_by_column(outcome.findings, first);
}

/// Checks a line that starts with words which the block above lacks. Returns false for any other line.
bool Checker::check_carried(const LineTree& line, const execution::Lack& lack, std::size_t line_number,
                            std::size_t first_label, Outcome& outcome) {
  const bool is_of_motion = lack.is_of_motion;
  const auto parts = execution::SplitLine::split(line, lack);
  if (!parts) return false;
  execute_carried(parts->carried(), is_of_motion, line_number, outcome);
  if (parts->rest().has(LineTree::kTwoBlocks)) {
    outcome.labels.resize(first_label);  // The blocks have it.
    check_two_blocks(parts->rest(), line_number, outcome);
  } else {
    check_block(parts->rest(), line_number, outcome);
  }
  return true;
}

void Checker::check_any(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  if (line.has(LineTree::kTwoBlocks)) return check_two_blocks(line, line_number, outcome);
  if (!line.words.empty() || !line.comments.empty() || !line.findings.empty()) {
    outcome.has_text = true;
    outcome.last_text_line = line_number;
  }
  const std::size_t first_label = outcome.labels.size();
  if (line.has_label() && jumps_.names(line.label)) arrive(line, line_number, outcome);
  Groups& live = frontier.live;
  if (live.empty()) {
    if (line.jump && line.jump->has_target) ++frontier.next_jump;
    return report_dead_code(line, line_number, outcome);
  }
  frontier.dead_reported = false;
  outcome.positions.by_several |= live.size() > 1 || !frontier.waiting().empty();
  const execution::Lack* const lack = lack_of_any(live);
  if (lack && check_carried(line, *lack, line_number, first_label, outcome)) return;
  check_block(line, line_number, outcome);
}

/// Checks a line, or what is left of it.
void Checker::check_block(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  Groups& live = frontier.live;
  const std::size_t first = outcome.findings.size();
  for (const Finding& finding : line.findings)
    if (!is_reported_above(finding, live)) outcome.findings.push_back({line_number, finding});
  if (!line.findings.empty())
    if (const std::optional<double> label = misspelled_label(line)) outcome.misspelled_labels.push_back(*label);
  if (jumps_anywhere(line)) outcome.leads_anywhere_from = std::min(outcome.leads_anywhere_from, line_number);
  if (line.jump && line.jump->has_target) {
    execute_around_jump(line, line_number, outcome);
  } else {
    execute_in_all_groups(line, line_number, outcome);
    if (line.jump && !frontier.live.empty()) pass_jump_to_nowhere(*line.jump);
  }
  sort_by_column(outcome.findings, first);
  if (live.empty() || !live[0].state.ended) return;
  live.clear();  // M02 ends every path through it.
  // On a line with an error, M02 may not be meant as the end: no W116 below.
  frontier.dead_reported = has_error(outcome.findings, first);
}

/// Unreachable lines are not executed; W116 is reported at the first of them, and nothing else (D51).
void Checker::report_dead_code(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  if (frontier.dead_reported || line.is_empty()) return;
  frontier.dead_reported = true;
  if (frontier.reduced) return;  // A path that is not followed may lead here.
  syntax::Span span;
  for (const syntax::Word& word : line.words)
    if (word.letter != 'N') span = span.empty() ? word.span() : syntax::hull(span, word.span());
  outcome.findings.push_back({line_number, {.id = "never-runs"_diag, .span = span}});
}

/// Handles a label that a jump names: paths that jumped here continue. A label on no feasible path is recorded as well.
void Checker::arrive(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  if (frontier.arrive(line) && frontier.bound_live()) admit_reduction(line, line_number, outcome);
  for (const syntax::Word& word : line.words) {
    if (word.letter != 'N' || word.owner != syntax::Word::kNoOwner) continue;
    outcome.labels.push_back({line.label, line_number, word.span(), !frontier.live.empty()});
    break;
  }
}

/// Most values are never compared: where no IF compares this one, forgets the old value and does nothing else.
void Checker::assign(Group& group, int reg, double value, Outcome& outcome) const {
  if (!jumps_.compares_registers()) return;
  outcome.assigned |= register_bit(reg);
  if ((jumps_.read_before(frontier.next_jump) & register_bit(reg)) != 0) {
    group.registers.assign(reg, value, jumps_);
  } else {
    group.registers.keep_only(~register_bit(reg));
  }
}

/// Words after an IF on its line (E002) are executed only if the IF does not jump (D56).
void Checker::execute_around_jump(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  if (line.findings.empty()) {  // The IF is alone on the line.
    execute_in_all_groups(line, line_number, outcome);
    return branch(line, line_number, outcome);
  }
  const execution::JumpLine parts = execution::around_jump(line);
  execute_in_all_groups(parts.before, line_number, outcome);
  branch(line, line_number, outcome);
  if (!parts.after.is_empty() && !frontier.live.empty()) execute_in_all_groups(parts.after, line_number, outcome);
}

/// Executes one line in each live group, and collects its findings and effects.
class Checker::LineExecution final : public execution::Sink {
 public:
  LineExecution(Checker& checker, const LineTree& line, std::size_t line_number, Outcome& outcome)
      : Sink(checker.checks_moves_ || (checker.house_ && checker.house_->watches_depth())),
        checker_(checker),
        line_(line),
        line_number_(line_number),
        outcome_(outcome) {}

  void run() {
    const bool is_wrong = has_error_in_text();
    Groups& live = checker_.frontier.live;
    // check_plain() has already tried all other lines.
    const bool is_target = line_.has_label() && checker_.jumps_.names(line_.label);
    const bool may_be_plain = (live.size() > 1 || is_target) && !checker_.checks_moves_;
    for (group_ = 0; group_ < live.size(); ++group_) {
      if (!may_be_plain || !run_plainly(live[group_])) execute(live[group_], is_wrong);
    }
  }

  void step(BlockStep step, const execution::State& before) override {
    checker_.frontier.live[group_].memory.take(step, before);
    is_legible_ = is_legible_ && step != BlockStep::LostLetter && step != BlockStep::IllegibleFunction &&
                  step != BlockStep::IllegibleMotion;
    if (const FoldSet ended = folds_ended_by(step)) outcome_.end_folds(ended, line_number_);
  }
  void report(const Finding& finding) override { checker_.group_findings_.push_back({finding, group_}); }
  void centered_arc(const execution::CenteredArc& arc) override { checker_.judge_arc(arc, outcome_, *this); }
  void move(const execution::ProgrammedMove& move, const execution::State&) override { move_ = move; }
  void assign(int reg, double value) override {
    outcome_.may_assign |= std::isnan(value);
    checker_.assign(checker_.frontier.live[group_], reg, value, outcome_);
  }

 private:
  bool has_error_in_text() const {
    return std::any_of(line_.findings.begin(), line_.findings.end(), [&](const Finding& finding) {
      return is_error(finding) && !is_reported_above(finding, checker_.frontier.live);
    });
  }

  /// Whether each word of the line can be read, as far as the line alone shows.
  bool has_legible_words() const {
    using syntax::Word;
    const bool is_open = line_.has(LineTree::kUnclosed | LineTree::kMayMove | LineTree::kCut);
    return !is_open && std::none_of(line_.words.begin(), line_.words.end(), [](const Word& word) {
      const bool is_stray = word.letter == syntax::kNumber || word.letter == syntax::kError;
      return is_stray || word.has(Word::kMalformed | Word::kMissing);
    }) && std::none_of(line_.instructions.begin(), line_.instructions.end(), [](const syntax::Instruction& each) {
      return each.is_unknown_g();
    });
  }

  bool run_plainly(Group& group) {
    if (group.memory.judges_plain_motions(group.state)) return false;
    const rules::HouseRules* const house = checker_.house_;
    if (house && (house->judges_plain_motions(group.house, group.state) ||
                  house->guard(group.house, group.state).stops_at(line_.words, line_.feed, group.state)))
      return false;
    const geometry::Pose before = group.state.position;
    execution::PlainRun run(group.state, checker_.setup_.machine, checker_.suspects_centers_);
    if (!run.run(line_.plain())) return false;
    outcome_.positions.far |= is_far(before);
    if (house) note_house_rules(*house, outcome_.positions);
    outcome_.centers.open |= run.met_open_center();
    dialect::LetterSet named = 0;
    note_plain_move(run, group.state, outcome_.positions, named);
    outcome_.positions.set |= execution::axes_of(named);
    group.memory.take(run.effects(), group.state);
    if (house) house->take(run.effects(), group.state, group.house);
    note_plain_feed(run, group.state, line_number_, outcome_);
    return true;
  }

  /// Executes the line, then runs the rules, unless the line has an error in its text or in this group.
  void execute(Group& group, bool is_wrong) {
    execution::State& state = group.state;
    const std::vector<GroupFinding>& findings = checker_.group_findings_;
    const auto first = static_cast<std::ptrdiff_t>(findings.size());
    const execution::State before = state;
    const rules::Memory remembered = group.memory;
    move_.reset();
    is_legible_ = true;
    execution::execute(line_, state, checker_.setup_.machine, *this);
    const auto is_error_here = [](const GroupFinding& found) { return is_error(found.finding); };
    const bool is_right = !is_wrong && std::none_of(findings.begin() + first, findings.end(), is_error_here);
    const rules::CheckSetup& setup = checker_.setup_;
    const rules::ExecutedBlock block{line_, before, state, setup.machine, setup.thresholds};
    if (is_right) {
      rules::run_rules(block, remembered, *this);
      if (move_ && checker_.checks_moves_) rules::run_move_rules(block, *move_, *this);
    }
    if (checker_.house_)
      checker_.house_->judge(block, is_right, is_legible_ && has_legible_words(), move_ ? &*move_ : nullptr,
                             group.house, *this);
    const bool is_incremental = before.incremental() && state.incremental();
    const auto may_depend_on_start = [&](const GroupFinding& found) {
      return !is_incremental || !is_of_circle(found.finding);
    };
    const bool has_findings =
        !line_.findings.empty() || std::any_of(findings.begin() + first, findings.end(), may_depend_on_start);
    const bool is_judged =
        has_findings || checker_.checks_moves_ || (checker_.house_ && checker_.house_->watches_depth());
    note_line(line_, before, state, is_judged, outcome_.positions);
  }

  Checker& checker_;
  const LineTree& line_;
  const std::size_t line_number_;
  Outcome& outcome_;
  std::size_t group_ = 0;                          // The group that executes the line.
  std::optional<execution::ProgrammedMove> move_;  // The line's motion, if motions are watched.
  bool is_legible_ = true;                         // Whether each word of the line can be read.
};

/// Executes words that belong to the block before (SplitLine). What they make wrong has been reported there, but for a
/// missing tool and a missing F, which are mistakes of their own (D45) and reported once only, and a broken house rule.
/// The words of a frame or a dwell move no axis, but whatever they name is unknown.
void Checker::execute_carried(const LineTree& words, bool is_of_motion, std::size_t line_number, Outcome& outcome) {
  Groups& live = frontier.live;
  group_findings_.clear();
  LineExecution(*this, words, line_number, outcome).run();
  std::erase_if(group_findings_, [](const GroupFinding& each) {
    return each.finding.id != "initial-tool-missing"_diag && each.finding.id != "feed-missing"_diag &&
           each.finding.id != "house-rule"_diag;
  });
  if (!group_findings_.empty()) report_common_findings(line_number, outcome);
  outcome.positions.read |= static_cast<execution::AxisSet>(execution::kAllAxes & ~outcome.positions.set);
  if (is_of_motion) return;
  for (const syntax::Word& word : words.words)
    if (dialect::contains(dialect::kCoordinateLetters, word.letter))
      for (Group& group : live) group.state.unknown |= execution::axes_of(dialect::letter_bit(word.letter));
}

void Checker::execute_in_all_groups(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  Groups& live = frontier.live;
  if (house_ && house_->watches_comments() && !line.comments.empty())
    for (Group& group : live) house_->take_comments(line, group.house);
  if (const auto assignment = execution::lone_assignment(line)) {
    for (Group& group : live) {
      execution::pass_by(group.state);
      assign(group, assignment->reg, assignment->value, outcome);
    }
  } else if (execution::is_lone_jump(line)) {
    for (Group& group : live) execution::pass_by(group.state);
  } else if (!line.is_empty() || !line.findings.empty()) {
    group_findings_.clear();
    LineExecution(*this, line, line_number, outcome).run();
    if (!group_findings_.empty()) report_common_findings(line_number, outcome);
  }
  if (live.size() == 1) return frontier.reduce_spread(1);
  live.converge();
  if (frontier.bound_live()) admit_reduction(line, line_number, outcome);
}

/// Judges an arc whose circle is given by its center, and collects evidence on how centers are meant (D70).
void Checker::judge_arc(const execution::CenteredArc& arc, Outcome& outcome, execution::Sink& sink) const {
  const double tolerance = setup_.machine.arc_tolerance;
  const geometry::CenterReadings readings =
      geometry::read_center_in_both_modes(arc.given, arc.start, arc.incremental, tolerance);
  if (!arc.incremental) {
    outcome.centers.from_start |= !readings.is_same_center && readings.shows_other_origin(tolerance);
    outcome.centers.open |= readings.is_legal_in_both_readings(tolerance);
  }
  if (arc.circle.problem == geometry::ArcProblem::None)
    rules::judge_arc(arc, readings, suspects_centers_, setup_.machine, sink);
}

/// Reports each finding once. A finding that only some groups have carries the decisions that lead to them.
void Checker::report_common_findings(std::size_t line_number, Outcome& outcome) {
  const Groups& live = frontier.live;
  for (std::size_t i = 0; i < group_findings_.size(); ++i) {
    const Finding& finding = group_findings_[i].finding;
    const auto same = [&](const GroupFinding& other) {
      return other.finding.id == finding.id && other.finding.span == finding.span &&
             other.finding.names == finding.names;
    };
    const auto here = group_findings_.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::any_of(group_findings_.begin(), here, same)) continue;
    LocatedFinding located{line_number, finding};
    // The decisions shared by all paths that have the finding.
    Decisions path = live[group_findings_[i].group].path;
    std::size_t count = 0;
    for (auto other = here; other != group_findings_.end(); ++other) {
      if (!same(*other)) continue;
      ++count;
      const Decisions& theirs = live[other->group].path;
      std::erase_if(path, [&](const Decision& decision) {
        return std::find(theirs.begin(), theirs.end(), decision) == theirs.end();
      });
    }
    // Where only some paths have it: of an IF that cannot be read it is not known whether it leads here.
    const auto is_illegible = [](const Decision& decision) { return !decision.is_legible; };
    if (count < live.size() && std::any_of(path.begin(), path.end(), is_illegible)) continue;
    // For findings on every path that comes here, report only the taken jumps; untaken IFs are implied.
    if (count == live.size()) std::erase_if(path, [](const Decision& decision) { return !decision.taken; });
    if (!path.empty()) {
      located.path = static_cast<std::int32_t>(outcome.paths.size());
      if (!outcome.paths.empty() && outcome.paths.back() == path) {
        --located.path;
      } else {
        outcome.paths.push_back(std::move(path));
      }
    }
    outcome.report(located);
  }
}

/// Passes a jump whose label is not known: the lines below are meant for when it is not taken (D63). Paths that would
/// take it are not followed, unless no other is left.
void Checker::pass_jump_to_nowhere(const syntax::Jump& jump) {
  if (jump.variable == 0 || !jump.condition_is_known()) return;
  const auto stays = [&](const Group& group) { return group.registers.where(jump, false).possible(); };
  Groups& live = frontier.live;
  if (std::none_of(live.begin(), live.end(), stays)) return;
  std::size_t staying = 0;
  for (Group& group : live) {
    group.registers = group.registers.where(jump, false);
    if (!group.registers.possible()) continue;
    Group& place = live[staying++];
    if (&place != &group) place = std::move(group);
  }
  live.keep_first(staying);
}

/// Executes an IF: follows the paths that are feasible (D51, D52).
void Checker::branch(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  const syntax::Jump& jump = *line.jump;
  const std::uint32_t ordinal = frontier.next_jump++;
  outcome.live_jumps.push_back(ordinal);
  if (jumps_.target_of(ordinal) != JumpMap::Target::Below) {
    outcome.leads_anywhere_from = std::min(outcome.leads_anywhere_from, line_number);
    pass_jump_to_nowhere(jump);
  }
  switch (jumps_.target_of(ordinal)) {
    case JumpMap::Target::Below:
      break;
    case JumpMap::Target::NotFound:
      outcome.findings.push_back(
          {line_number,
           {.id = "label-not-found"_diag, .span = jump.target_span, .values = {static_cast<double>(jump.target)}}});
      return;
    case JumpMap::Target::Above:
      outcome.findings.push_back({line_number, {.id = "backward-jump"_diag, .span = jump.target_span}});
      return;
  }
  Groups jumping;
  bool may_jump = false;
  bool may_stay = false;
  const auto decide = [&](Decisions path, bool taken) {
    path.insert(path.begin(), {ordinal, taken, jump.condition_is_known()});
    if (path.size() > kLongestPath) path.pop_back();
    return path;
  };
  std::size_t staying = 0;
  for (Group& group : frontier.live) {
    const bool on_register = jump.variable > 0 && jump.condition_is_known();
    Valuations where_true = on_register ? group.registers.where(jump, true) : group.registers;
    if (on_register) group.registers = group.registers.where(jump, false);
    if (jumps_.compares_registers()) {
      where_true.keep_only(jumps_.read_at_target(ordinal));
      group.registers.keep_only(jumps_.read_after(ordinal));
    }
    const bool jumps_on = where_true.possible();
    const bool stays = group.registers.possible();
    may_jump |= jumps_on;
    may_stay |= stays;
    if (jumps_on)
      jumping.append({group.state, group.memory, group.house, std::move(where_true),
                      stays ? decide(group.path, true) : group.path});
    if (!stays) continue;
    if (jumps_on) group.path = decide(std::move(group.path), false);
    Group& place = frontier.live[staying++];
    if (&place != &group) place = std::move(group);
  }
  frontier.live.keep_first(staying);
  if (!jumping.empty()) {
    Groups& waiting = frontier.jump(jump.target, std::move(jumping));
    if (frontier.reduce(waiting)) admit_reduction(line, line_number, outcome);
  }
  if (may_jump != may_stay && !frontier.reduced) {
    outcome.findings.push_back({line_number, {.id = "condition-decided"_diag, .span = jump.if_span}});
    frontier.dead_reported = !may_stay;  // No W116 below: an IF that always jumps often switches code off.
  }
  if (frontier.waiting().size() > kMaxWaiting) {
    frontier.drop_highest_label();
    admit_reduction(line, line_number, outcome);
  }
}

/// Reports once (W191) that some paths are not followed from here on. Axes in which states differed may be unknown now,
/// at 0, and whether they differ in more depends on that.
void Checker::admit_reduction(const LineTree& line, std::size_t line_number, Outcome& outcome) {
  outcome.positions.read |= execution::kAllAxes;
  if (frontier.reduced) return;
  frontier.reduced = true;
  syntax::Span span;
  if (!line.words.empty()) span = line.words.front().span();
  outcome.findings.push_back(
      {line_number, {.id = "too-many-paths"_diag, .span = span, .values = {static_cast<double>(kMaxStates)}}});
}

}  // namespace isocnc::check
