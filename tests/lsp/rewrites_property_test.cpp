#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <variant>

#include <fmt/format.h>

#include "analyzer/fixing/rewriting.h"
#include "client_text.h"
#include "interpreter/running/runner.h"
#include "session.h"
#include "tests/support/random_program.h"

/// After any rewrite in any place, the machine moves as before.
namespace isocnc::lsp {
namespace {

using execution::MachineMove;
using running::Event;
using support::Random;
using support::RandomProgram;

/// Writes programs that run to their end, with passes in all modes and sometimes a line that may be wrong.
class RandomPart {
 public:
  explicit RandomPart(Random& random) : random_(random) {}

  std::string text() {
    std::string all = fmt::format("M06 T10100{} M03 S9000\nG01 Z20 F{}\n", random_.between(1, 9), 100 * feed());
    const int lines = random_.between(4, 30);
    for (int i = 0; i < lines; ++i) all += line() + '\n';
    return all + (random_.one_in(3) ? "N900 M02" : "N900 M02\n");
  }

 private:
  int feed() { return random_.between(1, 40); }
  std::string number() { return fmt::format("{}.{}", random_.between(-90, 90), random_.between(0, 999)); }

  std::string line() {
    std::string text = statement();
    if (random_.one_in(6)) text = fmt::format("N{} {}", random_.between(1, 99), text);
    if (random_.one_in(6)) text = "  " + text;
    if (random_.one_in(5)) text += random_.any_of({" (è 😀)", " ; più", "(a)"});
    return text;
  }

  std::string statement() {
    switch (random_.between(0, 15)) {
      case 0:
        return "G90";
      case 1:
        return "G91";
      case 2:
        return std::string(random_.any_of({"G70", "G71"}));
      case 3:
        return std::string(random_.any_of({"G17", "G90 G71", "G94", "F1500", "S8000", "M100", "G04 P1", "G90 G00 X5"}));
      case 4:
        return fmt::format("G00 B{}", 5 * random_.between(-9, 9));
      case 5: {
        const int radius = feed();
        return fmt::format("G91 G17 G0{} X{} Y0 I{} J0", random_.between(2, 3), 2 * radius, radius);
      }
      case 6: {
        const int radius = feed();
        return fmt::format("G91 G17 G03 X{} Y{} I0 J{}", radius, radius, radius);
      }
      case 7:
        return fmt::format("G17 G0{} X{} Y{} R{}", random_.between(2, 3), number(), number(), 10000);
      case 8:
        return random_.one_in(3) ? fmt::format("G92 X{} Y{} Z0", number(), number())
                                 : fmt::format("G29 X{} Y{} Z0 B0 C{}", number(), number(), 15 * random_.between(0, 9));
      case 9:
        return random_.one_in(2) ? "G27" : "IF VGPL = 1 GOTO N900";
      case 10:
        return random_.one_in(8) ? RandomProgram(random_).line() : "";
      case 11:
        return fmt::format("G01 Z{} F{}", number(), 10 * feed());
      default:
        return fmt::format("{} X{} Y{}", random_.any_of({"G00", "G01", ""}), number(), number());
    }
  }

  Random& random_;
};

struct RecordedRun {
  std::vector<MachineMove> moves;
  std::vector<std::string> others;  // The other events in order, each after the number of moves before it.
};

RecordedRun run(const std::string& text, double vgpl) {
  RecordedRun recorded;
  const running::RunOptions options{.vgpl = vgpl};
  const auto result = running::run(text, options, [&](const Event& event) {
    if (const auto* const move = std::get_if<running::MoveEvent>(&event.what)) {
      recorded.moves.push_back(*move);
    } else {
      recorded.others.push_back(fmt::format("{} {}", recorded.moves.size(), running::kind_of(event)));
    }
  });
  recorded.others.push_back(fmt::format("ending {}", static_cast<int>(result.ending)));
  return recorded;
}

/// The middle point of an arc's path. Used for comparison because equal paths of flat arcs may have slightly different
/// centers.
geometry::Vec3 middle(const MachineMove& arc) {
  const Eigen::AngleAxisd half(arc.sweep_deg / 2 * std::numbers::pi / 180, arc.normal);
  const double rise = (arc.to.tip - arc.from.tip).dot(arc.normal);
  return arc.center + half * (arc.from.tip - arc.center) + rise / 2 * arc.normal;
}

/// The maximum difference between two motions: mm, degrees, and a fraction of the feed.
double difference(const MachineMove& a, const MachineMove& b) {
  if (a.kind != b.kind || a.inverse_time != b.inverse_time || a.five_axis != b.five_axis) return 1e9;
  double maximum = std::abs(a.feed - b.feed) / std::max(1.0, a.feed);
  for (const auto& [p, q] : {std::pair(a.from, b.from), std::pair(a.to, b.to)})
    maximum = std::max({maximum, (p.tip - q.tip).norm(), std::abs(p.b - q.b), std::abs(p.c - q.c)});
  if (a.kind != execution::MoveKind::Arc) return maximum;
  return std::max(
      {maximum, (middle(a) - middle(b)).norm(), std::abs(a.radius * a.sweep_deg - b.radius * b.sweep_deg) / 57});
}

/// A random offset at the start of a line, or within one.
std::size_t random_place(Random& random, const std::string& text) {
  const std::size_t at = random.below(text.size());
  const std::size_t end = text.rfind('\n', at);
  return end == std::string::npos ? 0 : end + 1;
}

TEST(RewritesProperty, TheMachineMovesAsItDid) {
  Session session;
  session.start();
  std::map<std::string, int> made;
  for (const std::uint64_t seed : support::seeds(250)) {
    Random random(seed);
    const std::string text = RandomPart(random).text();
    const ClientText before(text);
    std::size_t begin = random_place(random, text);
    std::size_t end = random.one_in(3) ? begin : random_place(random, text);
    if (end < begin) std::swap(begin, end);
    session.open(kUri, text);
    const Json actions =
        session.request("textDocument/codeAction", {{"textDocument", {{"uri", kUri}}},
                                                    {"range", before.range(begin, end)},
                                                    {"context", {{"only", Json::array({"refactor"})}}}});
    for (const Json& action : actions) {
      const std::string title = action["title"];
      ++made[title];
      const std::string after = before.with(action["edit"]["changes"][kUri]);
      EXPECT_NE(after, text) << title;
      for (const double vgpl : {0.0, 1.0}) {
        const RecordedRun old_run = run(text, vgpl);
        const RecordedRun new_run = run(after, vgpl);
        ASSERT_EQ(new_run.others, old_run.others) << "seed " << seed << ", " << title << '\n'
                                                  << text << "---\n"
                                                  << after;
        ASSERT_EQ(new_run.moves.size(), old_run.moves.size()) << "seed " << seed << ", " << title << '\n' << after;
        for (std::size_t i = 0; i < old_run.moves.size(); ++i)
          ASSERT_LE(difference(old_run.moves[i], new_run.moves[i]), 3 * fixing::kSameArc)
              << "seed " << seed << ", " << title << ", move " << i << '\n'
              << text << "---\n"
              << after;
      }
    }
  }
  EXPECT_EQ(made.size(), 9u);  // Each kind of rewrite, and the two rewrites of the motion G.
  for (const auto& [title, times] : made) EXPECT_GT(times, 0) << title;
}

}  // namespace
}  // namespace isocnc::lsp
