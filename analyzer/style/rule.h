#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::style {

using namespace dialect::literals;

/// A line as it is written, whether it runs or not.
struct Line {
  std::uint64_t number = 0;  ///< From 0.
  const syntax::LineTree& tree;
  std::string_view terminator;  ///< CR, LF or CRLF; nothing at the end of the program.
};

struct StyleFinding {
  std::uint64_t line = 0;
  syntax::Finding finding;
};

/// An opinion on how a program is written. All are off until somebody asks for them, and cost nothing till then.
class Rule {
 public:
  virtual ~Rule() = default;
  /// Reads the next line.
  virtual void read(const Line& line, std::vector<StyleFinding>& style_findings) = 0;
  /// There are no more.
  virtual void end(std::vector<StyleFinding>&) {}
};

/// What a file of this folder defines, under the file's name.
struct StyleRuleRow {
  dialect::DiagnosticId id;
  std::unique_ptr<Rule> (*make)();
};

template <class R>
constexpr StyleRuleRow rule(dialect::DiagnosticId id) {
  return {id, [] { return std::unique_ptr<Rule>(std::make_unique<R>()); }};
}

/// Which rules are wanted.
using IsWanted = std::function<bool(dialect::DiagnosticId)>;

/// Reads a program to the rules that are wanted, line by line from the top.
class Reader {
 public:
  explicit Reader(const IsWanted& is_wanted);
  ~Reader();

  /// Whether nobody listens.
  bool is_idle() const { return rules_.empty(); }
  void read(const Line& line);
  /// What the rules have said, in no order.
  std::vector<StyleFinding> finish();

 private:
  class Liveness;

  std::vector<std::unique_ptr<Rule>> rules_;
  std::unique_ptr<Liveness> liveness_;
  std::vector<StyleFinding> style_findings_;
};

/// What the wanted rules say of a program, in no order.
std::vector<StyleFinding> read_program(std::string_view text, const IsWanted& is_wanted);

}  // namespace isocnc::style
