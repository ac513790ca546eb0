#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lsp/documents/snapshot.h"

namespace isocnc::queries {

enum class SectionKind : std::uint8_t {
  Tool,       ///< From an M06 to the next, or to the last M02.
  Face,       ///< From G24, G28 or G29 to G27, to the next of them, or to the end of the tool's section.
  Workpiece,  ///< The line of a G92.
  Label,      ///< A line whose number is named by a GOTO.
  Heading,    ///< Comments on consecutive lines of their own.
};

/// A part of a program that appears in the outline.
struct Section {
  SectionKind kind = SectionKind::Tool;
  std::size_t first_line = 0;  ///< Comments directly above an M06 or a face frame belong to it.
  std::size_t last_line = 0;   ///< Inclusive.
  std::size_t head_line = 0;   ///< The line of `head`.
  syntax::Span head;
  std::uint64_t number = 0;  ///< The number of the tool, the G or the label.
  int parent = -1;           ///< The index of the section that contains this one; -1 for none.
  std::string title;         ///< `T101001`, `G29 B90`, `N30`, the text of a heading. Never empty.
  std::string detail;        ///< The tool's configured name, or else the comment above; often empty.
};

/// The protocol's SymbolKind of a section.
int symbol_kind(SectionKind kind);

/// The sections of a program in its order, each after the one that contains it. Reads the landmarks of the index only.
std::vector<Section> outline(const documents::Snapshot& snapshot);

/// A run of consecutive lines that hold only comments, from `first_line` to `last_line` inclusive.
struct CommentBlock {
  std::size_t first_line = 0;
  std::size_t last_line = 0;
  syntax::Span head;  ///< The first comment.
};
std::vector<CommentBlock> comment_blocks(const documents::Snapshot& snapshot);

}  // namespace isocnc::queries
