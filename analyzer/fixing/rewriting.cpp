#include "analyzer/fixing/rewriting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "analyzer/fixes/line_edits.h"
#include "interpreter/dialect/format.h"
#include "interpreter/execution/block_recorder.h"
#include "interpreter/execution/plane.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::fixing {

using dialect::ModalGroup;
using execution::BlockRecorder;
using execution::MoveKind;
using execution::ProgrammedFeed;
using execution::ProgrammedMove;
using execution::State;
using fixes::Edit;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineTree;
using syntax::Span;
using syntax::Word;

namespace {

bool is_near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }
bool is_near(const geometry::Vec3& a, const geometry::Vec3& b, double tolerance) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance;
}
bool is_same(const geometry::Pose& a, const geometry::Pose& b) {
  return is_near(a.tip, b.tip, kSamePlace) && is_near(a.b, b.b, kSamePlace) && is_near(a.c, b.c, kSamePlace);
}
bool is_same_feed(double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b)); }
bool is_same_feed(const ProgrammedFeed& a, const ProgrammedFeed& b) {
  return is_same_feed(a.number * a.mm_per_unit, b.number * b.mm_per_unit);
}

bool is_same(const ProgrammedMove& a, const ProgrammedMove& b) {
  if (a.kind != b.kind || a.inverse_time != b.inverse_time || !is_same_feed(a.feed, b.feed)) return false;
  if (!is_same(a.from, b.from) || !is_same(a.to, b.to)) return false;
  if (a.kind != MoveKind::Arc) return true;
  const double turn = (a.sweep_deg - b.sweep_deg) * std::numbers::pi / 180;
  return is_near(a.center, b.center, kSameArc) && is_near(a.radius, b.radius, kSameArc) && a.normal == b.normal &&
         std::abs(turn) * a.radius <= kSameArc;
}

/// Whether two states are the same for all later lines. The groups in `but` may differ.
bool is_same(const State& a, const State& b, std::initializer_list<ModalGroup> but) {
  for (std::size_t group = 0; group < dialect::kModalGroupCount; ++group)
    if (a.in_force[group] != b.in_force[group] &&
        std::find(but.begin(), but.end(), static_cast<ModalGroup>(group)) == but.end())
      return false;
  return is_same(a.position, b.position) && a.unknown == b.unknown &&
         is_near(a.workpiece_origin, b.workpiece_origin, kSamePlace) && a.face_mounted == b.face_mounted &&
         is_near(a.face.origin, b.face.origin, kSamePlace) && a.face.axes.isApprox(b.face.axes, 1e-9) &&
         is_same_feed(feed_in_force(a), feed_in_force(b)) && a.feed_given == b.feed_given && a.tool == b.tool &&
         a.spindle_function == b.spindle_function && a.spindle_speed == b.spindle_speed && a.ended == b.ended;
}

/// Allowed errors of written numbers, in mm or degrees; tried in this order, so that short numbers come first.
constexpr double kRoundings[] = {2e-6, 1e-8};
constexpr double kRadiusRoundings[] = {5e-5, 2e-6, 1e-8};
constexpr int kMaxDecimals = 9;

/// The number with as few decimals as keep the error within `rounding`.
std::string number_text(double value, double rounding) {
  int decimals = 0;
  while (decimals < kMaxDecimals) {
    const double power = std::pow(10, decimals);
    if (std::abs(std::round(value * power) / power - value) <= rounding) break;
    ++decimals;
  }
  return dialect::written_number(value, decimals);
}

/// The rewritten words of one line.
class LineRewriter {
 public:
  LineRewriter(std::size_t number, const LineTree& line) : number_(number), line_(line) {}

  /// Replaces a word. Blanks inside it are lost; a comment inside it must not be, so has_comment() reports that.
  void replace(Span span, std::string text) {
    has_comment_ |= line_.text_of(span).find('(') != std::string_view::npos;
    edits_.push_back({{number_, span.begin}, {number_, span.end}, std::move(text)});
  }
  /// Removes a word with the blanks before it, or with those after it at the start of the line.
  void remove(Span span) {
    has_comment_ |= line_.text_of(span).find('(') != std::string_view::npos;
    Span wide = fixes::with_blanks(line_.text, span);
    for (const Edit& edit : edits_)  // Blanks between two words are removed once.
      if (edit.begin.column < wide.begin)
        wide.begin = std::max(wide.begin, static_cast<std::uint32_t>(edit.end.column));
    edits_.push_back({{number_, wide.begin}, {number_, wide.end}, {}});
  }
  /// Gives a word a new value, unless it has that value within `rounding`.
  void set(const Word& word, double value, double mm_per_unit, double rounding) {
    if (std::abs(word.value - value) * mm_per_unit > rounding)
      replace(word.span(), word.letter + number_text(value, rounding / mm_per_unit));
  }

  bool has_comment() const { return has_comment_; }
  std::vector<Edit> edits() const {
    std::vector<Edit> sorted = edits_;
    std::sort(sorted.begin(), sorted.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
    return sorted;
  }
  std::string text() const { return fixes::edited(line_.text, edits_); }

 private:
  const std::size_t number_;
  const LineTree& line_;
  std::vector<Edit> edits_;
  bool has_comment_ = false;
};

// --- Arcs

/// The words of a motion with one of these letters, in the order of the line.
std::vector<const Word*> words_of(const LineTree& line, const Instruction& motion, dialect::LetterSet letters) {
  std::vector<const Word*> words;
  for (std::size_t i = motion.begin; i < motion.end; ++i)
    if (line.words[i].owner == motion.number && dialect::contains(letters, line.words[i].letter))
      words.push_back(&line.words[i]);
  return words;
}

/// The words of the center, such as `I10 J0`, according to G90 or G91.
std::string center_text(const BlockRecorder& done, double rounding) {
  const State& modes = done.modes();
  const ProgrammedMove& arc = done.motion()->move;
  const execution::Plane& plane = execution::plane_in_force(modes);
  const auto word = [&](char letter, int axis) {
    const double center = arc.center[axis] - (modes.incremental() ? arc.from.tip[axis] : 0);
    return letter + number_text(center / modes.mm_per_unit(), rounding / modes.mm_per_unit());
  };
  const std::string u = word(plane.u_center, plane.u);
  const std::string v = word(plane.v_center, plane.v);
  return u < v ? u + " " + v : v + " " + u;
}

constexpr dialect::LetterSet kRadiusLetters = dialect::letter_bit('R');

/// The letters that a rewrite removes.
constexpr dialect::LetterSet old_letters(Rewrite how) {
  return how == Rewrite::ArcByRadius ? dialect::kCenterLetters : kRadiusLetters;
}

/// Writes the circle of an arc in the other notation. If the line has both notations, only removes the old words.
void give_circle(LineRewriter& rewrite, Rewrite how, const LineTree& line, const Instruction& motion,
                 const BlockRecorder& done, double rounding) {
  const bool by_radius = how == Rewrite::ArcByRadius;
  const std::vector<const Word*> old = words_of(line, motion, old_letters(how));
  const std::vector<const Word*> there = words_of(line, motion, by_radius ? kRadiusLetters : dialect::kCenterLetters);
  const bool is_there = there.size() == (by_radius ? 1 : 2);
  const double mm_per_unit = done.modes().mm_per_unit();
  const std::string fresh = by_radius
                                ? "R" + number_text(done.motion()->move.radius / mm_per_unit, rounding / mm_per_unit)
                                : center_text(done, rounding);
  if (!is_there) {
    for (const Word* const word : there) rewrite.remove(word->span());
    rewrite.replace(old.front()->span(), fresh);
  }
  for (std::size_t i = is_there ? 0 : 1; i < old.size(); ++i) rewrite.remove(old[i]->span());
}

std::vector<Edit> rewrite_arc(Rewrite how, fixes::FixProgram& program, const execution::Setup& setup,
                              std::size_t number) {
  const LineTree line = program.line(number);
  const Instruction* const motion = line.motion();
  if (!motion || words_of(line, *motion, old_letters(how)).empty()) return {};
  const std::optional<State> before = program.state_before(number);
  if (!before || before->unknown != 0 || before->ended) return {};
  const BlockRecorder done(line, *before, setup);
  if (done.has_error() || !done.motion() || done.motion()->move.kind != MoveKind::Arc) return {};
  if (how == Rewrite::ArcByRadius && std::abs(done.motion()->move.sweep_deg) > 180 + 1e-6) return {};
  for (const double rounding : kRadiusRoundings) {
    LineRewriter rewrite(number, line);
    give_circle(rewrite, how, line, *motion, done, rounding);
    if (rewrite.has_comment()) return {};
    const syntax::ParsedLine parsed(rewrite.text());
    const BlockRecorder trial(parsed.tree(), *before, setup);
    if (!trial.has_error() && trial.motion() && is_same(done.motion()->move, trial.motion()->move) &&
        is_same(done.state(), trial.state(), {}))
      return rewrite.edits();
  }
  return {};
}

std::vector<Edit> rewrite_arcs(Rewrite how, fixes::FixProgram& program, const execution::Setup& setup,
                               std::size_t first, std::size_t last) {
  std::vector<Edit> all;
  for (std::size_t line = first; line <= last; ++line) {
    const std::vector<Edit> edits = rewrite_arc(how, program, setup, line);
    all.insert(all.end(), edits.begin(), edits.end());
  }
  return all;
}

// --- Dimensions

/// The mode that a rewrite sets.
struct ModeChange {
  ModalGroup group;
  std::uint8_t number;
};

constexpr ModeChange mode_of(Rewrite how) {
  switch (how) {
    case Rewrite::Incremental:
      return {ModalGroup::Distance, dialect::kIncremental};
    case Rewrite::Absolute:
      return {ModalGroup::Distance, dialect::kAbsolute};
    case Rewrite::Inches:
      return {ModalGroup::Units, dialect::kInches};
    default:
      return {ModalGroup::Units, dialect::kMillimeters};
  }
}

/// Rewrites the dimensions of consecutive lines, and tracks the machine state for both the old and the new lines. New
/// increments start from the position that the new lines reached, so that roundings do not add up.
class Dimensions {
 public:
  Dimensions(Rewrite how, fixes::FixProgram& program, const execution::Setup& setup, std::size_t first,
             std::size_t last)
      : mode_(mode_of(how)), program_(program), setup_(setup), first_(first), last_(last) {}

  std::optional<std::vector<Edit>> rewrite() {
    const std::optional<State> before = program_.state_before(first_);
    if (!before || before->unknown != 0 || before->ended) return std::nullopt;
    old_ = new_ = *before;
    if (!enter()) return std::nullopt;
    for (std::size_t line = first_; line <= last_ && !old_.ended; ++line)
      if (!rewrite_line(line)) return std::nullopt;
    if (!leave() || !has_changed_numbers_) return std::nullopt;
    return std::move(edits_);
  }

 private:
  static std::string mode_text(std::uint8_t number) { return "G" + std::to_string(number); }

  bool enter() {
    if (old_.mode(mode_.group) == mode_.number) return true;
    edits_.push_back({{first_, 0}, {first_, 0}, indentation(first_) + mode_text(mode_.number) + "\n"});
    return execute_mode(mode_.number);
  }

  /// Resets the mode for the lines after. A G09 there must still follow its motion (D23), so that case is refused.
  bool leave() {
    const std::uint8_t wanted = old_.mode(mode_.group);
    if (!old_.ended && wanted != mode_.number) {
      if (old_.exact_stop_fits && exact_stop_follows()) return false;
      const std::string text = indentation(last_) + mode_text(wanted);
      const bool is_end = last_ + 1 == program_.line_count();
      const syntax::Position at =
          is_end ? syntax::Position{last_, program_.text(last_).size()} : syntax::Position{last_ + 1, 0};
      edits_.push_back({at, at, is_end ? "\n" + text : text + "\n"});
      if (!execute_mode(wanted)) return false;
    }
    if (old_.ended) return true;
    const bool rotary_feed_is_other = feed_in_force(old_).number != feed_in_force(new_).number;
    return is_same(old_, new_, {}) && !(rotary_feed_is_other && turns_below());
  }

  bool execute_mode(std::uint8_t number) {
    const syntax::ParsedLine parsed(mode_text(number));
    const BlockRecorder done(parsed.tree(), new_, setup_);
    new_ = done.state();
    return !done.has_error();
  }

  bool exact_stop_follows() {
    for (std::size_t line = last_ + 1; line < program_.line_count(); ++line) {
      const LineTree tree = program_.line(line);
      if (tree.is_empty()) continue;
      if (tree.instructions.empty()) return false;
      const Instruction& first = tree.instructions.front();
      return first.is(dialect::GRole::ExactStop);
    }
    return false;
  }

  /// Whether a line below turns B or C alone: its F is in degrees, whatever the units (I.3.7).
  bool turns_below() {
    for (std::size_t line = last_ + 1; line < program_.line_count(); ++line) {
      const LineTree tree = program_.line(line);
      const Instruction* const motion = tree.motion();
      if (motion && words_of(tree, *motion, dialect::kLinearLetters).empty()) return true;
    }
    return false;
  }

  std::string indentation(std::size_t line) { return std::string(fixes::indentation(program_.text(line))); }

  bool rewrite_line(std::size_t number) {
    const LineTree line = program_.line(number);
    if (line.jump != nullptr || (line.has_label() && program_.is_jumped_to(line.label))) return false;
    const State before = old_;
    const BlockRecorder done(line, before, setup_);
    old_ = done.state();
    if (done.has_error() || old_.unknown != 0) return false;
    for (const double rounding : kRoundings) {
      LineRewriter rewrite(number, line);
      const bool has_changed = set_numbers(rewrite, line, done, before, rounding);
      remove_modes(rewrite, line);
      if (rewrite.has_comment()) return false;
      const std::string text = rewrite.text();
      const syntax::ParsedLine parsed(text);
      const BlockRecorder trial(parsed.tree(), new_, setup_);
      if (trial.has_error() || trial.motions().size() != done.motions().size()) continue;
      if (done.motion() && !is_same(done.motion()->move, trial.motion()->move)) continue;
      if (!is_same(old_, trial.state(), {mode_.group})) continue;
      new_ = trial.state();
      has_changed_numbers_ |= has_changed;
      take(number, line, rewrite, text);
      return true;
    }
    return false;
  }

  /// Takes the edits of a line; removes the line if it has become blank.
  void take(std::size_t number, const LineTree& line, const LineRewriter& rewrite, const std::string& text) {
    if (!line.words.empty() && fixes::is_blank(text) && number + 1 < program_.line_count()) {
      edits_.push_back({{number, 0}, {number + 1, 0}, {}});
      return;
    }
    const std::vector<Edit> edits = rewrite.edits();
    edits_.insert(edits_.end(), edits.begin(), edits.end());
  }

  void remove_modes(LineRewriter& rewrite, const LineTree& line) const {
    for (const Instruction& instruction : line.instructions)
      if (instruction.kind == InstructionKind::G && instruction.g() != nullptr && instruction.g()->group == mode_.group)
        rewrite.remove(line.command(instruction).span());
  }

  bool set_numbers(LineRewriter& rewrite, const LineTree& line, const BlockRecorder& done, const State& before,
                   double rounding) const {
    const State& modes = done.modes();
    const double old_scale = modes.mm_per_unit();
    State wanted = modes;
    wanted.set_mode(mode_.group, mode_.number);
    const double scale = wanted.mm_per_unit();
    const bool incremental = wanted.incremental();
    for (const Instruction& instruction : line.instructions) {
      if (instruction.is_motion() && done.motion()) {
        set_motion(rewrite, line, instruction, done.motion()->move, scale, old_scale, incremental, rounding);
      } else if (instruction.kind == InstructionKind::G && instruction.g() != nullptr && old_scale != scale) {
        set_origin(rewrite, line, instruction, before.mm_per_unit(), scale, rounding);
      }
    }
    if (line.feed >= 0 && old_scale != scale) set_feed(rewrite, line, done, old_scale / scale);
    return !rewrite.edits().empty();
  }

  void set_motion(LineRewriter& rewrite, const LineTree& line, const Instruction& instruction,
                  const ProgrammedMove& motion, double scale, double old_scale, bool incremental,
                  double rounding) const {
    const auto from_start = [&](double value, double start) { return incremental ? value - start : value; };
    for (const Word* const word : words_of(line, instruction, dialect::kDimensionLetters)) {
      const char letter = word->letter;
      if (letter >= 'X' && letter <= 'Z') {
        const int axis = letter - 'X';
        rewrite.set(*word, from_start(motion.to.tip[axis], new_.position.tip[axis]) / scale, scale, rounding);
      } else if (letter >= 'I' && letter <= 'K' && motion.kind == MoveKind::Arc) {
        const int axis = letter - 'I';
        rewrite.set(*word, from_start(motion.center[axis], new_.position.tip[axis]) / scale, scale, rounding);
      } else if (letter == 'B' || letter == 'C') {
        const bool is_b = letter == 'B';
        rewrite.set(*word, from_start(is_b ? motion.to.b : motion.to.c, is_b ? new_.position.b : new_.position.c), 1,
                    rounding);
      } else if (letter == 'R') {
        rewrite.set(*word, word->value * old_scale / scale, scale, rounding);
      }
    }
  }

  /// Sets the origin of a frame. G28 is not affected: its X, Y and Z are components.
  static void set_origin(LineRewriter& rewrite, const LineTree& line, const Instruction& instruction, double old_scale,
                         double scale, double rounding) {
    if (!instruction.g()->takes_origin()) return;
    for (const Word* const word : words_of(line, instruction, dialect::kLinearLetters))
      rewrite.set(*word, word->value * old_scale / scale, scale, rounding);
  }

  /// Sets a feed rate per minute along a path; inverse time and degrees do not depend on units.
  static void set_feed(LineRewriter& rewrite, const LineTree& line, const BlockRecorder& done, double factor) {
    if (done.modes().inverse_time()) return;
    const Instruction* const motion = line.motion();
    if (motion && words_of(line, *motion, dialect::kLinearLetters).empty()) return;
    const Word& feed = line.words[static_cast<std::size_t>(line.feed)];
    const double value = feed.value * factor;
    rewrite.set(feed, value, 1, std::abs(value) * 1e-7);
  }

  const ModeChange mode_;
  fixes::FixProgram& program_;
  const execution::Setup& setup_;
  const std::size_t first_;
  const std::size_t last_;
  State old_;
  State new_;
  std::vector<Edit> edits_;
  bool has_changed_numbers_ = false;
};

}  // namespace

std::optional<std::vector<Edit>> rewrite(Rewrite how, fixes::FixProgram& program, const execution::Setup& setup,
                                         std::size_t first, std::size_t last) {
  last = std::min(last, program.line_count() - 1);
  if (first > last) return std::nullopt;
  if (how != Rewrite::ArcByRadius && how != Rewrite::ArcByCenter)
    return Dimensions(how, program, setup, first, last).rewrite();
  std::vector<Edit> edits = rewrite_arcs(how, program, setup, first, last);
  return edits.empty() ? std::nullopt : std::optional(std::move(edits));
}

}  // namespace isocnc::fixing
