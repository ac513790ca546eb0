#include "analyzer/rules/house_rules.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "analyzer/rules/rule.h"
#include "interpreter/dialect/any_case.h"
#include "interpreter/execution/machine_move.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/text/characters.h"

namespace isocnc::rules {

using dialect::HouseEvent;
using dialect::HouseWatch;
using EventKind = HouseEvent::Kind;
using Watches = std::uint64_t;

/// Numbers of G and of M: at most three digits.
static constexpr std::size_t kCodeNumbers = 1000;

/// Calls `each` with the index of every watch of the set.
template <class Each>
static void for_each_watch(Watches set, Each each) {
  for (; set != 0; set &= set - 1) each(static_cast<std::size_t>(std::countr_zero(set)));
}

static constexpr Watches watch_bit(std::size_t index) { return Watches{1} << index; }

/// Whether a text fits a pattern in which each `*` stands for any characters. Case does not matter.
static bool fits(std::string_view text, std::string_view pattern) {
  std::size_t t = 0;
  std::size_t p = 0;
  std::size_t star = std::string_view::npos;
  std::size_t retry = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = t;
    } else if (p < pattern.size() && dialect::same_letter(pattern[p], text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++retry;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

/// The text of a comment without what encloses it.
static std::string_view inner_text(std::string_view comment) {
  if (comment.starts_with('(') && comment.ends_with(')')) comment.remove_suffix(1);
  if (!comment.empty()) comment.remove_prefix(1);
  return text::trimmed(comment);
}

static bool is_of_motion(const HouseEvent& event) {
  return event.kind == EventKind::Motion || event.kind == EventKind::Rapid || event.kind == EventKind::Cut;
}

bool PlainGuard::stops_at(std::span<const syntax::Word> words, std::int32_t feed, const execution::State& state) const {
  if (feed >= 0) {
    const double written = words[static_cast<std::size_t>(feed)].value * mm_per_unit;
    if (written < minimum_feed || written > maximum_feed) return true;
  }
  if (lowest == -std::numeric_limits<double>::infinity()) return false;
  const double here = state.position.tip.z();
  for (const syntax::Word& word : words) {
    if (word.letter != 'Z') continue;
    const double z = word.value * mm_per_unit + (is_incremental ? here : 0);
    if (z < lowest && z < here) return true;
  }
  return false;
}

// --- Made from a configuration

std::size_t HouseRules::index_of(const HouseEvent& event) {
  const auto number = static_cast<std::size_t>(event.number);
  if (event.kind == EventKind::G) return number;
  if (event.kind == EventKind::M) return kCodeNumbers + number;
  return 2 * kCodeNumbers + static_cast<std::size_t>(event.kind);
}

HouseRules::HouseRules(const std::vector<HouseWatch>& watches) : concerned_(2 * kCodeNumbers + 8) {
  assert(watches.size() <= dialect::kMaxHouseWatches);
  for (const HouseWatch& watch : watches) add(watch);
}

void HouseRules::add(const HouseWatch& watch) {
  const Watches mine = watch_bit(watches_.size());
  watches_.push_back({.rule = dialect::GivenName::of({watch.rule, watch.rule}),
                      .message = dialect::GivenName::of({watch.message.en, watch.message.it}),
                      .severity = watch.severity,
                      .comment = watch.comment,
                      .minimum = watch.minimum,
                      .maximum = watch.maximum,
                      .tools = watch.tools});
  if (watch.kind != HouseWatch::Kind::Order) {
    (watch.kind == HouseWatch::Kind::Speed ? speed_ : watch.kind == HouseWatch::Kind::Feed ? feed_ : depth_) |= mine;
    (watch.tools.empty() ? on_first_ : by_tool_) |= mine;
    return;
  }
  bool starts_in_row = false;
  bool matters_in_row = !watch.comment.empty();
  for (const HouseEvent& event : watch.reported) {
    concerned_[index_of(event)].reported |= mine;
    matters_in_row |= is_of_motion(event);
  }
  for (const HouseEvent& event : watch.ended) {
    concerned_[index_of(event)].ended |= mine;
    matters_in_row |= is_of_motion(event);
  }
  for (const HouseEvent& event : watch.started) {
    concerned_[index_of(event)].started |= mine;
    starts_in_row |= is_of_motion(event);
    needs_each_motion_ |= event.kind == EventKind::Rapid;  // A row does not say whether it has one.
  }
  // A row of plain motions is taken at its end, which is too late for what starts and matters within it.
  needs_each_motion_ |= starts_in_row && matters_in_row;
  if (matters_in_row) of_motions_ |= mine;
  if (watch.is_on_first) on_first_ |= mine;
  if (watch.stays_on) stays_on_ |= mine;
  if (!watch.comment.empty()) commented_ |= mine;
}

// --- Rows of plain motions

bool HouseRules::judges_plain_motions(const HouseMemory& memory, const execution::State& state) const {
  if ((memory.on & of_motions_) != 0 || (memory.on & memory.outside) != 0) return true;
  // An arc in another plane may go deeper than its ends.
  return (memory.on & depth_) != 0 && state.mode(dialect::ModalGroup::Plane) != 17;
}

PlainGuard HouseRules::guard(const HouseMemory& memory, const execution::State& state) const {
  PlainGuard guard{.mm_per_unit = state.mm_per_unit(), .is_incremental = state.incremental()};
  if (!state.inverse_time())
    for_each_watch(memory.on & feed_, [&](std::size_t i) {
      guard.is_active = true;
      guard.minimum_feed = std::max(guard.minimum_feed, watches_[i].minimum);
      guard.maximum_feed = std::min(guard.maximum_feed, watches_[i].maximum);
    });
  for_each_watch(memory.on & depth_, [&](std::size_t i) {
    guard.is_active = true;
    guard.lowest = std::max(guard.lowest, watches_[i].minimum);
  });
  return guard;
}

void HouseRules::take(const execution::PlainEffects& row, const execution::State& after, HouseMemory& memory) const {
  if (!row.has_run()) return;
  memory.on |= concerned_by({.kind = EventKind::Motion}).started;
  if (row.has_fed) memory.on |= concerned_by({.kind = EventKind::Cut}).started;
  if (feed_ == 0 || !row.has_taken_feed || after.inverse_time()) return;
  const execution::ProgrammedFeed feed = after.feed_per_minute;
  memory.outside = (memory.outside & ~feed_) | outside_of(feed_, feed.number * feed.mm_per_unit);
}

// --- Other lines

Watches HouseRules::outside_of(Watches watches, double value) const {
  Watches outside = 0;
  for_each_watch(watches, [&](std::size_t i) {
    if (value < watches_[i].minimum || value > watches_[i].maximum) outside |= watch_bit(i);
  });
  return outside;
}

/// `on` after a tool change.
Watches HouseRules::for_tool(Watches on, const execution::State& state) const {
  on &= ~by_tool_;
  if (!state.tool_known) return on;
  const int number = state.tool.head * 100'000 + state.tool.holder * 1'000 + state.tool.tool;
  for_each_watch(by_tool_, [&](std::size_t i) {
    const std::vector<dialect::ToolRange>& tools = watches_[i].tools;
    if (std::any_of(tools.begin(), tools.end(), [&](const dialect::ToolRange& range) { return range.holds(number); }))
      on |= watch_bit(i);
  });
  return on;
}

void HouseRules::take_comments(const syntax::LineTree& line, HouseMemory& memory) const {
  if ((memory.on & commented_) == 0) return;
  for (const syntax::Span span : line.comments) {
    const std::string_view comment = inner_text(line.text_of(span));
    for_each_watch(memory.on & commented_, [&](std::size_t i) {
      if (fits(comment, watches_[i].comment)) memory.on &= ~watch_bit(i);
    });
  }
}

/// Judges one block on one path.
class HouseRules::BlockJudge {
 public:
  BlockJudge(const HouseRules& rules, const ExecutedBlock& block, bool may_report, HouseMemory& memory,
             execution::Sink& sink)
      : rules_(rules), block_(block), line_(block.line), may_report_(may_report), memory_(memory), sink_(sink) {}

  void run(const execution::ProgrammedMove* move) {
    take_numbers();
    motion_ = block_.before.motion();
    for (const syntax::Instruction& instruction : line_.instructions) take(instruction);
    if (may_report_) report_numbers();
    if (move && may_report_ && (memory_.on & rules_.depth_) != 0) report_depth(*move);
  }

 private:
  /// Takes S and F, which count for the whole line (D14).
  void take_numbers() {
    speed_ = positive(line_.spindle);
    if (speed_) set_outside(rules_.speed_, speed_->value);
    const bool is_of_minutes = !block_.after.inverse_time();
    const bool is_ignored = block_.motion() && !block_.has_feed_move();  // On a rapid (D43).
    if (is_of_minutes && !is_ignored) feed_ = positive(line_.feed);
    if (feed_) set_outside(rules_.feed_, feed_->value * block_.after.mm_per_unit());
  }

  const syntax::Word* positive(std::int32_t index) const {
    if (index < 0) return nullptr;
    const syntax::Word& word = line_.words[static_cast<std::size_t>(index)];
    return word.value > 0 ? &word : nullptr;
  }

  void set_outside(Watches watches, double value) {
    if (watches != 0) memory_.outside = (memory_.outside & ~watches) | rules_.outside_of(watches, value);
  }

  void take(const syntax::Instruction& instruction) {
    const syntax::Word& command = line_.command(instruction);
    switch (instruction.kind) {
      case syntax::InstructionKind::G:
        if (instruction.is_motion()) return take_motion(instruction.g(), command);
        if (instruction.g()) take({.kind = EventKind::G, .number = instruction.g()->number}, command);
        return;
      case syntax::InstructionKind::Continuation:
        return take_motion(motion_, command);
      case syntax::InstructionKind::Function:
        if (const auto m = command.whole(); m && *m > 0 && *m < static_cast<int>(kCodeNumbers))
          take(*m == dialect::kProgramEnd ? HouseEvent{.kind = EventKind::End}
                                          : HouseEvent{.kind = EventKind::M, .number = *m},
               command);
        return;
      case syntax::InstructionKind::ToolChange:
        take({.kind = EventKind::ToolChange}, command);
        memory_.on = rules_.for_tool(memory_.on, block_.after);
        return;
      default:
        return;
    }
  }

  void take_motion(const dialect::GCode* motion, const syntax::Word& word) {
    motion_ = motion;
    if (!motion) return;
    take({.kind = EventKind::Motion}, word);
    take({.kind = motion->is_feed_move() ? EventKind::Cut : EventKind::Rapid}, word);
    if (motion->is_feed_move()) cut_ = &word;
  }

  void take(const HouseEvent& event, const syntax::Word& word) {
    const Concerned& concerned = rules_.concerned_by(event);
    const Watches hit = may_report_ ? memory_.on & concerned.reported : 0;
    for_each_watch(hit, [&](std::size_t i) { report("house-rule"_diag, i, word.span()); });
    memory_.on = (memory_.on & ~concerned.ended & ~(hit & ~rules_.stays_on_)) | concerned.started;
  }

  /// Reports S and F where they are given, or where a tool first cuts with what an earlier one has left.
  void report_numbers() {
    if (speed_) report_outside(rules_.speed_, *speed_, speed_->value);
    const bool turns_only = cut_ && !moves_linear_axes();  // Degrees per minute.
    if (feed_ && !turns_only) report_outside(rules_.feed_, *feed_, feed_->value * block_.after.mm_per_unit());
    if (!cut_) return;
    report_outside(rules_.speed_, *cut_, block_.before.spindle_speed);
    if (block_.after.inverse_time() || turns_only) return;
    const execution::ProgrammedFeed feed = execution::feed_in_force(block_.after);
    report_outside(rules_.feed_, *cut_, feed.number * feed.mm_per_unit);
  }

  bool moves_linear_axes() const {
    return std::any_of(line_.words.begin(), line_.words.end(), [](const syntax::Word& word) {
      return dialect::contains(dialect::kLinearLetters, word.letter);
    });
  }

  void report_outside(Watches watches, const syntax::Word& word, double value) {
    const Watches hit = memory_.on & memory_.outside & watches;
    for_each_watch(hit, [&](std::size_t i) {
      const LoadedWatch& watch = rules_.watches_[i];
      const bool is_speed = (rules_.speed_ & watch_bit(i)) != 0;
      const bool is_low = value < watch.minimum;
      const dialect::Cause cause = is_speed ? (is_low ? "house-rule/low-speed"_cause : "house-rule/high-speed"_cause)
                                            : (is_low ? "house-rule/low-feed"_cause : "house-rule/high-feed"_cause);
      report(cause, i, word.span(), {value, is_low ? watch.minimum : watch.maximum});
    });
    memory_.outside &= ~hit;
  }

  void report_depth(const execution::ProgrammedMove& move) {
    const execution::State& before = block_.before;
    const execution::State& after = block_.after;
    const execution::AxisSet judged =
        move.kind == execution::MoveKind::Arc ? execution::kLinearAxes : execution::axis_bit(execution::Axis::Z);
    if (((before.unknown | after.unknown) & judged) != 0) return;
    const double lowest = execution::extents(execution::in_machine(move, execution::State{}))[2].minimum;
    for_each_watch(memory_.on & rules_.depth_, [&](std::size_t i) {
      const double limit = rules_.watches_[i].minimum - geometry::kEqualCoordinate;
      if (lowest >= limit || move.from.tip.z() < limit) return;
      const syntax::Word* const z = block_.argument('Z');
      const double unit = after.mm_per_unit();
      report("house-rule/too-deep"_cause, i, z ? z->span() : block_.motion_word().span(),
             {lowest / unit, rules_.watches_[i].minimum / unit}, after.in_inches());
    });
  }

  void report(dialect::Cause cause, std::size_t watch, syntax::Span span, std::initializer_list<double> values = {},
              bool is_in_inches = false) {
    syntax::Finding finding = syntax::finding_of(cause, span, values);
    finding.is_in_inches = is_in_inches;
    finding.severity = rules_.watches_[watch].severity;
    finding.names = {rules_.watches_[watch].rule, rules_.watches_[watch].message};
    sink_.report(finding);
  }

  const HouseRules& rules_;
  const ExecutedBlock& block_;
  const syntax::LineTree& line_;
  const bool may_report_;
  HouseMemory& memory_;
  execution::Sink& sink_;
  const dialect::GCode* motion_ = nullptr;  // In force so far.
  const syntax::Word* cut_ = nullptr;       // The line's feed move.
  const syntax::Word* speed_ = nullptr;
  const syntax::Word* feed_ = nullptr;
};

void HouseRules::judge(const ExecutedBlock& block, bool may_report, bool is_legible,
                       const execution::ProgrammedMove* move, HouseMemory& memory, execution::Sink& sink) const {
  BlockJudge(*this, block, may_report, memory, sink).run(move);
  take_comments(block.line, memory);
  // A word that cannot be read may have been any. What is always on stays on.
  if (!is_legible) memory.on &= stays_on_ | speed_ | feed_ | depth_;
}

}  // namespace isocnc::rules
