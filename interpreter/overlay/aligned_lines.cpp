#include "interpreter/overlay/aligned_lines.h"

#include <algorithm>
#include <string>
#include <utility>

#include "interpreter/comparison/comparison.h"
#include "interpreter/comparison/effect_steps.h"
#include "interpreter/comparison/motion_steps.h"
#include "interpreter/text/characters.h"

namespace isocnc::overlay {

using comparison::ActionRanges;
using comparison::AlignedPiece;
using comparison::MotionStep;
using comparison::RecordedRun;

namespace {

/// Lines of both programs, from the first to the last one, that belong together.
struct LineTie {
  std::size_t a_first = 0;
  std::size_t a_last = 0;
  std::size_t b_first = 0;
  std::size_t b_last = 0;
};

/// Finds which lines of two runs belong together, from the alignment of their actions.
class LineTies {
 public:
  explicit LineTies(const comparison::RunPair& runs) : runs_(runs) {
    const std::vector<AlignedPiece> pieces = comparison::align(runs);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].kind == AlignedPiece::Kind::Same) {
        tie_same(pieces[i]);
      } else {
        tie_part(comparison::part_at(pieces, i));
      }
    }
  }

  /// In the order of the lines, of which each is in one tie at most.
  std::vector<LineTie> take() { return std::move(ties_); }

 private:
  void tie_same(const AlignedPiece& piece) {
    for (comparison::PlaceInBoth at{piece.a_begin, piece.b_begin}; at.a < piece.a_end;) {
      const auto next =
          comparison::same_step(runs_, at, piece.shift).value_or(comparison::PlaceInBoth{at.a + 1, at.b + 1});
      add(tie_of({at.a, next.a, at.b, next.b}));
      at = next;
    }
  }

  void tie_part(const comparison::DifferentPart& part) {
    const auto block = comparison::motion_block(runs_, part);
    if (!block) {
      if (!part.is_closed) return;
      const ActionRanges& at = part.actions;
      return add(tie_of({at.a_end - 1, at.a_end, at.b_end - 1, at.b_end}));
    }
    std::vector<LineTie> found = motion_ties(*block);
    for (const comparison::EffectStep& step : comparison::effect_steps(runs_, part.actions, *block))
      if (step.a && step.b) insert(found, tie_of({*step.a, *step.a + 1, *step.b, *step.b + 1}));
    for (const LineTie& tie : found) add(tie);
  }

  /// Motions that take the place of each other, and as many of one run as of the other one that do not.
  std::vector<LineTie> motion_ties(const comparison::MotionBlock& block) const {
    std::vector<LineTie> found;
    const auto tie = [&](std::size_t a_begin, std::size_t a_end, std::size_t b_begin, std::size_t b_end) {
      found.push_back(tie_of({block.a_actions[a_begin], block.a_actions[a_end - 1] + 1, block.b_actions[b_begin],
                              block.b_actions[b_end - 1] + 1}));
    };
    std::vector<std::size_t> only_a;
    std::vector<std::size_t> only_b;
    const auto tie_rest = [&] {
      for (std::size_t i = 0; only_a.size() == only_b.size() && i < only_a.size(); ++i)
        tie(only_a[i], only_a[i] + 1, only_b[i], only_b[i] + 1);
      only_a.clear();
      only_b.clear();
    };
    for (const MotionStep& step : block.steps) {
      const ActionRanges& at = step.motions;
      if (step.kind == MotionStep::Kind::OnlyInA) {
        only_a.push_back(at.a_begin);
      } else if (step.kind == MotionStep::Kind::OnlyInB) {
        only_b.push_back(at.b_begin);
      } else {
        tie_rest();
        tie(at.a_begin, at.a_end, at.b_begin, at.b_end);
      }
    }
    tie_rest();
    return found;
  }

  /// Inserts a tie unless it would cross another one.
  static void insert(std::vector<LineTie>& ties, const LineTie& tie) {
    const auto next =
        std::partition_point(ties.begin(), ties.end(), [&](const LineTie& each) { return each.a_first < tie.a_first; });
    if (next != ties.end() && next->b_first < tie.b_last) return;
    if (next != ties.begin() && std::prev(next)->b_last > tie.b_first) return;
    ties.insert(next, tie);
  }

  LineTie tie_of(const ActionRanges& at) const {
    return {runs_.a.actions[at.a_begin].line, runs_.a.actions[at.a_end - 1].line, runs_.b.actions[at.b_begin].line,
            runs_.b.actions[at.b_end - 1].line};
  }

  /// Adds a tie, together with those that share a line with it.
  void add(LineTie tie) {
    while (!ties_.empty() && (ties_.back().a_last >= tie.a_first || ties_.back().b_last >= tie.b_first)) {
      const LineTie& last = ties_.back();
      tie = {std::min(last.a_first, tie.a_first), std::max(last.a_last, tie.a_last),
             std::min(last.b_first, tie.b_first), std::max(last.b_last, tie.b_last)};
      ties_.pop_back();
    }
    ties_.push_back(tie);
  }

  const comparison::RunPair& runs_;
  std::vector<LineTie> ties_;
};

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p != end;) {
    const char* const line_end = text::find_line_end(p, end);
    lines.emplace_back(p, static_cast<std::size_t>(line_end - p));
    p = text::skip_line_end(line_end, end);
  }
  return lines;
}

/// A line without its block number and the blanks around what remains.
std::string_view without_number(std::string_view line) {
  line = text::trimmed(line);
  if (line.size() < 2 || (line[0] != 'N' && line[0] != 'n') || !text::is_digit(line[1])) return line;
  line.remove_prefix(1);
  while (!line.empty() && text::is_digit(line[0])) line.remove_prefix(1);
  return text::trimmed(line);
}

/// Aligns lines step by step, from the first ones on.
class LineAligner {
 public:
  LineAligner(const AlignedProgram& old_program, const AlignedProgram& new_program)
      : old_lines_(lines_of(old_program.text)), new_lines_(lines_of(new_program.text)) {}

  /// An error may stand behind the last line, where something is missing.
  void take(const LineTie& tie) {
    const std::size_t old_end = std::min(tie.a_last + 1, old_lines_.size());
    const std::size_t new_end = std::min(tie.b_last + 1, new_lines_.size());
    if (tie.a_first >= old_end || tie.b_first >= new_end) return;
    take_until(tie.a_first, tie.b_first);
    put(old_end - tie.a_first, new_end - tie.b_first);
  }

  std::vector<AlignedLines> finish() {
    take_until(old_lines_.size(), new_lines_.size());
    return std::move(aligned_);
  }

 private:
  /// Lines of which no action belongs together: equal texts at their start and at their end do.
  void take_until(std::size_t old_end, std::size_t new_end) {
    while (old_ < old_end && new_ < new_end && is_same_text(old_, new_)) put(1, 1);
    std::size_t last = 0;
    while (old_ + last < old_end && new_ + last < new_end && is_same_text(old_end - 1 - last, new_end - 1 - last))
      ++last;
    if (old_ + last < old_end || new_ + last < new_end) put(old_end - last - old_, new_end - last - new_);
    for (; last > 0; --last) put(1, 1);
  }

  bool is_same_text(std::size_t old_line, std::size_t new_line) const {
    return without_number(old_lines_[old_line]) == without_number(new_lines_[new_line]);
  }

  void put(std::size_t old_count, std::size_t new_count) {
    old_ += old_count;
    new_ += new_count;
    if (!aligned_.empty() && aligned_.back().old_count == old_count && aligned_.back().new_count == new_count) {
      ++aligned_.back().repeats;
    } else {
      aligned_.push_back({old_count, new_count, 1});
    }
  }

  std::vector<std::string_view> old_lines_;
  std::vector<std::string_view> new_lines_;
  std::size_t old_ = 0;
  std::size_t new_ = 0;
  std::vector<AlignedLines> aligned_;
};

}  // namespace

std::vector<AlignedLines> aligned_lines(const AlignedProgram& old_program, const AlignedProgram& new_program,
                                        double tolerance) {
  const bool is_swapped = comparison::is_before(new_program.run, old_program.run);
  comparison::WorkBudget budget;
  const comparison::RunPair runs{is_swapped ? new_program.run : old_program.run,
                                 is_swapped ? old_program.run : new_program.run, tolerance, &budget};
  LineAligner aligner(old_program, new_program);
  for (const LineTie& tie : LineTies(runs).take())
    aligner.take(is_swapped ? LineTie{tie.b_first, tie.b_last, tie.a_first, tie.a_last} : tie);
  return aligner.finish();
}

}  // namespace isocnc::overlay
