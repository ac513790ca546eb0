#pragma once

#include <cstdint>
#include <optional>

#include "debugger/session/session_state.h"

namespace isocnc::session {

/// Searches the past for the last place at which a run would have stopped, a window of blocks at a time. Log points are
/// silent.
class BackwardSearch {
 public:
  struct Hit {
    std::uint64_t block = 0;  ///< Blocks executed before the place.
    bool is_change = false;   ///< A watched value has changed in the block before.
    std::optional<breakpoints::InnerMoment> moment =
        {};  ///< The place within the block that comes next; none for its start.
  };

  /// From the present of the debuggee. Keeps a reference to the state.
  explicit BackwardSearch(SessionState& state);

  /// Searches the next window, which is the one before those that have been searched.
  std::optional<Hit> search_window();
  /// There is nothing before what has been searched.
  bool is_exhausted() const { return searched_from_ == 0; }
  double part_searched() const;  ///< 0 to 1.

 private:
  std::optional<Hit> judge(const running::Block& block);
  std::optional<std::uint64_t> find_overtravel_from(std::uint64_t block) const;
  std::optional<Hit> find_moment_from(std::uint64_t block) const;
  bool stops_before(const running::Block& block);
  bool changes_data(const running::Block& block);

  SessionState& state_;
  std::uint64_t start_ = 0;          ///< Blocks that had begun when the search did.
  double start_time_ = 0;            ///< When the search began; seconds of the run.
  std::uint64_t searched_from_ = 0;  ///< The blocks from this one on have been searched.
  expressions::ValueTrail trail_;
};

}  // namespace isocnc::session
