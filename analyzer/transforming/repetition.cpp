#include "analyzer/transforming/repetition.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analyzer/transforming/proof.h"
#include "analyzer/transforming/transform.h"
#include "interpreter/dialect/format.h"
#include "interpreter/syntax/each_tree.h"

namespace isocnc::transforming {

using dialect::ModalGroup;
using dialect::Text;

namespace {

constexpr Text kCopy{"(copy {} of {}: X{:+} Y{:+})", "(copia {} di {}: X{:+} Y{:+})"};

/// A copy of the program at its place.
struct Copy {
  std::string text;
  std::size_t first_line = 0;  ///< In the whole.
};

/// A run to the end of a program without jumps.
struct WholeRun {
  running::RunResult result;
  std::optional<std::size_t> jump;  ///< The line of the first IF.
  /// The greatest Z to which a motion leads; machine frame, mm.
  double height = std::numeric_limits<double>::lowest();
};

WholeRun run_whole(std::string_view text, const running::RunOptions& options) {
  WholeRun whole;
  running::RunOptions watched = options;
  watched.before_block = [&](const running::Block& block) {
    if (block.tree.jump != nullptr && !whole.jump) whole.jump = block.line;
  };
  whole.result = running::run(text, watched, [&](const running::Event& event) {
    const auto* const move = std::get_if<running::MoveEvent>(&event.what);
    // A Z that is not given is that of home, and no height of the program.
    const bool is_given = move != nullptr && ((move->placed >> 2 & 1u) != 0 || move->to.tip.z() != move->from.tip.z());
    if (is_given) whole.height = std::max(whole.height, move->to.tip.z());
  });
  return whole;
}

/// The first lines of a program, with the line end that it uses.
struct FirstLines {
  std::string_view text;
  std::string_view line_end = "\n";
};

FirstLines lines_before(std::string_view text, std::size_t end_line) {
  FirstLines first;
  std::size_t line = 0;
  std::size_t size = 0;
  syntax::each_tree(text, [&](const syntax::LineTree& tree, std::string_view terminator) {
    if (line++ >= end_line) return;
    size += tree.text.size() + terminator.size();
    if (line == 1) first.line_end = terminator;
  });
  first.text = text.substr(0, size);
  return first;
}

/// What brings back the modes of the start: a line for each, the frames first.
std::vector<std::string> restored_modes(const execution::State& state, const execution::State& start) {
  std::vector<std::string> lines;
  for (const ModalGroup group :
       {ModalGroup::Face, ModalGroup::CutterCompensation, ModalGroup::Plane, ModalGroup::ProfileReduction,
        ModalGroup::Interpolation, ModalGroup::Units, ModalGroup::Distance, ModalGroup::FeedMode})
    if (state.g(group) != start.g(group)) lines.push_back(fmt::format("G{:02d}", start.g(group)->number));
  if (state.workpiece_origin != start.workpiece_origin) lines.emplace_back("G92 X0 Y0 Z0");
  return lines;
}

/// Runs the whole beside each copy. `height` is the greatest Z of the program.
std::optional<TransformationRefusal> find_difference_in(const std::string& whole, const std::vector<Copy>& copies,
                                                        std::size_t end_line, double height,
                                                        const running::RunOptions& options,
                                                        dialect::Language language) {
  const running::Program program(whole);
  running::Runner run(program, options);
  for (std::size_t i = 0; i < copies.size(); ++i) {
    while (!run.has_ended() && run.place().line < copies[i].first_line) run.step();
    if (run.has_ended())
      return TransformationRefusal{TransformObstacle::NewError, end_line, error_text(run.result(), language)};
    const ProgramMap same({}, copies[i].text);
    const running::Program copy(copies[i].text);
    running::Runner copy_run(copy, options);
    const bool is_last = i + 1 == copies.size();
    if (const auto refusal =
            find_difference(copy_run, run, copies[i].first_line, is_last ? std::nullopt : std::optional(end_line), same,
                            language, i == 0 ? std::nullopt : std::optional(height)))
      return refusal;
  }
  return std::nullopt;
}

}  // namespace

std::variant<std::string, TransformationRefusal> repeated(std::string_view text, const Transformation& transformation,
                                                          const execution::Setup& setup, dialect::Language language) {
  running::RunOptions options;
  options.setup = setup;
  const WholeRun first = run_whole(text, options);
  if (first.result.ending == running::Ending::Error)
    return TransformationRefusal{TransformObstacle::ProgramError, first.result.line,
                                 error_text(first.result, language)};
  if (first.jump) return TransformationRefusal{TransformObstacle::JumpRepeated, *first.jump};
  const std::size_t end_line = first.result.line;
  const std::vector<std::string> modes = restored_modes(first.result.state, execution::initial_state(setup));
  const int count = transformation.columns * transformation.rows;
  std::vector<Copy> copies;
  std::string whole;
  std::size_t lines = 0;
  for (int i = 0; i < count; ++i) {
    const double x = transformation.place.x() * (i % transformation.columns);
    const double y = transformation.place.y() * (i / transformation.columns);
    Transformation shift{.movement = Movement::Shift, .place = {x, y, 0}};
    shift.feed_factor = transformation.feed_factor;
    auto shifted = transform(text, shift, setup, language);
    if (const auto* const refusal = std::get_if<TransformationRefusal>(&shifted)) return *refusal;
    Copy& copy = copies.emplace_back(Copy{std::get<std::string>(std::move(shifted)), 0});
    const FirstLines body = lines_before(copy.text, end_line);
    if (i > 0) {
      whole += dialect::format(kCopy, language, i + 1, count, x, y);
      whole += body.line_end;
      for (const std::string& mode : modes) {
        whole += mode;
        whole += body.line_end;
      }
      lines += 1 + modes.size();
    }
    copy.first_line = lines;
    lines += end_line;
    whole += i + 1 < count ? body.text : std::string_view(copy.text);
  }
  if (auto refusal = find_difference_in(whole, copies, end_line, first.height, options, language)) return *refusal;
  return whole;
}

}  // namespace isocnc::transforming
