#include <cstddef>
#include <cstdint>
#include <string_view>

#include "analyzer/check/check_text.h"
#include "analyzer/translation/translator.h"
#include "require.h"

namespace isocnc::fuzz {

/// A machine that knows what most programs need; the first byte selects the control, and what it leaves out.
static translation::TranslationSetup setup_by(std::uint8_t choice) {
  translation::TranslationSetup setup{.control = static_cast<translation::SourceControl>(choice % 3)};
  setup.map.tools = {{1, "101001"}, {2, "101002"}};
  if ((choice & 8) != 0) setup.map.start = "101001";
  if ((choice & 16) != 0) setup.map.zeros = {{540, geometry::Vec3(350, 220, -185.5)}, {550, geometry::Vec3::Zero()}};
  if ((choice & 32) != 0) setup.map.counts_thousandths = (choice & 64) != 0;
  return setup;
}

}  // namespace isocnc::fuzz

/// The rest of the data is a program of another control: its translation has no error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isocnc;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const translation::Translation translation = translation::translate(text, fuzz::setup_by(data[0]));
  if (translation.refusal) return 0;
  // Calls of subprograms, a thousand times each, make half a million lines of a few bytes.
  constexpr std::size_t kCheckedBytes = 500'000;
  if (translation.program.size() > kCheckedBytes) return 0;
  for (const check::LocatedFinding& located : check::check_text(translation.program, {}).findings)
    fuzz::require(located.severity() != dialect::Severity::Error, "the control runs the translation to its end");
  for (const translation::TranslationFinding& finding : translation.findings)
    fuzz::require(!finding.message(dialect::Language::Italian).empty(), "each finding has its reason");
  translation::read_translation_map(text);
  return 0;
}
