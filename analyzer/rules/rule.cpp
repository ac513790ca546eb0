#include "analyzer/rules/rule.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>

namespace isocnc::rules {

#define ISOCNC_RULE(name) extern const Rule name;
#include <rules.inc>
#undef ISOCNC_RULE

static const Rule* const kRules[] = {
#define ISOCNC_RULE(name) &(name),
#include <rules.inc>
#undef ISOCNC_RULE
};

const MemoryTable kMemoryTable{kRules};

/// A set of rules, one bit each.
using RuleSet = std::uint64_t;
static_assert(std::size(kRules) <= 64);

/// The rules to run on a line, by the parts that it has.
static const std::array<RuleSet, kAllParts + 1> kConcerned = [] {
  std::array<RuleSet, kAllParts + 1> concerned{};
  for (unsigned parts = 0; parts <= kAllParts; ++parts)
    for (std::size_t i = 0; i < std::size(kRules); ++i)
      if ((kRules[i]->concerns & parts) != 0) concerned[parts] |= RuleSet{1} << i;
  return concerned;
}();

/// Looks through a line once, for all rules. Returns its parts that rules can register for, and collects its codes.
static unsigned survey(const syntax::LineTree& line, Codes& codes) {
  codes = {.roles = 0, .functions = 0};
  unsigned parts = (line.spindle >= 0 ? kSpindle : 0) | (line.feed >= 0 ? kFeed : 0);
  for (const syntax::Instruction& instruction : line.instructions) {
    switch (instruction.kind) {
      case syntax::InstructionKind::Continuation:
        parts |= kMotion;
        break;
      case syntax::InstructionKind::G:
        parts |= instruction.is_motion() ? kMotion : kModal;
        if (const dialect::GCode* const code = instruction.g()) codes.add(code->role);
        break;
      case syntax::InstructionKind::Function:
        parts |= kFunction;
        codes.add_m(line.command(instruction));
        break;
      case syntax::InstructionKind::ToolChange:
        parts |= kToolChange;
        codes.add_m(line.command(instruction));
        break;
      default:
        break;
    }
  }
  return parts;
}

void run_rules(ExecutedBlock block, const Memory& memory, execution::Sink& sink) {
  for (RuleSet rest = kConcerned[survey(block.line, block.codes)]; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(rest));
    block.remembered = memory.of_rule(i);
    kRules[i]->check(block, sink);
  }
}

bool checks_moves(const CheckSetup& setup) {
  if (setup.house_rules && setup.house_rules->needs_each_motion()) return true;
  return setup.every_motion || setup.machine.clearance || setup.machine.limits != execution::Limits{};
}

void run_move_rules(const ExecutedBlock& block, const execution::ProgrammedMove& move, execution::Sink& sink) {
  if ((block.before.unknown | block.after.unknown) != 0 || !block.after.is_frame_known()) return;
  for (const Rule* const rule : kRules)
    if (rule->check_move) rule->check_move(block, move, sink);
}

void judge_arc(const execution::CenteredArc& arc, const geometry::CenterReadings& readings, bool suspects_centers,
               const execution::Setup& setup, execution::Sink& sink) {
  const geometry::Circle& circle = arc.circle;
  if (suspects_centers && !arc.incremental && readings.is_legal_in_both_readings(setup.arc_tolerance)) {
    sink.report({.id = "center-legal-both-ways"_diag,
                 .span = arc.centers(),
                 .values = {readings.radius, readings.other_radius}});
  } else if (std::abs(circle.found - circle.wanted) > setup.arc_tolerance / 2) {
    sink.report({.id = "arc-barely-fits"_diag, .span = arc.centers(), .values = {circle.found, circle.wanted}});
  }
}

static const syntax::Instruction* motion_instruction(const syntax::LineTree& line) {
  const syntax::Instruction* found = nullptr;
  for (const syntax::Instruction& instruction : line.instructions) {
    if (!instruction.is_motion()) continue;
    if (instruction.kind == syntax::InstructionKind::G) return &instruction;
    found = &instruction;
  }
  return found;
}

const dialect::GCode* ExecutedBlock::motion() const {
  const syntax::Instruction* const motion = motion_instruction(line);
  if (!motion) return nullptr;
  return motion->kind == syntax::InstructionKind::G ? motion->g() : before.motion();
}

bool ExecutedBlock::has_feed_move() const {
  const dialect::GCode* const code = motion();
  return code && code->is_feed_move();
}

const syntax::Word& ExecutedBlock::motion_word() const { return line.command(*motion_instruction(line)); }

const syntax::Word* ExecutedBlock::argument(char letter) const {
  const syntax::Instruction& motion = *motion_instruction(line);
  for (std::size_t i = motion.begin; i < motion.end; ++i)
    if (line.words[i].owner == motion.number && line.words[i].letter == letter) return &line.words[i];
  return nullptr;
}

int ExecutedBlock::spindle_function_before(const syntax::Word& word) const {
  int last = 0;
  for (const syntax::Instruction& instruction : line.instructions) {
    const syntax::Word& command = line.command(instruction);
    if (instruction.kind != syntax::InstructionKind::Function || command.begin >= word.begin) continue;
    for (const int m : {3, 4, 5})
      if (command.value == m) last = m;
  }
  return last;
}

bool ExecutedBlock::has_user_function() const {
  return std::any_of(line.instructions.begin(), line.instructions.end(), [&](const syntax::Instruction& instruction) {
    const std::optional<int> number = line.command(instruction).whole();
    return instruction.kind == syntax::InstructionKind::Function && number && dialect::is_user_function(*number);
  });
}

const syntax::Word* ExecutedBlock::find_g(dialect::GRole role) const {
  for (const syntax::Instruction& instruction : line.instructions)
    if (instruction.is(role)) return &line.command(instruction);
  return nullptr;
}

const syntax::Word* ExecutedBlock::find_m(int number) const {
  for (const syntax::Instruction& instruction : line.instructions) {
    const bool is_m = instruction.kind == syntax::InstructionKind::Function ||
                      instruction.kind == syntax::InstructionKind::ToolChange;
    if (is_m && line.command(instruction).value == number) return &line.command(instruction);
  }
  return nullptr;
}

}  // namespace isocnc::rules
