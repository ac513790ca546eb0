#include <algorithm>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "interpreter/text/unicode.h"
#include "lsp/extensions/extension.h"

/// The trees of some lines as text, which show how a line is parsed: by our own request `isocnc/syntaxTree`, and as a
/// document.
namespace isocnc::extensions {
namespace {

using syntax::InstructionKind;

/// The maximum number of lines shown if the request has no range.
constexpr std::size_t kMaxLines = 10'000;

struct TreeParams : protocol::DocumentParams {
  std::optional<ClientRange> range;
};

void from_json(const Json& json, TreeParams& params) {
  from_json(json, static_cast<protocol::DocumentParams&>(params));
  params.range = protocol::member<ClientRange>(json, "range");
}

std::string_view name_of(InstructionKind kind) {
  switch (kind) {
    case InstructionKind::G:
      return "G";
    case InstructionKind::Continuation:
      return "Continuation";
    case InstructionKind::Function:
      return "Function";
    case InstructionKind::ToolChange:
      return "ToolChange";
    case InstructionKind::StrayTool:
      return "StrayTool";
    case InstructionKind::Assignment:
      return "Assignment";
    case InstructionKind::Jump:
      return "Jump";
  }
  return "";
}

class TreeWriter {
 public:
  explicit TreeWriter(const Snapshot& snapshot) : snapshot_(snapshot) {}

  void write(std::size_t number) {
    const syntax::DocumentLine read = snapshot_.document().line(number);
    const syntax::LineTree& line = *read;
    text += fmt::format("Line {}\n", number + 1);
    for (const syntax::Instruction& instruction : line.instructions) {
      text += fmt::format("  {}\n", name_of(instruction.kind));
      for (const syntax::Word& word : line.words)
        if (word.owner == instruction.number || &line.command(instruction) == &word)
          write("    Word", line, word.span());
    }
    for (const syntax::Word& word : line.words)
      if (word.owner == syntax::Word::kNoOwner && !is_command(line, word)) write("  Word", line, word.span());
    for (const syntax::Span comment : line.comments) write("  Comment", line, comment);
    for (const syntax::Finding& finding : line.findings)
      write(fmt::format("  Finding {}", dialect::definition(finding.id).code), line, finding.span);
  }

  std::string text;

 private:
  static bool is_command(const syntax::LineTree& line, const syntax::Word& word) {
    return std::any_of(line.instructions.begin(), line.instructions.end(),
                       [&](const syntax::Instruction& each) { return &line.command(each) == &word; });
  }

  void write(std::string_view what, const syntax::LineTree& line, syntax::Span span) {
    text += fmt::format("{} {}-{} {}\n", what, span.begin, span.end, text::printable(line.text_of(span)));
  }

  const Snapshot& snapshot_;
};

std::string trees(const Snapshot& snapshot, std::size_t first, std::size_t end) {
  const std::size_t count = snapshot.document().line_count();
  first = std::min(first, count);
  end = std::min(end, count);
  TreeWriter writer(snapshot);
  for (std::size_t line = first; line < end; ++line) {
    if (line % 1'000 == 0) snapshot.throw_if_unwanted();
    writer.write(line);
  }
  return writer.text;
}

std::string answer_syntax_tree(const Snapshot& snapshot, const TreeParams& params) {
  if (!params.range) return trees(snapshot, 0, kMaxLines);
  return trees(snapshot, params.range->start.line, params.range->end.line + std::size_t{1});
}

/// Of one line, or of the whole program.
TextContent write_syntax_tree(const Snapshot& snapshot, const TextParams& params) {
  if (!params.line) return {trees(snapshot, 0, kMaxLines)};
  return {trees(snapshot, *params.line, *params.line + std::size_t{1})};
}

}  // namespace

extern const features::Feature syntax_tree = {.methods = {on<&answer_syntax_tree>("isocnc/syntaxTree")},
                                              .texts = {on<&write_syntax_tree>("syntax")}};

}  // namespace isocnc::extensions
