#pragma once

#include <string>
#include <string_view>

namespace isocnc::syntax {

/// Text for an XML document, inside elements and attributes alike: what XML cannot hold, even escaped, becomes U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace isocnc::syntax
