#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// A name from outside the program, such as that of a clamp in a configuration, as a number: so that findings, which
/// hold no text, can tell it. Equal names have equal numbers. Names stay until the process ends; there are few.
struct GivenName {
  std::uint32_t number = 0;  ///< 0: no name.

  /// May be called by any thread.
  static GivenName of(Text name);
  /// The name as messages show it; empty for no name. May be called by any thread.
  std::string_view in(Language language) const;

  friend bool operator==(const GivenName&, const GivenName&) = default;
};

/// A place in a file beside the program, such as where a configuration describes a clamp.
struct FilePlace {
  std::string file;          ///< As shown to users.
  std::size_t line = 0;      ///< From 0.
  std::uint32_t column = 0;  ///< Byte of the line, from 0.

  friend bool operator==(const FilePlace&, const FilePlace&) = default;
  friend bool operator<(const FilePlace& a, const FilePlace& b) {
    return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
  }
};

/// Such a place as a number, so that findings, which hold no text, can tell it. Equal places have equal numbers. Places
/// stay until the process ends; there are few.
struct GivenPlace {
  std::uint32_t number = 0;  ///< 0: none.

  /// May be called by any thread.
  static GivenPlace of(const FilePlace& place);
  explicit operator bool() const { return number != 0; }
  /// The place; stays valid. There must be one. May be called by any thread.
  const FilePlace& place() const;

  friend bool operator==(const GivenPlace&, const GivenPlace&) = default;
};

}  // namespace isocnc::dialect
