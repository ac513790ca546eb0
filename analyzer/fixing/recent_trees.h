#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "analyzer/fixes/fix.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::fixing {

/// Trees of a program's lines, to go over the same lines again and again: each is parsed once, or nearly so.
class RecentTrees {
 public:
  explicit RecentTrees(fixes::Program& program) : program_(program) {}

  /// Valid until another line is asked for.
  syntax::LineTree operator[](std::uint64_t line);

 private:
  static constexpr std::size_t kMaxTrees = 256;

  struct Parsed {
    std::optional<std::uint64_t> line;
    syntax::TreeStore store;
  };

  fixes::Program& program_;
  std::array<Parsed, kMaxTrees> parsed_;  ///< The trees, each at the number of its line modulo kMaxTrees.
};

}  // namespace isocnc::fixing
