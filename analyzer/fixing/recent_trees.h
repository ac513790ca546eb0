#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "analyzer/fixes/fix.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::fixing {

/// A cache of the trees of a program's lines, for repeated passes over the same lines.
class RecentTrees {
 public:
  explicit RecentTrees(fixes::FixProgram& program) : program_(program) {}

  /// Valid until the next call.
  syntax::LineTree operator[](std::size_t line);

 private:
  static constexpr std::size_t kMaxTrees = 256;

  struct KeptTree {
    std::optional<std::size_t> line;
    syntax::TreeStore store;
  };

  fixes::FixProgram& program_;
  std::array<KeptTree, kMaxTrees> parsed_;  ///< The trees, each at its line number modulo kMaxTrees.
};

}  // namespace isocnc::fixing
