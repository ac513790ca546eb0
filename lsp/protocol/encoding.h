#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace isocnc::protocol {

/// The unit in which a client counts columns: a code unit of UTF-8, UTF-16 or UTF-32.
enum class Encoding : std::uint8_t { Utf8, Utf16, Utf32 };

/// The encoding with this name in the protocol, such as `utf-16`.
std::optional<Encoding> encoding_named(std::string_view name);
std::string_view name_of(Encoding encoding);

/// The number of units before a byte of the line. An invalid byte counts as one unit.
std::uint32_t units_before(std::string_view line, std::size_t byte, Encoding encoding);

/// The byte after this number of units. If they end within a character, the first byte of that character; if the line
/// is shorter, its end.
std::size_t byte_at(std::string_view line, std::uint32_t units, Encoding encoding);

}  // namespace isocnc::protocol
