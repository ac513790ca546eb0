#include <algorithm>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/sheet/document.h"
#include "interpreter/sheet/pdf_page.h"

namespace isocnc::sheet {

namespace {

constexpr double kPageMargin = 12;
constexpr double kFoot = 6;  ///< With the number of the page.
constexpr double kType = points(8.5);
constexpr double kSmallType = points(7.5);
constexpr double kLineHeight = 1.28;  ///< Of the size of type.
constexpr double kPadding = 1.4;      ///< Beside the text of a cell.
constexpr double kRowGap = 0.9;       ///< Above and below it.
constexpr double kSwatch = 2.4;
constexpr double kDashedSwatch = 6;
constexpr std::uint32_t kGray = 0x555555;
constexpr std::uint32_t kRule = 0xC8CCD0;
constexpr std::uint32_t kWarning = 0xB42318;

/// Breaks encoded text into lines of a width: at blanks, and where a word alone is wider.
std::vector<std::string> wrapped(std::string_view text, PdfFont font, double size, double width) {
  std::vector<std::string> lines;
  std::string line;
  const auto fits = [&](std::string_view candidate) { return width_of(candidate, font, size) <= width; };
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    std::string word(text.substr(0, blank));
    text.remove_prefix(std::min(text.size(), blank + 1));
    if (fits(line.empty() ? word : line + " " + word)) {
      line += (line.empty() ? "" : " ") + word;
      continue;
    }
    if (!line.empty()) lines.push_back(std::exchange(line, ""));
    while (word.size() > 1 && !fits(word)) {
      std::size_t count = word.size() - 1;
      while (count > 1 && !fits(std::string_view(word).substr(0, count))) --count;
      lines.push_back(word.substr(0, count));
      word.erase(0, count);
    }
    line = std::move(word);
  }
  if (!line.empty() || lines.empty()) lines.push_back(std::move(line));
  return lines;
}

/// Places the blocks on pages, from the top down.
class PdfWriter {
 public:
  PdfWriter(const SheetDocument& document, double scale)
      : document_(document),
        scale_(scale),
        width_(kPaperWidth / scale - 2 * kPageMargin),
        bottom_(kPaperHeight / scale - kPageMargin - kFoot) {
    begin_page();
    const std::string title = encoded(document.title);
    page().write({kPageMargin, y_ + points(13)}, title, PdfFont::Bold, points(16));
    const double left = kPageMargin + width_of(title, PdfFont::Bold, points(16)) + 8;
    const std::string name =
        wrapped(encoded(document.program), PdfFont::Bold, points(12), kPageMargin + width_ - left)[0];
    page().write({kPageMargin + width_ - width_of(name, PdfFont::Bold, points(12)), y_ + points(13)}, name,
                 PdfFont::Bold, points(12));
    y_ += points(18);
    rule(0.6, 0);
    y_ += 2;
  }

  void operator()(const Heading& heading) {
    make_room(30);  // With the first rows of what follows.
    y_ += 3.5;
    page().write({kPageMargin, y_ + points(10)}, encoded(heading.text), PdfFont::Bold, points(10));
    y_ += points(10) * kLineHeight + 0.8;
  }
  void operator()(const NamedValues& facts) {
    double names = 0;
    for (const auto& [name, value] : facts.rows)
      names = std::max(names, width_of(encoded(name), PdfFont::Regular, kType));
    names = std::min(names, width_ / 3);
    for (const auto& [name, value] : facts.rows) {
      const auto left = wrapped(encoded(name), PdfFont::Regular, kType, names);
      const auto right = wrapped(encoded(value), PdfFont::Regular, kType, width_ - names - 4);
      for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
        make_room(kType * kLineHeight);
        if (i < left.size()) page().write({kPageMargin, y_ + kType}, left[i], PdfFont::Regular, kType, kGray);
        if (i < right.size()) page().write({kPageMargin + names + 4, y_ + kType}, right[i], PdfFont::Regular, kType);
        y_ += kType * kLineHeight;
      }
      y_ += 0.4;
    }
    y_ += 1;
  }
  void operator()(const Table& table) {
    double sum = 0;
    for (const TableColumn& column : table.columns) sum += column.width;
    columns_.clear();
    for (double left = kPageMargin; const TableColumn& column : table.columns) {
      columns_.push_back({left, column.width / sum * width_, column.is_number});
      left += columns_.back().width;
    }
    write_head(table);
    for (const std::vector<TableCell>& row : table.rows) write_row(table, row);
    y_ += 1;
  }
  void operator()(const Drawings& drawings) {
    double height = 0;
    for (const auto& [drawing, caption] : drawings.each) height = std::max(height, drawing->height);
    make_room(height + 6);
    double left = kPageMargin;
    for (const auto& [drawing, caption] : drawings.each) {
      page().draw(*drawing, {left, y_});
      page().write({left, y_ + drawing->height + 3.5}, encoded(caption), PdfFont::Regular, kSmallType, kGray);
      left += drawing->width +
              (width_ - widths_of(drawings)) / std::max<double>(1, static_cast<double>(drawings.each.size()) - 1);
    }
    y_ += height + 6;
  }
  void operator()(const Paragraph& paragraph) {
    const PdfFont font = paragraph.is_warning ? PdfFont::Bold : PdfFont::Regular;
    for (const std::string& line : wrapped(encoded(paragraph.text), font, kType, width_)) {
      make_room(kType * kLineHeight);
      page().write({kPageMargin, y_ + kType}, line, font, kType, paragraph.is_warning ? kWarning : 0);
      y_ += kType * kLineHeight;
    }
    y_ += 1;
  }
  void operator()(const Blanks& blanks) {
    make_room(20);
    y_ += 14;
    const double width =
        (width_ - 6 * static_cast<double>(blanks.names.size() - 1)) / static_cast<double>(blanks.names.size());
    double left = kPageMargin;
    for (const std::string& name : blanks.names) {
      page().draw({{.color = kGray, .width = 0.2}, {{left, y_}, {left + width, y_}}});
      page().write({left, y_ + 3.5}, encoded(name), PdfFont::Regular, kSmallType, kGray);
      left += width + 6;
    }
    y_ += 6;
  }

  bool is_one_page() const { return pages_.size() == 1; }

  std::string finish() {
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      const std::string number = encoded(fmt::format(fmt::runtime(document_.page), i + 1, pages_.size()));
      const double y = bottom_ + kFoot;
      pages_[i].write({kPageMargin + width_ - width_of(number, PdfFont::Regular, kSmallType), y}, number,
                      PdfFont::Regular, kSmallType, kGray);
      if (i > 0) pages_[i].write({kPageMargin, y}, encoded(document_.program), PdfFont::Regular, kSmallType, kGray);
    }
    return pdf_file(pages_, document_.program + " - " + document_.title);
  }

 private:
  struct PlacedColumn {
    double left = 0;
    double width = 0;
    bool is_number = false;
  };

  PdfPage& page() { return pages_.back(); }
  void begin_page() {
    pages_.emplace_back(scale_);
    y_ = kPageMargin;
  }
  /// Goes to the next page where so much does not fit any more.
  bool make_room(double height) {
    if (y_ + height <= bottom_ || y_ == kPageMargin) return false;
    begin_page();
    return true;
  }
  void rule(double width, std::uint32_t color) {
    page().draw({{.color = color, .width = width}, {{kPageMargin, y_}, {kPageMargin + width_, y_}}});
  }
  static double widths_of(const Drawings& drawings) {
    double sum = 0;
    for (const auto& [drawing, caption] : drawings.each) sum += drawing->width;
    return sum;
  }

  void write_head(const Table& table) {
    make_room(12);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::string text = encoded(table.columns[i].heading);
      page().write({text_left(columns_[i], width_of(text, PdfFont::Bold, kSmallType)), y_ + kSmallType}, text,
                   PdfFont::Bold, kSmallType, kGray);
    }
    y_ += kSmallType * kLineHeight + 0.6;
    rule(0.2, kRule);
  }

  static double text_left(const PlacedColumn& column, double width) {
    return column.is_number ? column.left + column.width - kPadding - width : column.left + kPadding;
  }

  void write_row(const Table& table, const std::vector<TableCell>& row) {
    std::vector<std::vector<std::string>> texts;
    std::size_t lines = 1;
    double drawing = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      texts.push_back(wrapped(encoded(row[i].text), PdfFont::Regular, kType,
                              columns_[i].width - 2 * kPadding - swatch_width(row[i])));
      lines = std::max(lines, texts.back().size());
      if (row[i].drawing != nullptr) drawing = std::max(drawing, row[i].drawing->height);
    }
    // A row that no page holds goes on on the next one.
    const auto most = static_cast<std::size_t>((bottom_ - kPageMargin - 12) / (kType * kLineHeight));
    for (std::size_t first = 0; first < lines; first += most) {
      const std::size_t count = std::min(most, lines - first);
      const double height = std::max(static_cast<double>(count) * kType * kLineHeight, first == 0 ? drawing : 0);
      if (make_room(height + 2 * kRowGap)) write_head(table);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const auto begin = texts[i].begin() + static_cast<std::ptrdiff_t>(std::min(first, texts[i].size()));
        const auto end = texts[i].begin() + static_cast<std::ptrdiff_t>(std::min(first + count, texts[i].size()));
        write_cell(first == 0 ? row[i] : TableCell{}, {begin, end}, columns_[i], height);
      }
      y_ += height + 2 * kRowGap;
    }
    rule(0.15, kRule);
  }

  /// With the gap before the text.
  static double swatch_width(const TableCell& cell) {
    if (!cell.swatch) return 0;
    return (cell.swatch->dashes.empty() ? kSwatch : kDashedSwatch) + 1.4;
  }

  void draw_swatch(PenStroke stroke, double left, double middle) {
    if (!stroke.dashes.empty()) {
      stroke.width = 0.5;
      return page().draw({stroke, {{left, middle}, {left + kDashedSwatch, middle}}});
    }
    page().draw(
        {{.color = 0, .width = 0, .fill = stroke.color}, {{0, 0}, {kSwatch, 0}, {kSwatch, kSwatch}, {0, kSwatch}}},
        {left, middle - kSwatch / 2});
  }

  /// In the middle of the height of its row.
  void write_cell(const TableCell& cell, const std::vector<std::string>& lines, const PlacedColumn& column,
                  double height) {
    const double middle = y_ + kRowGap + height / 2;
    if (cell.drawing != nullptr)
      page().draw(*cell.drawing,
                  {column.left + (column.width - cell.drawing->width) / 2, middle - cell.drawing->height / 2});
    const double left = swatch_width(cell);
    if (cell.swatch) draw_swatch(*cell.swatch, column.left + kPadding, middle);
    double y = middle - static_cast<double>(lines.size()) * kType * kLineHeight / 2 + kType;
    for (const std::string& line : lines) {
      page().write({text_left(column, width_of(line, PdfFont::Regular, kType)) + left, y}, line, PdfFont::Regular,
                   kType);
      y += kType * kLineHeight;
    }
  }

  const SheetDocument& document_;
  double scale_;
  double width_;
  double bottom_;
  std::vector<PdfPage> pages_;
  double y_ = 0;  ///< Where the next block begins.
  std::vector<PlacedColumn> columns_;
};

}  // namespace

std::string pdf_of(const Sheet& sheet, dialect::Language language) {
  const SheetDocument document = document_of(sheet, language);
  const auto written = [&](double scale) {
    PdfWriter writer(document, scale);
    for (const DocumentBlock& block : document.blocks) std::visit(writer, block);
    return writer;
  };
  // One page at a size that can be read is better than two.
  for (const double scale : {1.0, 0.9, 0.8, 0.72})
    if (PdfWriter writer = written(scale); writer.is_one_page()) return writer.finish();
  return written(1).finish();
}

}  // namespace isocnc::sheet
