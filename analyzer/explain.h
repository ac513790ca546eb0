#pragma once

#include <string>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::analyzer {

/// All that is known of a code, for the terminal: `isolint --explain ISO031`.
std::string explain(dialect::DiagnosticId id, dialect::Language language);
/// One line for each code: `isolint --list-rules`.
std::string list_rules(dialect::Language language);
/// The page of all codes, docs/rules.md.
std::string rules_page();

/// A program of the table with its mark, `[!` and `!]`, taken out.
struct MarkedProgram {
  std::string text;
  bool has_mark = false;
  std::size_t line = 0;  ///< Of the mark, from 0; its byte columns follow.
  std::size_t begin = 0;
  std::size_t end = 0;
};
MarkedProgram read_marked(std::string_view program);

}  // namespace isocnc::analyzer
