#pragma once

#include <string>

#include <fmt/format.h>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/syntax/document.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::support {

inline std::string text_of(syntax::Span span) { return fmt::format("{}-{}", span.begin, span.end); }

/// A finding with all its members. Equal texts mean equal numbers, also for an unknown number.
inline std::string text_of(const syntax::Finding& finding) {
  std::string text =
      fmt::format("{}/{} at {}", dialect::definition(finding.id).code, finding.cause, text_of(finding.span));
  if (!finding.related.empty()) text += " related " + text_of(finding.related);
  for (const double value : finding.values) text += fmt::format(" {}", value + 0.0);
  for (const dialect::GivenName& name : finding.names)
    if (name.number != 0) text += fmt::format(" named {}", name.in(dialect::Language::English));
  return text;
}

/// All members of a tree, so that equal texts mean equal trees.
inline std::string text_of(const syntax::LineTree& tree) {
  std::string text = fmt::format("[{}]\n", tree.text);
  for (const syntax::Word& word : tree.words)
    text += fmt::format("word {} at {} = {} digits {} owner {} flags {}\n", word.letter, text_of(word.span()),
                        word.value, word.digits, word.owner, word.flags);
  for (const syntax::Instruction& each : tree.instructions)
    text +=
        fmt::format("instruction {} row {} flags {} number {} command {} words {}-{}\n", static_cast<int>(each.kind),
                    each.row, each.flags, each.number, each.command, each.begin, each.end);
  for (const syntax::Span comment : tree.comments) text += "comment " + text_of(comment) + '\n';
  for (const syntax::Finding& finding : tree.findings) text += text_of(finding) + '\n';
  if (const syntax::Jump* jump = tree.jump)
    text += fmt::format("jump if {} at {} {} {} at {} to {} {} at {}\n", jump->variable, text_of(jump->variable_span),
                        static_cast<int>(jump->comparison), jump->value, text_of(jump->if_span), jump->has_target,
                        jump->target, text_of(jump->target_span));
  return text + fmt::format("label {} feed {} spindle {} flags {}\n", tree.label, tree.feed, tree.spindle, tree.flags);
}

/// All trees of a document.
inline std::string text_of(const syntax::Document& document) {
  std::string text;
  for (std::size_t i = 0; i < document.line_count(); ++i) {
    const syntax::DocumentLine line = document.line(i);
    text += text_of(*line);
  }
  return text;
}

}  // namespace isocnc::support
