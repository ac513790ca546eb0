#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lsp/documents/snapshot.h"

namespace isocnc::queries {

enum class NameKind : std::uint8_t {
  Label,     ///< A line number, or the label in a GOTO: N10 and N010 are the same.
  Register,  ///< V1 to V30.
};

/// A name that the author of a program defines and refers to elsewhere.
struct Name {
  NameKind kind = NameKind::Label;
  std::uint64_t number = 0;

  friend bool operator==(const Name&, const Name&) = default;
};

/// A place where a name is written.
struct Occurrence {
  std::size_t line = 0;
  syntax::Span span;  ///< The whole word: letter and number.
  Name name;
  bool is_definition =
      false;  ///< Whether this is the line number at the start of a line, or a register that gets a value.

  friend bool operator==(const Occurrence&, const Occurrence&) = default;
};

/// The name at a place, or the one that ends there.
std::optional<Occurrence> name_at(const documents::Snapshot& snapshot, const syntax::Position& place);

/// All places of a name in the order of the program.
std::vector<Occurrence> occurrences(const documents::Snapshot& snapshot, const Name& name);

/// The parts of a span outside comments, without blanks around them. A number is one part, except in `N1(a)0`.
std::vector<syntax::Span> outside_comments(const syntax::LineTree& line, syntax::Span span);

}  // namespace isocnc::queries
