#pragma once

#include <optional>

#include "interpreter/execution/lack.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::execution {

/// A line that starts with words that the block before it lacks: its author broke the line too early, or put a word on
/// the wrong line. The lack has been reported, so these words need no finding of their own. Both parts have the columns
/// of the line.
class SplitLine {
 public:
  /// Nothing if the line does not start with such words.
  static std::optional<SplitLine> split(const syntax::LineTree& line, const Lack& lack);

  /// The words that belong to the block before.
  syntax::LineTree carried() const { return carried_.tree(); }
  syntax::LineTree rest() const { return rest_.tree(); }

 private:
  SplitLine(std::string_view carried, std::string_view rest) : carried_(carried), rest_(rest) {}

  syntax::ParsedLine carried_;
  syntax::ParsedLine rest_;
};

}  // namespace isocnc::execution
