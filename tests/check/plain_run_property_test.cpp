#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "analyzer/rules/memory.h"
#include "interpreter/execution/execute.h"
#include "interpreter/execution/plain_run.h"
#include "interpreter/syntax/tree_store.h"
#include "tests/support/random_program.h"
#include "tests/support/report_text.h"

namespace isocnc::execution {
namespace {

using support::Random;
using support::RandomProgram;

/// Counts what is wrong.
class CountingSink final : public Sink {
 public:
  explicit CountingSink(rules::Memory& memory) : Sink(false), memory_(memory) {}
  void report(const syntax::Finding&) override { ++findings; }
  void step(BlockStep step, const State& before) override { memory_.take(step, before); }

  int findings = 0;

 private:
  rules::Memory& memory_;
};

/// The start of each line.
std::vector<const char*> line_starts(const std::string& text) {
  std::vector<const char*> starts = {text.data()};
  for (const char& c : text)
    if (c == '\n') starts.push_back(&c + 1);
  return starts;
}

/// Rows of plain lines are executed by a function of their own, which must leave the very state, and memory of the lint
/// rules, that execute() leaves, and pass over nothing that is wrong.
TEST(PlainRunProperty, LeavesTheStateAndTheMemoryOfExecute) {
  std::size_t rows = 0;
  std::size_t longest = 0;
  for (const std::uint64_t seed : support::seeds(1'500)) {
    Random random(seed);
    const execution::Setup setup;
    std::string text = support::joined(RandomProgram(random).lines(random.between(1, 120)));
    text += "M06 T101001 M3 S12000\nG1 G90 G71 G94 X1 Y1 F500\n";
    for (int i = random.between(0, 20); i > 0; --i)
      text += "X1 Y" + std::to_string(random.between(-9, 9)) + "\nG0 Z5\n";
    syntax::TreeStore trees;
    trees.append_lines(text.data(), text.data() + text.size(), text.data() + text.size());
    const std::vector<const char*> starts = line_starts(text);
    State state = initial_state(setup);
    State expected = state;
    rules::Memory memory;
    rules::Memory expected_memory;
    for (std::size_t line = 0; line < trees.size() && !state.ended;) {
      std::size_t done = 0;
      {
        PlainRun run(state, setup);
        const bool is_judged = memory.judges_plain_motions(state);
        while (!is_judged && line + done < trees.size() && run.run(trees.plain(line + done))) ++done;
        memory.take(run.effects(), state);
      }
      rows += done > 0 ? 1 : 0;
      longest = std::max(longest, done);
      CountingSink unheard(expected_memory);
      for (; done > 0; --done, ++line) execute(trees.tree(line, starts[line]), expected, setup, unheard);
      ASSERT_EQ(unheard.findings, 0) << "seed " << seed << ", line " << line;
      ASSERT_EQ(state, expected) << "seed " << seed << ", line " << line;
      ASSERT_EQ(memory, expected_memory) << "seed " << seed << ", line " << line;
      if (line == trees.size()) break;
      execute(trees.tree(line, starts[line]), state, setup, unheard);
      ++line;
      expected = state;
      memory = expected_memory;
    }
  }
  EXPECT_GT(rows, support::seeds(1'500).size());
  EXPECT_GT(longest, 10u);
}

/// The states before the lines of a random program.
std::vector<State> random_states(Random& random) {
  const execution::Setup setup;
  std::vector<State> states = {initial_state(setup)};
  for (const std::string& line : RandomProgram(random).lines(40)) {
    State state = states.back();
    rules::Memory memory;
    CountingSink unheard(memory);
    execute(syntax::ParsedLine(line).tree(), state, setup, unheard);
    states.push_back(state);
  }
  return states;
}

/// Runs plain lines from a state; returns how many it ran.
std::size_t run_row(const syntax::TreeStore& trees, State& state, PlainEffects& effects) {
  const execution::Setup setup;
  PlainRun run(state, setup);
  std::size_t done = 0;
  while (done < trees.size() && run.run(trees.plain(done))) ++done;
  effects = run.effects();
  return done;
}

/// What a row passes on makes no difference to it, and is the same after it.
TEST(PlainRunProperty, PassesOnWhatItDoesNotRead) {
  std::size_t different = 0;
  std::size_t with_arcs = 0;
  for (const std::uint64_t seed : support::seeds(3'000)) {
    Random random(seed);
    std::string text;
    for (int i = random.between(1, 6); i > 0; --i)
      text += std::string(random.any_of({"G0 X5 Y5", "G1 X7 F300", "Z3", "G2 X20 Y0 R500", "X1 Y2", "F100 Y3",
                                         "G3 X1 Y1 R90", "G2 X1 Z1 R400", "G1 Y8"})) +
              "\n";
    const std::string padded = text + std::string(40, '\n');
    syntax::TreeStore trees;
    trees.append_lines(padded.data(), padded.data() + text.size(), padded.data() + padded.size());
    const std::vector<State> states = random_states(random);
    State before = states[random.below(states.size())];
    before.tool_selected = true;
    before.lack = {};
    if (random.one_in(2)) before.in_doubt = 0;
    const State& other = states[random.below(states.size())];

    PlainEffects row;
    State after = before;
    const std::size_t done = run_row(trees, after, row);
    if (done < trees.size()) continue;
    State from = before;
    PlainRun::copy_unread(other, row, from);
    different += from == before ? 0 : 1;
    with_arcs += row.has_arc ? 1 : 0;

    State reached = from;
    PlainEffects same_row;
    ASSERT_EQ(run_row(trees, reached, same_row), done) << "seed " << seed;
    PlainRun::copy_passed_on(from, row, after);
    EXPECT_EQ(reached, after) << "seed " << seed;
  }
  EXPECT_GT(different, support::often(500));
  EXPECT_GT(with_arcs, support::often(100));
}

/// Lines without B and C read neither the origin of the workpiece nor how rotary axes are interpolated.
TEST(PlainRun, PassesOnTheOriginAndTheInterpolation) {
  State other;
  other.workpiece_origin = {1, 2, 3};
  other.set_mode(dialect::ModalGroup::Interpolation, 49);
  State after;
  PlainRun::copy_passed_on(other, {.letters = dialect::kLinearLetters}, after);
  EXPECT_EQ(after.workpiece_origin, other.workpiece_origin);
  EXPECT_EQ(after.mode(dialect::ModalGroup::Interpolation), 49);
}

/// The same for lines of one assignment, or one IF.
TEST(LoneAssignment, AndLoneJumpLeaveTheStateOfExecute) {
  std::size_t count = 0;
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const execution::Setup setup;
    const std::string text = support::joined(RandomProgram(random).lines(60));
    syntax::TreeStore trees;
    trees.append_lines(text.data(), text.data() + text.size(), text.data() + text.size());
    const std::vector<const char*> starts = line_starts(text);
    State state = initial_state(setup);
    rules::Memory memory;
    CountingSink unheard(memory);
    for (std::size_t line = 0; line < trees.size() && !state.ended; ++line) {
      const syntax::LineTree tree = trees.tree(line, starts[line]);
      State shortened = state;
      const rules::Memory remembered = memory;
      const bool is_lone = lone_assignment(tree).has_value() || is_lone_jump(tree);
      if (is_lone) pass_by(shortened);
      execute(tree, state, setup, unheard);
      if (!is_lone) continue;
      ++count;
      EXPECT_EQ(shortened, state) << "seed " << seed << ", line " << line;
      EXPECT_EQ(remembered, memory) << "seed " << seed << ", line " << line;
    }
  }
  EXPECT_GT(count, 100u);
}

TEST(LoneAssignment, IsNothingElse) {
  const auto read = [](const char* line) { return lone_assignment(syntax::ParsedLine(line).tree()); };
  ASSERT_TRUE(read("N5 V7 = -2.5 (depth)").has_value());
  EXPECT_EQ(read("N5 V7 = -2.5 (depth)")->reg, 7);
  EXPECT_EQ(read("N5 V7 = -2.5 (depth)")->value, -2.5);
  for (const char* const line : {"", "N5", "V31=1", "V7", "V7=", "V7=1 V8=2", "V7=1 F100", "V7=1 S100", "V7=1.2.3",
                                 "V7=1 X5", "G0 X5", "IF V7=1 GOTO N5"})
    EXPECT_FALSE(read(line).has_value()) << line;
}

TEST(LoneJump, IsNothingElse) {
  const auto is_lone = [](const char* line) { return is_lone_jump(syntax::ParsedLine(line).tree()); };
  EXPECT_TRUE(is_lone("IF VGPL=1 GOTO N5"));
  EXPECT_TRUE(is_lone("N1 IF V7 <= -2.5 GOTO N5 (as far as it goes)"));
  for (const char* const line : {"", "N5", "V7=1", "IF V7=1 GOTO N5 G0 X5", "IF V7=1 GOTO N5 F100", "IF V7=1", "G0 X5"})
    EXPECT_FALSE(is_lone(line)) << line;
}

}  // namespace
}  // namespace isocnc::execution
