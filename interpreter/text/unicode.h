#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace isocnc::text {

/// Length in bytes of the well-formed UTF-8 sequence that starts `text`; 0 if there is none. `text` must not be empty.
std::size_t sequence_length(std::string_view text);

/// Length in bytes of the sign that starts `text` and looks like a minus but is not the ASCII one, such as U+2212 or an
/// en dash, as programs get them from a word processor; 0 if there is none.
std::size_t foreign_minus_length(std::string_view text);

/// Whether a byte continues a UTF-8 character that started before it.
constexpr bool is_inside_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

/// The column of a byte, from 1, in Unicode code points; a byte that is not UTF-8 counts as one.
std::size_t column_of(std::string_view line, std::size_t byte);

/// Well-formed UTF-8 for the screen: control characters and stray bytes replaced, tabs as blanks.
std::string printable(std::string_view text);

/// The text with every character that is not printable ASCII replaced by `?`, for the comments of programs.
std::string ascii(std::string_view text);

}  // namespace isocnc::text
