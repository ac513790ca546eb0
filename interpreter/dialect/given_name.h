#pragma once

#include <cstdint>
#include <string_view>

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

}  // namespace isocnc::dialect
