#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "interpreter/execution/execute.h"
#include "interpreter/syntax/line_tree.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::check {

/// A set of registers, one bit each.
using RegisterSet = std::uint32_t;
constexpr RegisterSet register_bit(int reg) { return RegisterSet{1} << reg; }

/// An event on a line that concerns jumps: an IF with its label, an assignment to a register, or a label.
struct FlowEvent {
  enum class Kind : std::uint8_t { Assignment, Jump, Label };

  Kind kind = Kind::Jump;
  std::uint8_t reg = 0;     ///< The register assigned to.
  std::uint32_t line = 0;   ///< The line, counted from the start of the text or chunk.
  double value = 0;         ///< The value assigned; NaN if it could not be read.
  std::uint64_t label = 0;  ///< The label defined.
  syntax::Jump jump;

  /// Whether two events mean the same, wherever they are in the program.
  bool means_the_same(const FlowEvent& other) const;
};

/// Whether two conditions and their targets are the same.
bool jump_alike(const syntax::Jump& a, const syntax::Jump& b);

/// Sorts values, each once. Labels are in order already in most programs.
template <class Value>
void sort_once(std::vector<Value>& values) {
  if (!std::is_sorted(values.begin(), values.end())) std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The number of a line with findings, where its first word may be a misspelled line number: N3O, 30, or B30 with the
/// key beside N.
std::optional<double> misspelled_label(const syntax::LineTree& line);

/// Fast test: whether a text may hold assignments or jumps.
bool may_hold_jumps(std::string_view text);

/// Calls `take` with the events of a block in the order in which they take effect: label, assignments, jump.
template <class Take>
void each_event_of_block(const syntax::LineTree& line, Take take) {
  if (line.has_label()) take(FlowEvent{.kind = FlowEvent::Kind::Label, .label = line.label});
  for (const syntax::Instruction& instruction : line.instructions) {
    if (instruction.kind != syntax::InstructionKind::Assignment) continue;
    if (const auto assigned = execution::assigned_by(instruction, line))
      take(FlowEvent{.kind = FlowEvent::Kind::Assignment,
                     .reg = static_cast<std::uint8_t>(assigned->reg),
                     .value = assigned->value});
  }
  if (line.jump && line.jump->has_target) take(FlowEvent{.kind = FlowEvent::Kind::Jump, .jump = *line.jump});
}

/// Calls `take` with the events of a line: of its block, or of both where a line break is lost (D68).
template <class Take>
void each_event(const syntax::LineTree& line, Take take) {
  if (!line.has(syntax::LineTree::kTwoBlocks)) return each_event_of_block(line, take);
  std::uint32_t offset = 0;
  for (const std::string_view block : line.blocks()) {
    const syntax::ParsedLine parsed(block);
    each_event_of_block(parsed.tree(), [&](FlowEvent event) {
      event.jump.shift(offset);
      take(event);
    });
    offset = static_cast<std::uint32_t>(block.size());
  }
}

/// Calls `take` with the events of a text, without parsing lines that hold none; FlowEvent::line counts from its start.
void each_event_in(std::string_view text, const std::function<void(const FlowEvent&)>& take);

/// What must be known of a program's jumps before its first line is checked: the lines of the IFs, the labels that they
/// name, the constants that they compare registers with, and which of them find their label. Jumps go forward only
/// (I.5), so this and one pass over the lines suffice. Made from a text or by a JumpCollector; does not change after
/// that.
class JumpMap {
 public:
  struct Site {
    std::size_t line = 0;
    syntax::Jump jump;
  };
  /// Where a jump's label is, relative to the jump's line.
  enum class Target : std::uint8_t { Below, NotFound, Above };

  /// The map of a program without jumps.
  JumpMap() = default;
  /// The jumps of a text, found without parsing lines that hold none. Where no IF compares a register, labels are not
  /// read (knows_labels()): most programs have many, and nearly all of their jumps find theirs.
  explicit JumpMap(std::string_view text, int jobs = 1);
  /// The same, and labels are always read.
  static JumpMap with_labels(std::string_view text, int jobs = 1);

  bool empty() const { return sites_.empty(); }
  const std::vector<Site>& sites() const { return sites_; }
  /// Whether some jump names a label.
  bool names(std::uint64_t label) const {
    return !empty() && may_name(label) && std::binary_search(targets_.begin(), targets_.end(), label);
  }
  /// The labels that jumps name, ascending.
  const std::vector<std::uint64_t>& labels() const { return targets_; }
  /// The first jump on or below a line; the number of all jumps if there is none.
  std::size_t first_from(std::size_t line) const;
  /// The number of jumps on the lines above a place of the text from which the map was made.
  std::uint32_t count_above(std::size_t place) const;

  /// The registers that IFs compare.
  RegisterSet compared() const { return compared_; }
  bool compares_registers() const { return compared_ != 0; }
  /// The values that register 1 to 30 is compared with, ascending.
  const std::vector<double>& constants(int reg) const { return constants_[static_cast<std::size_t>(reg)]; }
  /// Registers whose value a later IF may compare, one bit each: after this jump (counted from the top) when it is not
  /// taken, and at its label when it is taken.
  RegisterSet read_after(std::uint32_t jump) const { return reads_[jump].after; }
  RegisterSet read_at_target(std::uint32_t jump) const { return reads_[jump].at_target; }
  /// Registers whose value this or a later IF may compare; none after the last jump.
  RegisterSet read_before(std::uint32_t jump) const { return jump < reads_.size() ? reads_[jump].before : 0; }

  /// Whether all labels that jumps name have been read, so that the target of each jump is known.
  bool knows_labels() const { return knows_labels_; }
  /// The target of a jump; Below while the labels are not known.
  Target target_of(std::uint32_t jump) const { return knows_labels_ ? targets_of_jumps_[jump] : Target::Below; }
  /// Whether a label is defined twice; true for all while the labels are not known.
  bool may_repeat(std::uint64_t label) const { return !knows_labels_ || repeated_.contains(label); }

  /// Whether a jump has the same effect as another one in another map, for every state.
  bool is_equivalent(std::uint32_t jump, const JumpMap& other, std::uint32_t other_jump) const;
  /// The map after an edit that leaves the jumps equivalent: replaces the sites from number `first` on by `sites`, and
  /// moves all later ones down by `lines` lines.
  JumpMap moved(std::size_t first, const std::vector<Site>& sites, std::int64_t lines) &&;

 private:
  friend class JumpCollector;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// A label or a jump, with the registers assigned to between it and the next one.
  struct ReducedEvent {
    FlowEvent::Kind kind = FlowEvent::Kind::Label;
    RegisterSet assigned = 0;
    std::uint64_t label = 0;     // The label defined, or jumped to.
    std::size_t target = kNone;  // Its index among those that jumps name. Set by follow().
  };
  static void add(std::vector<ReducedEvent>& events, const FlowEvent& event);
  /// A label, or a jump to it.
  static void add_place(std::vector<ReducedEvent>& events, FlowEvent::Kind kind, std::uint64_t label) {
    events.push_back({.kind = kind, .label = label});
  }
  static void add_assignments(std::vector<ReducedEvent>& events, RegisterSet registers) {
    if (!events.empty()) events.back().assigned |= registers;
  }
  struct Reads {
    RegisterSet after = 0;
    RegisterSet at_target = 0;
    RegisterSet before = 0;

    friend bool operator==(const Reads&, const Reads&) = default;
  };

  /// The map of the jumps alone, without labels. `before`: of the program before an edit; may be null.
  JumpMap(std::vector<Site> sites, const JumpMap* before);
  static JumpMap of_jumps_in(std::string_view text, int jobs);
  void find_constants(const JumpMap* before);
  void read_labels(std::string_view text);
  void follow(std::vector<ReducedEvent> events);
  void find_reads(const std::vector<ReducedEvent>& events);
  void find_targets(const std::vector<ReducedEvent>& events);

  // A filter of 2^20 bits: most line numbers are no targets, and the hash of the number rules most of them out.
  static std::size_t filter_bit(std::uint64_t label) { return (label * 0x9E3779B97F4A7C15ULL) >> 44; }
  bool may_name(std::uint64_t label) const {
    const std::size_t bit = filter_bit(label);
    return (filter_[bit / 64] >> (bit % 64) & 1) != 0;
  }

  std::vector<Site> sites_;
  std::vector<std::size_t> starts_;     // Where their lines start in the text; empty if not made from one.
  std::vector<std::uint64_t> targets_;  // Ascending.
  std::vector<std::uint64_t> filter_;   // 1,048,576 bits; empty without jumps.
  std::array<std::vector<double>, dialect::kRegisterCount + 1> constants_;
  RegisterSet compared_ = 0;
  std::vector<Reads> reads_;  // One per jump.
  bool knows_labels_ = true;
  std::vector<Target> targets_of_jumps_;
  std::unordered_set<std::uint64_t> repeated_;  // Labels defined twice.
};

/// Collects the jumps, labels and assignments of a program as its lines are read, and makes a JumpMap of them.
class JumpCollector {
 public:
  JumpCollector() = default;
  /// `before`: the jumps before an edit, of which much stays as it was; must outlive the collector.
  explicit JumpCollector(const JumpMap& before);

  /// Adds the next event; `line` counts from the start of the program. Labels that no jump names may be left out.
  void add(std::size_t line, const FlowEvent& event);
  /// The same for each kind of event.
  void add_assignments(RegisterSet registers) { JumpMap::add_assignments(events_, registers); }
  void add_label(std::uint64_t label) { JumpMap::add_place(events_, FlowEvent::Kind::Label, label); }
  void add_jump(std::size_t line, const syntax::Jump& jump);

  /// The map of all events added. It knows the labels.
  JumpMap finish() &&;

 private:
  const JumpMap* before_ = nullptr;
  std::vector<JumpMap::Site> sites_;
  std::vector<JumpMap::ReducedEvent> events_;
};

}  // namespace isocnc::check
