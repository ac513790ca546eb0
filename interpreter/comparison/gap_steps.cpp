#include "interpreter/comparison/gap_steps.h"

#include <algorithm>
#include <limits>

namespace isocnc::comparison {

using geometry::Vec3;

/// Maximum number of pairs of actions in a gap.
static constexpr std::size_t kMaxCells = 1'000'000;
static constexpr float kNever = std::numeric_limits<float>::max() / 4;

/// The cost of taking one for the other; 0 for the same, and at most a bit less than removing one and adding the other.
static float replacement_cost(const RunPair& runs, const MachineAction& a, const MachineAction& b, const Vec3& before,
                              const Vec3& after) {
  if (a.kind != b.kind) return kNever;
  if (!a.is_motion()) return is_same_effect(runs, a, b) ? 0.F : 1.F;
  constexpr float kOtherWay = 0.5F;
  if (ends_in_place(runs, a, b, before, after)) return goes_same_way(runs, a, b) ? 0.F : kOtherWay;
  const Vec3 other_way = (b.to.tip - b.from.tip) - (a.to.tip - a.from.tip);
  // The same way elsewhere: the retract after the last hole.
  if (a.is_line() && b.is_line() && a.is_rapid == b.is_rapid && other_way.norm() <= runs.tolerance) return 1;
  const double distance = (b.to.tip - a.to.tip - before).norm();
  const double length = 1 + (a.to.tip - a.from.tip).norm() + (b.to.tip - b.from.tip).norm();
  return 1 + 0.9F * static_cast<float>(std::min(1.0, distance / length));
}

bool is_too_large(std::size_t a_count, std::size_t b_count) { return b_count > 0 && a_count > kMaxCells / b_count; }

std::optional<std::vector<GapStep>> gap_steps(const RunPair& runs, const AlignedPiece& gap, const Vec3& shift) {
  const std::size_t rows = gap.a_end - gap.a_begin;
  const std::size_t columns = gap.b_end - gap.b_begin;
  if (rows == 0 || columns == 0)
    return std::vector<GapStep>(rows + columns, rows == 0 ? GapStep::OnlyInB : GapStep::OnlyInA);
  if (is_too_large(rows, columns)) return std::nullopt;
  if (runs.budget != nullptr && !runs.budget->take_cells(rows, columns)) return std::nullopt;
  std::vector<GapStep> last((rows + 1) * (columns + 1), GapStep::OnlyInB);
  std::vector<float> costs(columns + 1);
  for (std::size_t k = 0; k <= columns; ++k) costs[k] = static_cast<float>(k);
  for (std::size_t i = 1; i <= rows; ++i) {
    float diagonal = costs[0];
    costs[0] = static_cast<float>(i);
    last[i * (columns + 1)] = GapStep::OnlyInA;
    for (std::size_t k = 1; k <= columns; ++k) {
      const float with_both = diagonal + replacement_cost(runs, runs.a.actions[gap.a_begin + i - 1],
                                                          runs.b.actions[gap.b_begin + k - 1], shift, gap.shift);
      const float only_a = costs[k] + 1;
      const float only_b = costs[k - 1] + 1;
      diagonal = costs[k];
      costs[k] = std::min({with_both, only_a, only_b});
      GapStep& step = last[i * (columns + 1) + k];
      step = costs[k] == with_both ? GapStep::Pair : costs[k] == only_a ? GapStep::OnlyInA : GapStep::OnlyInB;
    }
  }
  std::vector<GapStep> steps;
  for (std::size_t i = rows, k = columns; i > 0 || k > 0;) {
    const GapStep step = last[i * (columns + 1) + k];
    steps.push_back(step);
    if (step != GapStep::OnlyInB) --i;
    if (step != GapStep::OnlyInA) --k;
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

}  // namespace isocnc::comparison
