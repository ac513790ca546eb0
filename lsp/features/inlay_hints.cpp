#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/execution/execute.h"
#include "interpreter/execution/silent_sink.h"
#include "lsp/features/feature.h"
#include "lsp/queries/jump_paths.h"
#include "lsp/queries/section_times.h"

/// Inlay hints: where incremental motions end, the G in force for coordinates without G, and when a tool section
/// starts.
namespace isocnc::features {

using execution::State;
using syntax::LineTree;

namespace {

struct Hint {
  ClientPosition position;
  std::string label;
  std::string_view tooltip;
  bool is_after = false;  ///< Whether the hint stands after its text, not before it.
};

void to_json(Json& json, const Hint& hint) {
  json = {{"position", hint.position},
          {"label", hint.label},
          {"tooltip", hint.tooltip},
          {hint.is_after ? "paddingLeft" : "paddingRight", true}};
}

/// Follows the state before each line of a range, if it is the same on all paths. Executes each line once, and asks the
/// snapshot again only where paths may part or meet: the snapshot has followed all paths from the top, with their
/// conditions, which a syntax::ForwardPaths that starts in the middle cannot do.
class StateWalk {
 public:
  StateWalk(const Snapshot& snapshot, std::size_t line)
      : snapshot_(snapshot), paths_(snapshot), state_(snapshot.state_before(line)) {}

  const std::optional<State>& state() const { return state_; }

  /// Arrives at a line, to which jumps may lead as well.
  void arrive(std::size_t line) {
    if (paths_.is_jump_target(line)) state_ = snapshot_.state_before(line);
  }
  /// Executes the line and goes to the next one; ignores jumps to that one.
  void step(std::size_t line, const LineTree& tree) {
    if (!state_ || tree.jump) {
      state_ = snapshot_.state_before(line + 1);
      return;
    }
    execution::SilentSink sink;
    execution::execute(tree, *state_, snapshot_.setup(), sink);
    if (state_->ended) state_.reset();
  }

 private:
  const Snapshot& snapshot_;
  const queries::JumpPaths paths_;
  std::optional<State> state_;
};

/// At most three decimals: users read positions to a thousandth of a millimeter.
std::string number_text(double value) {
  const double rounded = std::round(value * 1000) / 1000;
  return fmt::format("{}", rounded == 0 ? 0.0 : rounded);
}

/// Finds the hints in a range of lines.
class HintFinder {
 public:
  HintFinder(const Snapshot& snapshot, std::size_t first_line) : snapshot_(snapshot), walk_(snapshot, first_line) {}

  void look_at(std::size_t index) {
    const syntax::DocumentLine read = snapshot_.document().line(index);
    const syntax::LineTree& line = *read;
    const syntax::Instruction* const motion = line.motion();
    walk_.arrive(index);
    if (motion && motion->kind == syntax::InstructionKind::Continuation) add_motion_hint(index, line, *motion);
    walk_.step(index, line);
    if (motion) add_end_hint(index, line, *motion);
  }

  std::vector<Hint> hints;

 private:
  void add_motion_hint(std::size_t index, const LineTree& line, const syntax::Instruction& motion) {
    static constexpr dialect::Text kTooltip = {"the motion in force", "il movimento in presa"};
    if (!snapshot_.client().settings.shows_motion_in_force || !walk_.state()) return;
    const dialect::GCode* const g = walk_.state()->motion();
    if (!g) return;
    hints.push_back({.position = snapshot_.to_client({index, line.command(motion).begin}),
                     .label = fmt::format("G{:02}", g->number),
                     .tooltip = kTooltip.in(snapshot_.language())});
  }

  /// Adds the end coordinates of the axes in the line, as they would be written in G90.
  void add_end_hint(std::size_t index, const LineTree& line, const syntax::Instruction& motion) {
    static constexpr dialect::Text kTooltip = {"where the motion ends, in the frame in force",
                                               "dove finisce il movimento, nel riferimento in uso"};
    const std::optional<State>& after = walk_.state();
    if (!snapshot_.client().settings.shows_end_positions || !after || !after->incremental()) return;
    std::string label = "→";
    std::uint32_t end = 0;
    for (std::size_t i = motion.begin; i < motion.end; ++i) {
      const syntax::Word& word = line.words[i];
      end = std::max(end, word.end);
      if (word.owner == motion.number) label += coordinate_text(*after, word.letter);
    }
    if (label.find(' ') == std::string::npos) return;
    hints.push_back({.position = snapshot_.to_client({index, end}),
                     .label = std::move(label),
                     .tooltip = kTooltip.in(snapshot_.language()),
                     .is_after = true});
  }

  /// Text such as ` X12.5`; empty if the letter is not a coordinate, or its value is unknown.
  static std::string coordinate_text(const State& state, char letter) {
    const std::size_t axis = dialect::kAxisLetters.find(letter);
    if (axis == std::string_view::npos) return {};
    if ((state.unknown & execution::axis_bit(static_cast<execution::Axis>(axis))) != 0) return {};
    const bool is_linear = axis < 3;
    const double value = is_linear ? state.position.tip[static_cast<int>(axis)] / state.mm_per_unit()
                                   : (axis == 3 ? state.position.b : state.position.c);
    return fmt::format(" {}{}", letter, number_text(value));
  }

  const Snapshot& snapshot_;
  StateWalk walk_;
};

/// The maximum number of lines of a program that is timed for hints alone. The hints of longer programs appear after
/// the code lenses have started the timing.
constexpr std::size_t kMaxLinesToTime = 20'000;

std::shared_ptr<const queries::Sections> timed_sections(const Snapshot& snapshot) {
  const auto times = queries::SectionTimes::of(snapshot);
  if (auto known = times->known(snapshot)) return known;
  if (snapshot.document().line_count() > kMaxLinesToTime) return nullptr;
  return times->time(queries::TimedProgram(snapshot, 0), [&] {
    snapshot.throw_if_unwanted();
    return false;
  });
}

/// Adds, after each M06 in the range, the time since the start of the program.
void add_section_times(const Snapshot& snapshot, std::size_t first, std::size_t last, std::vector<Hint>& hints) {
  static constexpr dialect::Text kTooltip = {"time since the beginning of the program, with VGPL 0",
                                             "tempo dall'inizio del programma, con VGPL 0"};
  std::vector<documents::Landmark> changes = snapshot.index().landmarks(documents::LandmarkKind::ToolChange);
  std::erase_if(changes, [&](const documents::Landmark& change) { return change.line < first || change.line > last; });
  if (changes.empty()) return;
  const auto sections = timed_sections(snapshot);
  if (!sections) return;
  for (const documents::Landmark& change : changes) {
    const auto section = sections->find(change.line);
    if (section == sections->end()) continue;
    const syntax::DocumentLine read = snapshot.document().line(change.line);
    const syntax::LineTree& line = *read;
    hints.push_back({.position = snapshot.to_client({change.line, line.words.back().end}),
                     .label = queries::clock_text(section->second.start),
                     .tooltip = kTooltip.in(snapshot.language()),
                     .is_after = true});
  }
}

std::vector<Hint> answer_inlay_hints(const Snapshot& snapshot, const protocol::RangeParams& params) {
  const protocol::ClientSettings& settings = snapshot.client().settings;
  const std::size_t first = snapshot.from_client(params.range.start).line;
  const std::size_t last = snapshot.from_client(params.range.end).line;
  std::vector<Hint> times;
  if (settings.shows_section_times) add_section_times(snapshot, first, last, times);
  if (!settings.shows_end_positions && !settings.shows_motion_in_force) return times;
  HintFinder finder(snapshot, first);
  for (std::size_t line = first; line <= last; ++line) {
    if (line % 256 == 0) snapshot.throw_if_unwanted();
    finder.look_at(line);
  }
  std::vector<Hint> hints = std::move(finder.hints);
  hints.insert(hints.end(), times.begin(), times.end());
  return hints;
}

Json inlay_hints_capabilities(const Client&) { return {{"inlayHintProvider", true}}; }

}  // namespace

extern const Feature inlay_hints = {
    .capabilities = inlay_hints_capabilities,
    .methods = {on<&answer_inlay_hints>("textDocument/inlayHint")},
    .refresh = Refresh{"workspace/inlayHint/refresh", "/workspace/inlayHint/refreshSupport"}};

}  // namespace isocnc::features
