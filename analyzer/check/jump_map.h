#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "interpreter/execution/execute.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::check {

/// A set of registers, one bit each.
using RegisterSet = std::uint32_t;
constexpr RegisterSet register_bit(int reg) { return RegisterSet{1} << reg; }

/// What on a line concerns jumps: an IF with its label, an assignment to a register, or a label.
struct JumpEvent {
  enum class Kind : std::uint8_t { Assignment, Jump, Label };

  Kind kind = Kind::Jump;
  std::uint8_t reg = 0;     ///< Assigned.
  std::uint32_t line = 0;   ///< Of its chunk, where there is one.
  double value = 0;         ///< Assigned.
  std::uint64_t label = 0;  ///< Defined.
  syntax::Jump jump;

  /// Whether two events mean the same, wherever they stand.
  bool means_the_same(const JumpEvent& other) const;
};

/// Whether a text may hold assignments or jumps. False only where it holds none.
bool may_hold_jumps(std::string_view text);

/// Calls `take` with the events of a line in the order in which they count: label, assignments, jump.
template <class Take>
void each_event(const syntax::LineTree& line, Take take) {
  if (line.has_label()) take(JumpEvent{.kind = JumpEvent::Kind::Label, .label = line.label});
  for (const syntax::Instruction& instruction : line.instructions) {
    if (instruction.kind != syntax::InstructionKind::Assignment) continue;
    if (const auto assigned = execution::assigned_by(instruction, line))
      take(JumpEvent{.kind = JumpEvent::Kind::Assignment,
                     .reg = static_cast<std::uint8_t>(assigned->reg),
                     .value = assigned->value});
  }
  if (line.jump && line.jump->has_target) take(JumpEvent{.kind = JumpEvent::Kind::Jump, .jump = *line.jump});
}

/// The same of a text, line by line, without parsing the lines that hold none; JumpEvent::line counts from its start.
void each_event_in(std::string_view text, const std::function<void(const JumpEvent&)>& take);

/// What of a program's jumps must be known before its first line is checked: where the IFs stand, which labels they
/// name, and what they compare registers with. Jumps go forward only (I.5), so this and one pass over the lines
/// suffice.
class JumpMap {
 public:
  struct Site {
    std::uint64_t line = 0;
    syntax::Jump jump;
  };

  JumpMap() = default;
  /// Finds the jumps of a text without parsing the lines that hold none.
  explicit JumpMap(std::string_view text);

  /// Adds the jump of the next line that has one with a label.
  void add(std::uint64_t line, const syntax::Jump& jump);
  /// Whether an IF compares a register: then every line must be noted, in order, for what complete() works out.
  bool compares_registers() const { return compared_ != 0; }
  /// The registers that they compare.
  RegisterSet compared() const { return compared_; }
  /// Notes the next event.
  void note_registers(JumpEvent::Kind kind, std::uint8_t reg, std::uint64_t label);
  /// To be called when all have been added.
  void complete();

  bool empty() const { return sites_.empty(); }
  const std::vector<Site>& sites() const { return sites_; }
  bool names(std::uint64_t label) const { return may_name(label) && targets_.contains(label); }
  /// The values that register 1 to 30 is compared with, ascending.
  const std::vector<double>& constants(int reg) const { return constants_[static_cast<std::size_t>(reg)]; }
  /// Registers whose value some IF may still see, one bit each: where this jump (counted from the top) is not taken,
  /// and where it is.
  RegisterSet read_behind(std::uint32_t jump) const { return reads_[jump].behind; }
  RegisterSet read_at_target(std::uint32_t jump) const { return reads_[jump].at_target; }
  /// The same before it; none behind the last jump.
  RegisterSet read_before(std::uint32_t jump) const { return jump < reads_.size() ? reads_[jump].before : 0; }

  /// Notes a definition of a label that is named, line by line.
  void note_label(std::uint64_t label, std::uint64_t line);
  /// Marks the jumps that have no label below them, once all definitions have been noted.
  void resolve();
  /// The same from the program's text.
  void resolve(std::string_view text);
  bool is_resolved() const { return resolved_; }
  /// Whether a label may be defined twice: once the jumps are resolved, whether it is.
  bool may_repeat(std::uint64_t label) const { return !resolved_ || repeated_.contains(label); }
  enum class Target : std::uint8_t { Below, NotFound, Above };
  Target target_of(std::uint32_t jump) const { return resolved_ ? targets_of_jumps_[jump] : Target::Below; }
  /// The first jump on a line or below it; the number of all where there is none.
  std::size_t first_from(std::uint64_t line) const;
  /// Jumps that mean the same stand elsewhere, or are written otherwise: from this one on those given, and all behind
  /// them are that many lines further down.
  void move(std::size_t first, const std::vector<Site>& sites, std::int64_t lines);
  /// The labels that are named here, and not in the other.
  std::vector<std::uint64_t> named_beyond(const JumpMap& other) const;
  /// Whether the jump of this number does the same in both to every state that comes to it.
  bool does_the_same(std::uint32_t jump, const JumpMap& other) const;

 private:
  // Most line numbers are no targets; one bit by a hash of the number tells most of them apart.
  void note_all_registers(std::string_view text);
  static std::size_t filter_bit(std::uint64_t label) { return (label * 0x9E3779B97F4A7C15ULL) >> 44; }
  bool may_name(std::uint64_t label) const {
    const std::size_t bit = filter_bit(label);
    return !filter_.empty() && (filter_[bit / 64] >> (bit % 64) & 1) != 0;
  }

  std::vector<Site> sites_;
  std::unordered_set<std::uint64_t> targets_;
  std::vector<std::uint64_t> filter_;  // 1,048,576 bits, once there is a jump.
  std::array<std::vector<double>, dialect::kRegisterCount + 1> constants_;
  RegisterSet compared_ = 0;  // Registers that an IF compares.
  struct Event {
    JumpEvent::Kind kind;
    std::uint8_t reg;     // Assigned.
    std::uint64_t label;  // Defined.
  };
  std::vector<Event> events_;  // In the order of the program.
  struct Reads {
    RegisterSet behind = 0;
    RegisterSet at_target = 0;
    RegisterSet before = 0;

    friend bool operator==(const Reads&, const Reads&) = default;
  };
  std::vector<Reads> reads_;                                     // By jump.
  std::unordered_map<std::uint64_t, std::uint64_t> last_lines_;  // Of labels, until they are resolved.
  std::vector<Target> targets_of_jumps_;
  bool resolved_ = false;
  std::unordered_set<std::uint64_t> repeated_;
};

}  // namespace isocnc::check
