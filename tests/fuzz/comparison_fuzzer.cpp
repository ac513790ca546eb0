#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "require.h"
#include "tests/comparison/compared.h"

namespace isocnc::fuzz {

using comparison::BehaviorChange;
using comparison::ChangedLines;
using comparison::RecordedRun;

/// What stands between two programs, on a line of its own.
static constexpr std::string_view kBetween = "====";

/// Two programs; of one alone, the second is the same without a line.
static std::pair<std::string, std::string> programs_in(std::string_view bytes) {
  const std::size_t between = bytes.find(kBetween);
  if (between != std::string_view::npos)
    return {std::string(bytes.substr(0, between)), std::string(bytes.substr(between + kBetween.size()))};
  std::string without(bytes);
  const std::size_t begin = without.find('\n', bytes.size() / 2);
  if (begin != std::string::npos) without.erase(begin, without.find('\n', begin + 1) - begin);
  return {std::string(bytes), std::move(without)};
}

/// A large tolerance, mm, divides curves into few chords, and so tries more programs.
static constexpr double kTolerance = 0.5;

static void require_steps(const RecordedRun& old_run, const RecordedRun& new_run) {
  std::size_t of_old = 0;
  std::size_t of_new = 0;
  for (const comparison::AlignedStep& step : aligned_steps(old_run, new_run, kTolerance)) {
    require(step.old_begin == of_old && step.new_begin == of_new, "a step begins where the one before it ends");
    of_old = step.old_end;
    of_new = step.new_end;
  }
  require(of_old == old_run.actions.size() && of_new == new_run.actions.size(), "the steps lead to both ends");
}

static void compare_programs(std::string_view bytes) {
  const auto [old_program, new_program] = programs_in(bytes);
  const RecordedRun old_run = comparison::recorded(old_program, 1);
  const RecordedRun new_run = comparison::recorded(new_program, 1);
  const comparison::ComparisonOptions options{.tolerance = kTolerance};
  for (const RecordedRun* run : {&old_run, &new_run})
    require(compare(*run, *run, options).empty(), "a program does what it does");
  const std::vector<BehaviorChange> changes = compare(old_run, new_run, options);
  require(compare(new_run, old_run, options).size() == changes.size(), "the other way around there is as much to tell");
  const auto is_within = [](const std::optional<ChangedLines>& lines, std::string_view program) {
    const auto count = static_cast<std::size_t>(
        std::count_if(program.begin(), program.end(), [](char c) { return c == '\n' || c == '\r'; }));
    return !lines || (lines->first <= lines->last && lines->last <= count);
  };
  for (const BehaviorChange& change : changes) {
    require(is_within(change.old_lines, old_program) && is_within(change.new_lines, new_program),
            "changes stand in the programs");
    for (const dialect::Language language : {dialect::Language::English, dialect::Language::Italian})
      require(!in_words(change, language).empty(), "each change has words");
  }
  require_steps(old_run, new_run);
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::compare_programs(isocnc::fuzz::as_text(data, size));
  return 0;
}
