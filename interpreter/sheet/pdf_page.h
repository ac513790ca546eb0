#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "interpreter/sheet/drawing.h"
#include "interpreter/sheet/pdf_font.h"

namespace isocnc::sheet {

/// A4, mm.
inline constexpr double kPaperWidth = 210;
inline constexpr double kPaperHeight = 297;

/// A size of type in points, in mm.
constexpr double points(double size) { return size * 25.4 / 72; }

/// A page that is being drawn: mm from its top left corner, before all is scaled to paper.
class PdfPage {
 public:
  /// `scale`: mm of paper for a mm of the page, at most 1. A page of the scale 0.5 is twice as wide and as high as A4.
  explicit PdfPage(double scale);

  /// `text` in the encoding of the fonts, `size` in mm.
  void write(const PaperPoint& at, std::string_view text, PdfFont font, double size, std::uint32_t color = 0);
  void draw(const DrawnLine& line, const PaperPoint& corner = {});
  void draw(const Drawing& drawing, const PaperPoint& corner);

  const std::string& content() const { return content_; }

 private:
  double y_of(double mm) const;

  double height_;
  std::string content_;
};

/// A PDF 1.4 of these pages, in that order. The same pages give the same bytes.
std::string pdf_file(const std::vector<PdfPage>& pages, std::string_view title);

}  // namespace isocnc::sheet
