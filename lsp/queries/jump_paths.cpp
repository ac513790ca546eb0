#include "lsp/queries/jump_paths.h"

namespace isocnc::queries {

JumpPaths::JumpPaths(const documents::Snapshot& snapshot) {
  const documents::ProgramIndex& index = snapshot.index();
  std::map<std::uint64_t, std::vector<std::size_t>> lines_by_label;
  for (const documents::Landmark& landmark : index.landmarks(documents::LandmarkKind::Jump)) {
    snapshot.throw_if_unwanted();
    const auto [entry, is_new] = lines_by_label.try_emplace(landmark.number);
    std::vector<std::size_t>& lines = entry->second;
    if (is_new) lines = index.lines_of_label(landmark.number);
    const auto target = std::upper_bound(lines.begin(), lines.end(), landmark.line);
    ResolvedJump jump{landmark, std::nullopt};
    if (target != lines.end()) {
      jump.target = *target;
      jump_targets_.emplace(*target, landmark.line);
    }
    jumps_.push_back(jump);
  }
  for (const documents::Landmark& end : index.landmarks(documents::LandmarkKind::ProgramEnd))
    after_ends_.insert(end.line + 1);
}

/// The first line of the run of lines above this one that can only be entered at its first line.
std::size_t JumpPaths::run_start(std::size_t line) const {
  std::size_t start = 0;
  if (const auto jump_target = jump_targets_.lower_bound(line); jump_target != jump_targets_.begin())
    start = std::prev(jump_target)->first;
  if (const auto end = after_ends_.lower_bound(line); end != after_ends_.begin())
    start = std::max(start, *std::prev(end));
  return start;
}

}  // namespace isocnc::queries
