#pragma once

#include <string>
#include <string_view>

namespace isocnc::text {

/// Escapes text for XML elements and attributes. Characters that XML forbids even escaped become U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace isocnc::text
