#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kToolTable = "T;name;length;radius\nT101001;cutter 20;118;10\nT102002;drill 8;90;4\n";
constexpr std::string_view kCommentedShop =
    "{\n  // ours\n  \"machine\": {\"tools\": [\n    {\"head\": 1, \"holder\": 1, \"tool\": 1, \"length\": 120} // "
    "measured\n  ]}\n}\n";

std::string content(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class IsorunTools : public testing::Test {
 protected:
  CommandResult isorun(std::vector<std::string> options, std::string input = "") const {
    options.insert(options.begin(), {"isorun", "--lang", "en"});
    return run_command(options, {.input = std::move(input), .folder = folder_.path()});
  }

  const support::TemporaryFolder folder_;
};

TEST_F(IsorunTools, ShowsWhatWouldChangeAndWritesWhenAsked) {
  const std::string configuration = folder_.write("isocnc.json", kCommentedShop);
  folder_.write("tools.csv", kToolTable);
  const CommandResult shown = isorun({"--import-tools", "tools.csv"});
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_EQ(shown.out,
            "~ T101001 \"cutter 20\": name \"cutter 20\", length 120 -> 118, radius 10\n"
            "+ T102002 \"drill 8\": length 90, radius 4\n"
            "1 new, 1 changed, 0 as before, 0 of the machine not in the library, 0 of the library not taken\n"
            "nothing is written; --write writes isocnc.json\n");
  EXPECT_EQ(content(configuration), kCommentedShop);
  const CommandResult written = isorun({"--import-tools", "tools.csv", "--keep", "length", "--write"});
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_THAT(written.out, HasSubstr("isocnc.json is written\n"));
  EXPECT_EQ(
      content(configuration),
      "{\n  // ours\n  \"machine\": {\"tools\": [\n    {\"head\": 1, \"holder\": 1, \"tool\": 1, \"length\": 120, "
      "\"name\": \"cutter 20\", \"radius\": 10}, // measured\n"
      "    {\"head\": 1, \"holder\": 2, \"tool\": 2, \"name\": \"drill 8\", \"length\": 90, \"radius\": 4}\n  ]}\n}\n");
  // isolint takes what was written.
  EXPECT_EQ(run_command({"isolint", "--show-config", "."}, {.folder = folder_.path()}).status, 0);
}

TEST_F(IsorunTools, ExportsWhatItImports) {
  folder_.write("isocnc.json", kCommentedShop);
  folder_.write("tools.csv", kToolTable);
  EXPECT_EQ(isorun({"--import-tools", "tools.csv", "--write"}).status, 0);
  EXPECT_EQ(isorun({"--export-tools", "out.csv"}).status, 0);
  EXPECT_THAT(isorun({"--import-tools", "out.csv"}).out, HasSubstr("0 new, 0 changed, 2 as before"));
  const CommandResult list = isorun({"--export-tools", "-", "--presetter"});
  EXPECT_EQ(list.out,
            "T,name,length,radius,measured length,measured radius\r\nT101001,cutter 20,118,10,,\r\nT102002,drill "
            "8,90,4,,\r\n");
  folder_.write("measured.csv",
                "T,name,length,radius,measured length,measured radius\nT101001,cutter "
                "20,118,10,117.93,9.98\nT102002,drill 8,90,4,,\n");
  EXPECT_THAT(isorun({"--import-tools", "measured.csv"}).out,
              HasSubstr("~ T101001 \"cutter 20\": length 118 -> 117.93, radius 10 -> 9.98\n"));
}

// Nothing is half written, whatever is wrong.
TEST_F(IsorunTools, ChangesNothingAfterAMistake) {
  const std::string configuration = folder_.write("isocnc.json", kCommentedShop);
  folder_.write("tools.csv", kToolTable);
  folder_.write("broken.csv", "T;length\nT101001;\"100\n");
  folder_.write("twice.json", R"({"tools": {"a": "T101001", "b": "101001"}})");
  folder_.write("nowhere.tbl", "T1 D6\n");
  const std::pair<std::vector<std::string>, const char*> mistaken[] = {
      {{"--import-tools", "none.csv"}, "none.csv: cannot read: No such file or directory"},
      {{"--import-tools", "broken.csv"}, "broken.csv:2:9: error: a quote without its closing one"},
      {{"--import-tools", "tools.csv", "--map", "none.json"}, "none.json: cannot read"},
      {{"--import-tools", "tools.csv", "--map", "twice.json"},
       "twice.json:1:33: error: tools.b: tool a is at 101001 already"},
      {{"--import-tools", "tools.csv", "--keep", "size"}, "size is no key of a tool: name, length"},
      {{"--import-tools", "nowhere.tbl"},
       "no tool is taken: --map FILE says where they stand, such as {\"tools\": {\"1\": \"T101001\"}}"},
      {{"--import-tools", "."}, ".: not a file"},
      {{"--import-tools", "tools.csv", "--no-config"}, "--no-config reads no isocnc.json, so that --write has none"},
      {{"part.iso", "--import-tools", "tools.csv"}, "run no program, such as part.iso"},
      {{"--map", "map.json"}, "FILE is required"},
      {{"--export-tools", "out.txt"}, "--export-tools writes a file whose name ends in .csv"},
      {{"--import-tools", "tools.csv", "--export-tools", "out.csv"}, "excludes"},
      {{"--new-machine", "isocnc.json"}, "isocnc.json has a machine already"},
  };
  for (const auto& [options, complaint] : mistaken) {
    std::vector<std::string> words = options;
    if (words.front() == "--import-tools") words.emplace_back("--write");
    const CommandResult result = isorun(words);
    EXPECT_EQ(result.status, 2) << complaint << "\n" << result.out;
    EXPECT_THAT(result.err, HasSubstr(complaint));
    EXPECT_EQ(content(configuration), kCommentedShop);
  }
}

/// Against a machine without tools, whatever the file of the folder says.
TEST_F(IsorunTools, ShowsALibraryWithoutAConfiguration) {
  const std::string configuration = folder_.write("isocnc.json", kCommentedShop);
  folder_.write("tools.csv", kToolTable);
  const CommandResult shown = isorun({"--no-config", "--import-tools", "tools.csv"});
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_THAT(
      shown.out,
      EndsWith("2 new, 0 changed, 0 as before, 0 of the machine not in the library, 0 of the library not taken\n"));
  EXPECT_EQ(isorun({"--no-config", "--machine", "isocnc.json", "--import-tools", "tools.csv", "--write"}).status, 0);
  EXPECT_NE(content(configuration), kCommentedShop);
}

TEST_F(IsorunTools, WritesTheOthersWhereAnEntryIsMistaken) {
  const std::string configuration = folder_.write("isocnc.json", kCommentedShop);
  folder_.write("tools.csv", "T,name,length,radius\nT101001,cutter 20,long,10\nT102002,drill 8,90,4\n");
  constexpr std::string_view kDifference =
      "+ T102002 \"drill 8\": length 90, radius 4\n"
      "! cutter 20: not taken: tools.csv:2:19: error: length: long is no number\n"
      "1 new, 0 changed, 0 as before, 0 of the machine not in the library, 1 of the library not taken\n";
  const CommandResult shown = isorun({"--import-tools", "tools.csv"});
  EXPECT_EQ(shown.status, 1);
  EXPECT_EQ(shown.out, std::string(kDifference) + "nothing is written; --write writes isocnc.json\n");
  EXPECT_EQ(content(configuration), kCommentedShop);
  const CommandResult written = isorun({"--import-tools", "tools.csv", "--write"});
  EXPECT_EQ(written.status, 1);
  EXPECT_EQ(written.out, std::string(kDifference) + "isocnc.json is written\n");
  EXPECT_THAT(content(configuration), HasSubstr("\"name\": \"drill 8\""));
  EXPECT_THAT(content(configuration), HasSubstr("\"length\": 120"));
  // Nothing left to write: the entry is told all the same.
  EXPECT_EQ(isorun({"--import-tools", "tools.csv", "--write"}).status, 1);
  folder_.write("tools.csv", "T,name,length,radius\nT101001,cutter 20,long,10\n");
  const CommandResult none = isorun({"--import-tools", "tools.csv", "--write"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.out, HasSubstr("tools.csv:2:19"));
  EXPECT_THAT(none.err, HasSubstr("no tool is taken"));
}

TEST_F(IsorunTools, MakesAConfigurationWhereThereIsNone) {
  folder_.write("tools.csv", kToolTable);
  EXPECT_THAT(isorun({"--export-tools", "-"}).err, HasSubstr("there is no isocnc.json here or above"));
  EXPECT_EQ(isorun({"--import-tools", "tools.csv", "--write"}).status, 0);
  EXPECT_THAT(content(folder_.path("isocnc.json")), HasSubstr("\"tool\": 2"));
}

TEST_F(IsorunTools, AsksAboutANewMachine) {
  const CommandResult early = isorun({"--new-machine", "isocnc.json"}, "head\n0\n");
  EXPECT_EQ(early.status, 2);
  EXPECT_THAT(early.err, HasSubstr("the answers end before the questions; nothing is written"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("isocnc.json")));
  const CommandResult made =
      isorun({"--new-machine", "isocnc.json"}, "three-axis\n0\n3200\n0\n1600\n-250\n0\n" + std::string(20, '\n'));
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, Not(HasSubstr("axes.B")));
  EXPECT_EQ(content(folder_.path("isocnc.json")).find("{\n  \"machine\": {\n"), 0U);
  folder_.write("far.iso", "M06 T101001\nS12000 M03\nG00 X4000 Y0 Z0\nM05\nM02\n");
  EXPECT_THAT(run_command({"isolint", "--lang", "en", "far.iso"}, {.folder = folder_.path()}).out, HasSubstr("W130"));
}

}  // namespace
}  // namespace isocnc::commands
