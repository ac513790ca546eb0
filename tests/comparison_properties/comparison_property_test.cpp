#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "interpreter/comparison/alignment.h"
#include "tests/comparison/compared.h"
#include "tests/comparison_properties/random_part.h"
#include "tests/simulation/random_run.h"

namespace isocnc::comparison {
namespace {

/// How many random programs are tried: 10,000 with ISOCNC_COMPARISONS=10000.
std::uint64_t tries() {
  const char* const given = std::getenv("ISOCNC_COMPARISONS");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : support::often(300);
}

/// The changes as they are with both programs swapped, written independently of compare().
std::vector<BehaviorChange> swapped(std::vector<BehaviorChange> changes) {
  for (BehaviorChange& change : changes) {
    std::swap(change.old_lines, change.new_lines);
    std::swap(change.old_start, change.new_start);
    std::swap(change.old_tool, change.new_tool);
    std::swap(change.old_value, change.new_value);
    std::swap(change.old_motions, change.new_motions);
    std::swap(change.old_cause, change.new_cause);
    if (change.shift) *change.shift *= -1;
    change.later *= -1;
    change.seconds *= -1;
    if (change.kind == ChangeKind::Added) {
      change.kind = ChangeKind::Removed;
    } else if (change.kind == ChangeKind::Removed) {
      change.kind = ChangeKind::Added;
    }
  }
  return changes;
}

/// The changes between two programs, which have to be mirrored the other way around.
std::vector<BehaviorChange> symmetric_changes(const std::string& old_program, const std::string& new_program) {
  const RecordedRun old_run = recorded(old_program);
  const RecordedRun new_run = recorded(new_program);
  const std::vector<BehaviorChange> changes = compare(old_run, new_run, {});
  EXPECT_EQ(shown(swapped(compare(new_run, old_run, {}))), shown(changes));
  EXPECT_EQ(swapped(compare(new_run, old_run, {})), changes);
  return changes;
}

std::string failure(std::uint64_t seed, const std::string& old_program, const std::string& new_program) {
  return fmt::format("seed {}\nold:\n{}new:\n{}", seed, old_program, new_program);
}

TEST(ComparisonProperty, WritingMakesNoDifference) {
  for (std::uint64_t seed = 1; seed <= tries(); ++seed) {
    support::Random random(seed);
    const RandomPart part = random_part(random, random.between(3, 80), random.one_in(4));
    const WritingStyle style{.is_incremental = random.one_in(2),
                             .is_in_inches = random.one_in(2),
                             .by_radius = random.one_in(2),
                             .is_numbered = random.one_in(2),
                             .is_split = random.one_in(2)};
    const std::string plain = written(part).text;
    const std::string other = written(part, style).text;
    const RecordedRun run = recorded(plain);
    ASSERT_GE(run.actions.size(), part.steps.size() + 3) << failure(seed, plain, "");
    ASSERT_EQ(run.actions.back().number, 0U) << failure(seed, plain, "");
    ASSERT_EQ(shown(symmetric_changes(plain, other)), "") << failure(seed, plain, other);
  }
}

TEST(ComparisonProperty, ChordsWithinTheToleranceMakeNoDifference) {
  for (std::uint64_t seed = 1; seed <= tries() / 10; ++seed) {
    support::Random random(seed);
    const RandomPart part = random_part(random, random.between(3, 40));
    // With 720 chords of a half circle of 60 mm they are 0.06 * 60 / 720^2 mm from it, with 36 they are 0.06 mm or more
    // from a circle of 1 mm... and more from larger ones.
    const std::string plain = written(part).text;
    const std::string fine = written(part, {.chords = 720}).text;
    ASSERT_EQ(shown(symmetric_changes(plain, fine)), "") << failure(seed, plain, "");
  }
}

// A single change, found and found alone.

enum class SeededChange { Coordinate, TwoCoordinates, Feed, LineLost, LinesSwapped, Tool, Speed, Increment, Turn };

/// A step whose change counts for itself: a straight motion that leads elsewhere and from which no arc starts.
std::optional<std::size_t> free_step(const RandomPart& part, support::Random& random) {
  for (int i = 0; i < 100; ++i) {
    const std::size_t step = 1 + random.below(part.steps.size() - 1);
    if (part.is_free(step)) return step;
  }
  return std::nullopt;
}

/// A row of points on two lines, dense enough for a distance to 0.001 mm where it is checked.
double dense_distance(const std::vector<geometry::Vec3>& from, const std::vector<geometry::Vec3>& to) {
  const auto to_chain = [&](const geometry::Vec3& point) {
    double nearest = 1e300;
    for (std::size_t i = 0; i + 1 < to.size(); ++i) {
      const geometry::Vec3 along = to[i + 1] - to[i];
      const double square = along.squaredNorm();
      const double part = square > 0 ? std::clamp(along.dot(point - to[i]) / square, 0.0, 1.0) : 0;
      nearest = std::min(nearest, (to[i] + part * along - point).norm());
    }
    return nearest;
  };
  double farthest = 0;
  for (std::size_t i = 0; i + 1 < from.size(); ++i)
    for (int k = 0; k <= 4000; ++k)
      farthest = std::max(farthest, to_chain(from[i] + (from[i + 1] - from[i]) * (k / 4000.0)));
  return farthest;
}

/// The greatest distance of the points of one row from those of another one.
double distance_of_points(const std::vector<geometry::Vec3>& from, const std::vector<geometry::Vec3>& to) {
  double farthest = 0;
  for (const geometry::Vec3& point : from) {
    double nearest = 1e300;
    for (const geometry::Vec3& other : to) nearest = std::min(nearest, (other - point).squaredNorm());
    farthest = std::max(farthest, nearest);
  }
  return std::sqrt(farthest);
}

geometry::Vec3 point_of(const std::array<int, 3>& micrometers) {
  return geometry::Vec3(micrometers[0], micrometers[1], micrometers[2]) / 1000;
}

TEST(ComparisonProperty, ASingleChangeIsFoundAlone) {
  for (std::uint64_t seed = 1; seed <= tries(); ++seed) {
    support::Random random(seed);
    const RandomPart part = random_part(random, random.between(5, 80), random.one_in(4));
    RandomPart changed = part;
    const std::optional<std::size_t> found = free_step(part, random);
    if (!found) continue;
    const std::size_t step = *found;
    const auto kind = static_cast<SeededChange>(random.between(0, 8));
    WritingStyle style{.is_numbered = random.one_in(2)};
    ChangeKind expected = ChangeKind::Moved;
    switch (kind) {
      case SeededChange::Coordinate:
        changed.steps[step].to[random.below(3)] += random.between(50, 20'000);
        break;
      case SeededChange::TwoCoordinates:
        if (!part.is_free(step + 1)) continue;
        changed.steps[step].to[0] += random.between(50, 20'000);
        changed.steps[step + 1].to[1] += random.between(50, 20'000);
        break;
      case SeededChange::Turn:
        if (!part.is_five_axis) continue;
        changed.steps[step].turn[random.below(2)] += random.between(50, 5'000);
        break;
      case SeededChange::Increment:
        style.is_incremental = true;
        for (std::size_t i = step; i < changed.steps.size(); ++i) {
          changed.steps[i].to[0] += 7000;
          changed.steps[i].center[0] += 7000;
        }
        break;
      case SeededChange::Feed:
        if (part.steps[step].kind != PartStep::Kind::Line) continue;
        changed.steps[step].feed += 50;
        expected = ChangeKind::Feed;
        break;
      case SeededChange::LineLost:
        changed.steps.erase(changed.steps.begin() + static_cast<std::ptrdiff_t>(step));
        expected = ChangeKind::Removed;
        break;
      case SeededChange::LinesSwapped:
        if (!part.is_free(step + 1)) continue;
        std::swap(changed.steps[step], changed.steps[step + 1]);
        expected = ChangeKind::Reordered;
        break;
      case SeededChange::Tool:
        changed.tool = 101002;
        expected = ChangeKind::Tool;
        break;
      case SeededChange::Speed:
        changed.speed = 9000;
        expected = ChangeKind::Speed;
        break;
    }
    const WrittenPart before = written(part, style);
    const WrittenPart after = written(changed, style);
    const std::vector<BehaviorChange> changes = symmetric_changes(before.text, after.text);
    ASSERT_EQ(changes.size(), 1U) << shown(changes) << failure(seed, before.text, after.text);
    const BehaviorChange& change = changes[0];
    ASSERT_EQ(change.kind, expected) << shown(changes) << failure(seed, before.text, after.text);
    if (kind == SeededChange::Tool || kind == SeededChange::Speed) continue;
    ASSERT_EQ(change.old_lines->first, before.lines[step]) << shown(changes) << failure(seed, before.text, after.text);
    if (kind == SeededChange::Increment) {
      ASSERT_LT((*change.shift - geometry::Vec3(7, 0, 0)).norm(), 1e-9) << seed;
      continue;
    }
    const bool are_two = kind == SeededChange::LinesSwapped || kind == SeededChange::TwoCoordinates;
    const std::size_t last = are_two ? step + 1 : step;
    ASSERT_EQ(change.old_lines->last, before.lines[last]) << shown(changes) << failure(seed, before.text, after.text);
    if (kind == SeededChange::Coordinate) {
      const geometry::Vec3 vector = point_of(changed.steps[step].to) - point_of(part.steps[step].to);
      ASSERT_NEAR(*change.distance, vector.norm(), 1e-9) << failure(seed, before.text, after.text);
    }
    if (kind != SeededChange::TwoCoordinates && kind != SeededChange::LineLost) continue;
    // The distance against a dense reference.
    std::vector<geometry::Vec3> old_path;
    std::vector<geometry::Vec3> new_path;
    std::size_t first = step;
    while (!part.steps[--first].is_motion()) continue;
    if (kind == SeededChange::LineLost) {
      if (part.is_five_axis) continue;
      std::size_t next = step + 1;
      while (next < part.steps.size() && !part.steps[next].is_motion()) ++next;
      if (next == part.steps.size()) continue;
      new_path = {point_of(part.steps[first].to), point_of(part.steps[next].to)};
      old_path = {new_path[0], point_of(part.steps[step].to), new_path[1]};
      // Straight to the next place: where the old program did not go, that has to be told.
      ASSERT_EQ(change.distance.has_value(), dense_distance(new_path, old_path) > 0.001) << shown(changes) << seed;
      if (!change.distance) continue;
      ASSERT_EQ(change.new_lines, (ChangedLines{after.lines[next - 1], after.lines[next - 1]})) << seed;
      const double reference = std::max(dense_distance(old_path, new_path), dense_distance(new_path, old_path));
      ASSERT_NEAR(*change.distance, reference, 0.001) << failure(seed, before.text, after.text);
      continue;
    }
    for (std::size_t i = first; i < part.steps.size(); ++i) {
      if (!part.steps[i].is_motion()) continue;
      old_path.push_back(point_of(part.steps[i].to));
      new_path.push_back(point_of(changed.steps[i].to));
      if (i > last) break;
    }
    // The tip of a rapid that turns B or C does not go straight, and the reference does.
    if (part.is_five_axis) continue;
    const double reference = std::max(dense_distance(old_path, new_path), dense_distance(new_path, old_path));
    // Between two points of the reference it can be farther by half of what lies between them.
    ASSERT_GE(*change.distance, reference - 0.001) << failure(seed, before.text, after.text);
    ASSERT_LE(*change.distance, reference + 0.05) << failure(seed, before.text, after.text);
  }
}

/// Lines that one program has as two are no changes beside a place that is moved, and what stands between the motions
/// is none, either.
TEST(ComparisonProperty, APlaceIsMovedAloneBesideLinesInOtherParts) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= tries(); ++seed) {
    support::Random random(seed);
    const RandomPart part = random_part(random, random.between(5, 60), random.one_in(4));
    const std::optional<std::size_t> step = free_step(part, random);
    if (!step) continue;
    RandomPart changed = part;
    changed.steps[*step].to[random.below(3)] += random.one_in(2) ? random.between(10, 60) : random.between(500, 20'000);
    const WrittenPart before = written(part, {.is_split = random.one_in(2)});
    const WrittenPart after = written(changed, {.is_split = random.one_in(2)});
    const std::vector<BehaviorChange> changes = symmetric_changes(before.text, after.text);
    ASSERT_EQ(changes.size(), 1U) << shown(changes) << failure(seed, before.text, after.text);
    ASSERT_EQ(changes[0].kind, ChangeKind::Moved) << shown(changes) << failure(seed, before.text, after.text);
    ++compared;
  }
  EXPECT_GT(compared, tries() / 2);
}

/// Random waves in short lines, of which a part is lifted: one change, as far as that is, however short the lines are.
TEST(ComparisonProperty, ALocalEditOfAFinePathIsFoundAlone) {
  for (std::uint64_t seed = 0; seed <= tries() / 6; ++seed) {
    constexpr std::uint64_t kBumpOnAShift = 1161;  // Within motions of one vector some are moved a bit otherwise.
    support::Random random(seed == 0 ? kBumpOnAShift : seed);
    const double step = random.between(4, 50) / 100.0;
    const double length = random.between(20, 60) / 10.0;
    const double height = random.between(3, 100) / 100.0;
    const double depth = random.between(0, 60) / 10.0;
    const int count = random.between(300, 1200);
    const double tolerance = random.one_in(3) ? 0.01 : 0.001;
    const int middle = random.between(count / 3, count / 2);
    const int half = std::min(count / 4, static_cast<int>(random.between(10, 80) / 10.0 / step) + 1);
    std::string old_program = "M06 T101001\nG00 X0 Y0 Z0\n";
    std::string new_program = old_program;
    std::vector<geometry::Vec3> old_path;
    std::vector<geometry::Vec3> new_path;
    for (int i = 1; i <= count; ++i) {
      const geometry::Vec3 place(i * step, depth * std::sin(i * step / length), 0.1 * depth * std::cos(i * step / 11));
      const double part = std::max(0.0, 1 - std::pow(static_cast<double>(i - middle) / half, 2));
      const geometry::Vec3 lifted = place + geometry::Vec3(0, 0, height * part * part);
      old_program += fmt::format("G01 X{:.4f} Y{:.4f} Z{:.4f} F1000\n", place.x(), place.y(), place.z());
      new_program += fmt::format("G01 X{:.4f} Y{:.4f} Z{:.4f} F1000\n", lifted.x(), lifted.y(), lifted.z());
      if (std::abs(i - middle) > half + 1) continue;
      old_path.push_back(place);
      new_path.push_back(lifted);
    }
    const RecordedRun old_run = recorded(old_program + "G00 Z50\nM02\n");
    const RecordedRun new_run = recorded(new_program + "G00 Z50\nM02\n");
    const std::vector<BehaviorChange> changes = compare(old_run, new_run, {.tolerance = tolerance});
    ASSERT_EQ(shown(swapped(compare(new_run, old_run, {.tolerance = tolerance}))), shown(changes)) << seed;
    ASSERT_EQ(changes.size(), 1U) << seed << '\n' << shown(changes);
    ASSERT_TRUE(changes[0].kind == ChangeKind::Moved || changes[0].kind == ChangeKind::Shape) << shown(changes);
    ASSERT_TRUE(changes[0].distance) << seed << shown(changes);
    const double reference = std::max(distance_of_points(old_path, new_path), distance_of_points(new_path, old_path));
    ASSERT_NEAR(*changes[0].distance, reference, step / 2 + 2 * tolerance) << seed << shown(changes);
    const double first = middle - half + 1;  // Lines from 0; two stand before the path.
    const double last = middle + half + 1;
    ASSERT_GE(static_cast<double>(changes[0].old_lines->first), first - 3) << seed << shown(changes);
    ASSERT_LE(static_cast<double>(changes[0].old_lines->last), last + 3) << seed << shown(changes);
  }
}

/// Holes in random places, of which two are exchanged or one comes at another time: that alone is found.
TEST(ComparisonProperty, HolesAtOtherTimesAreAnotherOrderAlone) {
  for (std::uint64_t seed = 1; seed <= tries(); ++seed) {
    support::Random random(seed);
    const auto count = static_cast<std::size_t>(random.between(4, 30));
    std::vector<std::array<int, 3>> holes;
    const bool is_grid = random.one_in(2);
    const int depth = random.between(1, 3);
    for (std::size_t i = 0; i < count; ++i) {
      const int x = is_grid ? 30 * static_cast<int>(i % 5) : static_cast<int>(7 * i) + random.between(0, 5);
      const int y = is_grid ? 40 * static_cast<int>(i / 5) : random.between(-90, 90);
      holes.push_back({x, y, is_grid ? depth : random.between(1, 20)});
    }
    auto changed = holes;
    const std::size_t from = random.below(count);
    const std::size_t to = random.below(count);
    if (from == to) continue;
    const bool are_neighbors = std::max(from, to) - std::min(from, to) == 1;
    const bool are_swapped = random.one_in(2);
    // With another depth, the retract after the last hole is moved otherwise than the rest of it.
    if (are_swapped && std::max(from, to) + 1 == count && holes[from][2] != holes[to][2]) continue;
    if (are_swapped) {
      std::swap(changed[from], changed[to]);
    } else {
      changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(from));
      changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(to), holes[from]);
    }
    const auto program = [](const std::vector<std::array<int, 3>>& places) {
      std::string text = "M06 T101001\nS12000 M03\nG00 X-50 Y-50 Z40\nZ5\n";
      for (const auto& [x, y, z] : places) text += fmt::format("G00 X{} Y{}\nZ2\nG01 Z{} F500\nG00 Z5\n", x, y, -z);
      return text + "Z40\nM02\n";
    };
    const std::string before = program(holes);
    const std::string after = program(changed);
    const std::vector<BehaviorChange> changes = symmetric_changes(before, after);
    ASSERT_EQ(changes.size(), are_swapped && !are_neighbors ? 2U : 1U)
        << shown(changes) << failure(seed, before, after);
    const auto lines = [](std::size_t hole) { return ChangedLines{4 + 4 * hole, 7 + 4 * hole}; };
    for (const BehaviorChange& change : changes) {
      ASSERT_EQ(change.kind, ChangeKind::Reordered) << shown(changes) << failure(seed, before, after);
      if (are_neighbors) continue;  // Either of them may be the one that has moved.
      const bool is_other = change.old_lines == lines(to);
      ASSERT_EQ(change.old_lines, lines(is_other ? to : from)) << shown(changes) << failure(seed, before, after);
      ASSERT_EQ(change.new_lines, lines(is_other ? from : to)) << shown(changes) << failure(seed, before, after);
      ASSERT_TRUE(are_swapped || !is_other) << shown(changes) << failure(seed, before, after);
    }
  }
}

/// The program as lines.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Motions in several zeros and faces one after the other, of which one is elsewhere: the frame alone, with its line.
TEST(ComparisonProperty, AFrameElsewhereIsFoundAlone) {
  for (std::uint64_t seed = 1; seed <= tries(); ++seed) {
    support::Random random(seed);
    const int count = random.between(2, 5);
    const int changed = random.between(0, count - 1);
    const std::array<int, 3> shift{random.between(1, 9), random.one_in(2) ? 0 : random.between(1, 9), 0};
    std::vector<std::string> lines{"M06 T101001", "S12000 M03"};
    std::vector<std::string> others = lines;
    std::size_t cause = 0;
    std::size_t last = 0;  // The last line in the changed frame.
    std::array<int, 3> at{0, 0, 0};
    for (int frame = 0; frame < count; ++frame) {
      const std::array<int, 3> zero{random.between(-200, 200), random.between(-200, 200), random.between(-20, 20)};
      const bool is_face = random.one_in(3);
      const std::string turn = is_face ? fmt::format(" C{}", random.between(1, 80)) : "";
      const auto line = [&](const std::array<int, 3>& by) {
        return fmt::format("{} X{} Y{} Z{}{}", is_face ? "G29" : "G92", zero[0] + by[0], zero[1] + by[1], zero[2],
                           turn);
      };
      if (frame == changed) cause = lines.size();
      lines.push_back(line({}));
      others.push_back(frame == changed ? line(shift) : lines.back());
      for (int i = random.between(4, 12); i > 0; --i) {
        std::string text = random.one_in(3) ? "G00" : "G01";
        const int axes = i == 1 ? 7 : random.between(1, 7);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if ((axes >> axis & 1) == 0 && at[axis] != 0) continue;
          int next = at[axis];
          // Farther than the shift: where the next motion ends in the place of this one, more is the same.
          while (std::abs(next - at[axis]) < 10) next = random.between(1, 300);
          at[axis] = next;
          text += fmt::format(" {}{}", "XYZ"[axis], next);
        }
        lines.push_back(text + (text[2] == '1' ? " F1000" : ""));
        others.push_back(lines.back());
      }
      if (frame == changed) last = lines.size() - 1;
      at = {0, 0, 0};  // The first motion in the next frame gives all coordinates.
      if (!is_face) continue;
      lines.push_back("G27");
      others.push_back("G27");
    }
    lines.push_back("M02");
    others.push_back("M02");
    const std::vector<BehaviorChange> changes = symmetric_changes(joined(lines), joined(others));
    ASSERT_EQ(changes.size(), 1U) << shown(changes) << failure(seed, joined(lines), joined(others));
    ASSERT_EQ(changes[0].kind, ChangeKind::Frame) << shown(changes) << failure(seed, joined(lines), joined(others));
    ASSERT_EQ(changes[0].old_cause, std::optional(cause)) << failure(seed, joined(lines), joined(others));
    ASSERT_TRUE(changes[0].shift) << failure(seed, joined(lines), joined(others));
    ASSERT_LE(changes[0].old_lines->first, cause + 2) << failure(seed, joined(lines), joined(others));
    ASSERT_GE(changes[0].old_lines->last + 1, last) << failure(seed, joined(lines), joined(others));
  }
}

// A path that differs, beside another change.

/// Points of an arc, dense enough for a distance to a fiftieth of its radius; it starts in -X of its center.
std::vector<geometry::Vec3> dense_arc(const geometry::Vec3& from, const geometry::Vec3& to,
                                      const geometry::Vec3& center, bool is_counterclockwise) {
  const double pi = std::acos(-1.0);
  const double radius = center.x() - from.x();
  double sweep = std::atan2(to.y() - center.y(), to.x() - center.x()) - pi;
  while (is_counterclockwise && sweep <= 0) sweep += 2 * pi;
  while (!is_counterclockwise && sweep >= 0) sweep -= 2 * pi;
  std::vector<geometry::Vec3> points;
  constexpr int kChords = 100;
  for (int i = 0; i <= kChords; ++i) {
    const double part = static_cast<double>(i) / kChords;
    const double angle = pi + part * sweep;
    points.push_back(center + radius * geometry::Vec3(std::cos(angle), std::sin(angle), 0));
    points.back().z() = from.z() + part * (to.z() - from.z());
  }
  return points;
}

enum class Beside { Nothing, Feed, Dwell, DwellLost, Function, Speed, Frame, LineBefore, LineAfter };

TEST(ComparisonProperty, AnArcThatGoesOtherwiseIsNamedBesideAnyChange) {
  std::size_t named = 0;
  for (std::uint64_t seed = 1; seed <= tries() / 2; ++seed) {
    support::Random random(seed);
    const RandomPart part = random_part(random, random.between(6, 40));
    std::vector<std::size_t> arcs;
    for (std::size_t i = 1; i < part.steps.size(); ++i)
      if (part.is_arc(i)) arcs.push_back(i);
    if (arcs.empty()) continue;
    const std::size_t step = arcs[random.below(arcs.size())];
    std::size_t before = step - 1;
    while (!part.steps[before].is_motion()) --before;
    RandomPart changed = part;
    const bool is_by_radius = part.steps[step].to[0] == part.steps[step].center[0] && random.one_in(2);
    if (!is_by_radius) changed.steps[step].is_counterclockwise = !part.steps[step].is_counterclockwise;

    // Another change between one motion before it and two after it.
    const auto beside = static_cast<Beside>(random.between(0, 8));
    const std::size_t at = std::min(part.steps.size() - 1, step + random.below(3));
    ComparisonOptions options{
        .ignores_feed = random.one_in(2), .ignores_speed = random.one_in(2), .ignores_time = random.one_in(2)};
    RandomPart old_part = part;
    const auto insert = [&](RandomPart& where, const PartStep& what) {
      where.steps.insert(where.steps.begin() + static_cast<std::ptrdiff_t>(at) + (at == step ? 0 : 1), what);
    };
    const std::size_t arc_now =
        (beside == Beside::Dwell || beside == Beside::DwellLost || beside == Beside::Function) && at == step ? step + 1
                                                                                                             : step;
    switch (beside) {
      case Beside::Nothing:
      case Beside::Frame:
        break;
      case Beside::Feed:
        changed.steps[at].feed += 50;
        break;
      case Beside::Dwell:
      case Beside::Function: {
        const auto kind = beside == Beside::Dwell ? PartStep::Kind::Dwell : PartStep::Kind::Function;
        insert(old_part, {.kind = kind, .number = 101});
        insert(changed, {.kind = kind, .number = 102});
        break;
      }
      case Beside::DwellLost:
        insert(old_part, {.kind = PartStep::Kind::Dwell, .number = 7});
        insert(changed, {.kind = PartStep::Kind::Function, .number = 103});
        break;
      case Beside::Speed:
        changed.speed = 9000;
        break;
      case Beside::LineBefore:
        // Not the start of the arc, but where the motion to it starts.
        if (before == 0 || !part.is_free(before - 1)) continue;
        changed.steps[before - 1].to[1] += 3000;
        break;
      case Beside::LineAfter:
        if (!part.is_free(step + 1)) continue;
        changed.steps[step + 1].to[1] += 3000;
        break;
    }
    const WrittenPart old_program = written(old_part);
    WrittenPart new_program = written(changed);
    std::vector<std::string> lines = lines_of(new_program.text);
    if (is_by_radius) {
      std::string& line = lines[new_program.lines[arc_now]];
      const double radius = std::abs(part.steps[step].center[0] - part.steps[before].to[0]) / 1000.0;
      const std::size_t center = line.find(" I");
      line.replace(center, line.find(" F") - center, fmt::format(" R{:.4f}", 1.5 * radius));
    }
    if (beside == Beside::Frame) lines.insert(lines.begin() + 2, "G92 X0 Y0 Z-1.5");
    const std::string text = joined(lines);
    const RecordedRun old_run = recorded(old_program.text);
    const RecordedRun new_run = recorded(text);
    ASSERT_EQ(new_run.actions.back().number, 0U) << failure(seed, old_program.text, text);
    const std::vector<BehaviorChange> changes = compare(old_run, new_run, options);
    ASSERT_EQ(shown(swapped(compare(new_run, old_run, options))), shown(changes)) << seed;
    const std::size_t arc_line = old_program.lines[arc_now];
    const auto change = std::find_if(changes.begin(), changes.end(), [&](const BehaviorChange& each) {
      return each.kind == ChangeKind::Shape && each.old_lines == ChangedLines{arc_line, arc_line};
    });
    ASSERT_NE(change, changes.end()) << shown(changes) << failure(seed, old_program.text, text);
    ASSERT_LE(changes.size(), 4U) << shown(changes) << failure(seed, old_program.text, text);
    ++named;
    if (is_by_radius) continue;
    const geometry::Vec3 from = point_of(part.steps[before].to);
    const geometry::Vec3 to = point_of(part.steps[step].to);
    const geometry::Vec3 center(part.steps[step].center[0] / 1000.0, part.steps[step].center[1] / 1000.0, from.z());
    const auto old_arc = dense_arc(from, to, center, part.steps[step].is_counterclockwise);
    const auto new_arc = dense_arc(from, to, center, !part.steps[step].is_counterclockwise);
    const double reference = std::max(distance_of_points(old_arc, new_arc), distance_of_points(new_arc, old_arc));
    ASSERT_NEAR(change->distance.value_or(0), reference, 0.04 * (center - from).norm()) << seed;
  }
  EXPECT_GT(named, tries() / 6);
}

/// Several changes far enough from each other: as many are found, each in its place.
TEST(ComparisonProperty, SeveralChangesAreFoundEachInItsPlace) {
  for (std::uint64_t seed = 1; seed <= tries() / 12; ++seed) {
    support::Random random(seed);
    const RandomPart part = random_part(random, 200, random.one_in(4));
    RandomPart changed = part;
    std::vector<std::size_t> steps;
    for (std::size_t i = 5; i + 5 < part.steps.size(); ++i)
      if (part.is_free(i) && (steps.empty() || i > steps.back() + 12) && random.one_in(3)) steps.push_back(i);
    for (const std::size_t step : steps) changed.steps[step].to[1] += 1000;
    const WrittenPart before = written(part);
    const WrittenPart after = written(changed);
    const std::vector<BehaviorChange> changes = symmetric_changes(before.text, after.text);
    ASSERT_EQ(changes.size(), steps.size()) << shown(changes) << failure(seed, before.text, after.text);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const ChangedLines line{before.lines[steps[i]], before.lines[steps[i]]};
      ASSERT_EQ(changes[i].kind, ChangeKind::Moved) << shown(changes) << failure(seed, before.text, after.text);
      ASSERT_EQ(changes[i].old_lines, line) << shown(changes) << failure(seed, before.text, after.text);
      ASSERT_EQ(changes[i].new_lines, line) << shown(changes) << failure(seed, before.text, after.text);
      ASSERT_LT((*changes[i].shift - geometry::Vec3(0, 1, 0)).norm(), 1e-9) << seed;
    }
  }
}

/// Programs that contain all that a program can: jumps, compensation, frames, errors.
TEST(ComparisonProperty, AProgramIsTheSameAsItself) {
  for (const std::uint64_t seed : support::seeds(300)) {
    support::Random random(seed);
    const std::string program = simulation::RandomRun(random).text(random.between(1, 4));
    ASSERT_EQ(shown(changes_between(program, program)), "") << program;
    ASSERT_EQ(shown(changes_between(program, "( the same )\n" + program)), "") << program;
  }
}

/// A program and the same one without a line, whatever that does: mirrored, and no failure.
TEST(ComparisonProperty, AnyTwoProgramsCompareTheSameInBothWays) {
  for (const std::uint64_t seed : support::seeds(200)) {
    support::Random random(seed);
    const std::string program = simulation::RandomRun(random).text(random.between(1, 4));
    std::string other = program;
    const std::size_t begin = other.find('\n', random.below(other.size()));
    if (begin != std::string::npos) other.erase(begin, other.find('\n', begin + 1) - begin);
    symmetric_changes(program, other);
    support::Random another_random(seed + 100'000);
    symmetric_changes(program, simulation::RandomRun(another_random).text(2));
    if (HasFailure()) FAIL() << failure(seed, program, other);
  }
}

// Differences larger than what is looked into in all ways.

RandomPart without(RandomPart part, std::size_t begin, std::size_t end) {
  part.steps.erase(part.steps.begin() + static_cast<std::ptrdiff_t>(begin),
                   part.steps.begin() + static_cast<std::ptrdiff_t>(end));
  return part;
}

class LargeDifferences : public testing::Test {
 protected:
  LargeDifferences() {
    support::Random random(7);
    part_ = random_part(random, 3000, true);
  }

  std::string changes(const RandomPart& other) const {
    return shown(symmetric_changes(written(part_).text, written(other).text));
  }
  /// The first motion from a step on; it has line step + 5.
  std::size_t motion_from(std::size_t step) const {
    while (!part_.steps[step].is_motion()) ++step;
    return step;
  }

  RandomPart part_;
};

TEST_F(LargeDifferences, BlockRemoved) {
  const std::size_t begin = motion_from(1000);
  const std::size_t end = motion_from(1400);
  const RecordedRun old_run = recorded(written(part_).text);
  const std::vector<BehaviorChange> changes =
      compare(old_run, recorded(written(without(part_, begin, end)).text), ComparisonOptions{.ignores_time = true});
  std::vector<ChangeKind> kinds;
  for (const BehaviorChange& change : changes)
    if (change.kind != ChangeKind::Function) kinds.push_back(change.kind);
  ASSERT_EQ(kinds, std::vector{ChangeKind::Removed}) << shown(changes);
}

TEST_F(LargeDifferences, BlockElsewhere) {
  part_.steps.erase(
      std::remove_if(part_.steps.begin(), part_.steps.end(), [](const PartStep& step) { return !step.is_motion(); }),
      part_.steps.end());
  RandomPart other = part_;
  std::rotate(other.steps.begin() + 500, other.steps.begin() + 600, other.steps.begin() + 1500);
  EXPECT_EQ(changes(other), "reordered 505-604|1405-1504: order changed\n");
}

/// Random operations, in another order: those that stay are as many actions as possible, and the others alone are told.
TEST(OperationsInAnotherOrder, AreEachOneChange) {
  support::Random random(11);
  for (int round = 0; round < (support::kTriesAll ? 300 : 30); ++round) {
    const int count = random.between(2, 6);
    std::vector<std::string> texts;
    for (int tool = 1; tool <= count; ++tool) {
      RandomPart part = random_part(random, random.between(1, 30), random.one_in(3));
      part.tool = 101000 + tool;
      // None begins where another one ends: going nowhere would be no motion there.
      part.steps.insert(part.steps.begin(), {.kind = PartStep::Kind::Rapid, .to = {1000 * tool, 0, 50'000}});
      std::string text = written(part).text;
      text.erase(text.find("M02"));
      texts.push_back(text + (part.is_five_axis ? "G01 B0 C0 F1000\nG48\n" : "") + "M05\n");
    }
    std::vector<std::size_t> order(texts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = order.size(); i-- > 1;)
      std::swap(order[i], order[static_cast<std::size_t>(random.between(0, static_cast<int>(i)))]);
    const bool is_lost = count > 2 && random.one_in(4);
    std::string old_program;
    std::string new_program;
    for (const std::string& text : texts) old_program += text;
    for (const std::size_t i : order)
      if (!is_lost || i != 0) new_program += texts[i];
    const std::vector<BehaviorChange> changes = symmetric_changes(old_program + "M02\n", new_program + "M02\n");
    std::size_t longest = 0;  // Of operations that keep their order.
    for (unsigned kept = 0; kept < 1U << texts.size(); ++kept) {
      std::size_t last = 0;
      std::size_t row = 0;
      bool keeps = true;
      for (const std::size_t i : order) {
        if ((kept >> i & 1U) == 0 || (is_lost && i == 0)) continue;
        keeps = keeps && (row == 0 || i > last);
        last = i;
        ++row;
      }
      if (keeps) longest = std::max(longest, row);
    }
    EXPECT_GE(changes.size(), texts.size() - longest) << shown(changes);
    EXPECT_LT(changes.size(), texts.size()) << shown(changes);
    EXPECT_TRUE(
        std::all_of(changes.begin(), changes.end(), [](const BehaviorChange& each) { return each.is_operation; }))
        << shown(changes) << old_program << "\n--\n"
        << new_program;
  }
}

TEST_F(LargeDifferences, TooLargeToLookInto) {
  support::Random random(8);
  const RandomPart other = random_part(random, 3000, true);
  const std::vector<BehaviorChange> all = symmetric_changes(written(part_).text, written(other).text);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, ChangeKind::Shape);
  EXPECT_FALSE(all[0].distance);
}

/// Blocks that are quite different, between others that are the same: each alone is small enough to be looked into, and
/// all together are not. The time is that of the budget, whatever their number.
TEST(WorkBudget, BoundsTheWorkOfAllDifferences) {
  if (!support::kTriesAll) GTEST_SKIP() << "minutes under the sanitizers";
  support::Random random(9);
  std::string old_program = "M06 T101001\nS12000 M03\n";
  std::string new_program = old_program;
  const auto motion = [&] {
    return fmt::format("G01 X{} Y{} F2000\n", random.between(0, 500), random.between(0, 500));
  };
  constexpr int kBlocks = 32;
  for (int block = 0; block < kBlocks; ++block) {
    for (int i = 0; i < 60; ++i) {
      const std::string same = motion();
      old_program += same;
      new_program += same;
    }
    for (int i = 0; i < 900; ++i) {
      old_program += motion();
      new_program += motion();
    }
  }
  const std::vector<BehaviorChange> changes =
      compare(recorded(old_program + "M02\n"), recorded(new_program + "M02\n"), {});
  const auto are_looked_into =
      std::count_if(changes.begin(), changes.end(), [](const BehaviorChange& each) { return each.distance; });
  EXPECT_GE(changes.size(), static_cast<std::size_t>(kBlocks)) << "each has its place";
  EXPECT_GT(are_looked_into, 10);
  EXPECT_LT(are_looked_into, kBlocks - 5);
}

TEST(WorkBudget, IsNotSpentBySmallDifferences) {
  WorkBudget budget{.window_pairs = 0, .gap_cells = 10'000, .distances = 0};
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(budget.take_cells(50, 50));
  EXPECT_TRUE(budget.take_cells(100, 100));
  EXPECT_FALSE(budget.take_cells(51, 50));
  EXPECT_TRUE(budget.take_cells(50, 50));
}

}  // namespace
}  // namespace isocnc::comparison
