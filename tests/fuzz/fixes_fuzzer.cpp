#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "analyzer/fixing/fixer.h"
#include "analyzer/selection/selection.h"
#include "interpreter/syntax/document.h"
#include "require.h"
#include "tests/support/fixed_program.h"
#include "tests/support/motions.h"

namespace isocnc::fuzz {

static void check_fixes(std::string_view text, bool unsafe, double vgpl) {
  const selection::Selection selection;
  const rules::CheckSetup setup;
  const fixing::FixedText fixed = fixing::fix_text(text, {.selection = selection, .setup = setup, .unsafe = unsafe});
  require(fixed.origins.size() == syntax::Document(fixed.text).line_count(), "each line has its origin");
  if (fixed.fixed == 0) require(fixed.text == text, "without a fix nothing changes");
  const std::multiset<std::string> before = support::without_what_units_reveal(support::codes_of(text), text);
  const std::multiset<std::string> after = support::without_what_units_reveal(support::codes_of(fixed.text), text);
  require(std::includes(before.begin(), before.end(), after.begin(), after.end()), "no fix brings a finding");
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
