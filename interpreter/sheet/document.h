#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "interpreter/sheet/sheet.h"

namespace isocnc::sheet {

// The content of a sheet in its order, for writers of any format. Texts are UTF-8 and may contain any characters.

struct TableCell {
  std::string text;
  const Drawing* drawing = nullptr;      ///< Instead of the text; null for none.
  std::optional<PenStroke> swatch = {};  ///< Before the text: a square of its color, or a piece of a dashed line.
};

struct TableColumn {
  std::string heading;
  double width = 1;  ///< In proportion to the others.
  bool is_number = false;
  bool is_kept_whole = false;  ///< Its words are never broken.
};

struct Heading {
  std::string text;
};

/// Names, each with its value.
struct NamedValues {
  std::vector<std::pair<std::string, std::string>> rows;
};

struct Table {
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows;  ///< Each has a cell for each column.
};

/// Drawings side by side, each with its caption.
struct Drawings {
  std::vector<std::pair<const Drawing*, std::string>> each;
};

struct Paragraph {
  std::string text;
  bool is_warning = false;
};

/// Places to write on by hand.
struct Blanks {
  std::vector<std::string> names;
};

using DocumentBlock = std::variant<Heading, NamedValues, Table, Drawings, Paragraph, Blanks>;

struct SheetDocument {
  std::string title;
  std::string program;
  std::string page;  ///< `page {} of {}`, with the number and the count.
  std::vector<DocumentBlock> blocks;
};

/// `sheet` must outlive the document, which refers to its drawings.
SheetDocument document_of(const Sheet& sheet, dialect::Language language);

}  // namespace isocnc::sheet
