#include "analyzer/fixing/fixer.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>

#include "analyzer/check/check_text.h"
#include "analyzer/check/folding.h"
#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/selection/style_findings.h"
#include "analyzer/selection/suppressions.h"
#include "analyzer/selection/tally.h"

namespace isocnc::fixing {

using fixes::Edit;
using fixes::Fix;
using fixes::Safety;

namespace {

/// The maximum number of bytes checked, depending on the text's size: a bound for hostile programs, in which most fixes
/// are undone.
constexpr std::size_t kMinWork = 64'000'000;
constexpr std::size_t kWorkPerByte = 40;
/// The number of times that the cause of a new finding is guessed before it is searched for by halving.
constexpr int kMaxGuesses = 4;

/// A fix that may be applied.
struct FixCandidate {
  check::LocatedFinding located;
  std::vector<Edit> edits;  // The edits, sorted.
  fixes::Habit habit = fixes::Habit::None;
};

/// The identity of a finding (line, code, column), used to recognize it after lines have moved.
using FindingKey = std::tuple<std::size_t, dialect::DiagnosticId, std::uint32_t>;
FindingKey key_of(const check::LocatedFinding& located) {
  return {located.line, located.finding.id, located.finding.span.begin};
}

/// A text, its findings, and those of them to be fixed.
struct Version {
  std::string text;
  check::Report found;   // All findings.
  check::Report to_fix;  // The selected findings after the filter.
  std::size_t filtered_out = 0;
  std::vector<std::size_t> origins;
};

/// Parts of a text that are already edited.
class Taken {
 public:
  /// Takes the parts, unless one of them overlaps a taken one. Two parts may touch, except at an insertion, because the
  /// order would be ambiguous.
  bool take(std::vector<std::pair<std::size_t, std::size_t>> parts) {
    std::sort(parts.begin(), parts.end());
    if (std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return meets(part.first, part.second); }))
      return false;
    for (const auto& [begin, end] : parts) taken_.emplace_hint(taken_.end(), begin, end);
    return true;
  }

 private:
  bool meets(std::size_t begin, std::size_t end) const {
    const auto next = taken_.lower_bound(begin);
    if (next != taken_.end() && conflict(begin, end, next->first, next->second)) return true;
    if (next == taken_.begin()) return false;
    const auto before = std::prev(next);
    return conflict(before->first, before->second, begin, end);
  }
  static bool conflict(std::size_t begin, std::size_t end, std::size_t next_start, std::size_t next_end) {
    return next_start < end || (next_start == end && (begin == end || next_start == next_end));
  }

  std::multimap<std::size_t, std::size_t> taken_;
};

/// The lines of a text before and after edits.
struct LineMap {
  std::vector<std::size_t> new_lines;  // The new line of each old line.
  std::vector<std::size_t> origins;    // The original line of each new line.
};

/// Tracks the lines of a text through sorted edits; `origins` are the original lines of its lines.
class LineFollower {
 public:
  explicit LineFollower(const std::vector<std::size_t>& origins) : origins_(origins), origin_(origins.front()) {
    map_.new_lines.resize(origins.size());
  }

  LineMap follow(const std::vector<Edit>& edits) {
    for (const Edit& edit : edits) {
      leave_lines_up_to(edit.begin.line);
      pass(edit);
    }
    leave_lines_up_to(origins_.size() - 1);
    map_.origins.push_back(origin_);
    return std::move(map_);
  }

 private:
  void enter(std::size_t line) {
    line_ = line;
    map_.new_lines[line] = map_.origins.size();
  }

  void leave_lines_up_to(std::size_t line) {
    while (line_ < line) {
      map_.origins.push_back(origin_);
      enter(line_ + 1);
      origin_ = origins_[line_];
    }
  }

  /// Text inserted at the start of a line is above that line; elsewhere, the part after a new line end is the new line.
  void pass(const Edit& edit) {
    const bool is_above = edit.begin.column == 0;
    for (auto left = std::count(edit.text.begin(), edit.text.end(), '\n'); left > 0; --left) {
      map_.origins.push_back(is_above ? FixedText::kNew : origin_);
      if (!is_above) origin_ = FixedText::kNew;
    }
    if (is_above) enter(line_);
    while (line_ < edit.end.line) {
      enter(line_ + 1);
      if (is_above) origin_ = origins_[line_];
    }
  }

  const std::vector<std::size_t>& origins_;
  LineMap map_;
  std::size_t line_ = 0;  // The current old line.
  std::size_t origin_;    // The origin of the new line being built.
};

/// The result of applying candidates together.
struct FixBatch {
  Version version;
  LineMap lines;
  bool is_good = false;
};

class Fixer {
 public:
  Fixer(std::string_view text, const FixOptions& options)
      : options_(options), work_budget_(kMinWork + kWorkPerByte * text.size()) {
    present_ = checked(std::string(text));
    std::vector<std::size_t>& origins = present_.origins;
    origins.resize(TextProgram(present_.text, options.setup).line_count());
    std::iota(origins.begin(), origins.end(), std::size_t{0});
  }

  FixedText run() {
    while (work_budget_ > 0) {
      const std::vector<FixCandidate> all = candidates();
      if (!all.empty()) {
        make_some_of(all);
      } else if (undone_.empty() || !changed_since_undone_) {
        break;
      } else {  // After other changes they may succeed.
        undone_.clear();
        undone_habits_ = {};
        changed_since_undone_ = false;
      }
    }
    // Of a mistake on several lines, perhaps only some are fixed.
    const std::size_t fixed = std::max<std::size_t>(fixed_, has_changed_ ? 1 : 0);
    return {std::move(present_.text), check::folded(std::move(present_.to_fix)), fixed, present_.filtered_out,
            std::move(present_.origins)};
  }

 private:
  Version checked(std::string text) {
    work_budget_ -= std::min(work_budget_, text.size() + 1);
    Version version{.text = std::move(text)};
    version.found = check::check_text(version.text, options_.setup, options_.jobs);
    version.found = selection::with_style(std::move(version.found), version.text, options_.selection);
    std::erase_if(version.found.findings, [&](const check::LocatedFinding& located) {
      const dialect::DiagnosticId id = located.finding.id;
      return dialect::definition(id).is_off && !options_.selection.shows(id);  // Not requested.
    });
    version.found = selection::suppress(std::move(version.found), version.text, options_.selection);
    version.to_fix = options_.selection.shown(version.found);
    const std::size_t selected = check::folded_size(version.to_fix);
    if (options_.finding_filter) version.to_fix = options_.finding_filter(std::move(version.to_fix), version.text);
    version.filtered_out = selected - check::folded_size(version.to_fix);
    return version;
  }

  /// The fixes that can be applied together, in the order of the program. The rewrites of a habit are applied alone.
  std::vector<FixCandidate> candidates() const {
    std::vector<FixCandidate> all;
    FindingFixes fixes(present_.text, present_.found, options_.setup);
    Taken taken;
    std::set<std::int32_t> mended;  // Mistakes whose first fix removes the findings below as well.
    for (const check::LocatedFinding& located : present_.to_fix.findings) {
      if (undone_.contains(key_of(located)) || mended.contains(located.mistake)) continue;
      std::optional<Fix> fix = fixes.of(located);
      if (!fix || (fix->safety == Safety::Unsafe && !options_.unsafe)) continue;
      if (fix->mends_repetitions && located.mistake >= 0) mended.insert(located.mistake);
      if (fix->habit != fixes::Habit::None) {
        if (undone_habits_[static_cast<std::size_t>(fix->habit)]) continue;
        return {{located, all_edits(*fix, fixes.program()), fix->habit}};
      }
      std::vector<std::pair<std::size_t, std::size_t>> parts;
      for (const Edit& edit : fix->edits)
        parts.emplace_back(fixes.program().offset(edit.begin), fixes.program().offset(edit.end));
      if (taken.take(std::move(parts))) all.push_back({.located = located, .edits = std::move(fix->edits)});
    }
    return all;
  }

  FixBatch made(const std::vector<FixCandidate>& candidates) {
    std::vector<Edit> edits;
    for (const FixCandidate& candidate : candidates)
      edits.insert(edits.end(), candidate.edits.begin(), candidate.edits.end());
    FixBatch trial;
    std::string text = edited(present_.text, edits, TextProgram(present_.text, options_.setup));
    trial.version = checked(std::move(text));
    trial.lines = LineFollower(present_.origins).follow(edits);
    const fixes::Habit habit = candidates.empty() ? fixes::Habit::None : candidates.front().habit;
    trial.is_good = habit == fixes::Habit::None ? is_good(trial.version.found, candidates.size())
                                                : reads_better(present_.found, trial.version.found, habit);
    return trial;
  }

  /// Whether each fix has removed its finding, and no code is found more often.
  bool is_good(const check::Report& found, std::size_t made) const {
    selection::Tally before;
    selection::Tally after;
    before.add(present_.found);
    after.add(found);
    for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i) {
      const dialect::DiagnosticId id{static_cast<std::uint8_t>(i)};
      if (after.of(id) > before.of(id)) return false;
    }
    return found.findings.size() + made <= present_.found.findings.size();
  }

  /// Applies as many candidates as a few attempts allow; at least one is applied, or one is given up.
  void make_some_of(std::vector<FixCandidate> all) {
    FixBatch trial = made(all);
    for (int i = 0; i < kMaxGuesses && !trial.is_good && work_budget_ > 0; ++i) {
      std::vector<FixCandidate> unsuspected = without_suspects(all, trial);
      if (unsuspected.empty() || unsuspected.size() == all.size()) break;
      all = std::move(unsuspected);
      trial = made(all);
    }
    // Halves the candidates until they are good, or one is left.
    while (!trial.is_good && all.size() > 1 && work_budget_ > 0) {
      all.resize((all.size() + 1) / 2);
      trial = made(all);
    }
    if (trial.is_good) return accept(std::move(trial));
    for (const FixCandidate& candidate : all) {
      undone_.insert(key_of(candidate.located));
      undone_habits_[static_cast<std::size_t>(candidate.habit)] = true;
    }
  }

  /// Removes the candidates that are nearest above the new findings.
  std::vector<FixCandidate> without_suspects(const std::vector<FixCandidate>& all, const FixBatch& trial) const {
    const auto place = [](std::size_t line, dialect::DiagnosticId id) {
      return std::uint64_t{line} << 8 | static_cast<std::uint64_t>(id);
    };
    std::unordered_map<std::uint64_t, std::int64_t> expected;
    for (const check::LocatedFinding& located : present_.found.findings)
      ++expected[place(trial.lines.new_lines[located.line], located.finding.id)];
    std::vector<std::size_t> first_lines;
    for (const FixCandidate& candidate : all) {
      const check::LocatedFinding& located = candidate.located;
      --expected[place(trial.lines.new_lines[located.line], located.finding.id)];
      const std::size_t above = first_lines.empty() ? 0 : first_lines.back();
      first_lines.push_back(std::max(above, first_new_line(candidate, trial.lines)));
    }
    std::vector<bool> suspected(all.size());
    for (const check::LocatedFinding& located : trial.version.found.findings) {
      if (--expected[place(located.line, located.finding.id)] >= 0) continue;
      const auto after = std::upper_bound(first_lines.begin(), first_lines.end(), located.line);
      if (after != first_lines.begin()) suspected[static_cast<std::size_t>(after - first_lines.begin()) - 1] = true;
    }
    std::vector<FixCandidate> unsuspected;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!suspected[i]) unsuspected.push_back(all[i]);
    return unsuspected;
  }

  /// The first line that the candidate changes or inserts.
  static std::size_t first_new_line(const FixCandidate& candidate, const LineMap& lines) {
    std::size_t first = lines.new_lines[candidate.located.line];
    for (const Edit& edit : candidate.edits) {
      const bool is_above = edit.begin.column == 0;
      const auto inserted = is_above ? std::count(edit.text.begin(), edit.text.end(), '\n') : 0;
      const std::size_t line = lines.new_lines[edit.begin.line];
      first = std::min(first, line - std::min(line, static_cast<std::size_t>(inserted)));
    }
    return first;
  }

  /// Counts the fixed findings of each code. New findings are not subtracted.
  void count_fixed(const Version& next) {
    selection::Tally before;
    selection::Tally after;
    before.add(check::folded(present_.to_fix));
    after.add(check::folded(next.to_fix));
    for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i) {
      const dialect::DiagnosticId id{static_cast<std::uint8_t>(i)};
      fixed_ += before.of(id) - std::min(before.of(id), after.of(id));
    }
  }

  void accept(FixBatch trial) {
    std::set<FindingKey> undone;
    for (const auto& [line, id, begin] : undone_) undone.emplace(trial.lines.new_lines[line], id, begin);
    undone_ = std::move(undone);
    count_fixed(trial.version);
    present_ = std::move(trial.version);
    present_.origins = std::move(trial.lines.origins);
    changed_since_undone_ = true;
    has_changed_ = true;
  }

  const FixOptions& options_;
  std::size_t work_budget_;
  Version present_;
  std::set<FindingKey> undone_;  // Findings whose fix was rejected.
  std::array<bool, fixes::kHabitCount> undone_habits_{};
  bool changed_since_undone_ = false;
  bool has_changed_ = false;
  std::size_t fixed_ = 0;
};

}  // namespace

FixedText fix_text(std::string_view text, const FixOptions& options) { return Fixer(text, options).run(); }

}  // namespace isocnc::fixing
