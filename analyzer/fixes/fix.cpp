#include "analyzer/fixes/fix.h"

#include <algorithm>

#include <fmt/format.h>

#include "analyzer/fixes/fix_table.h"

namespace isocnc::analyzer::fixes {

using dialect::DiagnosticId;

/// The rows of each code, found once: programs may have a finding on every line.
static constexpr auto kFirstRows = [] {
  std::array<std::uint8_t, dialect::kDiagnosticCount> rows{};
  rows.fill(static_cast<std::uint8_t>(kFixes.size()));
  for (std::size_t row = kFixes.size(); row-- > 0;)
    rows[static_cast<std::size_t>(kFixes[row].diagnostic)] = static_cast<std::uint8_t>(row);
  return rows;
}();
static_assert(kFixes.size() < 255);

/// Longer lines have lost their line ends; they may have thousands of findings, and to look through them for each would
/// take long.
static constexpr std::size_t kLongestLine = 1'000;

std::string Fix::title_in(dialect::Language language) const {
  return fmt::format(fmt::runtime(title.in(language)), fmt::arg("text", marked), fmt::arg("new", what));
}

std::optional<Fix> fix_of(const Place& place, Program& program) {
  const DiagnosticId id = place.finding.id;
  std::size_t row = kFirstRows[static_cast<std::size_t>(id)];
  if (row == kFixes.size() || kFixes[row].make == nullptr) return std::nullopt;
  if (program.text(place.line).size() > kLongestLine) return std::nullopt;
  const Request request{place.line, place.finding, place.on_every_path, program.line(place.line), program};
  for (; row < kFixes.size() && kFixes[row].diagnostic == id; ++row) {
    Draft draft = kFixes[row].make(request);
    if (draft.edits.empty()) continue;
    return Fix{kFixes[row].safety, kFixes[row].title, std::string(request.marked()), std::move(draft.what),
               std::move(draft.edits)};
  }
  return std::nullopt;
}

}  // namespace isocnc::analyzer::fixes
