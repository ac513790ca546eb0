#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "interpreter/restart/restart.h"

namespace isocnc::restart {
namespace {

namespace fs = std::filesystem;
using dialect::Language;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// One case of a file in restarts/: a program, how it is taken up again, and what becomes of it.
struct Case {
  std::string program;
  /// `line 4`, `clearance 30`, `highest-z 820`, `approach-feed 500`, `vgpl 1`, `radius T101002 8`, `italian` and so on.
  std::vector<std::string> settings;
  std::string expected;  ///< The restart program, or the refusal.
};

std::string content_of(const fs::path& file) {
  std::stringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

/// `; ---- restart at line 4, clearance 30` follows the program, `; ---- becomes` or `; ---- refused` that, and `;
/// ====` stands between cases.
std::vector<Case> cases_in(const fs::path& file) {
  std::vector<Case> cases(1);
  std::string* part = &cases.back().program;
  std::istringstream lines(content_of(file));
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kSettingsMark = "; ---- restart at ";
    if (line == "; ====") {
      part = &cases.emplace_back().program;
    } else if (line.starts_with(kSettingsMark)) {
      std::istringstream settings(line.substr(kSettingsMark.size()));
      for (std::string setting; std::getline(settings >> std::ws, setting, ',');)
        cases.back().settings.push_back(setting);
    } else if (line.starts_with("; ---- ")) {
      part = &cases.back().expected;
    } else {
      *part += line + '\n';
    }
  }
  return cases;
}

/// `radius T101002 8` or `length T101002 50`.
void add_tool(const std::string& setting, timing::TimedMachine& machine) {
  std::istringstream words(setting);
  std::string what;
  char letter = 0;
  int code = 0;
  double value = 0;
  words >> what >> letter >> code >> value;
  auto& values = what == "radius" ? machine.tool_radii : machine.tool_lengths;
  values[execution::tool_code(code)] = value;
}

RestartOptions options_of(const Case& each) {
  RestartOptions options;
  options.name = "part.iso";
  for (const std::string& setting : each.settings) {
    std::istringstream words(setting);
    std::string what;
    double value = 0;
    words >> what >> value;
    if (what == "line") {
      options.line = static_cast<std::uint64_t>(value) - 1;
    } else if (what == "clearance") {
      options.clearance = value;
    } else if (what == "machine-clearance") {
      options.run.setup.clearance = value;
    } else if (what == "home-z") {
      options.run.setup.home.tip.z() = options.machine.home.tip.z() = value;
    } else if (what == "highest-z") {
      options.machine.motion.axes[kinematics::kZ].maximum = value;
    } else if (what == "radius" || what == "length") {
      add_tool(setting, options.machine);
    } else if (what == "approach-feed") {
      options.approach_feed = value;
    } else if (what == "vgpl") {
      options.run.vgpl = value;
    } else if (what == "italian") {
      options.language = Language::Italian;
    } else {
      ADD_FAILURE() << "no such option: " << what;
    }
  }
  return options;
}

std::string outcome_of(std::string_view program, const RestartOptions& options) {
  const auto made = restart_program(program, options);
  if (const auto* const restarted = std::get_if<std::string>(&made)) return *restarted;
  return "; " + message(std::get<RestartRefusal>(made), options.language) + '\n';
}

std::string outcome_of(std::string_view program, std::uint64_t line) {
  RestartOptions options;
  options.name = "part.iso";
  options.line = line - 1;
  return outcome_of(program, options);
}

TEST(Restart, OfEachCaseIsAsWritten) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(ISOCNC_SOURCE_DIR "/tests/restart/restarts"))
    for (const Case& each : cases_in(entry.path())) {
      EXPECT_EQ(outcome_of(each.program, options_of(each)), each.expected) << entry.path() << '\n' << each.program;
      ++count;
    }
  EXPECT_GT(count, 10u);
}

constexpr std::string_view kProgram =
    "M06 T101001\n"
    "G00 X10 Y10\n"
    "Z2\n"
    "G01 Z-5 F2000\n"
    "X50\n"
    "G00 Z30\n"
    "M02\n";

std::string with_line_ends(std::string_view program, std::string_view line_end) {
  std::string text;
  for (const char c : program) c == '\n' ? text.append(line_end) : text.append(1, c);
  return text;
}

TEST(Restart, KeepsTheLineEndsOfTheProgram) {
  const std::string expected = outcome_of(kProgram, 5);
  for (const std::string_view line_end : {"\r\n", "\r"})
    EXPECT_EQ(outcome_of(with_line_ends(kProgram, line_end), 5), with_line_ends(expected, line_end));
}

TEST(Restart, EndsAsTheProgramDoes) {
  const std::string_view open = kProgram.substr(0, kProgram.size() - 1);
  EXPECT_THAT(outcome_of(open, 5), EndsWith("\nX50\nG00 Z30\nM02"));
  EXPECT_THAT(outcome_of(open, 7), EndsWith("\nM02"));
  EXPECT_THAT(outcome_of(std::string(open) + "\r\n\r\n", 5), EndsWith("\nX50\nG00 Z30\nM02\r\n\r\n"));
}

TEST(Restart, KeepsEveryByteOfTheRest) {
  const std::string rest = "X50 (caff\xE8 \xFF)\t \r\n\r\n  g00 z30 ; \xC3\xA8\rM02\n\x1A";
  EXPECT_THAT(outcome_of(std::string(kProgram.substr(0, kProgram.find("X50"))) + rest, 5), EndsWith("\n" + rest));
}

TEST(Restart, NamesNoByteThatIsNotAscii) {
  RestartOptions options;
  options.name = "caff\xC3\xA8\n.iso";
  EXPECT_THAT(outcome_of(kProgram, options), StartsWith("; restart of caff???.iso before its line 1\n"));
}

TEST(Restart, BeyondTheLastLineIsRefused) {
  EXPECT_EQ(outcome_of(kProgram, 8), "; there is no line 8: the last one is 7\n");
  EXPECT_EQ(outcome_of(kProgram.substr(0, kProgram.size() - 1), 8), "; there is no line 8: the last one is 7\n");
  RestartOptions options{.line = std::numeric_limits<std::uint64_t>::max() - 1};
  options.language = Language::Italian;
  EXPECT_EQ(outcome_of(kProgram, options), "; la riga 18446744073709551615 non esiste: l'ultima è la 7\n");
  EXPECT_EQ(outcome_of("", 1), "; there is no line 1: the last one is 0\n");
}

TEST(Restart, OfAProgramInErrorReportsTheError) {
  for (const std::uint64_t line : {0u, 2u}) {
    const auto made = restart_program("M06 T101001\nG01\nM02\n", {.line = line});
    const auto& refusal = std::get<RestartRefusal>(made);
    EXPECT_EQ(refusal.obstacle, RestartObstacle::ProgramError);
    EXPECT_EQ(refusal.run.line, 1u);
  }
}

}  // namespace
}  // namespace isocnc::restart
