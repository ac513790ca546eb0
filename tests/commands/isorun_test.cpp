#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

/// The SVG of a program.
std::string svg_of(const std::string& program, const std::string& name = "part.iso") {
  const support::TemporaryFolder folder;
  const std::string plot = folder.path("plot.svg");
  EXPECT_EQ(run_command({"isorun", "--plot", plot, folder.write(name, program)}).status, 0);
  std::stringstream svg;
  svg << std::ifstream(plot).rdbuf();
  return svg.str();
}

TEST(IsorunPlot, IsAPictureOfWhatWasDone) {
  const std::string svg = svg_of("M06 T101001\nG00 X50\nG03 X50 Y40 R20 F1000\nM02\n", "a<b>&.iso");
  EXPECT_THAT(svg, StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr("a&lt;b&gt;&amp;.iso</title>"));
  EXPECT_THAT(svg, HasSubstr("d=\"M0.000 -0.000L50.000 -0.000\""));
  EXPECT_THAT(svg, HasSubstr("T101001"));
}

/// A rapid turns B with the axes going straight, so that the tip swings out.
TEST(IsorunPlot, ShowsWhereTheTipGoes) {
  const std::string svg = svg_of("M06 T101001\nG00 X100 B90\nM02\n");
  const std::size_t begin = svg.find("d=\"M0.000 ");
  ASSERT_NE(begin, std::string::npos);
  const std::string path = svg.substr(begin, svg.find("\"/>", begin) - begin);
  EXPECT_GT(std::count(path.begin(), path.end(), 'L'), 10) << path;
}

TEST(IsorunPlot, ShowsStrokesAlongTheViewAsDots) {
  EXPECT_THAT(svg_of("M06 T101001\nG00 X5 Y6\nG01 Z-3 F100\nZ0\nM02\n"),
              HasSubstr("d=\"M5.000 -6.000h0M5.000 -6.000h0"));
  EXPECT_THAT(svg_of("M06 T101001\nG01 Z-3 F100\nM02\n"), HasSubstr("d=\"M0.000 -0.000h0\""));
}

TEST(IsorunPlot, ShowsFramesWithoutMotion) {
  const std::string svg = svg_of("G92 X10 Y20 Z30\nM02\n");
  EXPECT_THAT(svg, HasSubstr("class=\"frame\""));
  EXPECT_THAT(svg, HasSubstr("The program moves nothing."));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg_of("M02\n").find("class=\"frame\""), std::string::npos);
}

/// Whether this isorun draws HTML; it says why when it does not.
TEST(IsorunPlot, IsAPageOrSaysWhyNot) {
  const support::TemporaryFolder folder;
  const std::string plot = folder.path("PLOT.HTML");
  const std::string program = folder.write("part.iso", "M06 T101001 ; </script><script>\nG00 X50\nM02\n");
  const CommandResult result = run_command({"isorun", "--plot", plot, program});
  if (result.status == 2) {
    EXPECT_THAT(result.err, HasSubstr("it was built without npm"));
    EXPECT_FALSE(std::filesystem::exists(plot));
    return;
  }
  EXPECT_EQ(result.status, 0);
  std::stringstream page;
  page << std::ifstream(plot).rdbuf();
  EXPECT_THAT(page.str(), StartsWith("<!doctype html>"));
  EXPECT_THAT(page.str(), HasSubstr("<title>part.iso</title>"));
  EXPECT_THAT(page.str(), HasSubstr("Content-Security-Policy"));
  EXPECT_EQ(page.str().find("M06 T101001"), std::string::npos);
}

TEST(IsorunSheet, IsWrittenBesideTheSummary) {
  const support::TemporaryFolder folder;
  const std::string program = folder.write("part.iso", "\xEF\xBB\xBFM06 T101001\nG01 X5\nM02\n");
  const std::string sheet = folder.path("sheet.HTML");
  const CommandResult result = run_command({"isorun", "--sheet", sheet, program});
  EXPECT_EQ(result.status, 1) << "the F is missing";
  EXPECT_THAT(result.out, HasSubstr("result: "));
  std::stringstream page;
  page << std::ifstream(sheet).rdbuf();
  EXPECT_THAT(page.str(), HasSubstr("<h1>Setup sheet</h1><strong>part.iso</strong>"));
  EXPECT_THAT(page.str(), HasSubstr("ISO066"));
  // Of the whole file, with its mark, as sha256sum has it.
  EXPECT_THAT(page.str(), HasSubstr("67ea4c310a2e55426c6ebf6920efe60466ac4ecba0575edb7a27573e84da0050"));
  const std::string pdf = folder.path("sheet.pdf");
  EXPECT_EQ(
      run_command({"isorun", "--json", "--lang", "it", "--sheet", pdf, "-"}, {.input = std::string(kCleanProgram)})
          .status,
      0);
  std::stringstream file;
  file << std::ifstream(pdf, std::ios::binary).rdbuf();
  EXPECT_THAT(file.str(), StartsWith("%PDF-1.4\n"));
  EXPECT_THAT(file.str(), HasSubstr("(Scheda di attrezzaggio)"));
}

TEST(IsorunSheet, RefusesMistakenCommands) {
  const support::TemporaryFolder folder;
  const std::string program = folder.write("part.iso", kCleanProgram);
  const auto said = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    options.push_back(program);
    const CommandResult result = run_command(options);
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_EQ(said({"--sheet", "sheet.txt"}),
            "isorun: --sheet writes a file whose name ends in .html or .pdf, unlike sheet.txt\n");
  EXPECT_EQ(said({"--lang", "it", "--sheet", ".pdf"}),
            "isorun: --sheet scrive un file il cui nome finisce in .html o .pdf, non come .pdf\n");
  EXPECT_THAT(said({"--sheet", folder.path("none/sheet.pdf")}), HasSubstr("sheet.pdf: cannot write: "));
  EXPECT_THAT(said({"--sheet", folder.path("a.html"), "--plot", folder.path("a.html")}),
              HasSubstr("--plot and --sheet would both be written there"));
  EXPECT_THAT(said({"--sheet", folder.path("a.pdf"), "--lift", "5"}), HasSubstr("--sheet"));
}

TEST(IsorunOptions, RefuseWhatMakesNoSense) {
  const auto said = [](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    options.push_back("-");
    const CommandResult result = run_command(options, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_EQ(said({"--plot", "a.png"}), "isorun: --plot writes a file whose name ends in .svg or .html, unlike a.png\n");
  EXPECT_EQ(said({"--plot", ".html"}), "isorun: --plot writes a file whose name ends in .svg or .html, unlike .html\n");
  EXPECT_THAT(said({"--samples", "x", "--dt", "0"}), StartsWith("isorun: --dt takes a plain number of seconds"));
  EXPECT_EQ(said({"--trace", "-", "--samples", "-"}), "isorun: --trace - and --samples - both take standard output\n");
  EXPECT_EQ(said({"--plot", "/no/such/folder/x.svg"}),
            "isorun: /no/such/folder/x.svg: cannot write: No such file or directory\n");
}

TEST(IsorunError, StopsTheProgramAsTheControlWould) {
  const CommandResult result =
      run_command({"isorun", "--trace", "-", "-"}, {.input = "M06 T101001\nG00 X10\nG01\nG00 X20\nM02\n"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(kinds_in(events_in(result.out)), ElementsAre("tool", "rapid"));
  EXPECT_EQ(result.err, "<stdin>:3: error: G01 has no coordinate: write at least one directly after it [ISO026]\n");
}

TEST(IsorunError, IsReportedBesideTheSummary) {
  const CommandResult result = run_command({"isorun", "-"}, {.input = std::string(kBrokenProgram)});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, StartsWith("result: stopped by an error, line 3\n"));
  EXPECT_THAT(result.err, HasSubstr("[ISO026]"));
}

TEST(IsorunError, OfABlockLeavesNothingOfItDone) {
  const std::vector<json> events = trace_of("M06 T101001\nS100 G00 X10 X20\nM02\n");
  EXPECT_THAT(kinds_in(events), ElementsAre("tool"));
}

TEST(IsorunError, LetsNoControlCharacterThrough) {
  const CommandResult result = run_command({"isorun", "-"}, {.input = "M06 T101001\n\x1b]0;title\x07\nM02\n"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
}

constexpr std::string_view kForkedRun =
    "M06 T101001\n"
    "G00 X0\n"
    "IF VGPL >= 1 GOTO N10\n"
    "G00 X1\n"
    "N10 G00 X2\n"
    "IF V3 = 1.5 GOTO N20\n"
    "G00 X3\n"
    "N20 G00 X4\n"
    "M02\n";

std::vector<double> x_positions(const std::vector<json>& events) {
  std::vector<double> positions;
  for (const json& event : events)
    if (event.at("kind") == "rapid") positions.push_back(event.at("to")[0]);
  return positions;
}

TEST(IsorunPath, FollowsVgplAndTheRegisters) {
  EXPECT_THAT(x_positions(trace_of(kForkedRun)), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(x_positions(trace_of(kForkedRun, {"--vgpl", "1"})), ElementsAre(0, 2, 3, 4));
  EXPECT_THAT(x_positions(trace_of(kForkedRun, {"--vgpl", "-2.5"})), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(x_positions(trace_of(kForkedRun, {"--set", "V3=1.5"})), ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(x_positions(trace_of(kForkedRun, {"--set", "V3=1.5", "--set", "V4=2", "--vgpl", "1"})),
              ElementsAre(0, 2, 4));
}

TEST(IsorunPath, ReportsJumpsTakenAndNot) {
  const std::vector<json> events = trace_of(kForkedRun, {"--vgpl", "1"});
  std::vector<json> jumps;
  for (const json& event : events)
    if (event.at("kind") == "jump") jumps.push_back(timeless(event));
  EXPECT_THAT(jumps, ElementsAre(json::parse(R"({"line": 3, "kind": "jump", "taken": true, "target": 5})"),
                                 json::parse(R"({"line": 6, "kind": "jump", "taken": false, "target": 7})")));
}

TEST(IsorunUntil, StopsBeforeTheLine) {
  const CommandResult result = run_command({"isorun", "--until", "2", "-"}, {.input = std::string(kBrokenProgram)});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("result: stopped where asked, line 2\n"));
  EXPECT_THAT(kinds_in(trace_of(kCleanProgram, {"--until", "2"})), ElementsAre("tool"));
  EXPECT_THAT(kinds_in(trace_of(kCleanProgram, {"--until", "100"})), ElementsAre("tool", "rapid", "end"));
}

TEST(IsorunUntil, AfterAJumpOverTheLineStopsAtItsTarget) {
  const CommandSetup forked{.input = std::string(kForkedRun)};
  const CommandResult result = run_command({"isorun", "--vgpl", "1", "--until", "4", "-"}, forked);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("result: stopped where asked, line 5 (the IF of line 3 jumps over the line asked "
                                     "for)\n"));
  EXPECT_THAT(run_command({"isorun", "--lang", "it", "--vgpl", "1", "--until", "4", "-"}, forked).out,
              StartsWith("esito: fermato dove richiesto, riga 5 (l'IF della riga 3 scavalca la riga richiesta)\n"));
  EXPECT_THAT(kinds_in(trace_of(kForkedRun, {"--vgpl", "1", "--until", "4"})), ElementsAre("tool", "rapid", "jump"));
  EXPECT_EQ(summary_of(std::string(kForkedRun), {"--vgpl", "1", "--until", "4"}).at("jumpedOverFrom"), 3);
  EXPECT_EQ(summary_of(std::string(kForkedRun), {"--vgpl", "1", "--until", "5"}).at("jumpedOverFrom"), nullptr)
      << "where it leads is not passed over";
  EXPECT_EQ(summary_of(std::string(kForkedRun), {"--until", "4"}).at("line"), 4);
}

/// A jump to nowhere is no way around the line.
TEST(IsorunUntil, AfterAJumpToNowhereIsAnError) {
  const CommandResult result =
      run_command({"isorun", "--until", "3", "-"}, {.input = "M06 T101001\nIF VGPL = 0 GOTO N5\nG00 X1\nM02\n"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("[E004]"));
}

TEST(IsorunUsage, RefusesWhatItDoesNotKnow) {
  std::vector<std::vector<std::string>> mistakes = {{"isorun"},
                                                    {"isorun", "--no-such-option", "-"},
                                                    {"isorun", "--vgpl", "x", "-"},
                                                    {"isorun", "--until", "0", "-"},
                                                    {"isorun", "--until", "-1", "-"},
                                                    {"isorun", "--until", "1.5", "-"},
                                                    {"isorun", "--until", "99999999999999999999", "-"},
                                                    {"isorun", "--lang", "de", "-"}};
  for (const std::string number : {"", " ", "x", "1x", "nan", "inf", "-inf", "0x10", "1e3", "1,5", "--1", "1-", "1.2.3",
                                   ".", "+", " 1", "1 ", "1(a)2"}) {
    mistakes.push_back({"isorun", "--set", "V3=" + number, "-"});
    mistakes.push_back({"isorun", "--vgpl=" + number, "-"});
  }
  for (const std::string setting :
       {"V0=1", "V31=1", "V-1=1", "V+1=1", "V=1", "V3", "3=1", "v3=1", "V3 = 1", " V3=1", "V1.5=2", "V3=1=2", "="})
    mistakes.push_back({"isorun", "--set", setting, "-"});
  for (const auto& mistake : mistakes) {
    const CommandResult result = run_command(mistake, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2) << testing::PrintToString(mistake);
    EXPECT_EQ(result.out, "") << testing::PrintToString(mistake);
    EXPECT_THAT(result.err, StartsWith("isorun: ")) << testing::PrintToString(mistake);
  }
}

TEST(IsorunUsage, NamesItsVersionAndOptions) {
  EXPECT_THAT(run_command({"isorun", "--version"}).out, MatchesRegex("isorun [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  const CommandResult help = run_command({"isorun", "--help"});
  EXPECT_EQ(help.status, 0);
  for (const std::string option : {"--trace", "--vgpl", "--set", "--until", "--lang"})
    EXPECT_THAT(help.out, HasSubstr(option));
}

TEST(IsorunUsage, TakesNumbersAsProgramsWriteThem) {
  for (const std::string number : {"1.5", "+1.5", "01.50", "1.500000000000000000000000"})
    EXPECT_THAT(x_positions(trace_of(kForkedRun, {"--set", "V3=" + number})), ElementsAre(0, 1, 2, 4)) << number;
  for (const std::string number : {"-2.5", "-.5", "0", "-0", ".5"})
    EXPECT_THAT(x_positions(trace_of(kForkedRun, {"--vgpl", number})), ElementsAre(0, 1, 2, 3, 4)) << number;
}

TEST(IsorunUsage, TakesOneSettingAtATime) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kCleanProgram);
  EXPECT_EQ(run_command({"isorun", "--set", "V1=1", file, "--until", "2"}).status, 0);
  EXPECT_EQ(run_command({"isorun", "--set", "V1=1", "--set", "V30=-2.5", file}).status, 0);
}

TEST(IsorunUsage, ComplainsInTheReadersLanguage) {
  const auto complaint = [](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    return run_command(options, {.input = std::string(kCleanProgram)}).err;
  };
  EXPECT_EQ(complaint({"--set", "V31=1", "-"}),
            "isorun: --set takes a register and a plain number, V1=0 to V30=-2.5, not V31=1\n");
  EXPECT_EQ(complaint({"--lang", "it", "--set", "V31=1", "-"}),
            "isorun: --set vuole un registro e un numero semplice, da V1=0 a V30=-2.5, non V31=1\n");
  EXPECT_EQ(complaint({"--vgpl", "nan", "-"}), "isorun: --vgpl takes a plain number, such as -2.5, not nan\n");
  EXPECT_EQ(complaint({"--vgpl", "nan", "--lang", "it", "-"}),
            "isorun: --vgpl vuole un numero semplice, come -2.5, non nan\n");
  EXPECT_EQ(complaint({"--until", "0", "-"}), "isorun: --until takes a line, counted from 1, not 0\n");
  EXPECT_EQ(complaint({"--until", "0", "--lang", "it", "-"}), "isorun: --until vuole una riga, contata da 1, non 0\n");
}

TEST(IsorunUsage, LetsNoControlCharacterThrough) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"isorun", "--set", "\x1b[31m", "-"}, {"isorun", "\x1b[31m.iso"}}) {
    const CommandResult result = run_command(command, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("\xEF\xBF\xBD[31m"));
    EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
  }
}

TEST(IsorunOutput, ThatCannotBeWrittenIsAFailure) {
  const std::vector<std::vector<std::string>> commands = {
      {"isorun", "-"}, {"isorun", "--trace", "-", "-"}, {"isorun", "--version"}, {"isorun", "--help"}};
  for (const auto& command : commands) {
    for (const auto& [output, reason] : {std::pair{StandardOutput::FullDisk, "No space left on device"},
                                         std::pair{StandardOutput::ClosedPipe, "Broken pipe"}}) {
      const CommandResult result =
          run_command(command, {.input = std::string(kCleanProgram), .standard_output = output});
      EXPECT_EQ(result.status, 2) << testing::PrintToString(command);
      EXPECT_EQ(result.err, std::string("isorun: <stdout>: cannot write: ") + reason + "\n");
    }
  }
}

TEST(IsorunOutput, ThatCannotBeWrittenDoesNotHideTheErrorOfTheProgram) {
  const CommandResult result =
      run_command({"isorun", "-"}, {.input = std::string(kBrokenProgram), .standard_output = StandardOutput::FullDisk});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err,
              HasSubstr("<stdin>:3: error: G01 has no coordinate: write at least one directly after it [ISO026]\n"));
}

TEST(IsorunInput, ThatCannotBeReadIsAFailure) {
  const support::TemporaryFolder folder;
  const std::string missing = folder.path("gone.iso");
  const std::string binary = folder.write("noise.iso", std::string(2000, '\x01'));
  const auto complaint = [](std::vector<std::string> command) {
    command.insert(command.begin(), "isorun");
    const CommandResult result = run_command(command);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  EXPECT_EQ(complaint({missing}), "isorun: " + missing + ": cannot read: No such file or directory\n");
  EXPECT_EQ(complaint({"--lang", "it", missing}),
            "isorun: " + missing + ": non si può leggere: file o directory non esistente\n");
  EXPECT_EQ(complaint({folder.path()}), "isorun: " + folder.path() + ": is a directory\n");
  EXPECT_EQ(complaint({"--lang", "it", folder.path()}), "isorun: " + folder.path() + ": è una directory\n");
  EXPECT_EQ(complaint({binary}), "isorun: " + binary + ": looks like a binary file\n");
}

TEST(IsorunInput, IsNotOverwrittenByItsTrace) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kCleanProgram);
  const CommandResult result = run_command({"isorun", "--trace", "./part.iso", file}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "isorun: ./part.iso: this would overwrite the program\n");
  EXPECT_EQ(run_command({"isorun", file}).status, 0);
}

/// Whatever is read stays as it is, and each output has a file of its own; links and other names make no difference.
TEST(IsorunOutput, GoesToFilesOfItsOwn) {
  const support::TemporaryFolder folder;
  const std::string program = folder.write("part.iso", kCleanProgram);
  const std::string configuration = folder.write("isocnc.json", "{}");
  const std::string machine = folder.write("machine.json", "{}");
  const std::string taken = folder.write("old.jsonl", "old\n");
  std::filesystem::create_directory(folder.path("sub"));
  std::filesystem::create_symlink("old.jsonl", folder.path("link"));
  std::filesystem::create_hard_link(taken, folder.path("hard"));
  std::filesystem::create_symlink("nothing.svg", folder.path("dangling"));
  std::filesystem::create_symlink("isocnc.json", folder.path("config.svg"));
  const auto said = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    options.push_back("part.iso");
    const CommandResult result = run_command(options, {.folder = folder.path()});
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_EQ(said({"--trace", "new", "--samples", "new"}),
            "isorun: new: --trace and --samples would both be written there\n");
  EXPECT_EQ(said({"--trace", "new", "--samples", "sub/../new"}),
            "isorun: new: --trace and --samples would both be written there\n");
  EXPECT_EQ(said({"--trace", "old.jsonl", "--samples", "link"}),
            "isorun: old.jsonl: --trace and --samples would both be written there\n");
  EXPECT_EQ(said({"--samples", folder.path("hard"), "--trace", "old.jsonl", "--lang", "it"}),
            "isorun: old.jsonl: ci scriverebbero sia --trace sia --samples\n");
  EXPECT_EQ(said({"--trace", "dangling", "--plot", "nothing.svg"}),
            "isorun: dangling: --trace and --plot would both be written there\n");
  EXPECT_EQ(said({"--plot", "config.svg"}), "isorun: config.svg: this would overwrite the configuration\n");
  EXPECT_EQ(said({"--samples", "isocnc.json", "--lang", "it"}),
            "isorun: isocnc.json: così si sovrascriverebbe la configurazione\n");
  EXPECT_EQ(said({"--machine", "machine.json", "--samples", machine}),
            "isorun: " + machine + ": this would overwrite the machine's file\n");
  EXPECT_EQ(said({"--machine", "machine.json", "--restart-at", "2", "-o", "machine.json"}),
            "isorun: machine.json: this would overwrite the machine's file\n");
  EXPECT_EQ(run_command({"isorun", "--trace", "/dev/null", "--samples", "/dev/null", program}).status, 0);
  for (const auto& [file, content] : std::map<std::string, std::string>{
           {program, std::string(kCleanProgram)}, {configuration, "{}"}, {machine, "{}"}, {taken, "old\n"}}) {
    std::stringstream now;
    now << std::ifstream(file).rdbuf();
    EXPECT_EQ(now.str(), content) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("new")));
}

TEST(IsorunInput, MayBeginWithAByteOrderMark) {
  EXPECT_EQ(run_command({"isorun", "-"}, {.input = "\xEF\xBB\xBF" + std::string(kCleanProgram)}).status, 0);
}

TEST(IsorunInput, InUtf16IsRefused) {
  const support::TemporaryFolder folder;
  std::string wide = "\xFF\xFE";
  for (const char c : kCleanProgram) wide += std::string{c, '\0'};
  const CommandResult result = run_command({"isorun", folder.write("wide.iso", wide)});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("wide.iso: is UTF-16; save it as UTF-8 or ASCII\n"));
  EXPECT_EQ(run_command({"isorun", "--lang", "it", "-"}, {.input = wide}).err,
            "isorun: <stdin>: è in UTF-16: va salvato in UTF-8 o ASCII\n");
}

TEST(IsorunInput, WithoutM02StopsAtItsEnd) {
  const CommandResult result = run_command({"isorun", "-"}, {.input = "M06 T101001\nG00 X1\n"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("[ISO045]"));
}

}  // namespace
}  // namespace isocnc::commands
