#pragma once

#include <string>
#include <string_view>

namespace isocnc::sheet {

/// The two fonts that every PDF reader has, in the encoding of Windows for Western Europe.
enum class PdfFont { Regular, Bold };

/// UTF-8 in the encoding of the fonts; other characters become `?`.
std::string encoded(std::string_view utf8);

/// The width of text in the encoding of the fonts, in the unit of `size`.
double width_of(std::string_view encoded, PdfFont font, double size);

}  // namespace isocnc::sheet
