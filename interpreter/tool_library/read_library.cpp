#include "interpreter/tool_library/read_library.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "interpreter/system/paths.h"
#include "interpreter/system/source_file.h"
#include "interpreter/text/unicode.h"
#include "interpreter/tool_library/library_reader.h"
#include "interpreter/tool_library/tool_map.h"
#include "interpreter/tool_library/zip_entry.h"

namespace isocnc::tool_library {

using configuration::JsonValue;
using dialect::Language;
using dialect::Text;
using Kind = JsonValue::Kind;

namespace {

/// More than the largest libraries of manufacturers have.
constexpr std::size_t kLargestLibrary = 64 * 1024 * 1024;
constexpr std::size_t kMostTools = 10'000;

constexpr Text kUnknownFormat{
    "no library of tools by its name: .json and .tools (Fusion), .fctb and .fctl (FreeCAD), .json and .camotics "
    "(CAMotics), .tbl "
    "(LinuxCNC), .csv, .tsv and .txt (named columns) are",
    "dal nome non è una libreria di utensili: lo sono .json e .tools (Fusion), .fctb e .fctl (FreeCAD), .json e "
    ".camotics "
    "(CAMotics), .tbl (LinuxCNC), .csv, .tsv e .txt (colonne con nome)"};
constexpr Text kUnknownJson{"neither a library of Fusion, with data, nor a table of CAMotics",
                            "non è né una libreria di Fusion, con data, né una tabella di CAMotics"};
constexpr Text kNoArchive{"no archive that holds a tools.json, or a damaged one",
                          "non è un archivio con un tools.json, oppure è danneggiato"};
constexpr Text kTooLarge{"larger than any library of tools", "troppo grande per una libreria di utensili"};
constexpr Text kTooMany{"more than 10000 tools", "più di 10000 utensili"};
constexpr Text kNoBit{"{0} is no tool of FreeCAD: .fctb is needed", "{0} non è un utensile di FreeCAD: ci vuole .fctb"};
constexpr Text kMissingBit{"{0} is neither beside the library nor in ../Bit",
                           "{0} non è né accanto alla libreria né in ../Bit"};

std::string ending_of(std::string_view name) {
  const std::size_t point = name.rfind('.');
  return point == std::string_view::npos ? "" : in_small_letters(name.substr(point));
}

/// Of Windows-1252 from 0x80 to 0x9F, where Unicode has control characters; U+FFFD for five that mean nothing.
constexpr std::u32string_view kWindowsLetters =
    U"\u20AC\uFFFD\u201A\u0192\u201E\u2026\u2020\u2021\u02C6\u2030\u0160\u2039\u0152\uFFFD\u017D\uFFFD"
    U"\uFFFD\u2018\u2019\u201C\u201D\u2022\u2013\u2014\u02DC\u2122\u0161\u203A\u0153\uFFFD\u017E\u0178";

/// What spreadsheets of Windows write where they do not write UTF-8: the characters of Windows-1252, most of which have
/// the numbers of Unicode.
std::string to_utf8(std::string bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = text::sequence_length(std::string_view(bytes).substr(at));
    if (length > 0) {
      at += length;
      continue;
    }
    std::string converted;
    for (const char each : bytes) {
      const auto byte = static_cast<unsigned char>(each);
      const char32_t letter = byte >= 0x80 && byte < 0xA0 ? kWindowsLetters[byte - 0x80] : byte;
      if (letter < 0x80) {
        converted += each;
      } else if (letter < 0x800) {
        converted += static_cast<char>(0xC0 | (letter >> 6));
        converted += static_cast<char>(0x80 | (letter & 0x3F));
      } else {
        converted += static_cast<char>(0xE0 | (letter >> 12));
        converted += static_cast<char>(0x80 | ((letter >> 6) & 0x3F));
        converted += static_cast<char>(0x80 | (letter & 0x3F));
      }
    }
    return converted;
  }
  return bytes;
}

/// The bytes of a file; none after a mistake.
std::optional<std::string> read_file(const std::filesystem::path& path, Language language,
                                     std::vector<std::string>& mistakes) {
  auto bytes = system::read_bytes(path, kLargestLibrary, language);
  if (auto* const read = std::get_if<std::string>(&bytes)) return std::move(*read);
  mistakes.push_back(unread_message(path, std::get<system::FileBytesProblem>(bytes), kTooLarge, language));
  return std::nullopt;
}

/// The text of a file as JSON; none after a mistake, also where it is no object.
std::optional<JsonValue> object_in(LibraryFile& file) {
  auto parsed = configuration::parse_json(file.text());
  if (const auto* const mistake = std::get_if<configuration::Mistake>(&parsed)) {
    file.fail(mistake->at, mistake->key, mistake->text, mistake->names);
    return std::nullopt;
  }
  std::optional<JsonValue> value = std::get<JsonValue>(std::move(parsed));
  if (value->kind != Kind::Object) {
    file.fail(value->at, {}, configuration::mistakes::kNeedsObject);
    value.reset();
  }
  return value;
}

bool is_table_of_camotics(const JsonValue& value) {
  const JsonValue* const tools = member_of(value, "tools");
  const JsonValue& table = tools == nullptr ? value : *tools;
  return table.kind == Kind::Object && !table.members.empty() &&
         std::all_of(table.members.begin(), table.members.end(), [](const configuration::JsonMember& member) {
           return !member.key.empty() && member.key.find_first_not_of("0123456789") == std::string::npos;
         });
}

void read_json(LibraryFile& file, double millimeters, Library& library) {
  const std::optional<JsonValue> value = object_in(file);
  if (!value) return;
  if (member_of(*value, "data") != nullptr) {
    library.tools = read_fusion(*value, millimeters, file);
  } else if (is_table_of_camotics(*value)) {
    library.tools = read_camotics(*value, file);
  } else {
    file.fail(value->at, {}, kUnknownJson);
  }
}

/// The file of a tool that a library of FreeCAD names.
std::optional<std::filesystem::path> find_bit(const std::filesystem::path& library, const std::string& name) {
  for (const std::filesystem::path& folder : {library.parent_path(), library.parent_path() / ".." / "Bit"}) {
    std::error_code ignored;
    std::filesystem::path file = folder / name;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return std::nullopt;
}

/// The tool of an entry in a library of FreeCAD, which has a file of its own.
LibraryTool read_freecad_entry(const std::filesystem::path& library, const JsonValue& entry, const std::string& key,
                               LibraryFile& file) {
  LibraryTool tool;
  const std::string name = text_of(entry, "path");
  const std::optional<std::filesystem::path> path = find_bit(library, name);
  if (ending_of(name) != ".fctb") {
    file.fail(entry.at, key + ".path", kNoBit, {configuration::shortened(name)});
  } else if (!path) {
    file.fail(entry.at, key + ".path", kMissingBit, {configuration::shortened(name)});
  } else {
    std::vector<std::string> mistakes;
    if (std::optional<std::string> bytes = read_file(*path, file.language(), mistakes)) {
      LibraryFile bit_file(text::printable(path->generic_string()), *std::move(bytes), file.language());
      if (const std::optional<JsonValue> bit = object_in(bit_file))
        if (auto read = read_freecad_bit(*bit, bit_file)) tool = *std::move(read);
      mistakes = bit_file.mistakes();
    }
    for (const std::string& mistake : mistakes) file.add_mistake(mistake);
  }
  if (const JsonValue* const number = member_of(entry, "nr"); number != nullptr && number->kind == Kind::Number)
    tool.number = fmt::format("{:.0f}", number->number);
  return tool;
}

/// A library of FreeCAD: a list of numbers and files of tools.
void read_freecad_library(const std::filesystem::path& path, LibraryFile& file, Library& library) {
  const std::optional<JsonValue> value = object_in(file);
  if (!value) return;
  const JsonValue* const tools = member_of(*value, "tools");
  if (tools == nullptr || tools->kind != Kind::List)
    return file.fail(tools == nullptr ? value->at : tools->at, "tools", configuration::mistakes::kNeedsList);
  if (tools->elements.size() > kMostTools) return file.fail(tools->at, "tools", kTooMany);
  for (std::size_t i = 0; i < tools->elements.size(); ++i) {
    const JsonValue& entry = tools->elements[i];
    const std::string key = fmt::format("tools[{}]", i);
    LibraryTool tool = *file.entry([&] { return std::optional(read_freecad_entry(path, entry, key, file)); });
    library.tools.push_back(std::move(tool));
  }
}

Library read_bytes_of(const std::filesystem::path& path, const std::string& name, std::string bytes, bool is_in_inches,
                      Language language) {
  Library library;
  const std::string ending = ending_of(name);
  if (ending == ".tools") {
    std::optional<std::string> unpacked = zip_entry(bytes, "tools.json", kLargestLibrary);
    if (!unpacked) {
      library.mistakes.push_back(fmt::format("{}: {}", name, kNoArchive.in(language)));
      return library;
    }
    bytes = *std::move(unpacked);
  }
  LibraryFile file(name, to_utf8(std::move(bytes)), language);
  const double millimeters = is_in_inches ? kInch : 1;
  if (ending == ".json" || ending == ".camotics" || ending == ".tools") {
    read_json(file, millimeters, library);
  } else if (ending == ".fctl") {
    read_freecad_library(path, file, library);
  } else if (ending == ".fctb") {
    if (const std::optional<JsonValue> bit = object_in(file))
      if (auto tool = read_freecad_bit(*bit, file)) library.tools.push_back(*std::move(tool));
  } else if (ending == ".tbl") {
    library.tools = read_linuxcnc(file, millimeters);
  } else if (ending == ".csv" || ending == ".tsv" || ending == ".txt") {
    library.tools = read_columns(file, millimeters, library.ignored);
  } else {
    library.mistakes.push_back(fmt::format("{}: {}", name, kUnknownFormat.in(language)));
  }
  if (library.tools.size() > kMostTools) file.fail(0, {}, kTooMany);
  library.mistakes.insert(library.mistakes.begin(), file.mistakes().begin(), file.mistakes().end());
  return library;
}

}  // namespace

Library read_library(const std::filesystem::path& path, bool is_in_inches, Language language) {
  Library library;
  std::optional<std::string> bytes = read_file(path, language, library.mistakes);
  if (!bytes) return library;
  return read_bytes_of(path, text::printable(system::generic_name(path)), *std::move(bytes), is_in_inches, language);
}

Library read_library_text(const std::string& name, std::string bytes, bool is_in_inches, Language language) {
  return read_bytes_of(name, name, std::move(bytes), is_in_inches, language);
}

}  // namespace isocnc::tool_library
