#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

class IsolintShards : public testing::Test {
 protected:
  IsolintShards() {
    const std::string broken = ISOCNC_SOURCE_DIR "/examples/broken";
    std::filesystem::copy(broken, folder_.path("broken"));
    std::filesystem::copy(broken, folder_.path("a [folder]%"));
    // Findings there have places in other files than programs.
    std::filesystem::copy(ISOCNC_SOURCE_DIR "/examples/setups", folder_.path("setups"),
                          std::filesystem::copy_options::recursive);
    for (const char* const slow : {"setups/tilted.iso", "setups/broken/tilted.iso"})
      std::filesystem::remove(folder_.path(slow));
    folder_.write("Z/clean.iso", kCleanProgram);
    folder_.write("[a.iso", kBrokenProgram);
    folder_.write("b.iso", kWarnedProgram);
  }

  CommandResult run(std::vector<std::string> command) const {
    return run_command(std::move(command), {.folder = folder_.path()});
  }

  const support::TemporaryFolder folder_;
};

TEST_F(IsolintShards, MergeToTheWholeReport) {
  const std::pair<std::string, std::vector<std::size_t>> kCases[] = {{"json", {1, 3, 40}}, {"sarif", {3}}};
  for (const auto& [format, counts] : kCases) {
    const std::string whole = run({"isolint", "--verify", "--format", format}).out;
    for (const std::size_t count : counts) {
      std::vector<std::string> merging = {"isolint", "--merge"};
      std::size_t findings = 0;
      for (std::size_t i = count; i >= 1; --i) {
        const std::string name = format + std::to_string(i);
        const CommandResult part = run({"isolint", "--verify", "--format", format, "--output", name, "--shard",
                                        std::to_string(i) + "/" + std::to_string(count)});
        EXPECT_THAT(part.status, testing::AnyOf(0, 1)) << part.err;
        findings += text_of_file(folder_.path(name)).size() < whole.size() ? 1 : 0;
        merging.push_back(name);
      }
      const CommandResult merged = run(merging);
      EXPECT_EQ(merged.out, whole) << format << " " << count;
      EXPECT_EQ(merged.status, 1);
      EXPECT_EQ(merged.err, "");
      EXPECT_EQ(findings, count == 1 ? 0 : count) << "each part is less than the whole";
      merging.push_back(merging.back());
      EXPECT_EQ(run(merging).out, whole) << "a report counts once";
      if (format != "sarif") continue;  // A JSON report is a plain list of findings.
      merging.erase(std::remove(merging.begin(), merging.end(), "sarif2"), merging.end());
      const CommandResult gap = run(merging);
      EXPECT_EQ(gap.status, 2);
      EXPECT_EQ(gap.err, "isolint: --merge: the report of part 2/3 is missing\n");
    }
  }
}

TEST_F(IsolintShards, AreTheSameFromBelowAndByAbsolutePath) {
  for (const char* const shard : {"1/3", "2/3", "3/3"}) {
    const auto names = [&](const std::string& path) {
      std::set<std::string> files;
      for (const json& finding : json::parse(run({"isolint", "--format", "json", "--shard", shard, path}).out))
        files.insert(std::filesystem::path(finding.at("file").get<std::string>()).filename());
      return files;
    };
    EXPECT_EQ(names("."), names(folder_.path()));
    EXPECT_EQ(names("broken"), names("./Z/../broken"));
  }
}

TEST_F(IsolintShards, HashThePathsOnEverySystemAlike) {
  folder_.write("one/part.iso", kWarnedProgram);
  constexpr int kShard = 7;  // The FNV-1a hash of "one/part.iso" is 0xb261d5de9a471a.
  for (int i = 1; i <= 7; ++i) {
    const std::string shard = std::to_string(i) + "/7";
    EXPECT_EQ(run({"isolint", "--format", "concise", "--shard", shard, "one"}).out.empty(), i != kShard) << i;
  }
}

TEST_F(IsolintShards, RefuseWhatIsNone) {
  for (const char* const shard : {"0/3", "4/3", "1", "1/", "/3", "1/3x", "-1/3", "1/0", "a/b"})
    EXPECT_EQ(run({"isolint", "--shard", shard}).status, 2) << shard;
}

TEST_F(IsolintShards, MergeRefusesWhatIsNoReport) {
  const std::string report = run({"isolint", "--format", "sarif", "b.iso"}).out;
  folder_.write("b.sarif", report);
  folder_.write("it.sarif", run({"isolint", "--lang", "it", "--format", "sarif", "b.iso"}).out);
  folder_.write("b.json", run({"isolint", "--format", "json", "b.iso"}).out);
  folder_.write("deep.json", std::string(100'000, '['));
  folder_.write("closed.json", std::string(100'000, '[') + std::string(100'000, ']'));
  folder_.write("odd.json", R"([{"file": "a.iso", "severity": "fatal"}])");
  folder_.write("number.json", "7");
  folder_.write("cut.sarif", report.substr(0, report.size() / 2));
  for (const char* const file : {"deep.json", "closed.json", "odd.json", "number.json", "cut.sarif", "b.iso", "none"}) {
    const CommandResult result = run({"isolint", "--merge", file});
    EXPECT_EQ(result.status, 2) << file;
    EXPECT_EQ(result.out, "") << file;
    EXPECT_THAT(result.err, StartsWith("isolint: " + std::string(file) + ": "));
  }
  EXPECT_THAT(run({"isolint", "--merge", "b.sarif", "it.sarif"}).err, HasSubstr("another version"));
  EXPECT_THAT(run({"isolint", "--merge", "b.sarif", "b.json"}).err, HasSubstr("another format"));
  EXPECT_EQ(run({"isolint", "--merge"}).status, 2);
  EXPECT_EQ(run({"isolint", "--merge", "--output", "b.sarif", "b.sarif"}).status, 2);
  EXPECT_EQ(text_of_file(folder_.path("b.sarif")), report);
  EXPECT_EQ(run({"isolint", "--merge", "--max-warnings", "0", "b.sarif"}).status, 1);
  EXPECT_EQ(run({"isolint", "--merge", "b.sarif"}).status, 0);
}

}  // namespace
}  // namespace isocnc::commands
