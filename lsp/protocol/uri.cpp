#include "lsp/protocol/uri.h"

#include <algorithm>
#include <charconv>
#include <iterator>

#include <fmt/format.h>

#include "analyzer/formats/rendering.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/configuration/shape_files.h"
#include "interpreter/dialect/any_case.h"
#include "interpreter/system/paths.h"

namespace isocnc::protocol {

/// Decodes escapes such as %20, a blank. An invalid escape stays unchanged.
static std::string unescaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const char* const digits = text.data() + i + 1;
    const bool is_escape =
        text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
    result.push_back(is_escape ? static_cast<char>(byte) : text[i]);
    if (is_escape) i += 2;
  }
  return result;
}

std::optional<std::filesystem::path> path_of(std::string_view uri) {
  static constexpr std::string_view kScheme = "file://";
  if (!dialect::begins_with(uri, kScheme)) return std::nullopt;
  std::string_view rest = uri.substr(kScheme.size());
  rest = rest.substr(0, rest.find_first_of("?#"));
  // A host may precede the path; for this machine it is usually omitted.
  const std::size_t slash = rest.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const std::string_view host = rest.substr(0, slash) == "localhost" ? "" : rest.substr(0, slash);
  const std::string path = unescaped(rest.substr(slash));
  if (path.find('\0') != std::string::npos) return std::nullopt;
  // Where names have roots, on Windows: file:///c:/part.iso and file://server/share/part.iso.
  const std::filesystem::path rooted = host.empty() ? path.substr(1) : fmt::format("//{}{}", host, path);
  if (system::has_root_name(rooted)) return system::normal(rooted);
  return host.empty() ? std::optional(system::normal(std::filesystem::path(path))) : std::nullopt;
}

std::string name_in(std::string_view uri) { return unescaped(uri.substr(uri.find_last_of("/:") + 1)); }

bool names_configuration(std::string_view uri) {
  const auto path = path_of(uri);
  return path && (path->filename() == configuration::kFileName || configuration::is_setup_file(*path));
}

bool names_shape(std::string_view uri) {
  const auto path = path_of(uri);
  const auto has = [&](std::string_view extension) {
    return dialect::ends_with(path->filename().generic_string(), extension);
  };
  return path &&
         std::any_of(std::begin(configuration::kShapeExtensions), std::end(configuration::kShapeExtensions), has);
}

std::string uri_of(const std::filesystem::path& path) { return formats::uri_of(system::generic_name(path)); }

static constexpr std::string_view kLineKey = "line=";
static constexpr std::string_view kProgramKey = "program=";

std::optional<TextAboutProgram> read_text_uri(std::string_view uri) {
  const std::string start = fmt::format("{}://", kTextScheme);
  const std::size_t question_mark = uri.find('?');
  if (!dialect::begins_with(uri, start) || question_mark == std::string_view::npos) return std::nullopt;
  const std::string_view rest = uri.substr(start.size(), question_mark - start.size());
  TextAboutProgram text;
  text.kind = rest.substr(0, rest.find('/'));
  // Some editors escape the marks between the members of a query as well. The URI of the program is escaped twice.
  const std::string unescaped_query = unescaped(uri.substr(question_mark + 1));
  std::string_view query = unescaped_query;
  if (query.starts_with(kLineKey)) {
    query.remove_prefix(kLineKey.size());
    std::uint32_t line = 0;
    const auto read = std::from_chars(query.data(), query.data() + query.size(), line);
    if (read.ec != std::errc{} || read.ptr == query.data() + query.size() || *read.ptr != '&') return std::nullopt;
    text.line = line;
    query.remove_prefix(static_cast<std::size_t>(read.ptr + 1 - query.data()));
  }
  if (!query.starts_with(kProgramKey)) return std::nullopt;
  text.program = query.substr(kProgramKey.size());
  return text;
}

std::string uri_of(const TextAboutProgram& text) {
  const std::string line = text.line ? fmt::format("{}{}&", kLineKey, *text.line) : "";
  return fmt::format("{}://{}/{}.{}?{}{}{}", kTextScheme, text.kind, formats::in_uri(name_in(text.program)), text.kind,
                     line, kProgramKey, formats::in_uri(text.program));
}

}  // namespace isocnc::protocol
