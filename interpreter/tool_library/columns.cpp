#include "interpreter/tool_library/columns.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include "interpreter/configuration/keys.h"
#include "interpreter/running/event.h"
#include "interpreter/tool_library/library_reader.h"
#include "interpreter/tool_library/tool_map.h"

namespace isocnc::tool_library {

using configuration::Configuration;
using configuration::Key;
using configuration::KeyKind;
using configuration::Tool;
using dialect::Language;
using dialect::Text;

namespace {

constexpr Text kNoHeader{"the first line of a table names its columns, such as T;name;length;diameter",
                         "la prima riga di una tabella dà i nomi alle colonne, per esempio T;nome;lunghezza;diametro"};
constexpr Text kTwoColumns{"two columns are called {0}", "due colonne si chiamano {0}"};
constexpr Text kTwoColumnsOfOneFact{"the columns {0} and {1} say the same",
                                    "le colonne {0} e {1} dicono la stessa cosa"};
constexpr Text kUnitOfSome{"this heading has no unit, and {0} has one: give each length its unit",
                           "questa intestazione non ha l'unità, {0} sì: darla a ogni lunghezza"};
constexpr Text kTooManyCells{
    "a row with more cells than there are columns; decimals with a comma need another separator",
    "una riga con più celle che colonne; i decimali con la virgola vogliono un altro separatore"};
constexpr Text kOpenQuote{"a quote without its closing one", "virgolette senza quelle di chiusura"};
constexpr Text kNoNumber{"{0} is no number", "{0} non è un numero"};
constexpr Text kOutOfRange{"{0} is outside of what {1} may be", "{0} è fuori da ciò che {1} può essere"};
constexpr Text kNoChoice{"{0} is not one of {1}", "{0} non è fra {1}"};
constexpr Text kNoProfile{"an outline is pairs of numbers, z and radius: 0 1.5 3 4",
                          "un contorno è coppie di numeri, z e raggio: 0 1.5 3 4"};

// Columns that are no keys of isocnc.json.
constexpr std::string_view kPlace = "T";
constexpr std::string_view kNumber = "number";
constexpr std::string_view kDiameter = "diameter";
constexpr std::string_view kUnit = "unit";
constexpr Text kMeasuredLength{"measured length", "lunghezza misurata"};
constexpr Text kMeasuredRadius{"measured radius", "raggio misurato"};

/// Other names of columns, in small letters.
struct Alias {
  std::string_view written;
  std::string_view column;
};
constexpr Alias kAliases[] = {{"t", kPlace},
                              {"place", kPlace},
                              {"posto", kPlace},
                              {"number", kNumber},
                              {"numero", kNumber},
                              {"nr", kNumber},
                              {"diameter", kDiameter},
                              {"diametro", kDiameter},
                              {"unit", kUnit},
                              {"units", kUnit},
                              {"unit\xC3\xA0", kUnit},
                              {"unita", kUnit},
                              {"description", "name"},
                              {"descrizione", "name"},
                              {"nome", "name"},
                              {"testa", "head"},
                              {"portautensile", "holder"},
                              {"utensile", "tool"},
                              {"lunghezza", "length"},
                              {"raggio", "radius"},
                              {"forma", "shape"},
                              {"profilo", "profile"},
                              {"raggio spigolo", "cornerRadius"},
                              {"corner radius", "cornerRadius"},
                              {"angolo", "tipAngle"},
                              {"tip angle", "tipAngle"},
                              {"lunghezza tagliente", "cutLength"},
                              {"cut length", "cutLength"},
                              {"passata massima", "maxDepth"},
                              {"max depth", "maxDepth"},
                              {"gambo", "shank"},
                              {"mandrino", "body"},
                              {"measured length", kMeasuredLength.en},
                              {"lunghezza misurata", kMeasuredLength.en},
                              {"measured radius", kMeasuredRadius.en},
                              {"raggio misurato", kMeasuredRadius.en}};

/// What a column is called here, however it is written; empty if nothing is.
std::string_view column_called(std::string_view written) {
  const std::string small = in_small_letters(written);
  for (const Key* key : tool_keys())
    if (in_small_letters(key->name()) == small) return key->name();
  for (const Alias& alias : kAliases)
    if (alias.written == small) return alias.column;
  return {};
}

/// Whether a spreadsheet would take a text for a formula. It is written after an apostrophe, and so is what would be
/// read as such a text: `'=1`.
bool is_like_formula(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  return !text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos;
}

/// How many mm a unit has; none for an unknown one.
std::optional<double> millimeters_in(std::string_view unit) {
  if (unit == "mm" || unit == "millimeters" || unit == "millimetri") return 1;
  if (unit == "inch" || unit == "inches" || unit == "in" || unit == "\"" || unit == "pollici") return kInch;
  return std::nullopt;
}

/// A cell with its place in the text.
struct CsvCell {
  std::string text;  ///< With the blanks that stand in quotes.
  std::size_t at = 0;
};
using CsvRow = std::vector<CsvCell>;

/// Divides a table into rows without the empty ones. Quoted cells may hold separators, ends of lines and blanks around
/// their text; "" is a quote in them.
class RowReader {
 public:
  RowReader(LibraryFile& file, char separator) : file_(file), text_(file.text()), separator_(separator) {}

  /// The next row; none at the end, and after a mistake.
  std::optional<CsvRow> next() {
    while (at_ < text_.size()) {
      CsvRow row;
      do {
        std::optional<CsvCell> cell = next_cell();
        if (!cell) return std::nullopt;
        row.push_back(*std::move(cell));
      } while (take(separator_));
      take('\r');
      take('\n');
      if (std::any_of(row.begin(), row.end(), [](const CsvCell& cell) { return !cell.text.empty(); })) return row;
    }
    return std::nullopt;
  }

 private:
  bool take(char expected) {
    const bool is_there = at_ < text_.size() && text_[at_] == expected;
    if (is_there) ++at_;
    return is_there;
  }

  std::optional<CsvCell> next_cell() {
    while (at_ < text_.size() && (text_[at_] == ' ' || (text_[at_] == '\t' && separator_ != '\t'))) ++at_;
    CsvCell cell{{}, at_};
    if (take('"')) {
      while (true) {
        const std::size_t quote = text_.find('"', at_);
        if (quote == std::string_view::npos) {
          file_.fail(cell.at, {}, kOpenQuote);
          at_ = text_.size();
          return std::nullopt;
        }
        cell.text += text_.substr(at_, quote - at_);
        at_ = quote + 1;
        if (!take('"')) break;
        cell.text += '"';
      }
    }
    const std::size_t end = std::min(text_.find_first_of(std::string{separator_, '\r', '\n'}, at_), text_.size());
    const std::string_view unquoted = text_.substr(at_, end - at_);
    cell.text += unquoted.substr(0, unquoted.find_last_not_of(" \t") + 1);
    if (cell.text.starts_with('\'') && is_like_formula(cell.text)) cell.text.erase(0, 1);
    at_ = end;
    return cell;
  }

  LibraryFile& file_;
  std::string_view text_;
  char separator_;
  std::size_t at_ = 0;
};

/// The separator that the first line has most of.
char separator_of(std::string_view text) {
  const std::string_view header = text.substr(0, text.find('\n'));
  char best = ';';
  std::ptrdiff_t most = 0;
  for (const char separator : {';', '\t', ','}) {
    const std::ptrdiff_t count = std::count(header.begin(), header.end(), separator);
    if (count <= most) continue;
    best = separator;
    most = count;
  }
  return best;
}

/// A number with a decimal point, or with a comma.
std::optional<double> number_in(std::string text) {
  if (std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos) text[text.find(',')] = '.';
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double number = 0;
  const auto read = fast_float::from_chars(begin, text.data() + text.size(), number);
  const bool is_number = read.ec == std::errc{} && read.ptr == text.data() + text.size() && std::isfinite(number);
  return is_number ? std::optional(number) : std::nullopt;
}

/// Reads the cells of one tool.
class ToolRow {
 public:
  ToolRow(LibraryFile& file, double millimeters) : file_(file), millimeters_(millimeters) {
    configuration_.machine.tools.emplace(1);
  }

  /// The unit of this tool, where its row says one.
  void read_unit(const CsvCell& cell) {
    const std::string unit = in_small_letters(trimmed(cell.text));
    if (const std::optional<double> millimeters = millimeters_in(unit)) {
      millimeters_ = *millimeters;
    } else if (!unit.empty()) {
      file_.fail(cell.at, std::string(kUnit), problems::kUnknownUnit,
                 {configuration::shortened(cell.text), std::string("mm, inch")});
    }
  }

  /// `millimeters` is that of the unit in the heading of the column, which counts before that of the row.
  void read(std::string_view column, std::optional<double> millimeters, const CsvCell& cell) {
    if (cell.text.empty() || column == kUnit) return;
    const double of_row = std::exchange(millimeters_, millimeters.value_or(millimeters_));
    const Key* const key = tool_key(column);
    if (key != nullptr && key->kind == KeyKind::Text) {
      *std::get<std::string*>(key->slot(configuration_, {0, 0})) = cell.text;
    } else if (const CsvCell bare{std::string(trimmed(cell.text)), cell.at}; !bare.text.empty()) {
      read(column, bare);
    }
    millimeters_ = of_row;
  }

  LibraryTool take() {
    if (measured_length_) tool().length = measured_length_;
    if (measured_radius_) tool().radius = measured_radius_;
    // Of anything but a bull nose, a 0 is what libraries write for what they leave open.
    if (tool().corner_radius == 0 && tool().shape != "bull") tool().corner_radius.reset();
    const execution::ToolCode& code = tool().code;
    return {.number = std::move(number_),
            .tool = tool(),
            .has_place = code.head > 0 && code.holder > 0 && code.tool > 0,
            .holder = {},
            .kind_without_shape = {},
            .mistakes = {}};
  }

 private:
  Tool& tool() { return configuration_.machine.tools->front(); }

  /// In mm. What is in mm stays the number that it is.
  double in_millimeters(double number) const { return millimeters_ == 1 ? number : tidy(number * millimeters_); }

  /// `cell` has something in it, without blanks around that.
  void read(std::string_view column, const CsvCell& cell) {
    if (column == kNumber) {
      number_ = cell.text;
    } else if (column == kPlace) {
      read_place(cell);
    } else if (column == kDiameter) {
      if (const auto diameter = length("diameter", cell)) tool().radius = *diameter / 2;
    } else if (column == kMeasuredLength.en) {
      measured_length_ = length(column, cell);
    } else if (column == kMeasuredRadius.en) {
      measured_radius_ = length(column, cell);
    } else if (const Key* const key = tool_key(column)) {
      read_key(*key, cell);
    }
  }

  void fail(std::string_view column, const CsvCell& cell, const Text& why,
            std::vector<configuration::Named> more = {}) {
    more.insert(more.begin(), configuration::shortened(cell.text));
    file_.fail(cell.at, std::string(column), why, std::move(more));
  }

  std::optional<double> length(std::string_view column, const CsvCell& cell) {
    const std::optional<double> number = number_in(cell.text);
    if (number && *number == 0) return std::nullopt;
    const double length = in_millimeters(number.value_or(0));
    if (length > 0 && length <= kLongest) return length;
    fail(column, cell, number ? problems::kNeedsLength : kNoNumber);
    return std::nullopt;
  }

  void read_place(const CsvCell& cell) {
    const auto place = read_tool_place(cell.text);
    if (const auto* const code = std::get_if<execution::ToolCode>(&place)) {
      tool().code = *code;
    } else {
      fail(kPlace, cell, std::get<Text>(place));
    }
  }

  void read_key(const Key& key, const CsvCell& cell) {
    using Slot = configuration::ValueSlot;
    const Slot slot = key.slot(configuration_, {0, 0});
    if (key.kind == KeyKind::Choice) {
      const std::string choice = in_small_letters(cell.text);
      if (std::find(key.choices.begin(), key.choices.end(), choice) == key.choices.end())
        return fail(key.name(), cell, kNoChoice, {fmt::format("{}", fmt::join(key.choices, ", "))});
      *std::get<std::string*>(slot) = choice;
    } else if (key.kind == KeyKind::Rows) {
      read_profile(cell);
    } else if (const std::optional<double> number = number_in(cell.text); !number) {
      fail(key.name(), cell, kNoNumber);
    } else if (int* const* const whole = std::get_if<int*>(&slot)) {
      if (*number != std::floor(*number) || *number < key.range.minimum || *number > key.range.maximum)
        return fail(key.name(), cell, kOutOfRange, {std::string(key.name())});
      **whole = static_cast<int>(*number);
    } else {
      const double value = key.unit.en == "mm" ? in_millimeters(*number) : *number;
      const bool may_be_0 = key.range.minimum < 0 || (key.range.minimum == 0 && !key.range.exclusive_minimum);
      if (value == 0 && !may_be_0) return;  // As libraries write what they leave open.
      if (value < key.range.minimum || value > key.range.maximum)
        return fail(key.name(), cell, kOutOfRange, {std::string(key.name())});
      *std::get<std::optional<double>*>(slot) = value;
    }
  }

  void read_profile(const CsvCell& cell) {
    configuration::NumberRows rows;
    bool is_whole = true;
    for (std::size_t at = cell.text.find_first_not_of(' '); at != std::string::npos;) {
      const std::size_t end = std::min(cell.text.find(' ', at), cell.text.size());
      const std::optional<double> number = number_in(cell.text.substr(at, end - at));
      if (!number || *number < 0 || *number > kLongest) return fail("profile", cell, kNoProfile);
      if (is_whole) rows.emplace_back();
      rows.back().push_back(in_millimeters(*number));
      is_whole = !is_whole;
      at = cell.text.find_first_not_of(' ', end);
    }
    if (!is_whole || rows.size() < 2) return fail("profile", cell, kNoProfile);
    tool().profile = std::move(rows);
  }

  LibraryFile& file_;
  double millimeters_;
  Configuration configuration_;  // Keys write into it.
  std::string number_;
  std::optional<double> measured_length_;
  std::optional<double> measured_radius_;
};

/// A column of a table; its name is empty if it is not read.
struct HeadedColumn {
  std::string_view name;
  std::optional<double> millimeters;  ///< Of its unit, if its heading says one.
};

bool is_length(std::string_view column) {
  if (column == kDiameter || column == kMeasuredLength.en || column == kMeasuredRadius.en) return true;
  const Key* const key = tool_key(column);
  return key != nullptr && key->unit.en == "mm";
}

/// A heading without a unit beside one whose unit is another than that of the table was most likely meant in that one.
void check_units(const CsvRow& header, const std::vector<HeadedColumn>& columns, double millimeters,
                 LibraryFile& file) {
  const auto has_other_unit = [&](const HeadedColumn& column) {
    return column.millimeters.value_or(millimeters) != millimeters;
  };
  const auto other = std::find_if(columns.begin(), columns.end(), has_other_unit);
  const bool has_units =
      std::any_of(columns.begin(), columns.end(), [](const HeadedColumn& column) { return column.name == kUnit; });
  if (other == columns.end() || has_units) return;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (!columns[i].millimeters && is_length(columns[i].name))
      file.fail(header[i].at, std::string(columns[i].name), kUnitOfSome, {std::string(other->name)});
}

/// The column of each cell of a row, in a table whose unit has so many mm.
std::vector<HeadedColumn> read_header(const CsvRow& header, double millimeters, LibraryFile& file,
                                      std::vector<std::string>& ignored) {
  std::vector<HeadedColumn> columns;
  const auto has = [&](std::string_view name) {
    return std::any_of(columns.begin(), columns.end(), [&](const HeadedColumn& column) { return column.name == name; });
  };
  for (const CsvCell& cell : header) {
    // `length (mm)`, `length [inch]`
    const std::size_t bracket = std::min(cell.text.find_first_of("(["), cell.text.size());
    const std::string_view written = trimmed(std::string_view(cell.text).substr(0, bracket));
    HeadedColumn column{column_called(written), {}};
    if (column.name.empty() && !cell.text.empty()) ignored.push_back(configuration::shortened(cell.text));
    if (!column.name.empty() && has(column.name)) file.fail(cell.at, {}, kTwoColumns, {std::string(column.name)});
    if (!column.name.empty() && bracket < cell.text.size()) {
      const std::size_t end = cell.text.find_first_of(")]", bracket);
      const std::string unit = in_small_letters(cell.text.substr(bracket + 1, end - bracket - 1));
      column.millimeters = millimeters_in(unit);
      const bool is_angle = unit == "deg" || unit == "degrees" || unit == "gradi" || unit == "\xC2\xB0";
      if (!column.millimeters && !is_angle)
        file.fail(cell.at, std::string(column.name), problems::kUnknownUnit,
                  {configuration::shortened(unit), std::string("mm, inch")});
    }
    columns.push_back(column);
  }
  check_units(header, columns, millimeters, file);
  if (std::all_of(columns.begin(), columns.end(), [](const HeadedColumn& column) { return column.name.empty(); }))
    file.fail(header.front().at, {}, kNoHeader);
  constexpr std::pair<std::string_view, std::string_view> kSameFacts[] = {
      {kPlace, "head"}, {kPlace, "holder"}, {kPlace, "tool"}, {kDiameter, "radius"}};
  for (const auto& [one, other] : kSameFacts)
    if (has(one) && has(other))
      file.fail(header.front().at, {}, kTwoColumnsOfOneFact, {std::string(one), std::string(other)});
  return columns;
}

/// Writes cells as spreadsheets of a language read them.
class CellWriter {
 public:
  explicit CellWriter(Language language)
      : separator_(language == Language::Italian ? ';' : ','), is_comma_decimal_(language == Language::Italian) {}

  void add(std::string_view text) {
    if (!is_first_) text_ += separator_;
    is_first_ = false;
    // What a spreadsheet would take for a formula stays a text.
    const bool is_formula = is_like_formula(text);
    const bool has_blanks_around = trimmed(text).size() != text.size();
    if (!is_formula && !has_blanks_around && text.find_first_of("\",;\t\r\n") == std::string_view::npos) {
      text_ += text;
      return;
    }
    text_ += '"';
    if (is_formula) text_ += '\'';
    for (const char letter : text) text_ += letter == '"' ? "\"\"" : std::string(1, letter);
    text_ += '"';
  }

  void add(std::optional<double> number) {
    std::string digits = number ? fmt::format("{}", *number) : "";
    if (is_comma_decimal_) std::replace(digits.begin(), digits.end(), '.', ',');
    if (!is_first_) text_ += separator_;
    is_first_ = false;
    text_ += digits.find(separator_) == std::string::npos ? digits : fmt::format("\"{}\"", digits);
  }

  void end_row() {
    text_ += "\r\n";
    is_first_ = true;
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  char separator_;
  bool is_comma_decimal_;
  bool is_first_ = true;
};

}  // namespace

std::vector<LibraryTool> read_columns(LibraryFile& file, double millimeters, std::vector<std::string>& ignored) {
  RowReader rows(file, separator_of(file.text()));
  const std::optional<CsvRow> header = rows.next();
  if (!header) {
    if (file.mistakes().empty()) file.fail(0, {}, kNoHeader);
    return {};
  }
  const std::vector<HeadedColumn> columns = read_header(*header, millimeters, file, ignored);
  if (!file.mistakes().empty()) return {};
  std::vector<LibraryTool> tools;
  const auto read_row = [&](const CsvRow& row) -> std::optional<LibraryTool> {
    ToolRow tool(file, millimeters);
    const std::size_t count = std::min(row.size(), columns.size());
    for (std::size_t i = count; i < row.size(); ++i)
      if (!row[i].text.empty()) {
        file.fail(row[i].at, {}, kTooManyCells);
        break;
      }
    for (std::size_t i = 0; i < count; ++i)
      if (columns[i].name == kUnit) tool.read_unit(row[i]);
    for (std::size_t i = 0; i < count; ++i) tool.read(columns[i].name, columns[i].millimeters, row[i]);
    return tool.take();
  };
  while (const std::optional<CsvRow> row = rows.next()) tools.push_back(*file.entry([&] { return read_row(*row); }));
  return tools;
}

std::string columns_of(const std::vector<Tool>& tools, Language language) {
  const std::vector<const Key*> keys = tool_keys();
  const auto is_place = [](const Key* key) { return key->is_required; };
  CellWriter cells(language);
  cells.add(kPlace);
  for (const Key* key : keys)
    if (!is_place(key)) cells.add(key->name());
  cells.end_row();
  Configuration configuration;  // Keys read from it.
  for (const Tool& tool : tools) {
    configuration.machine.tools = {tool};
    cells.add(running::tool_name(tool.code));
    for (const Key* key : keys) {
      if (is_place(key)) continue;
      const configuration::ValueSlot slot = key->slot(configuration, {0, 0});
      if (const auto* const text = std::get_if<std::string*>(&slot)) {
        cells.add(**text);
      } else if (const auto* const rows = std::get_if<std::optional<configuration::NumberRows>*>(&slot)) {
        std::string numbers;
        if (**rows)
          for (const std::vector<double>& row : ***rows)
            numbers += fmt::format("{}{} {}", numbers.empty() ? "" : " ", row[0], row[1]);
        cells.add(numbers);
      } else {
        cells.add(*std::get<std::optional<double>*>(slot));
      }
    }
    cells.end_row();
  }
  return cells.take();
}

std::string presetter_list(const std::vector<Tool>& tools, Language language) {
  constexpr Text kHeads[] = {{"name", "nome"}, {"length", "lunghezza"}, {"radius", "raggio"}};
  CellWriter cells(language);
  cells.add(kPlace);
  for (const Text& head : kHeads) cells.add(head.in(language));
  cells.add(kMeasuredLength.in(language));
  cells.add(kMeasuredRadius.in(language));
  cells.end_row();
  for (const Tool& tool : tools) {
    cells.add(running::tool_name(tool.code));
    cells.add(tool.name);
    cells.add(tool.length);
    cells.add(tool.radius);
    cells.add(std::string_view());
    cells.add(std::string_view());
    cells.end_row();
  }
  return cells.take();
}

}  // namespace isocnc::tool_library
