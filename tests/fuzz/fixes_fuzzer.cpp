#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "analyzer/check_text.h"
#include "analyzer/fixer.h"
#include "analyzer/selection.h"
#include "interpreter/syntax/document.h"
#include "require.h"
#include "tests/support/motions.h"

namespace isocnc::fuzz {

using Counts = std::array<int, dialect::kDiagnosticCount>;

static Counts count(std::string_view text) {
  Counts counts{};
  for (const analyzer::LocatedFinding& located : analyzer::check_text(text, {}).findings)
    ++counts[static_cast<std::size_t>(located.finding.id)];
  return counts;
}

static void check_fixes(std::string_view text, bool unsafe, double vgpl) {
  const analyzer::Selection selection;
  const execution::Setup setup;
  const analyzer::FixedText fixed =
      analyzer::fix_text(text, {.selection = selection, .setup = setup, .unsafe = unsafe});
  require(fixed.origins.size() == syntax::Document(fixed.text).line_count(), "each line has its origin");
  if (fixed.fixed == 0) require(fixed.text == text, "without a fix nothing changes");
  const Counts before = count(text);
  const Counts after = count(fixed.text);
  for (std::size_t code = 0; code < before.size(); ++code) {
    const dialect::DiagnosticId id{static_cast<std::uint8_t>(code)};
    require(after[code] <= before[code] || dialect::definition(id).is_off,
            "no fix brings a finding that is told by default");
  }
  if (unsafe || fixed.fixed == 0) return;
  const std::string motions = support::motions_of(text, vgpl);
  require(motions.empty() || motions == support::motions_of(fixed.text, vgpl),
          "a safe fix leaves what the program does");
}

}  // namespace isocnc::fuzz

/// The first bit chooses whether unsafe fixes are made, the next three the operator's VGPL. What holds a zero byte is
/// no program to isolint.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0 && std::find(data + 1, data + size, 0) == data + size)
    isocnc::fuzz::check_fixes(isocnc::fuzz::as_text(data + 1, size - 1), (data[0] & 1) != 0, data[0] >> 1 & 7);
  return 0;
}
