#include "interpreter/sheet/pdf_page.h"

#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace isocnc::sheet {

/// PDF counts from the bottom, in points.
static double x_of(double mm) { return mm * 72 / 25.4; }
double PdfPage::y_of(double mm) const { return x_of(height_ - mm); }

PdfPage::PdfPage(double scale)
    : height_(kPaperHeight / scale), content_(scale == 1 ? "" : fmt::format("{0} 0 0 {0} 0 0 cm\n", scale)) {}

static std::string color_of(std::uint32_t color, std::string_view what) {
  const auto part = [&](unsigned shift) { return (color >> shift & 0xFFU) / 255.0; };
  return fmt::format("{:.3g} {:.3g} {:.3g} {}\n", part(16), part(8), part(0), what);
}

/// Text as a PDF string.
static std::string literal(std::string_view text) {
  std::string written = "(";
  for (const char c : text) {
    if (c == '(' || c == ')' || c == '\\') written += '\\';
    if (static_cast<unsigned char>(c) < 0x80) {
      written += c;
    } else {
      written += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    }
  }
  return written + ")";
}

void PdfPage::write(const PaperPoint& at, std::string_view text, PdfFont font, double size, std::uint32_t color) {
  if (text.empty()) return;
  content_ += color_of(color, "rg");
  fmt::format_to(std::back_inserter(content_), "BT /F{} {:.2f} Tf {:.2f} {:.2f} Td {} Tj ET\n",
                 font == PdfFont::Bold ? 2 : 1, x_of(size), x_of(at.x), y_of(at.y), literal(text));
}

void PdfPage::draw(const DrawnLine& line, const PaperPoint& corner) {
  if (line.points.empty()) return;
  const bool has_line = line.stroke.width > 0;
  if (has_line) content_ += color_of(line.stroke.color, "RG") + fmt::format("{:.3f} w\n", x_of(line.stroke.width));
  if (line.stroke.fill) content_ += color_of(*line.stroke.fill, "rg");
  std::string dashes;
  for (const double length : line.stroke.dashes)
    dashes += fmt::format("{}{:.1f}", dashes.empty() ? "" : " ", x_of(length));
  content_ += fmt::format("[{}] 0 d\n", dashes);
  bool is_first = true;
  for (const PaperPoint& point : line.points)
    fmt::format_to(std::back_inserter(content_), "{:.2f} {:.2f} {}\n", x_of(corner.x + point.x),
                   y_of(corner.y + point.y), std::exchange(is_first, false) ? 'm' : 'l');
  // A line to where it begins is a point, by its round ends.
  if (line.points.size() == 1)
    content_ += fmt::format("{:.2f} {:.2f} l\n", x_of(corner.x + line.points[0].x), y_of(corner.y + line.points[0].y));
  content_ += line.stroke.fill ? (has_line ? "b\n" : "f\n") : "S\n";
}

void PdfPage::draw(const Drawing& drawing, const PaperPoint& corner) {
  content_ += "1 J 1 j\n";
  for (const DrawnLine& line : drawing.lines) draw(line, corner);
  for (const DrawnText& text : drawing.texts)
    write({corner.x + text.at.x, corner.y + text.at.y}, encoded(text.text), PdfFont::Regular, 2.6, 0x333333);
}

std::string pdf_file(const std::vector<PdfPage>& pages, std::string_view title) {
  // Objects: catalog, pages, two fonts, information, then for each page itself and its content.
  constexpr std::size_t kFirstPage = 6;
  std::string file = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n";
  std::vector<std::size_t> offsets;
  const auto add = [&](std::string_view body) {
    offsets.push_back(file.size());
    file += fmt::format("{} 0 obj\n{}\nendobj\n", offsets.size(), body);
  };
  std::string kids;
  for (std::size_t i = 0; i < pages.size(); ++i) kids += fmt::format("{} 0 R ", kFirstPage + 2 * i);
  add("<< /Type /Catalog /Pages 2 0 R >>");
  add(fmt::format("<< /Type /Pages /Count {} /Kids [ {}] >>", pages.size(), kids));
  for (const std::string_view font : {"Helvetica", "Helvetica-Bold"})
    add(fmt::format("<< /Type /Font /Subtype /Type1 /BaseFont /{} /Encoding /WinAnsiEncoding >>", font));
  add(fmt::format("<< /Title {} /Producer (isorun) >>", literal(encoded(title))));
  for (std::size_t i = 0; i < pages.size(); ++i) {
    add(fmt::format(
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.2f} {:.2f}] /Resources << /Font << /F1 3 0 R /F2 4 0 R >> >> "
        "/Contents {} 0 R >>",
        x_of(kPaperWidth), x_of(kPaperHeight), kFirstPage + 2 * i + 1));
    add(fmt::format("<< /Length {} >>\nstream\n{}endstream", pages[i].content().size(), pages[i].content()));
  }
  const std::size_t table = file.size();
  file += fmt::format("xref\n0 {}\n0000000000 65535 f \n", offsets.size() + 1);
  for (const std::size_t offset : offsets) file += fmt::format("{:010} 00000 n \n", offset);
  file +=
      fmt::format("trailer\n<< /Size {} /Root 1 0 R /Info 5 0 R >>\nstartxref\n{}\n%%EOF\n", offsets.size() + 1, table);
  return file;
}

}  // namespace isocnc::sheet
