#include "analyzer/rendering.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::analyzer {

/// Bytes of the UTF-8 sequence that starts `text`; 0 when none does.
static std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const unsigned char second = byte(1);
  const bool too_long = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool out_of_range = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return too_long || out_of_range ? 0 : length;
}

std::size_t column_of(std::string_view line, std::size_t byte) {
  std::size_t column = 1;
  for (std::size_t at = 0; at < std::min(byte, line.size()); ++column)
    at += std::max<std::size_t>(1, sequence_length(line.substr(at)));
  return column;
}

std::string_view LineFinder::line(std::uint64_t index) {
  if (found_ && index == at_) return line_;
  const char* p = rest_.data();
  const char* const end = rest_.data() + rest_.size();
  for (; at_ < index; ++at_) p = syntax::skip_line_end(syntax::find_line_end(p, end), end);
  rest_ = {p, static_cast<std::size_t>(end - p)};
  line_ = {p, static_cast<std::size_t>(syntax::find_line_end(p, end) - p)};
  found_ = true;
  walked_ = 0;
  column_ = 1;
  return line_;
}

std::size_t LineFinder::column(std::size_t byte) {
  if (byte < walked_) {
    walked_ = 0;
    column_ = 1;
  }
  for (; walked_ < std::min(byte, line_.size()); ++column_)
    walked_ += std::max<std::size_t>(1, sequence_length(line_.substr(walked_)));
  return column_;
}

StepTexts::StepTexts(std::string_view text, const Report& report, dialect::Language language) {
  for (const std::vector<PathStep>& path : report.paths)
    for (const PathStep& step : path) texts_[{step.line, step.taken}];
  LineFinder lines(text);
  for (auto& [step, words] : texts_) words = describe_step({step.first, step.second}, lines.line(step.first), language);
}

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = sequence_length(text.substr(at));
    const auto c = static_cast<unsigned char>(text[at]);
    if (c == '\t') {
      result.push_back(' ');
    } else if (length == 0 || c < 0x20 || c == 0x7F || (length == 2 && c == 0xC2 && static_cast<unsigned char>(text[at + 1]) < 0xA0)) {
      result += "\xEF\xBF\xBD";
    } else {
      result.append(text.substr(at, length));
    }
    at += std::max<std::size_t>(1, length);
  }
  return result;
}

std::string rule_url(dialect::DiagnosticId id) {
  const dialect::DiagnosticDef& def = dialect::definition(id);
  std::string code(def.code);
  std::transform(code.begin(), code.end(), code.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return fmt::format("{}#{}-{}", ISOCNC_DOCS_URL, code, def.name);
}

std::string describe_step(const PathStep& step, std::string_view line_text, dialect::Language language) {
  syntax::ParsedLine parsed(line_text);
  const syntax::LineTree tree = parsed.tree();
  std::string condition = "IF";
  if (tree.jump && tree.jump->has_target)
    condition = printable(tree.text_of({tree.jump->if_span.begin, tree.jump->target_span.end}));
  static constexpr dialect::Text kJumps = {"jumps", "salta"};
  static constexpr dialect::Text kGoesOn = {"does not jump", "non salta"};
  return fmt::format("{}: {}", condition, (step.taken ? kJumps : kGoesOn).in(language));
}

}  // namespace isocnc::analyzer
