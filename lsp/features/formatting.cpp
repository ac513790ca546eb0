#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "analyzer/formatting/program_formatter.h"
#include "interpreter/text/characters.h"
#include "lsp/features/feature.h"
#include "lsp/queries/snapshot_program.h"
#include "lsp/queries/text_edits.h"

/// Formats the program as isofmt does, by the configuration. If it cannot be renumbered, the rest is formatted.
namespace isocnc::features {

using formatting::LinesFormatter;
using formatting::ProgramStyle;
using protocol::TextEdit;

namespace {

struct OnTypeParams : protocol::PositionParams {
  std::string character;
};

void from_json(const Json& json, OnTypeParams& params) {
  from_json(json, static_cast<protocol::PositionParams&>(params));
  params.character = json.at("ch");
}

/// The edits of the lines [first, after); the other lines are only read.
std::vector<TextEdit> format_lines(const Snapshot& snapshot, LinesFormatter& formatter, std::size_t first,
                                   std::size_t after) {
  std::vector<TextEdit> edits;
  std::size_t number = 0;
  queries::each_line_of(snapshot)([&](const syntax::LineTree& line) {
    const std::size_t at = number++;
    if (at >= after) return;
    const syntax::LineChange change = formatter.next(line);
    if (at < first) return;
    if (auto edit = queries::line_edit(snapshot, at, formatter.written(line, change)))
      edits.push_back(std::move(*edit));
  });
  return edits;
}

protocol::RawJson format(const Snapshot& snapshot, const protocol::DocumentParams&) {
  ProgramStyle style = formatting::style_by(snapshot.configuration().format);
  const formatting::EachLine each_line = queries::each_line_of(snapshot);
  std::optional<LinesFormatter> formatter(std::in_place, style, each_line);
  if (formatter->obstacle()) {
    style.numbers.reset();
    formatter.emplace(style, each_line);
  }
  return queries::written(format_lines(snapshot, *formatter, 0, snapshot.document().line_count()));
}

/// Keeps line numbers, which concern the whole program.
protocol::RawJson format_range(const Snapshot& snapshot, const protocol::RangeParams& params) {
  ProgramStyle style = formatting::style_by(snapshot.configuration().format);
  style.numbers.reset();
  LinesFormatter formatter(style, {});
  const bool ends_before_line = params.range.end.character == 0 && params.range.end.line > params.range.start.line;
  const std::size_t after = std::size_t{params.range.end.line} + (ends_before_line ? 0 : 1);
  return queries::written(format_lines(snapshot, formatter, params.range.start.line, after));
}

/// The line with all letters outside comments in upper case.
std::string in_capitals(const syntax::LineTree& line) {
  std::string text(line.text);
  std::transform(text.begin(), text.end(), text.begin(), text::upper);
  for (const syntax::Span comment : line.comments)
    text.replace(comment.begin, comment.end - comment.begin, line.text_of(comment));
  return text;
}

/// Writes the letters of the present line in upper case; after a line end, formats the line that was ended, which is no
/// longer incomplete.
std::vector<TextEdit> format_on_type(const Snapshot& snapshot, const OnTypeParams& params) {
  const std::size_t line = snapshot.from_client(params.position).line;
  std::optional<TextEdit> edit;
  if (params.character != "\n") {
    const syntax::DocumentLine typed = snapshot.document().line(line);
    edit = queries::line_edit(snapshot, line, in_capitals(*typed));
  } else if (line > 0) {
    ProgramStyle style = formatting::style_by(snapshot.configuration().format);
    syntax::Formatter formatter(style.line);
    const syntax::DocumentLine ended = snapshot.document().line(line - 1);
    edit = queries::line_edit(snapshot, line - 1, formatter.format(*ended));
  }
  return edit ? std::vector{*edit} : std::vector<TextEdit>{};
}

/// The trigger characters: the lower-case letters with which words start, and the line end.
Json formatting_capabilities(const Client&) {
  Json letters = Json::array();
  for (char letter = 'a'; letter <= 'z'; ++letter) letters.push_back(std::string(1, letter));
  return {{"documentFormattingProvider", true},
          {"documentRangeFormattingProvider", true},
          {"documentOnTypeFormattingProvider", {{"firstTriggerCharacter", "\n"}, {"moreTriggerCharacter", letters}}}};
}

}  // namespace

extern const Feature formatting = {
    .capabilities = formatting_capabilities,
    .methods = {on<&format>("textDocument/formatting"), on<&format_range>("textDocument/rangeFormatting"),
                on<&format_on_type>("textDocument/onTypeFormatting")}};

}  // namespace isocnc::features
