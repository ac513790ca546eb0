/// What writes a program anew promises that the machine does the same. The comparison, which knows nothing of how they
/// work, holds them to it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "analyzer/fixing/rewriting.h"
#include "analyzer/fixing/text_program.h"
#include "analyzer/revisions/same_behavior.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/restart/restart.h"
#include "revisions.h"
#include "tests/support/random.h"
#include "tests/support/text_of_file.h"

namespace isocnc::revisions {
namespace {

namespace fs = std::filesystem;
using fixing::Rewrite;

/// The programs of examples/, the broken ones, too.
std::vector<fs::path> examples() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(ISOCNC_SOURCE_DIR "/examples"))
    if (entry.path().extension() == ".iso") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

timing::TimedMachine head_machine() {
  timing::TimedMachine machine;
  machine.motion.kinematics = kinematics::head_router().kinematics;
  return machine;
}

/// The changes, a line each; empty for none.
std::string shown(const std::vector<comparison::BehaviorChange>& changes) {
  std::string text;
  for (const comparison::BehaviorChange& change : changes)
    text += fmt::format("{} {}\n", name_of(change.kind), in_words(change, dialect::Language::English));
  return text;
}

/// The program with lines rewritten; none if the rewrite refuses.
std::optional<std::string> rewritten(const std::string& program, Rewrite how, std::size_t first, std::size_t last) {
  const rules::CheckSetup setup;
  fixing::TextProgram lines(program, setup);
  const auto edits = fixing::rewrite(how, lines, setup.machine, first, last);
  if (!edits) return std::nullopt;
  std::string result = program;
  for (auto edit = edits->rbegin(); edit != edits->rend(); ++edit) {
    const std::size_t begin = lines.offset(edit->begin);
    result.replace(begin, lines.offset(edit->end) - begin, edit->text);
  }
  return result;
}

TEST(SameBehavior, OfEachRewriteOfTheEditor) {
  support::Random random(20260206);
  const timing::TimedMachine machine = head_machine();
  std::array<int, 6> made{};
  for (const fs::path& file : examples()) {
    const std::string program = text_of_file(file);
    const comparison::RecordedRun run = comparison::record(program, {}, machine);
    const auto lines = static_cast<std::size_t>(std::count(program.begin(), program.end(), '\n'));
    for (int how = 0; how < 6; ++how)
      for (int i = 0; i < 6; ++i) {
        const std::size_t first = i == 0 ? 0 : random.below(lines);
        const std::size_t last = i == 0 ? lines - 1 : std::min(lines - 1, first + random.below(25));
        const auto other = rewritten(program, static_cast<Rewrite>(how), first, last);
        if (!other) continue;
        ++made[static_cast<std::size_t>(how)];
        ASSERT_EQ(shown(comparison::compare(run, comparison::record(*other, {}, machine), {})), "")
            << file << " rewrite " << how << " of lines " << first + 1 << " to " << last + 1 << '\n'
            << *other;
      }
  }
  EXPECT_THAT(made, testing::Each(testing::Gt(5)));
}

/// A rewrite that is a bit off is found.
TEST(SameBehavior, IsNoPromiseThatCannotBeBroken) {
  const std::string program = "M06 T101001\nS12000 M03\nG00 X10 Y0 Z5\nG01 Z-2 F1000\nG02 X30 Y0 I20 J0\nG00 Z5\nM02\n";
  std::string other = rewritten(program, Rewrite::Inches, 3, 5).value_or("");
  const std::size_t inches = other.find("X1.1811");
  ASSERT_NE(inches, std::string::npos) << other;
  const timing::TimedMachine machine = head_machine();
  const comparison::RecordedRun run = comparison::record(program, {}, machine);
  EXPECT_EQ(shown(comparison::compare(run, comparison::record(other, {}, machine), {})), "");
  other.replace(inches, 7, "X1.1812");
  EXPECT_NE(shown(comparison::compare(run, comparison::record(other, {}, machine), {})), "");
}

TEST(SameBehavior, SaysWhyItIsNotCertain) {
  const auto why = [](const std::string& old_program, const std::string& new_program) {
    const Revision before = revision_of(old_program);
    const Revision after = revision_of(new_program);
    return why_not_same({before, after}, {}, dialect::Language::English).value_or("");
  };
  const std::string branch = "M06 T101001\nIF VGPL = 1 GOTO N1\nG00 X10\nN1 G00 Y10\n";
  EXPECT_EQ(why(branch + "M02\n", "( the same )\n" + branch + "M02\n"), "");
  EXPECT_EQ(why(branch, branch), "") << "without M02 it is run to its end";
  EXPECT_EQ(why(branch + "M02\n", "M06 T101001\nIF VGPL = 1 GOTO N1\nG00 X10\nN1 G00 Y10 Z1\nM02\n"),
            "the machine would do otherwise: moved by Z1");
  // The path of VGPL = 1 alone.
  EXPECT_EQ(why(branch + "M02\n", "M06 T101001\nIF VGPL = 1 GOTO N2\nG00 X10\nN1 G00 Y10\nN2 M02\n"),
            "the machine would do otherwise: removed: 1 motion");
  EXPECT_EQ(why(branch + "G01\nM02\n", branch + "G01\nM02\n"),
            "ISO026 stops the program on line 5, and what comes after it is not run");
  const std::string on_register = "M06 T101001\nIF V7 = 1 GOTO N1\nG00 X10\nN1 M02\n";
  EXPECT_EQ(why(on_register, on_register), "an IF compares V7, which the program does not set");
}

/// What a run does from a line on. What the restart has done before is its own affair.
comparison::RecordedRun tail_of(comparison::RecordedRun run, std::size_t first_line) {
  const auto first = std::find_if(run.actions.begin(), run.actions.end(),
                                  [&](const comparison::MachineAction& each) { return each.line >= first_line; });
  const auto before = static_cast<std::size_t>(first - run.actions.begin());
  run.actions.erase(run.actions.begin(), first);
  std::erase_if(run.decisions, [&](const comparison::ActionDecision& each) { return each.line < first_line; });
  for (comparison::ActionDecision& each : run.decisions) each.action -= before;
  for (comparison::ActionSpindle& each : run.spindles)
    each.cause = each.cause && *each.cause >= before ? std::optional(*each.cause - before) : std::nullopt;
  return run;
}

TEST(SameBehavior, OfTheTailOfEachRestart) {
  int made = 0;
  for (const fs::path& file : examples()) {
    const std::string program = text_of_file(file);
    restart::RestartOptions options;
    options.machine = head_machine();
    options.machine.home.tip.z() = options.run.setup.home.tip.z() = 450;
    const comparison::RecordedRun run = comparison::record(program, options.run, options.machine);
    if (!comparison::error_of(run).empty()) continue;
    const auto lines = static_cast<std::size_t>(std::count(program.begin(), program.end(), '\n'));
    for (std::size_t line = 1; line < lines; line += 3) {
      options.line = line;
      const auto restarted = restart::restart_program(program, options);
      const auto* const text = std::get_if<std::string>(&restarted);
      if (text == nullptr) continue;
      ++made;
      const auto new_lines = static_cast<std::size_t>(std::count(text->begin(), text->end(), '\n'));
      const comparison::RecordedRun again = comparison::record(*text, options.run, options.machine);
      ASSERT_EQ(shown(comparison::compare(tail_of(run, line), tail_of(again, new_lines - (lines - line)), {})), "")
          << file << " from line " << line + 1 << '\n'
          << *text;
    }
  }
  EXPECT_GT(made, 150);
}

}  // namespace
}  // namespace isocnc::revisions
