#include "lsp/protocol/encoding.h"

#include <algorithm>
#include <array>
#include <utility>

#include "interpreter/text/unicode.h"

namespace isocnc::protocol {

static constexpr std::array<std::pair<std::string_view, Encoding>, 3> kNames{
    {{"utf-8", Encoding::Utf8}, {"utf-16", Encoding::Utf16}, {"utf-32", Encoding::Utf32}}};

std::optional<Encoding> encoding_named(std::string_view name) {
  for (const auto& [known, encoding] : kNames)
    if (known == name) return encoding;
  return std::nullopt;
}

std::string_view name_of(Encoding encoding) { return kNames[static_cast<std::size_t>(encoding)].first; }

namespace {

/// One character of a line: its length in bytes and in units.
struct CharacterStep {
  std::size_t bytes;
  std::uint32_t units;
};

CharacterStep step_at(std::string_view rest, Encoding encoding) {
  const std::size_t bytes = std::max<std::size_t>(1, text::sequence_length(rest));
  if (encoding == Encoding::Utf8) return {bytes, static_cast<std::uint32_t>(bytes)};
  return {bytes, encoding == Encoding::Utf16 && bytes == 4 ? 2u : 1u};
}

}  // namespace

std::uint32_t units_before(std::string_view line, std::size_t byte, Encoding encoding) {
  byte = std::min(byte, line.size());
  if (encoding == Encoding::Utf8) return static_cast<std::uint32_t>(byte);
  std::uint32_t units = 0;
  for (std::size_t at = 0; at < byte;) {
    const CharacterStep step = step_at(line.substr(at), encoding);
    if (at + step.bytes > byte) break;
    at += step.bytes;
    units += step.units;
  }
  return units;
}

std::size_t byte_at(std::string_view line, std::uint32_t units, Encoding encoding) {
  std::size_t at = 0;
  for (std::uint32_t passed = 0; at < line.size() && passed < units;) {
    const CharacterStep step = step_at(line.substr(at), encoding);
    if (passed + step.units > units) break;
    passed += step.units;
    at += step.bytes;
  }
  return at;
}

}  // namespace isocnc::protocol
