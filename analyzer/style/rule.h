#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::style {

using namespace dialect::literals;

/// A line as written, executed or not.
struct StyleLine {
  std::size_t number = 0;  ///< The line number, from 0.
  const syntax::LineTree& tree;
  std::string_view terminator;  ///< CR, LF or CRLF; empty at the end of the program.
};

struct StyleFinding {
  std::size_t line = 0;
  syntax::Finding finding;
};

/// A rule on how a program is written. All are off by default, and then cost nothing.
class StyleRule {
 public:
  virtual ~StyleRule() = default;
  /// Reads the next line.
  virtual void read(const StyleLine& line, std::vector<StyleFinding>& style_findings) = 0;
  /// Called after the last line.
  virtual void end(std::vector<StyleFinding>&) {}
};

/// A rule's row, defined in the file named after the rule.
struct StyleRuleRow {
  dialect::DiagnosticId id;
  std::unique_ptr<StyleRule> (*make)();
};

template <class R>
constexpr StyleRuleRow rule(dialect::DiagnosticId id) {
  return {id, [] { return std::unique_ptr<StyleRule>(std::make_unique<R>()); }};
}

/// Whether a rule is selected.
using IsWanted = std::function<bool(dialect::DiagnosticId)>;

/// Passes a program's lines, from the top, to the selected rules.
class StyleReader {
 public:
  explicit StyleReader(const IsWanted& is_wanted);
  ~StyleReader();

  /// Whether no rule is selected.
  bool is_idle() const { return rules_.empty(); }
  void read(const StyleLine& line);
  /// The findings of the rules, unsorted.
  std::vector<StyleFinding> finish();

 private:
  class Liveness;

  std::vector<std::unique_ptr<StyleRule>> rules_;
  std::unique_ptr<Liveness> liveness_;
  std::vector<StyleFinding> style_findings_;
};

/// The findings of the selected rules in a program, unsorted.
std::vector<StyleFinding> read_program(std::string_view text, const IsWanted& is_wanted);

}  // namespace isocnc::style
