#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lsp/documents/snapshot.h"

namespace isocnc::lsp::documents {

enum class NameKind : std::uint8_t {
  Label,     ///< A line number, and what a GOTO says of it: N10 and N010 are the same.
  Register,  ///< V1 to V30.
};

/// What an author names, and refers to from elsewhere.
struct Name {
  NameKind kind = NameKind::Label;
  std::uint64_t number = 0;

  friend bool operator==(const Name&, const Name&) = default;
};

/// A name where it is written.
struct Occurrence {
  std::size_t line = 0;
  syntax::Span span;  ///< Of the word, letter and number.
  Name name;
  bool is_definition = false;  ///< The label before a line, or a register that gets a value.

  friend bool operator==(const Occurrence&, const Occurrence&) = default;
};

/// The name that stands at a place, or ends there.
std::optional<Occurrence> name_at(const Snapshot& snapshot, const syntax::Position& place);

/// All places of a name in the order of the program.
std::vector<Occurrence> occurrences(const Snapshot& snapshot, const Name& name);

/// The pieces of a span that are no comment, without blanks around them: a number is one, but for `N1(a)0`.
std::vector<syntax::Span> outside_comments(const syntax::LineTree& line, syntax::Span span);

}  // namespace isocnc::lsp::documents
