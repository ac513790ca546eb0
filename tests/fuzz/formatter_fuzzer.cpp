#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analyzer/check/check_text.h"
#include "analyzer/formatting/program_formatter.h"
#include "interpreter/running/runner.h"
#include "require.h"

namespace isocnc::fuzz {

using formatting::MotionStyle;
using formatting::NumberStyle;
using formatting::ProgramStyle;

/// Nothing where the program cannot be renumbered.
static std::optional<std::string> format(std::string_view text, const ProgramStyle& style) {
  formatting::ProgramFormatter formatter(text, style);
  if (formatter.obstacle()) return std::nullopt;
  std::string formatted;
  std::size_t read = 0;
  while (const auto piece = formatter.next()) {
    require(piece->before.data() == text.data() + read, "pieces follow one another");
    read += piece->before.size();
    formatted += piece->after;
  }
  require(read == text.size(), "all of the program is formatted");
  return formatted;
}

static std::string events_of(std::string_view text) {
  std::string events;
  const running::RunOptions options{.stop_at_errors = false};
  const running::RunResult result = running::run(
      text, options, [&](const running::Event& event) { events.append(running::to_json(event)).push_back('\n'); });
  return events + std::to_string(result.line);
}

/// The codes on each line. Of a line that is wrong on several paths, the order of its words decides which of them is
/// reported, and whether the paths report the same one: where an IF cannot be read, only that is reported, so that
/// other lines are not compared.
static std::vector<std::uint64_t> findings_of(std::string_view text) {
  using namespace dialect::literals;
  const std::vector<check::LocatedFinding> found = check::check_text(text, {}).findings;
  const auto is_unreadable_if = [](const check::LocatedFinding& it) { return it.finding.id == "if-malformed"_diag; };
  const bool has_unreadable_if = std::any_of(found.begin(), found.end(), is_unreadable_if);
  std::vector<std::uint64_t> all;
  for (const check::LocatedFinding& located : found)
    if (!has_unreadable_if || is_unreadable_if(located))
      all.push_back(located.line * 1'000 + static_cast<std::uint64_t>(located.finding.id));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

static std::string ends_of(std::string_view text) {
  std::string ends;
  std::copy_if(text.begin(), text.end(), std::back_inserter(ends), [](char c) { return c == '\r' || c == '\n'; });
  return ends;
}

static void check_style(std::string_view text, const ProgramStyle& style) {
  const std::optional<std::string> once = format(text, style);
  if (!once) return;
  require(ends_of(text) == ends_of(*once), "line ends stay");
  require(format(*once, style) == once, "a second time changes nothing");
  require(events_of(text) == events_of(*once), "the program does what it did");
  require(findings_of(text) == findings_of(*once), "the same is found in it");
}

}  // namespace isocnc::fuzz

/// The first byte chooses the style.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isocnc;
  if (size == 0) return 0;
  const unsigned choice = data[0];
  formatting::ProgramStyle style;
  if ((choice & 1u) != 0) style.line.max_decimals = 2;
  if ((choice & 2u) != 0) style.line.word_order = true;
  style.line.g_digits = static_cast<syntax::GDigits>((choice >> 2) % 3);
  style.motions = static_cast<formatting::MotionStyle>((choice >> 4) % 3);
  if ((choice & 64u) != 0) style.numbers = formatting::NumberStyle{.all_lines = (choice & 128u) != 0};
  fuzz::check_style(fuzz::as_text(data + 1, size - 1), style);
  return 0;
}
