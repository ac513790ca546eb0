#include "lsp/documents/configuration_diagnostics.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/read.h"
#include "interpreter/system/source_file.h"
#include "interpreter/text/characters.h"
#include "interpreter/text/unicode.h"

namespace isocnc::documents {

namespace fs = std::filesystem;
using configuration::Mistake;
using dialect::Language;
using system::SourceFile;

/// The end of the value, key or sign that starts at `at`.
static std::size_t end_of_token(std::string_view text, std::size_t at) {
  if (at >= text.size()) return at;
  const char first = text[at];
  std::size_t end = at + 1;
  if (first == '"') {
    while (end < text.size() && text[end] != '"' && !text::is_line_end(text[end])) end += text[end] == '\\' ? 2 : 1;
    return std::min(end + 1, text.size());
  }
  if (std::string_view("{}[]:,").find(first) != std::string_view::npos) return end;
  end = text.find_first_of(" \t\r\n,:]}", at);
  return std::max(std::min(end, text.size()), at + std::max<std::size_t>(1, text::sequence_length(text.substr(at))));
}

static protocol::ClientRange range_of(std::string_view text, std::size_t at, protocol::Encoding encoding) {
  at = std::min(at, text.size());
  const char* const end = text.data() + text.size();
  const char* begin = text.data();
  std::uint32_t line = 0;
  for (const char* line_end = text::find_line_end(begin, end); line_end < text.data() + at && line_end != end;
       line_end = text::find_line_end(begin, end)) {
    begin = text::skip_line_end(line_end, end);
    ++line;
  }
  const char* const line_end = text::find_line_end(begin, end);
  const std::string_view content(begin, static_cast<std::size_t>(line_end - begin));
  const auto column = static_cast<std::size_t>(text.data() + at - begin);
  const auto place = [&](std::size_t byte) {
    return protocol::ClientPosition{line, protocol::units_before(content, byte, encoding)};
  };
  return {place(column), place(column + (end_of_token(text, at) - at))};
}

static Json diagnostic(const protocol::ClientRange& range, const std::string& message) {
  return {{"range", range}, {"severity", 1}, {"source", "isolint"}, {"message", message}};
}

namespace {

/// What the text of a file says.
struct DescribedFile {
  std::vector<Mistake> mistakes;
  std::vector<configuration::ShapeFile> shapes;

  void add(const std::optional<configuration::ShapeFile>& shape) {
    if (shape) shapes.push_back(*shape);
  }
  void add(const configuration::DescribedSetup& setup) {
    if (setup.stock) add(setup.stock->shape.mesh);
    if (setup.stock) add(setup.stock->from);
    for (const configuration::DescribedBody& fixture : setup.fixtures) add(fixture.shape.mesh);
    if (setup.target) add(setup.target->mesh);
  }
};

}  // namespace

static DescribedFile described_in(std::string_view text, const fs::path& file) {
  DescribedFile described;
  if (configuration::is_setup_file(file)) {
    configuration::ReadSetup read = configuration::read_setup(text);
    described.mistakes = std::move(read.mistakes);
    described.add(read.setup);
    return described;
  }
  configuration::ReadConfiguration read =
      configuration::read_configuration(text, configuration::real_path(file.parent_path()));
  described.mistakes = std::move(read.mistakes);
  for (const configuration::DescribedBody& body : read.configuration.machine.bodies) described.add(body.shape.mesh);
  for (const configuration::DescribedSetup& setup : read.configuration.setups) described.add(setup);
  return described;
}

/// The offset of a place in the text in which it was found.
static std::size_t offset_of(std::string_view text, const configuration::DescriptionPlace& place) {
  const char* const end = text.data() + text.size();
  const char* begin = text.data();
  for (std::size_t line = 1; line < place.shown.line; ++line) begin = text::next_line(begin, end);
  return static_cast<std::size_t>(begin - text.data()) + place.byte;
}

/// What is wrong with a file with a shape as far as it is known.
static const Mistake* mistake_of(const configuration::ShapeFile& shape, const fs::path& file,
                                 const std::vector<configuration::SurroundingsMistake>& known) {
  for (const configuration::SurroundingsMistake& each : known) {
    if (!each.is_of_shape || each.mistake.key != shape.key || each.mistake.names.empty()) continue;
    if (each.mistake.names.front().en == configuration::shortened(shape.name) && each.real_file == file)
      return &each.mistake;
  }
  return nullptr;
}

Json configuration_diagnostics(std::string_view text, const fs::path& file, const configuration::Scenes& scenes,
                               protocol::Encoding encoding, Language language) {
  Json all = Json::array();
  if (text.starts_with(system::kByteOrderMark)) {
    all.push_back(diagnostic({}, Mistake{.text = configuration::mistakes::kByteOrderMark}.message(language)));
    text.remove_prefix(system::kByteOrderMark.size());
  }
  if (text.size() > configuration::kLongestFile) {
    all.push_back(diagnostic({}, Mistake{.text = configuration::mistakes::kTooLarge}.message(language)));
    return all;
  }
  const auto add = [&](std::size_t at, const Mistake& mistake) {
    all.push_back(diagnostic(range_of(text, at, encoding), text::printable(mistake.message(language))));
  };
  const DescribedFile described = described_in(text, file);
  for (const Mistake& mistake : described.mistakes) add(mistake.at, mistake);
  if (!described.mistakes.empty()) return all;
  const std::vector<configuration::SurroundingsMistake> known = scenes.all_mistakes();
  if (known.empty()) return all;
  const fs::path real = configuration::real_path(file);
  for (const configuration::ShapeFile& shape : described.shapes)
    if (const Mistake* const mistake = mistake_of(shape, real, known)) add(offset_of(text, shape.place), *mistake);
  return all;
}

Json configuration_diagnostics(const fs::path& file, const configuration::Scenes& scenes, protocol::Encoding encoding,
                               Language language) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const auto problem = [](const std::string& message) { return Json::array({diagnostic({}, message)}); };
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
    return problem(std::string(configuration::mistakes::kNoFile.in(language)));
  const auto opened = SourceFile::open_unmapped(file, language);
  if (const auto* const why = std::get_if<SourceFile::Problem>(&opened)) return problem(why->message);
  const auto& source = std::get<SourceFile>(opened);
  std::string text(source.has_byte_order_mark() ? system::kByteOrderMark : std::string_view());
  text += source.text();
  return configuration_diagnostics(text, file, scenes, encoding, language);
}

}  // namespace isocnc::documents
