#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "analyzer/fixes/line_edits.h"
#include "interpreter/dialect/format.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::fixes {

using execution::State;
using syntax::LineTree;
using syntax::Word;

namespace {

/// The maximum number of lines below the cycle that repeat it, and of lines above that say how far it retracts.
constexpr std::size_t kCycleReach = 1'000;

/// A drilling cycle of other controls, G81 X10 Y10 Z-5 R2 F100, as text of the program.
struct DrillingCycle {
  std::string depth;    ///< Z-5
  std::string height;   ///< Z2: the R, above which the tool moves in rapid.
  std::string retract;  ///< Where the tool goes after each hole: `height`, or the Z before the cycle.
  std::string feed;     ///< F100, or empty.
};

/// Whether the line has only words with these letters, each with a number, and no comment.
bool has_only(const LineTree& line, std::string_view letters) {
  return line.comments.empty() && std::all_of(line.words.begin(), line.words.end(), [&](const Word& word) {
           return letters.find(word.letter) != std::string_view::npos && word.known();
         });
}

const Word* word_of(const LineTree& line, char letter) {
  const auto found =
      std::find_if(line.words.begin(), line.words.end(), [&](const Word& word) { return word.letter == letter; });
  return found == line.words.end() ? nullptr : &*found;
}

/// Whether the last G98 or G99, on this line or above, is a G99: the tool then retracts to the R only.
bool retracts_to_height(const FixRequest& request) {
  const std::size_t end = request.number - std::min(request.number, kCycleReach);
  for (std::size_t number = request.number + 1; number-- > end;) {
    const syntax::ParsedLine parsed(request.program.text(number));
    const LineTree line = parsed.tree();
    const auto is_return = [](const Word& word) { return is_g(word, 98) || is_g(word, 99); };
    const auto found = std::find_if(line.words.rbegin(), line.words.rend(), is_return);
    if (found != line.words.rend()) return found->value == 99;
  }
  return false;
}

std::optional<DrillingCycle> cycle_of(const FixRequest& request, const State& before) {
  const LineTree& line = request.line;
  const Word* const depth = word_of(line, 'Z');
  const Word* const height = word_of(line, 'R');
  const Word* const feed = word_of(line, 'F');
  const auto is_other_g = [](const Word& word) {
    return word.letter == 'G' && !is_g(word, 81) && !is_g(word, 98) && !is_g(word, 99);
  };
  if (!has_only(line, "NGXYZRF") || std::any_of(line.words.begin(), line.words.end(), is_other_g)) return std::nullopt;
  if (!depth || !height || !(depth->value < height->value)) return std::nullopt;
  const auto z = execution::axis_bit(execution::Axis::Z);
  const bool to_height = retracts_to_height(request);
  const double start = before.position.tip[2] / before.mm_per_unit();
  if (!to_height && ((before.unknown & z) != 0 || start < height->value)) return std::nullopt;
  DrillingCycle cycle{.depth = std::string(line.text_of(depth->span())),
                      .height = "Z" + std::string(text::trimmed(line.text_of(height->span()).substr(1)))};
  cycle.retract = to_height ? cycle.height : "Z" + dialect::written_number(start, 4);
  if (feed) cycle.feed = " " + std::string(line.text_of(feed->span()));
  return cycle;
}

/// The moves of one hole, in place of its line.
Edit hole(const DrillingCycle& cycle, std::size_t number, const LineTree& line, bool is_first) {
  std::string label;
  std::string place;
  for (const Word& word : line.words) {
    if (word.letter == 'N') label = std::string(line.text_of(word.span())) + " ";
    if (word.letter == 'X' || word.letter == 'Y') place += " " + std::string(line.text_of(word.span()));
  }
  const std::string indent(indentation(line.text));
  std::vector<std::string> moves;
  if (!place.empty()) moves.push_back("G00" + place);
  if (is_first || cycle.retract != cycle.height) moves.push_back("G00 " + cycle.height);
  moves.push_back("G01 " + cycle.depth + (is_first ? cycle.feed : ""));
  moves.push_back("G00 " + cycle.retract);
  std::string text = indent + label;
  for (const std::string& move : moves) text += (&move == moves.data() ? "" : "\n" + indent) + move;
  return {{number, 0}, {number, line.text.size()}, text};
}

bool drills_along_z(const State& state) {
  return !state.incremental() && !state.is_compensated() && !state.inverse_time() &&
         state.mode(dialect::ModalGroup::Plane) == 17;
}

/// Whether a line ends the cycle: G80, a motion G or the end of the program.
bool ends_cycle(const LineTree& line) {
  const auto is_end = [](const Word& word) {
    return is_g(word, 80) || (word.letter == 'G' && word.is_plain_integer() && dialect::is_motion_number(word.value));
  };
  return std::any_of(line.words.begin(), line.words.end(), is_end) ||
         std::any_of(line.instructions.begin(), line.instructions.end(),
                     [&](const syntax::Instruction& each) { return line.ends_program(each); });
}

/// Whether a line has only functions and a spindle speed, between two holes: M08.
bool has_only_functions(const LineTree& line) {
  const auto changes_tool = [](const syntax::Instruction& each) {
    return each.kind == syntax::InstructionKind::ToolChange;
  };
  return has_only(line, "NMS") && std::none_of(line.instructions.begin(), line.instructions.end(), changes_tool);
}

}  // namespace

/// G81 and the coordinates of further holes below it, up to the end of the cycle: writes the moves of each hole. There
/// is no fix where another line than one of functions is between them, since the cycle stays in force.
Draft moves_of_cycle(const FixRequest& request) {
  const Word* const marked = word_at(request.line, request.finding.span);
  if (!marked || !is_g(*marked, 81)) return {};
  const std::optional<State> before = request.program.state_before(request.number);
  if (!before || !drills_along_z(*before)) return {};
  const std::optional<DrillingCycle> cycle = cycle_of(request, *before);
  if (!cycle) return {};
  Draft draft{{hole(*cycle, request.number, request.line, true)}};
  const std::size_t end = std::min(request.program.line_count(), request.number + 1 + kCycleReach);
  for (std::size_t number = request.number + 1; number < end; ++number) {
    const syntax::ParsedLine parsed(request.program.text(number));
    const LineTree line = parsed.tree();
    if (line.is_empty() && !line.has_label()) continue;
    if (ends_cycle(line)) return draft;
    if (line.has_label() && request.program.is_jumped_to(line.label)) return {};
    if (has_only_functions(line) && !line.is_empty()) continue;
    if (!has_only(line, "NXY")) return {};
    if (!line.is_empty()) draft.edits.push_back(hole(*cycle, number, line, false));
  }
  return {};
}

}  // namespace isocnc::fixes
