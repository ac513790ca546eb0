#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace isocnc::lsp::documents {

/// What a client counts columns in: the units in which UTF-8, UTF-16 or UTF-32 would write the line.
enum class Encoding : std::uint8_t { Utf8, Utf16, Utf32 };

/// By its name in the protocol: `utf-16`.
std::optional<Encoding> encoding_named(std::string_view name);
std::string_view name_of(Encoding encoding);

/// Units before a byte of the line. A byte that is no UTF-8 counts as one.
std::uint32_t units_before(std::string_view line, std::size_t byte, Encoding encoding);

/// The byte at which so many units end: that of the character which they end within, and the line's end where it has
/// fewer.
std::size_t byte_at(std::string_view line, std::uint32_t units, Encoding encoding);

}  // namespace isocnc::lsp::documents
