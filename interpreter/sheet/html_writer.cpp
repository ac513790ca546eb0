#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpreter/dialect/locale.h"
#include "interpreter/sheet/document.h"
#include "interpreter/text/xml.h"

namespace isocnc::sheet {

namespace {

/// Prints on A4 and on Letter; a heading stays with what follows it.
constexpr std::string_view kStyle = R"(
@page { size: A4; margin: 12mm; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 12mm; max-width: 210mm; color: #1a1a1a; background: #fff; font: 9pt/1.3 Helvetica, Arial, sans-serif; }
header { display: flex; justify-content: space-between; align-items: baseline; gap: 6mm; border-bottom: 0.6mm solid #1a1a1a; }
h1 { margin: 0; font-size: 16pt; }
header strong { font-size: 13pt; overflow-wrap: anywhere; }
h2 { margin: 4mm 0 1mm; font-size: 10.5pt; break-after: avoid; }
table { width: 100%; border-collapse: collapse; }
th, td { padding: 0.8mm 1.5mm; text-align: left; vertical-align: middle; border-bottom: 0.2mm solid #c8ccd0; overflow-wrap: anywhere; }
th { font-size: 8pt; color: #555; }
tr { break-inside: avoid; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.whole { white-space: nowrap; }
.facts { display: grid; grid-template-columns: max-content 1fr; gap: 0.6mm 4mm; margin: 2mm 0; }
.facts dt { color: #555; max-width: 60mm; }
.facts dd { margin: 0; overflow-wrap: anywhere; }
.drawings { display: flex; flex-wrap: wrap; justify-content: space-between; gap: 4mm; margin: 3mm 0; }
figure { margin: 0; break-inside: avoid; }
figcaption { color: #555; font-size: 8pt; }
.swatch { display: inline-block; width: 2.6mm; height: 2.6mm; margin-right: 1.5mm; }
.dashes { display: inline-block; margin-right: 1.5mm; vertical-align: middle; line-height: 0; }
.warning { padding: 1.5mm 2mm; border: 0.4mm solid #b42318; color: #b42318; font-weight: bold; }
.blanks { display: flex; gap: 6mm; margin-top: 10mm; break-inside: avoid; }
.blanks span { flex: 1; border-top: 0.2mm solid #555; padding-top: 1mm; color: #555; font-size: 8pt; }
@media print { body { padding: 0; max-width: none; font-size: 8pt; line-height: 1.2; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  th, td { padding: 0.35mm 1.5mm; } h2 { margin-top: 2.5mm; } .facts { gap: 0.2mm 4mm; } .drawings { margin: 1.5mm 0; } p { margin: 1mm 0; } .blanks { margin-top: 8mm; } }
)";

std::string hex(std::uint32_t color) { return fmt::format("#{:06x}", color); }

void append_drawing(std::string& html, const Drawing& drawing) {
  fmt::format_to(std::back_inserter(html),
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.4g}mm\" height=\"{1:.4g}mm\" viewBox=\"0 0 "
                 "{0:.4g} {1:.4g}\" "
                 "fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">",
                 drawing.width, drawing.height);
  for (const DrawnLine& line : drawing.lines) {
    fmt::format_to(std::back_inserter(html), "<path stroke=\"{}\" stroke-width=\"{:g}\"", hex(line.stroke.color),
                   line.stroke.width);
    if (!line.stroke.dashes.empty())
      fmt::format_to(std::back_inserter(html), " stroke-dasharray=\"{:g}\"", fmt::join(line.stroke.dashes, " "));
    if (line.stroke.fill) fmt::format_to(std::back_inserter(html), " fill=\"{}\"", hex(*line.stroke.fill));
    html += " d=\"";
    bool is_first = true;
    for (const PaperPoint& point : line.points)
      fmt::format_to(std::back_inserter(html), "{}{:.2f} {:.2f}", std::exchange(is_first, false) ? 'M' : 'L', point.x,
                     point.y);
    if (line.points.size() == 1) html += "h0";
    html += "\"/>";
  }
  for (const DrawnText& text : drawing.texts)
    fmt::format_to(std::back_inserter(html),
                   "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"2.6\" fill=\"#333\">{}</text>", text.at.x, text.at.y,
                   text::xml_escaped(text.text));
  html += "</svg>";
}

/// The mark of what is drawn so.
void append_swatch(std::string& html, PenStroke stroke) {
  if (stroke.dashes.empty()) {
    html += fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>", hex(stroke.color));
    return;
  }
  stroke.width = 0.5;
  html += "<span class=\"dashes\">";
  append_drawing(html, {.width = 6, .height = 2.6, .lines = {{stroke, {{0.3, 1.3}, {5.7, 1.3}}}}, .texts = {}});
  html += "</span>";
}

/// Writes each kind of block.
class HtmlWriter {
 public:
  explicit HtmlWriter(std::string& html) : html_(html) {}

  void operator()(const Heading& heading) { add("<h2>{}</h2>\n", heading.text); }
  void operator()(const NamedValues& facts) {
    html_ += "<dl class=\"facts\">";
    for (const auto& [name, value] : facts.rows) {
      add("<dt>{}</dt>", name);
      add("<dd>{}</dd>", value);
    }
    html_ += "</dl>\n";
  }
  void operator()(const Table& table) {
    html_ += "<table><thead><tr>";
    for (const TableColumn& column : table.columns) {
      html_ += column.is_number ? "<th class=\"number\">" : "<th>";
      add("{}</th>", column.heading);
    }
    html_ += "</tr></thead><tbody>\n";
    for (const std::vector<TableCell>& row : table.rows) {
      html_ += "<tr>";
      for (std::size_t i = 0; i < row.size(); ++i) {
        html_ += table.columns[i].is_number       ? "<td class=\"number\">"
                 : table.columns[i].is_kept_whole ? "<td class=\"whole\">"
                                                  : "<td>";
        if (row[i].swatch) append_swatch(html_, *row[i].swatch);
        if (row[i].drawing != nullptr) append_drawing(html_, *row[i].drawing);
        add("{}</td>", row[i].text);
      }
      html_ += "</tr>\n";
    }
    html_ += "</tbody></table>\n";
  }
  void operator()(const Drawings& drawings) {
    html_ += "<div class=\"drawings\">";
    for (const auto& [drawing, caption] : drawings.each) {
      html_ += "<figure>";
      append_drawing(html_, *drawing);
      add("<figcaption>{}</figcaption></figure>", caption);
    }
    html_ += "</div>\n";
  }
  void operator()(const Paragraph& paragraph) {
    html_ += paragraph.is_warning ? "<p class=\"warning\">" : "<p>";
    add("{}</p>\n", paragraph.text);
  }
  void operator()(const Blanks& blanks) {
    html_ += "<div class=\"blanks\">";
    for (const std::string& name : blanks.names) add("<span>{}</span>", name);
    html_ += "</div>\n";
  }

 private:
  void add(fmt::format_string<std::string> format, const std::string& text) {
    fmt::format_to(std::back_inserter(html_), format, text::xml_escaped(text));
  }

  std::string& html_;
};

}  // namespace

std::string html_of(const Sheet& sheet, dialect::Language language) {
  const SheetDocument document = document_of(sheet, language);
  const std::string title = text::xml_escaped(document.title);
  const std::string program = text::xml_escaped(document.program);
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
      "<title>{} - {}</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<header><h1>{}</h1><strong>{}</strong></header>\n",
      dialect::name_of(language), program, title, kStyle, title, program);
  HtmlWriter writer(html);
  for (const DocumentBlock& block : document.blocks) std::visit(writer, block);
  return html + "</body>\n</html>\n";
}

}  // namespace isocnc::sheet
