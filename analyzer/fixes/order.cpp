#include <algorithm>
#include <optional>

#include "analyzer/fixes/line_edits.h"
#include "interpreter/text/characters.h"

namespace isocnc::fixes {

using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineTree;
using syntax::Span;
using syntax::Word;

/// The instruction whose command is marked, or null.
static const Instruction* marked_instruction(const FixRequest& request) {
  const Word* const command = word_at(request.line, request.finding.span);
  return command ? owner_of(request.line, *command) : nullptr;
}

/// Moves the text of a span to another column.
static Draft moved(const FixRequest& request, Span span, std::uint32_t column, bool before) {
  const std::string text(request.line.text_of(span));
  return {{removed(request, span), inserted(request, column, before ? text + " " : " " + text)}, text};
}

/// Replaces the blanks before the word at `column` by a line end.
static Edit line_end_before(const FixRequest& request, std::uint32_t column) {
  const std::string_view line = request.line.text;
  std::uint32_t begin = column;
  while (begin > 0 && text::is_blank(line[begin - 1])) --begin;
  return replaced(request, {begin, column}, "\n" + std::string(indentation(line)));
}

/// The words of an instruction on its line: [first, last], without words of others between them.
struct Extent {
  std::size_t first = 0;
  std::size_t last = 0;
};

static std::optional<Extent> extent_of(const LineTree& line, const Instruction& instruction) {
  for (std::size_t i = instruction.begin; i < instruction.end; ++i)
    if (line.words[i].owner != instruction.number) return std::nullopt;
  return Extent{instruction.begin, instruction.end - 1u};
}

/// Whether the instruction takes all its words; if not, something else was meant.
static bool takes_all_its_words(const LineTree& line, const Instruction& instruction) {
  if (instruction.kind != InstructionKind::G) return true;
  for (std::size_t i = instruction.begin; i < instruction.end; ++i)
    if (i != instruction.command && !dialect::contains(instruction.g()->arguments, line.words[i].letter)) return false;
  return true;
}

/// F and S apply to the motion of their line, wherever they are on it: they must stay with it.
static bool speeds_stay_with_motions(const LineTree& line, Extent alone) {
  const auto part_of = [&](std::size_t word) { return word < alone.first ? 0 : 1; };
  for (const Instruction& instruction : line.instructions) {
    if (!instruction.is_motion()) continue;
    for (const std::int32_t speed : {line.feed, line.spindle})
      if (speed >= 0 && part_of(static_cast<std::size_t>(speed)) != part_of(instruction.command)) return false;
  }
  return true;
}

/// G91 G28 Z0: an instruction that also lacks arguments may belong to another control.
static bool has_another_finding(const FixRequest& request) {
  const auto is_another = [&](const syntax::Finding& finding) {
    return finding.span == request.finding.span && finding.id != request.finding.id;
  };
  return std::any_of(request.line.findings.begin(), request.line.findings.end(), is_another);
}

/// Whether a word has a finding: its intended form, and so the words that belong together, are unknown.
static bool is_ambiguous(const LineTree& line, const Word& word) {
  const auto marks_it = [&](const syntax::Finding& finding) {
    return finding.span.begin < word.end && word.begin < finding.span.end;
  };
  return std::any_of(line.findings.begin(), line.findings.end(), marks_it);
}

/// Splits G00 Z50 M02 into two lines, S5000 M03 G04 P2 G01 X5 into three; effects and their order stay the same.
Draft on_its_own_line(const FixRequest& request) {
  const LineTree& line = request.line;
  const Instruction* const alone = marked_instruction(request);
  if (!alone || (alone->kind == InstructionKind::G && !alone->g()) || !takes_all_its_words(line, *alone)) return {};
  if (has_another_finding(request) || lacks_frame_arguments(line, line.command(*alone))) return {};
  const std::optional<Extent> extent = extent_of(line, *alone);
  if (!extent || !speeds_stay_with_motions(line, *extent)) return {};
  const bool may_be_followed =
      alone->kind != InstructionKind::Jump && line.command(*alone).value != dialect::kProgramEnd;
  const auto is_label = [](const Word& word) { return word.letter == 'N'; };
  const auto after = line.words.subspan(extent->last + 1);
  if (std::any_of(after.begin(), after.end(), is_label)) return {};
  if (!after.empty() && alone->kind == InstructionKind::Function && !may_be_followed) return {};
  if (!after.empty() && alone->kind == InstructionKind::Jump) return {};
  const auto before = line.words.first(extent->first);
  // In G92 X10 Y20=-Z146 the Z belongs to the G92.
  if ((!after.empty() && is_ambiguous(line, after.front())) || (!before.empty() && is_ambiguous(line, before.back())))
    return {};
  Draft draft;
  if (!std::all_of(before.begin(), before.end(), is_label))
    draft.edits.push_back(line_end_before(request, line.words[extent->first].begin));
  if (!after.empty()) draft.edits.push_back(line_end_before(request, after.front().begin));
  return draft;
}

/// G00 X2 Y3 G70: moves the G70 to the start. The finding says that other words are before it.
Draft mode_first(const FixRequest& request) {
  return moved(request, request.finding.span, first_word(request.line)->begin, true);
}

/// G1 X1 S500 Z5: moves the Z next to the X. S and N may be anywhere, so that alone they are no reason to move words.
Draft arguments_together(const FixRequest& request) {
  const LineTree& line = request.line;
  const Instruction* const motion = marked_instruction(request);
  if (!motion || !motion->is_motion()) return {};
  Draft draft;
  std::size_t last = motion->kind == InstructionKind::G ? motion->command : motion->begin;
  std::string strays;
  for (std::size_t i = motion->begin; i < motion->end; ++i) {
    const Word& word = line.words[i];
    if (word.owner == motion->number && i != motion->command && word.has(Word::kBreak)) {
      strays += ' ';
      strays += line.text_of(word.span());
      draft.edits.push_back(removed(request, word.span()));
    } else if (word.owner == motion->number) {
      last = i;
    } else if (word.letter != 'S' && word.letter != 'N' && word.letter != 'F') {
      return {};
    }
  }
  if (draft.edits.empty()) return {};
  draft.what = text::trimmed(strays);
  draft.edits.insert(draft.edits.begin(), inserted(request, line.words[last].end, strays));
  return draft;
}

/// X10 G1: moves the G1 before the X10.
Draft command_first(const FixRequest& request) {
  using namespace dialect::literals;
  if (!request.finding.has("stray-argument/before-its-g"_cause)) return {};
  return moved(request, request.finding.related, request.finding.span.begin, true);
}

/// The first word of the line's first motion, or null.
static const Word* motion_start(const LineTree& line) {
  const Instruction* const motion = line.motion();
  if (motion == nullptr) return nullptr;
  return &line.words[motion->kind == InstructionKind::G ? motion->command : motion->begin];
}

/// G01 X10 G41: moves the G41 before the motion.
Draft compensation_before_motion(const FixRequest& request) {
  const Word* const motion = motion_start(request.line);
  if (!motion || motion->begin > request.finding.span.begin) return {};
  return moved(request, request.finding.span, motion->begin, true);
}

/// The line's last motion, or null.
static const Instruction* last_motion(const LineTree& line) {
  const Instruction* last = nullptr;
  for (const Instruction& each : line.instructions)
    if (each.is_motion()) last = &each;
  return last;
}

/// G40 G01 Y20: moves the G40 after the last coordinate.
Draft move_after_motion(const FixRequest& request) {
  const Instruction* const motion = last_motion(request.line);
  const auto begins_compensation = [](const Instruction& it) {
    return it.is(dialect::GRole::CompensationLeft) || it.is(dialect::GRole::CompensationRight);
  };
  const auto& all = request.line.instructions;
  // G40 G41 G01 X10: behind the motion the G40 would end what the G41 begins.
  if (!motion || std::any_of(all.begin(), all.end(), begins_compensation)) return {};
  return moved(request, request.finding.span, request.line.words[motion->end - 1u].end, false);
}

/// G09 G01 X10: moves the G09 after a feed motion; a rapid stops at its end anyway.
Draft move_after_feed_motion(const FixRequest& request) {
  const Instruction* const motion = last_motion(request.line);
  return motion && !motion->is(dialect::GRole::Rapid) ? move_after_motion(request) : Draft{};
}

/// T101001 M06: moves the M06 before the T.
Draft change_before_tool(const FixRequest& request) {
  const LineTree& line = request.line;
  for (const Instruction& change : line.instructions) {
    const Word& command = line.command(change);
    if (change.kind != InstructionKind::ToolChange || command.begin < request.finding.span.begin) continue;
    return moved(request, command.span(), request.finding.span.begin, true);
  }
  return {};
}

/// M06 S5000 T101001: moves the T next to the M06.
Draft move_tool_after_change(const FixRequest& request) {
  const LineTree& line = request.line;
  const Instruction* const change = marked_instruction(request);
  if (!change) return {};
  for (const Word& word : line.words)
    if (word.letter == 'T' && word.owner == change->number)
      return moved(request, word.span(), request.finding.span.end, false);
  return {};
}

/// G00 X10 G01 Z-3 F1000: splits the line between the motions.
Draft motions_on_two_lines(const FixRequest& request) {
  const LineTree& line = request.line;
  const Instruction* const second = marked_instruction(request);
  const Word* const first_command = word_at(line, request.finding.related);
  const Instruction* const first = first_command ? owner_of(line, *first_command) : nullptr;
  if (!first || !second || first->end == first->command + 1 || second->end == second->command + 1) return {};
  if (first->end > second->command) return {};
  return {{line_end_before(request, request.finding.span.begin)}};
}

/// N10 G00 X5 N20 G01 X9: breaks the line where its second block starts (D68).
Draft line_break_between_blocks(const FixRequest& request) {
  if (!request.line.has(LineTree::kTwoBlocks)) return {};
  return {{line_end_before(request, request.finding.span.begin)}};
}

}  // namespace isocnc::fixes
