#include "interpreter/comparison/anchors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace isocnc::comparison {

using geometry::Pose;
using geometry::Vec3;

namespace {

/// An action by what has to be the same.
struct KeyedAction {
  std::uint64_t key = 0;
  std::size_t index = 0;

  friend auto operator<=>(const KeyedAction&, const KeyedAction&) = default;
};

/// Gathers numbers into a key. Numbers that differ by less than the tolerance have the same key, but for those close to
/// the edges of a grid, which lie beside the numbers that programs write.
class KeyMaker {
 public:
  explicit KeyMaker(double tolerance) : cell_(std::max(8 * tolerance, 1e-5)) {}

  void add(std::uint64_t number) {
    key_ = (key_ ^ number) * 0x9E3779B97F4A7C15ULL;
    key_ ^= key_ >> 29;
  }
  void add(double number) {
    constexpr double kOffset = 0.3719;
    constexpr double kLargest = 1e15;
    const double cell = std::floor(std::clamp(number / cell_ + kOffset, -kLargest, kLargest));
    add(static_cast<std::uint64_t>(static_cast<std::int64_t>(cell)));
  }
  void add(const Vec3& tip, double b, double c) {
    for (const double each : {tip.x(), tip.y(), tip.z(), b, c}) add(each);
  }
  std::uint64_t take() { return std::exchange(key_, kStart); }

 private:
  static constexpr std::uint64_t kStart = 0x243F6A8885A308D3ULL;

  double cell_;
  std::uint64_t key_ = kStart;
};

std::vector<KeyedAction> sorted(std::vector<KeyedAction> keyed) {
  std::sort(keyed.begin(), keyed.end());
  return keyed;
}

std::vector<KeyedAction> keyed_by_place(const RecordedRun& run, double tolerance) {
  std::vector<KeyedAction> keyed;
  KeyMaker maker(tolerance);
  for (std::size_t i = 0; i < run.actions.size(); ++i) {
    const MachineAction& action = run.actions[i];
    if (action.is_motion()) {
      maker.add(action.to.tip, action.to.b, action.to.c);
    } else if (action.kind == ActionKind::Tool) {
      const execution::ToolCode& code = run.tools[action.tool].code;
      for (const int each : {-1, code.head, code.holder, code.tool}) maker.add(static_cast<std::uint64_t>(each));
    } else {
      continue;
    }
    keyed.push_back({maker.take(), i});
  }
  return sorted(std::move(keyed));
}

std::vector<KeyedAction> keyed_by_shape(const RecordedRun& run, double tolerance) {
  constexpr std::size_t kRow = 3;
  std::vector<KeyedAction> keyed;
  KeyMaker maker(tolerance);
  for (std::size_t i = 0; i + kRow <= run.actions.size(); ++i) {
    const std::span row = std::span(run.actions).subspan(i, kRow);
    if (!std::all_of(row.begin(), row.end(), [](const MachineAction& each) { return each.is_motion(); })) continue;
    for (const MachineAction& each : row) {
      maker.add(each.to.tip - each.from.tip, each.to.b, each.to.c);
      maker.add(static_cast<std::uint64_t>(each.arc != MachineAction::kNone));
    }
    keyed.push_back({maker.take(), i});
  }
  return sorted(std::move(keyed));
}

/// Whether the key at `i` is that of a neighbor, too.
bool is_repeated(std::span<const KeyedAction> keyed, std::size_t i) {
  return (i > 0 && keyed[i - 1].key == keyed[i].key) || (i + 1 < keyed.size() && keyed[i + 1].key == keyed[i].key);
}

/// The pairs of keys that each run has once, in the order of the first one.
std::vector<PlaceInBoth> unique_pairs(std::span<const KeyedAction> a, std::span<const KeyedAction> b) {
  std::vector<PlaceInBoth> pairs;
  for (std::size_t i = 0, k = 0; i < a.size(); ++i) {
    while (k < b.size() && b[k].key < a[i].key) ++k;
    if (k == b.size()) break;
    if (b[k].key == a[i].key && !is_repeated(a, i) && !is_repeated(b, k)) pairs.push_back({a[i].index, b[k].index});
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& left, const auto& right) { return left.a < right.a; });
  return pairs;
}

/// The longest row in which both indices rise.
std::vector<PlaceInBoth> longest_row(const std::vector<PlaceInBoth>& pairs) {
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> ends;  // The pair that ends the row of each length with the smallest index in b.
  std::vector<std::size_t> before(pairs.size(), kNone);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto place = std::lower_bound(ends.begin(), ends.end(), pairs[i].b,
                                        [&](std::size_t end, std::size_t b) { return pairs[end].b < b; });
    if (place != ends.begin()) before[i] = *(place - 1);
    if (place == ends.end()) {
      ends.push_back(i);
    } else {
      *place = i;
    }
  }
  std::vector<PlaceInBoth> row;
  for (std::size_t i = ends.empty() ? kNone : ends.back(); i != kNone; i = before[i]) row.push_back(pairs[i]);
  std::reverse(row.begin(), row.end());
  return row;
}

}  // namespace

Anchors::Anchors(const RunPair& runs)
    : by_numbers_(longest_row(unique_pairs(keyed_by_place(runs.a, 0), keyed_by_place(runs.b, 0)))),
      by_place_(
          longest_row(unique_pairs(keyed_by_place(runs.a, runs.tolerance), keyed_by_place(runs.b, runs.tolerance)))),
      by_shape_(
          longest_row(unique_pairs(keyed_by_shape(runs.a, runs.tolerance), keyed_by_shape(runs.b, runs.tolerance)))) {}

std::optional<PlaceInBoth> Anchors::next(const PlaceInBoth& place, AnchorRow of) const {
  const std::vector<PlaceInBoth>& row = of == AnchorRow::Numbers ? by_numbers_
                                        : of == AnchorRow::Place ? by_place_
                                                                 : by_shape_;
  const auto found = std::partition_point(
      row.begin(), row.end(), [&](const PlaceInBoth& pair) { return pair.a < place.a || pair.b < place.b; });
  return found == row.end() ? std::nullopt : std::optional(*found);
}

}  // namespace isocnc::comparison
