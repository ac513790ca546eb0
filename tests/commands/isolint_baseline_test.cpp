#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view kOldProgram =
    "M06 T101001\n"
    "G00 X10 U5\n"
    "G00 X10 U5\n"
    "G71\n"
    "G71\n"
    "M02\n";

class IsolintBaseline : public testing::Test {
 protected:
  IsolintBaseline() {
    folder_.write("parts/old.iso", kOldProgram);
    folder_.write("parts/clean.iso", kCleanProgram);
  }

  CommandResult run(std::vector<std::string> options) const {
    options.insert(options.begin(), "isolint");
    return run_command(options, {.folder = folder_.path()});
  }
  /// What is reported of a new version of the program, beside the baseline.
  std::string found_in(const std::string& program) const {
    folder_.write("parts/old.iso", program);
    return run({"--format", "concise", "--baseline", "known.json", "parts"}).out;
  }

  const support::TemporaryFolder folder_;
};

TEST_F(IsolintBaseline, RecordsInPlaceOfReporting) {
  const CommandResult result = run({"--write-baseline", "known.json", "--max-warnings", "0", "parts"});
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "2 errors, 1 warning in 2 files\n");
  EXPECT_EQ(result.status, 0);
  const json file = json::parse(text_of_file(folder_.path("known.json")));
  EXPECT_EQ(file["version"], 1);
  ASSERT_EQ(file["findings"].size(), 2u);
  EXPECT_EQ(file["findings"][0]["file"], "parts/old.iso");
  EXPECT_EQ(file["findings"][0]["code"], "ISO003");
  EXPECT_EQ(file["findings"][0]["count"], 2);
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_THAT(entry.path().filename().string(), testing::AnyOf("parts", "known.json"));
}

TEST_F(IsolintBaseline, IsNotReportedAgain) {
  run({"--write-baseline", "known.json", "parts"});
  const CommandResult result = run({"--baseline", "known.json", "parts"});
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "0 errors, 0 warnings in 2 files; 3 in the baseline\n");
  EXPECT_EQ(result.status, 0);
}

TEST_F(IsolintBaseline, DoesNotMindEditsElsewhere) {
  run({"--write-baseline", "known.json", "parts"});
  EXPECT_EQ(found_in("M06 T101001\n(new)\n\nG00 X10  U5\nG00 X1\nG00 X10 U5\nG71\n G71\nM02\n"), "");
  // One more of the same is new, and so is what has been changed.
  EXPECT_EQ(found_in("M06 T101001\nG00 X10 U5\nG00 X10 U5\nG00 X10 U5\nM02\n"),
            "parts/old.iso:4:9: error: U5 is not a word of this control: words start with A B C F G I J K M N P Q R S "
            "T V X Y Z [ISO003]\n");
  EXPECT_THAT(found_in("M06 T101001\nG00 X10 U6\nM02\n"), StartsWith("parts/old.iso:2:9: "));
}

/// Of a mistake that repeats, each line is recorded; a new line of it is reported alone.
TEST_F(IsolintBaseline, KnowsEachLineOfARepeatedMistake) {
  folder_.write("parts/old.iso", "M06 T101001\nG01 X1 B1 F500\nX2 B2\nX3 B3\nM02\n");
  EXPECT_EQ(run({"--write-baseline", "known.json", "parts"}).err, "1 error, 0 warnings in 2 files\n");
  EXPECT_EQ(json::parse(text_of_file(folder_.path("known.json")))["findings"].size(), 3u);
  EXPECT_EQ(run({"--baseline", "known.json", "parts"}).err, "0 errors, 0 warnings in 2 files; 1 in the baseline\n");
  EXPECT_THAT(found_in("M06 T101001\nG01 X1 B1 F500\nX4 B4\nX2 B2\nX5 B5\nX3 B3\nM02\n"),
              testing::AllOf(StartsWith("parts/old.iso:3:4: "), HasSubstr("(and 1 more line, line 5)")));
}

TEST_F(IsolintBaseline, NamesProgramsFromItsFolder) {
  run({"--write-baseline", "parts/known.json", "parts"});
  EXPECT_THAT(text_of_file(folder_.path("parts/known.json")), HasSubstr(R"("file": "old.iso")"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"isolint", "--baseline", "known.json"},
        std::vector<std::string>{"isolint", "--baseline", folder_.path("parts/known.json"), "./old.iso", "../parts"}})
    EXPECT_EQ(run_command(command, {.folder = folder_.path("parts")}).status, 0);
}

TEST_F(IsolintBaseline, IsNotWrittenWhenProgramsAreMissingInIt) {
  const CommandResult result = run({"--write-baseline", "known.json", "parts", "gone.iso"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("isolint: known.json: not written\n"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("known.json")));
}

TEST_F(IsolintBaseline, ReplacesTheFileAndKeepsItsLinksAndRights) {
  folder_.write("real.json", "old");
  ::chmod(folder_.path("real.json").c_str(), 0640);
  std::filesystem::create_symlink("real.json", folder_.path("known.json"));
  EXPECT_EQ(run({"--write-baseline", "known.json", "parts"}).status, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path("known.json")));
  EXPECT_THAT(text_of_file(folder_.path("real.json")), StartsWith("{\n  \"version\": 1,\n"));
  EXPECT_EQ(std::filesystem::status(folder_.path("real.json")).permissions(), std::filesystem::perms(0640));
  EXPECT_EQ(run({"--write-baseline", "/no/such/folder/x", "parts"}).status, 2);
  EXPECT_EQ(run({"--write-baseline", "/dev/full", "parts"}).status, 2);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(IsolintBaseline, IsNoProgramAndNotReadAndWrittenAtOnce) {
  EXPECT_EQ(run({"--write-baseline", "parts/old.iso", "parts"}).status, 2);
  EXPECT_EQ(text_of_file(folder_.path("parts/old.iso")), kOldProgram);
  EXPECT_EQ(run({"--write-baseline", "a.json", "--baseline", "b.json", "parts"}).status, 2);
}

TEST_F(IsolintBaseline, ReportsTheLineOfAMistake) {
  const std::pair<std::string, std::string> mistakes[] = {
      {"", "1: not JSON: syntax error"},
      {"{\n  \"version\": 1,\n  \"findings\": [\n", "3: not JSON: syntax error"},
      {"{\"version\": 1,\n\"findings\": [],\n}", "3: not JSON: syntax error"},
      {"[]", "1: an object was expected here\n"},
      {"{\n\"version\": 2\n}", "2: no version of baselines that is known here\n"},
      {"{\n\"version\": \"1\"\n}", "2: not a value of version\n"},
      {"{\"version\": 1,\n\"finding\": []}", "2: unknown key: finding\n"},
      {"{\"version\": 1\n}\n", "2: findings is missing from what ends here\n"},
      {"{\"findings\": []\n}\n", "2: version is missing from what ends here\n"},
      {"{\"version\": 1,\n\"findings\": [\n[]]}", "3: an object was expected here\n"},
      {"{\"version\": 1,\n\"findings\": [\n{\"file\": \"a\"}]}", "3: code is missing from what ends here\n"},
      {"{\"version\": 1,\n\"findings\": [\n{\"code\":\n\"ISO31\"}]}",
       "4: unknown code: ISO31; did you mean ISO031? (--list-rules)\n"},
      {"{\"version\": 1,\n\"findings\": [{\"line\":\n\"0x12\"}]}", "3: not a value of line\n"},
      {"{\"version\": 1,\n\"findings\": [{\"count\": 0}]}", "2: not a value of count\n"},
      {"{\"version\": 1,\n\"findings\": [{\"count\": {}}]}", "2: not a value of count\n"},
      {"{\"version\": 1,\n\"findings\": [{\"count\": -1}]}", "2: not a value of count\n"},
      {"{\"version\": 1,\n\"findings\": [{\"count\": 1.5}]}", "2: not a value of count\n"},
      {"{\"version\": 1,\n\"findings\": [{\"file\":\nnull}]}", "3: not a value of file\n"},
      {"{\"version\": 1,\n\"findings\": true}", "2: not a value of findings\n"},
  };
  for (const auto& [text, mistake] : mistakes) {
    folder_.write("known.json", text);
    const CommandResult result = run({"--baseline", "known.json", "parts"});
    EXPECT_EQ(result.status, 2) << text;
    EXPECT_EQ(result.out, "") << text;
    EXPECT_THAT(result.err, StartsWith("isolint: known.json:" + mistake)) << text;
  }
  EXPECT_EQ(run({"--baseline", "no-such.json", "parts"}).err,
            "isolint: no-such.json: cannot read: No such file or directory\n");
}

}  // namespace
}  // namespace isocnc::commands
