#include "analyzer/transforming/transform.h"

#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "analyzer/transforming/block_transformer.h"
#include "analyzer/transforming/proof.h"
#include "analyzer/transforming/repetition.h"
#include "interpreter/execution/execute.h"
#include "interpreter/syntax/each_tree.h"

namespace isocnc::transforming {

using running::JumpEvent;

namespace {

/// Transforms one program, path by path.
class ProgramTransformer {
 public:
  ProgramTransformer(std::string_view text, const Transformation& transformation, const execution::Setup& setup,
                     dialect::Language language)
      : text_(text), map_(transformation, text), language_(language) {
    options_.setup = setup;
  }

  std::variant<std::string, TransformationRefusal> transform() {
    std::set<JumpDecisions> known;
    std::vector<StartValues> of_paths;
    std::vector<StartValues> open = {{}};
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open.size() > kMaxRuns) return TransformationRefusal{TransformObstacle::TooManyPaths};
      const StartValues values = open[i];
      use(values);
      PathTaken path;
      if (auto refusal = rewrite_path(path)) return *refusal;
      if (known.insert(path.decisions).second) of_paths.push_back(values);
      for (const int variable : path.compared) {
        if (values.count(variable) > 0) continue;
        // What other values of this one lead to shows which others count.
        for (const double value : values_of(variable)) {
          open.push_back(values);
          open.back()[variable] = value;
        }
        break;
      }
    }
    std::string transformed = written();
    for (const StartValues& values : of_paths) {
      use(values);
      if (auto refusal = find_difference(text_, transformed, map_, options_, language_)) return *refusal;
    }
    return transformed;
  }

 private:
  /// StartValues of variables at the start: of registers by their number, and of VGPL (Jump::kVgplVariable). Others are
  /// 0.
  using StartValues = std::map<int, double>;
  /// The lines of IFs, and whether they jump.
  using JumpDecisions = std::vector<std::pair<std::size_t, bool>>;

  /// A path, and the variables that its IFs compare though the program has not set them.
  struct PathTaken {
    JumpDecisions decisions;
    std::set<int> compared;
  };

  void use(const StartValues& values) {
    options_.vgpl = 0;
    options_.registers = {};
    for (const auto& [variable, value] : values)
      (variable == syntax::Jump::kVgplVariable ? options_.vgpl
                                               : options_.registers[static_cast<std::size_t>(variable)]) = value;
  }

  /// A value for each way in which the IFs can decide by this variable.
  std::vector<double> values_of(int variable) const {
    std::set<double> constants;
    syntax::each_tree(text_, [&](const syntax::LineTree& line, std::string_view) {
      if (line.jump != nullptr && line.jump->condition_is_known() && line.jump->variable == variable)
        constants.insert(line.jump->value);
    });
    std::vector<double> values = {*constants.begin() - 1};
    for (auto constant = constants.begin(); constant != constants.end(); ++constant) {
      values.push_back(*constant);
      const auto next = std::next(constant);
      values.push_back(next == constants.end() ? *constant + 1 : *constant + (*next - *constant) / 2);
    }
    return values;
  }

  /// Rewrites the lines of the path along which the run leads.
  std::optional<TransformationRefusal> rewrite_path(PathTaken& path) {
    const running::Program program(text_);
    running::Runner run(program, options_);
    BlockTransformer blocks(map_, options_.setup);
    std::set<int> assigned;
    while (const auto block = run.next()) {
      const std::size_t line = block->line;
      const syntax::LineTree& tree = block->tree;
      const std::string text = blocks.next(tree, block->state);
      const bool is_new = text != tree.text;
      if (tree.jump != nullptr && tree.jump->condition_is_known() && assigned.count(tree.jump->variable) == 0)
        path.compared.insert(tree.jump->variable);
      for (const syntax::Instruction& instruction : tree.instructions)
        if (instruction.kind == syntax::InstructionKind::Assignment)
          if (const auto value = execution::assigned_by(instruction, tree)) assigned.insert(value->reg);
      run.step();
      if (run.has_ended() && run.result().ending == running::Ending::Error) break;
      if (blocks.obstacle()) return TransformationRefusal{*blocks.obstacle(), line};
      if (!keep(line, text, is_new)) return TransformationRefusal{TransformObstacle::OnTwoPaths, line};
      for (const running::Event& event : run.events())
        if (const auto* jump = std::get_if<JumpEvent>(&event.what)) path.decisions.emplace_back(line, jump->taken);
    }
    run.step();  // The end of the text, if it comes without an M02.
    if (run.result().ending != running::Ending::Error) return std::nullopt;
    return TransformationRefusal{TransformObstacle::ProgramError, run.result().line,
                                 error_text(run.result(), language_)};
  }

  /// Keeps the new text of a line; false if another path has given it another one.
  bool keep(std::size_t line, const std::string& text, bool is_new) {
    if (seen_.size() <= line) seen_.resize(line + 1);
    const bool is_first = !seen_[line];
    seen_[line] = true;
    const auto found = changed_.find(line);
    if (!is_first) return found == changed_.end() ? !is_new : found->second == text;
    if (is_new) changed_.emplace(line, text);
    return true;
  }

  std::string written() const {
    std::string result;
    result.reserve(text_.size() + text_.size() / 8);
    std::size_t line = 0;
    auto change = changed_.begin();
    syntax::each_tree(text_, [&](const syntax::LineTree& tree, std::string_view terminator) {
      if (change != changed_.end() && change->first == line) {
        result += (change++)->second;
      } else {
        result += tree.text;
      }
      result += terminator;
      ++line;
    });
    return result;
  }

  const std::string_view text_;
  const ProgramMap map_;
  const dialect::Language language_;
  running::RunOptions options_;
  std::vector<bool> seen_;                      // By line: some path leads there.
  std::map<std::size_t, std::string> changed_;  // The new text of lines that change.
};

}  // namespace

std::variant<std::string, TransformationRefusal> transform(std::string_view text, const Transformation& transformation,
                                                           const execution::Setup& setup, dialect::Language language) {
  if (transformation.movement == Movement::Repeat) return repeated(text, transformation, setup, language);
  return ProgramTransformer(text, transformation, setup, language).transform();
}

}  // namespace isocnc::transforming
