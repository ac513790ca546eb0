#pragma once

#include <string>
#include <string_view>

namespace isocnc::text {

/// The SHA-256 of bytes (FIPS 180-4), as 64 lowercase hexadecimal digits: what `sha256sum` and Windows' `Get-FileHash`
/// show of a file.
std::string sha256(std::string_view bytes);

}  // namespace isocnc::text
