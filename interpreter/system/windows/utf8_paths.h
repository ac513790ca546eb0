#pragma once

#include <filesystem>
#include <string>
#include <string_view>

// Makes a path of a std::string of UTF-8, as our strings are. GCC 12 takes the bytes for the characters of the C
// locale, which no setlocale() of msvcrt.dll makes UTF-8, but gives UTF-8 back: `più.iso` would be another file.
// The build includes this header in every source file for Windows.
template <>
inline auto std::filesystem::path::_S_convert<char>(const char* begin, const char* end) {
  return __detail::__wstr_from_utf8(std::string_view(begin, static_cast<std::size_t>(end - begin)));
}
