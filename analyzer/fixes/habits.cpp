#include "analyzer/fixes/habits.h"

#include <algorithm>
#include <cmath>

#include "analyzer/fixes/centered_arcs.h"
#include "analyzer/fixes/line_edits.h"
#include "interpreter/dialect/format.h"

namespace isocnc::fixes {

using namespace dialect::literals;
using geometry::CenterReadings;
using geometry::PlanePoint;
using syntax::Instruction;
using syntax::LineTree;
using syntax::Word;

namespace {

/// The minimum time of a G04 without a decimal point that may be meant in milliseconds: shorter dwells are unlikely.
constexpr double kFewMilliseconds = 10;

bool has_centers(const LineTree& line, const Instruction& motion) {
  for (std::size_t i = motion.begin; i < motion.end; ++i)
    if (line.words[i].owner == motion.number && dialect::contains(dialect::kCenterLetters, line.words[i].letter))
      return true;
  return false;
}

bool has_centers(const LineTree& line) {
  return std::any_of(line.instructions.begin(), line.instructions.end(),
                     [&](const Instruction& each) { return each.is_motion() && has_centers(line, each); });
}

bool starts_with_lost_letter(const LineTree& line) {
  const auto is_no_label = [](const Word& word) { return word.letter != 'N'; };
  const auto first = std::find_if(line.words.begin(), line.words.end(), is_no_label);
  return first != line.words.end() && first->letter == syntax::kNumber;
}

/// Whether a G of the line cannot be read, or a number has lost its letter: the motion and modes in force after the
/// line are then unknown. G91.1 can be read; it belongs to another control.
bool hides_a_g(const LineTree& line) {
  return starts_with_lost_letter(line) || std::any_of(line.words.begin(), line.words.end(), [](const Word& word) {
           return word.letter == 'G' && word.has(Word::kMissing | Word::kMalformed | Word::kReported) &&
                  !word.has(Word::kPoint);
         });
}

/// The center of an arc as read from the other origin. A sum of numbers with few decimals has few itself.
LineRewrite with_other_center(const LineTree& line, std::size_t number, const ArcOfProgram& arc) {
  const PlanePoint center = arc.readings.other_center;
  int decimals = decimals_of_center(line, arc);
  const auto error = [&] { return (rounded_center(arc, center, decimals) - center).norm(); };
  while (decimals < kMaxDecimals && error() > geometry::kEqualCoordinate) ++decimals;
  WrittenCenter written = center_written(arc, number, center, decimals);
  return {number, std::move(written.edits), std::move(written.words)};
}

/// Surveys the arcs of a program that are given by centers, under one of G90 and G91, for the habit of counting centers
/// from the other origin (D70).
class CenterSurvey {
 public:
  explicit CenterSurvey(double tolerance) : tolerance_(tolerance) {}

  /// Records an arc that is not known, or whose words cannot be changed.
  void add_unknown() { has_unknown_ = true; }

  void add(const CenterReadings& readings, LineRewrite rewrite) {
    if (readings.is_same_center) return;
    is_shown_ |= readings.shows_other_origin(tolerance_);
    const bool is_legal = readings.fits(tolerance_);
    if (readings.shows_own_origin(tolerance_)) {
      is_contradicted_ = true;
      return;
    }
    has_open_ |= is_legal;
    if (!readings.fits_other(tolerance_)) {
      // An illegal arc keeps its finding. A legal one would become illegal by rewriting, without having had a finding.
      if (is_legal) add_unknown();
      return;
    }
    if (readings.shows_other_origin(tolerance_)) certain_.push_back(rewrites_.size());
    rewrites_.push_back(std::move(rewrite));
  }

  bool is_shown() const { return is_shown_; }
  bool is_open() const { return (has_open_ || has_unknown_) && !is_contradicted_; }

  /// If nothing contradicts the habit: all centers that fit from the other origin. If some arcs do: those that fit in
  /// no other way, unless others are legal both ways.
  HabitRewrites rewrites() {
    if (!is_shown_ || has_unknown_ || (is_contradicted_ && has_open_)) return {};
    if (!is_contradicted_) return std::move(rewrites_);
    HabitRewrites certain;
    for (const std::size_t index : certain_) certain.push_back(std::move(rewrites_[index]));
    return certain;
  }

 private:
  double tolerance_;
  HabitRewrites rewrites_;
  std::vector<std::size_t> certain_;  // Indices into rewrites_ of arcs that fit from the other origin only.
  bool is_shown_ = false;
  bool is_contradicted_ = false;
  bool has_open_ = false;  // Whether some arc is legal as written and at least nearly so from the other origin.
  bool has_unknown_ = false;
};

}  // namespace

bool is_foreign_unit(const Word& word) {
  return is_g(word, 20) || is_g(word, 21) || is_g(word, 700) || is_g(word, 710);
}

LineTree Habits::line(std::size_t number) {
  const std::string_view text = program_.text(number);
  line_.clear();
  line_.append_line(text.data(), text.data() + text.size());
  return line_.tree(0, text.data());
}

void Habits::find_centers() {
  const double tolerance = program_.setup().arc_tolerance;
  CenterSurvey absolute(tolerance);
  CenterSurvey incremental(tolerance);
  for (std::size_t number = 0; number < program_.line_count(); ++number) {
    const bool is_affected = has_centers(line(number));
    if (!is_affected && !hides_a_g(line(number))) continue;
    if (!program_.is_read(number)) continue;
    if (!is_affected || hides_a_g(line(number))) {
      absolute.add_unknown();
      incremental.add_unknown();
      continue;
    }
    const std::optional<execution::State> before = program_.state_before(number);
    const LineTree tree = line(number);
    const bool is_short = tree.text.size() <= kLongestLine;
    if (const auto arc = before && is_short ? arc_on(tree, *before, program_.setup()) : std::nullopt) {
      (arc->incremental ? incremental : absolute).add(arc->readings, with_other_center(tree, number, *arc));
    } else if (!before || may_be_arc(tree, *before, program_.setup())) {
      absolute.add_unknown();
      incremental.add_unknown();
    }
  }
  for (const auto& [habit, survey] :
       {std::pair{Habit::CentersInG90, &absolute}, std::pair{Habit::CentersInG91, &incremental}})
    found_[static_cast<std::size_t>(habit)] = {
        .rewrites = survey->rewrites(), .is_shown = survey->is_shown(), .is_open = survey->is_open()};
}

/// On other controls G20 and G21, or G700 and G710, set inches and millimeters; rewriting only some of them would mix
/// the units.
HabitRewrites Habits::find_foreign_units() {
  HabitRewrites rewrites;
  for (std::size_t number = 0; number < program_.line_count(); ++number) {
    if (program_.text(number).find_first_of("Gg") == std::string_view::npos) continue;
    const LineTree tree = line(number);
    LineRewrite rewrite{.line = number};
    for (const Word& word : tree.words) {
      if (!is_foreign_unit(word)) continue;
      const syntax::Finding finding{.id = "unsupported-g"_diag, .span = word.span()};
      const FixRequest request{number, finding, true, tree, program_};
      rewrite.what = word.value == 20 || word.value == 700 ? "G70" : "G71";
      rewrite.edits.push_back(replaced(request, word.span(), rewrite.what));
      if (!helps(request, rewrite.edits)) return {};
    }
    if (!rewrite.edits.empty() && program_.is_read(number)) rewrites.push_back(std::move(rewrite));
  }
  return rewrites;
}

/// G04 P500: if one time is far too long for seconds, all are milliseconds, unless one has a decimal point or is too
/// short for that.
HabitRewrites Habits::find_milliseconds() {
  HabitRewrites rewrites;
  bool is_shown = false;
  for (std::size_t number = 0; number < program_.line_count(); ++number) {
    if (program_.text(number).find_first_of("Gg") == std::string_view::npos) continue;
    const LineTree tree = line(number);
    for (const Instruction& dwell : tree.instructions) {
      if (!dwell.is(dialect::GRole::Dwell)) continue;
      const auto is_time = [&](const Word& word) { return word.letter == 'P' && word.owner == dwell.number; };
      const auto time = std::find_if(tree.words.begin(), tree.words.end(), is_time);
      if (time == tree.words.end() || time->value == 0 || !program_.is_read(number)) continue;
      const std::string_view text = tree.text_of(time->span());
      const bool may_be_milliseconds =
          time->known() && time->value >= kFewMilliseconds && text.find_first_of(".(") == std::string_view::npos;
      if (!may_be_milliseconds) return {};
      is_shown |= time->value > program_.thresholds().longest_dwell;
      std::string what = text.front() + dialect::written_number(time->value / 1000, 6);
      rewrites.push_back({number, {{{number, time->begin}, {number, time->end}, what}}, what});
    }
  }
  return is_shown ? rewrites : HabitRewrites{};
}

const Habits::FoundRewrites& Habits::found(Habit habit) {
  std::optional<FoundRewrites>& known = found_[static_cast<std::size_t>(habit)];
  if (known) return *known;
  switch (habit) {
    case Habit::None:
      known = FoundRewrites{};
      break;
    case Habit::CentersInG90:
    case Habit::CentersInG91:
      find_centers();
      break;
    case Habit::ForeignUnits:
      known = FoundRewrites{.rewrites = find_foreign_units()};
      break;
    case Habit::Milliseconds:
      known = FoundRewrites{.rewrites = find_milliseconds()};
      break;
  }
  return *known;
}

const HabitRewrites& Habits::rewrites(Habit habit) { return found(habit).rewrites; }

bool Habits::shows(Habit centers) { return found(centers).is_shown; }

bool Habits::leaves_open(Habit centers) { return found(centers).is_open; }

bool Habits::separates_thousands() {
  if (separates_thousands_) return *separates_thousands_;
  separates_thousands_ = false;
  for (std::size_t number = 0; number < program_.line_count() && !*separates_thousands_; ++number) {
    if (program_.text(number).find(',') == std::string_view::npos) continue;
    const LineTree tree = line(number);
    for (const syntax::Finding& finding : tree.findings) {
      const std::string_view text = tree.text_of(finding.span);
      const std::size_t comma = text.find(',');
      if (comma == std::string_view::npos || finding.id != "malformed-number"_diag) continue;
      *separates_thousands_ |= text.find_first_of(",.", comma + 1) != std::string_view::npos;
    }
  }
  return *separates_thousands_;
}

Draft habit_draft(const FixRequest& request, Habit habit) {
  const HabitRewrites& all = request.program.habits().rewrites(habit);
  const auto own = std::lower_bound(all.begin(), all.end(), request.number,
                                    [](const LineRewrite& each, std::size_t line) { return each.line < line; });
  if (own == all.end() || own->line != request.number) return {};
  return {.edits = own->edits, .what = own->what, .habit = habit};
}

}  // namespace isocnc::fixes
