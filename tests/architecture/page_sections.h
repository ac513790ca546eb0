#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace isocnc::architecture {

/// What a page says in words that no translation changes, each with the line where it stands first: options, codes of
/// findings, decisions, sections of the specification, G and M codes, numbers, and images.
using Marks = std::map<std::string, std::size_t>;

/// An example without what a translation may change: comments, answers of programs, messages.
struct CodeBlock {
  std::size_t line = 0;
  std::vector<std::string> lines;
};

/// A row of a table.
struct Row {
  std::size_t line = 0;
  std::size_t cells = 0;
  std::string code;  ///< The code in its first cell.
};

/// A part of a Markdown page from a heading to the next one.
struct Section {
  std::size_t line = 0;  ///< Line of the heading, from 1.
  int level = 0;         ///< 1 for `#`.
  std::string heading;
  Marks marks;  ///< Outside examples.
  std::vector<Row> rows;
  std::vector<CodeBlock> code;
};

std::vector<Section> sections_of(const std::string& page);

}  // namespace isocnc::architecture
