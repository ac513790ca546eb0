#pragma once

#include <string>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::analyzer {

/// The full description of a code, for the terminal: `isolint --explain ISO031`.
std::string explain(dialect::DiagnosticId id, dialect::Language language);
/// One line for each code: `isolint --list-rules`.
std::string list_rules(dialect::Language language);
/// The page of all codes, docs/rules.md.
std::string rules_page();

/// A program of the table, without its marks `[!` and `!]`.
struct MarkedProgram {
  std::string text;
  bool has_mark = false;
  std::size_t line = 0;  ///< The line of the mark, from 0; `begin` and `end` are its byte columns.
  std::size_t begin = 0;
  std::size_t end = 0;
};
MarkedProgram read_marked(std::string_view program);

}  // namespace isocnc::analyzer
