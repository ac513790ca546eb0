#include <algorithm>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include "interpreter/tool_library/library_reader.h"

namespace isocnc::tool_library {

using dialect::Text;

static constexpr Text kNoEntry{"{0} is no entry of a tool table, such as T1, P1, D6 or Z40",
                               "{0} non è una voce di una tabella utensili, come T1, P1, D6 o Z40"};
static constexpr Text kLineWithoutTool{"a line of a tool table needs a T with a number",
                                       "una riga di una tabella utensili vuole una T con un numero"};

/// A line such as `T1 P1 D6.0 Z+40.5 ;end mill`. Q, I and J belong to lathes, P to the changer, X to W to other axes.
static std::optional<LibraryTool> read_line(std::string_view line, std::size_t at, double millimeters,
                                            LibraryFile& file) {
  const std::size_t comment = std::min(line.find(';'), line.size());
  std::string_view entries = line.substr(0, comment);
  LibraryTool read;
  if (comment < line.size()) read.tool.name = trimmed(line.substr(comment + 1));
  bool has_entries = false;
  for (std::size_t begin = entries.find_first_not_of(" \t"); begin != std::string_view::npos;
       begin = entries.find_first_not_of(" \t", begin)) {
    has_entries = true;
    const std::size_t end = std::min(entries.find_first_of(" \t", begin), entries.size());
    const std::string_view entry = entries.substr(begin, end - begin);
    begin = end;
    const char letter =
        entry.front() >= 'a' && entry.front() <= 'z' ? static_cast<char>(entry.front() - 'a' + 'A') : entry.front();
    std::string_view digits = entry.substr(1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double number = 0;
    const auto parsed = fast_float::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool is_known = std::string_view("TPXYZABCUVWDIJQ").find(letter) != std::string_view::npos;
    if (!is_known || parsed.ec != std::errc{} || parsed.ptr != digits.data() + digits.size()) {
      file.fail(at + static_cast<std::size_t>(entry.data() - line.data()), {}, kNoEntry,
                {configuration::shortened(entry)});
      return read;
    }
    const double length = tidy(number * millimeters);
    if (letter == 'T' && number >= 0 && number < 1e9) read.number = fmt::format("{:.0f}", number);
    if ((letter == 'D' || letter == 'Z') && std::abs(length) > kLongest) {
      file.fail(at + static_cast<std::size_t>(entry.data() - line.data()), {}, problems::kNeedsLength,
                {configuration::shortened(digits)});
      return read;
    }
    if (letter == 'D' && length > 0) read.tool.radius = tidy(length / 2);
    // An offset below 0 counts from another tool, or from the table.
    if (letter == 'Z' && length > 0) read.tool.length = length;
  }
  if (!has_entries) return std::nullopt;
  if (read.number.empty()) file.fail(at, {}, kLineWithoutTool);
  return read;
}

std::vector<LibraryTool> read_linuxcnc(LibraryFile& file, double millimeters) {
  std::vector<LibraryTool> tools;
  const std::string_view text = file.text();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (auto tool = file.entry([&] { return read_line(line, at, millimeters, file); }))
      tools.push_back(*std::move(tool));
    at = end + 1;
  }
  return tools;
}

}  // namespace isocnc::tool_library
