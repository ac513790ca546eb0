#include <algorithm>
#include <optional>

#include "analyzer/fixes/line_edits.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::fixes {

using execution::State;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineTree;
using syntax::Word;

/// The maximum number of lines searched for the block above or below.
static constexpr std::size_t kReach = 20;

/// A jump to the line would skip a line inserted above it.
static bool is_jumped_to(const LineTree& line, FixProgram& program) {
  return line.has_label() && program.is_jumped_to(line.label);
}

static Draft line_above(const FixRequest& request, std::string_view block) {
  if (!request.on_every_path || is_jumped_to(request.line, request.program)) return {};
  std::string text(indentation(request.line.text));
  text += block;
  return {{inserted(request, 0, text + "\n")}, std::string(block)};
}

Draft g27_above(const FixRequest& request) { return line_above(request, "G27"); }
Draft g40_above(const FixRequest& request) { return line_above(request, "G40"); }
Draft g49_above(const FixRequest& request) { return line_above(request, "G49"); }
/// Not where a motion stands on the line: the spindle would stop before it.
Draft m05_above(const FixRequest& request) { return request.line.motion() ? Draft{} : line_above(request, "M05"); }
Draft g90_above(const FixRequest& request) { return line_above(request, "G90"); }
Draft g71_above(const FixRequest& request) { return line_above(request, "G71"); }

/// The maximum number of lines searched for the late G27.
static constexpr std::size_t kFarthestDismount = 5'000;

/// G92 under a face frame with its G27 further down: moves the G27 up.
Draft later_g27_above(const FixRequest& request) {
  Draft draft = g27_above(request);
  if (draft.edits.empty()) return {};
  const std::size_t end = std::min(request.program.line_count(), request.number + 1 + kFarthestDismount);
  for (std::size_t number = request.number + 1; number < end; ++number) {
    const syntax::ParsedLine parsed(request.program.text(number));
    const LineTree line = parsed.tree();
    if (is_jumped_to(line, request.program)) return {};
    for (const Instruction& each : line.instructions) {
      if (each.kind == InstructionKind::Jump || line.ends_program(each)) return {};
      const dialect::GCode* const code = each.kind == InstructionKind::G ? each.g() : nullptr;
      if (!code || !code->is_frame()) continue;
      if (code->role != dialect::GRole::DismountFace || line.instructions.size() > 1) return {};
      const syntax::Finding at_g27{.span = line.command(each).span()};
      draft.edits.push_back(removed_with_line({number, at_g27, true, line, request.program}, at_g27.span));
      return draft;
    }
  }
  return {};
}

/// The blocks that must precede the end of the program: compensation off, face frame dismounted, spindle stopped.
static std::string blocks_before_end(const State& state, const std::string& line_start) {
  std::string blocks;
  if (state.is_compensated()) blocks += line_start + "G40";
  if (state.face_mounted) blocks += line_start + "G27";
  if (state.spindle_turns()) blocks += line_start + "M05";
  return blocks;
}

Draft end_of_program(const FixRequest& request) {
  const std::string_view line = request.line.text;
  if (is_blank(line)) return {};
  const std::string line_start = "\n" + std::string(indentation(line));
  const std::optional<State> state = request.program.state_before(request.program.line_count());
  std::string text = state ? blocks_before_end(*state, line_start) : "";
  text += line_start + "M02";
  return {{inserted(request, static_cast<std::uint32_t>(line.size()), std::move(text))}};
}

/// M30, which ends the program on other controls. Beside an F or S, which helps() would find (ISO043), it stays.
Draft m02_for_m30(const FixRequest& request) {
  const LineTree& line = request.line;
  const bool is_alone = line.instructions.size() == 1 && line.findings.empty();
  if (!is_alone || line.instructions.front().kind != InstructionKind::Function) return {};
  const Word& m30 = line.command(line.instructions.front());
  if (m30.value != 30 || line.instructions.front().end != line.instructions.front().command + 1) return {};
  const std::string line_start = "\n" + std::string(indentation(line.text));
  const std::optional<State> state = request.program.state_before(request.program.line_count());
  std::string blocks = state ? blocks_before_end(*state, line_start) : "";
  Draft draft{{replaced(request, m30.span(), "M02")}, "M02"};
  if (!blocks.empty()) draft.edits.insert(draft.edits.begin(), inserted(request, 0, blocks.substr(1) + "\n"));
  return draft;
}

/// The nearest line above (step -1) or below (1) that holds a block.
static std::optional<std::size_t> block_beside(const FixRequest& request, int step) {
  std::size_t number = request.number;
  for (std::size_t i = 0; i < kReach; ++i) {
    if (step < 0 ? number == 0 : number + 1 >= request.program.line_count()) return std::nullopt;
    number += static_cast<std::size_t>(step);
    const syntax::ParsedLine parsed(request.program.text(number));
    if (!parsed.tree().is_empty()) return number;
  }
  return std::nullopt;
}

static bool waits_for_tool(const LineTree& line) {
  return std::any_of(line.instructions.begin(), line.instructions.end(), [](const Instruction& each) {
    return each.kind == InstructionKind::ToolChange && each.end == each.command + 1;
  });
}

/// Adds M06 before a T, unless an M06 without a T is on the line, above it or below it.
Draft m06_before_tool(const FixRequest& request) {
  if (waits_for_tool(request.line)) return {};
  for (const int step : {-1, 1}) {
    const std::optional<std::size_t> beside = block_beside(request, step);
    if (beside && waits_for_tool(syntax::ParsedLine(request.program.text(*beside)).tree())) return {};
  }
  return {{inserted(request, request.finding.span.begin, "M06 ")}};
}

/// Whether a line continues a motion of an earlier line, without a word that gives a circle.
static bool continues_without_circle(const LineTree& line) {
  const Instruction* const motion = line.motion();
  const auto gives_circle = [](const Word& word) { return dialect::contains(dialect::kCircleLetters, word.letter); };
  return motion && motion->kind == InstructionKind::Continuation &&
         std::none_of(line.words.begin(), line.words.end(), gives_circle);
}

/// X20 Y10 after an arc: the straight line lacks its G01. Of several such lines only the first needs it.
Draft g01_before_coordinates(const FixRequest& request) {
  using namespace dialect::literals;
  if (!request.finding.has("circle-not-given/continuation"_cause)) return {};
  const std::optional<std::size_t> above = block_beside(request, -1);
  if (above && continues_without_circle(syntax::ParsedLine(request.program.text(*above)).tree())) return {};
  return {{inserted(request, request.finding.span.begin, "G01 ")}};
}

/// Whether a line has a T without its M06, and otherwise a speed or feed at most.
static bool has_tool_alone(const LineTree& line) {
  return line.instructions.size() == 1 && line.instructions.front().kind == InstructionKind::StrayTool &&
         line.findings.empty();
}

/// M06 on one line, T101001 alone on the next: joins them.
Draft tool_of_other_line(const FixRequest& request) {
  const std::optional<std::size_t> number = block_beside(request, 1);
  if (!number) return {};
  const syntax::ParsedLine parsed(request.program.text(*number));
  const LineTree below = parsed.tree();
  if (!has_tool_alone(below) || is_jumped_to(below, request.program)) return {};
  const syntax::Finding at_tool{.span = below.command(below.instructions.front()).span()};
  const FixRequest there{*number, at_tool, true, below, request.program};
  const std::string tool(there.marked());
  return {{inserted(request, request.finding.span.end, " " + tool), removed_with_line(there, at_tool.span)}, tool};
}

/// Whether a T may be moved past the line: it holds no motion, tool change, T, jump or end of the program.
static bool lets_tool_pass(const LineTree& line, FixProgram& program) {
  const auto is_blocking = [&](const Instruction& each) {
    return each.is_motion() || each.kind == InstructionKind::ToolChange || each.kind == InstructionKind::StrayTool ||
           each.kind == InstructionKind::Jump || line.ends_program(each);
  };
  return !is_jumped_to(line, program) && std::none_of(line.instructions.begin(), line.instructions.end(), is_blocking);
}

/// T101001 alone, as other controls prepare a tool, with its M06 below: moves the T there.
Draft tool_to_later_change(const FixRequest& request) {
  if (!has_tool_alone(request.line)) return {};
  for (std::size_t number = request.number + 1;
       number < request.program.line_count() && number <= request.number + kReach; ++number) {
    const syntax::ParsedLine parsed(request.program.text(number));
    const LineTree below = parsed.tree();
    if (waits_for_tool(below) && !is_jumped_to(below, request.program)) {
      const auto is_change = [](const Instruction& each) { return each.kind == InstructionKind::ToolChange; };
      const Instruction& change = *std::find_if(below.instructions.begin(), below.instructions.end(), is_change);
      const syntax::Position after{number, below.command(change).end};
      return {
          {removed_with_line(request, request.finding.span), Edit{after, after, " " + std::string(request.marked())}}};
    }
    if (!lets_tool_pass(below, request.program)) return {};
  }
  return {};
}

/// G01 alone, with its coordinates on the next line: moves the G there.
Draft command_to_next_line(const FixRequest& request) {
  const std::string command(request.marked());
  const std::optional<std::size_t> number = block_beside(request, 1);
  if (!number || command.find('(') != std::string::npos) return {};
  const syntax::ParsedLine parsed(request.program.text(*number));
  const LineTree next = parsed.tree();
  const Word* const first = first_word(next);
  const Word* const own = word_at(request.line, request.finding.span);
  const bool continues = first != nullptr && !next.instructions.empty() &&
                         next.instructions.front().kind == InstructionKind::Continuation &&
                         dialect::contains(dialect::kCoordinateLetters, first->letter);
  if (!continues || own == nullptr || own->letter != 'G' || is_jumped_to(next, request.program)) return {};
  const Edit there{{*number, first->begin}, {*number, first->begin}, command + " "};
  return {{removed_with_line(request, request.finding.span), there}};
}

}  // namespace isocnc::fixes
