#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "lsp/protocol/uri.h"
#include "run_command.h"
#include "tests/lsp/session.h"
#include "tests/lsp/watched_runs.h"
#include "tests/support/example_programs.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Line, column, end of the mark, code, severity, message, and whether only the run shows it.
using Shown = std::tuple<int, int, int, std::string, std::string, std::string, bool>;

/// What isolint --verify shows of a program, without the note (W162) that the run stops at an error which is shown.
std::vector<Shown> shown_by_isolint(const fs::path& program) {
  const CommandResult result = run_command({"isolint", "--verify", "--lang", "en", "--format", "json", program});
  std::vector<Shown> shown;
  for (const Json& each : Json::parse(result.out))
    shown.emplace_back(each["line"], each["column"], each["endColumn"], each["code"], each["severity"], each["message"],
                       each.value("source", "") == "run");
  const auto place = [](const Shown& each) {
    return std::tuple(std::get<0>(each), std::get<1>(each), std::get<2>(each));
  };
  std::set<std::tuple<int, int, int>> errors;
  for (const Shown& each : shown)
    if (std::get<4>(each) == "error") errors.insert(place(each));
  std::erase_if(shown,
                [&](const Shown& each) { return std::get<3>(each) == "W162" && errors.count(place(each)) != 0; });
  std::sort(shown.begin(), shown.end());
  return shown;
}

/// The same of diagnostics, whose lines and columns count from 0. Hints are no findings.
std::vector<Shown> shown_by_isols(const Json& diagnostics) {
  static const std::vector<std::string> kSeverities = {"", "error", "warning", "info"};
  constexpr std::size_t kHint = 4;
  std::vector<Shown> shown;
  for (const Json& each : diagnostics) {
    if (each["severity"] == kHint) continue;
    const Json& range = each["range"];
    shown.emplace_back(range["start"]["line"].get<int>() + 1, range["start"]["character"].get<int>() + 1,
                       range["end"]["character"].get<int>() + 1, each["code"],
                       kSeverities[each["severity"].get<std::size_t>()], each["message"],
                       each["source"] == "isocnc verify");
  }
  std::sort(shown.begin(), shown.end());
  return shown;
}

/// Opens a program and waits until it has been verified: the progress of a held run says when it ends.
Json verified_diagnostics(lsp::Session& session, lsp::WatchedRuns& runs, const fs::path& program) {
  const std::string uri = protocol::uri_of(program);
  runs.hold();
  session.open(uri, text_of_file(program));
  session.wait_for([](const Json& message) {
    return message.value("method", "") == "$/progress" && message["params"]["value"]["kind"] == "begin";
  });
  runs.release();
  session.wait_for([](const Json& message) {
    return message.value("method", "") == "$/progress" && message["params"]["value"]["kind"] == "end";
  });
  Json diagnostics = session.request("textDocument/diagnostic", {{"textDocument", {{"uri", uri}}}}).at("items");
  session.close(uri);
  return diagnostics;
}

TEST(IsolsVerify, ShowsOfEachExampleWhatIsolintShows) {
  lsp::WatchedRuns runs;
  background::VerificationOptions options = runs.options();
  options.shown_after = std::chrono::milliseconds(0);
  lsp::Session session(options);
  session.start({{"general", {{"positionEncodings", {"utf-32"}}}},
                 {"window", {{"workDoneProgress", true}}},
                 {"textDocument", {{"diagnostic", Json::object()}}}},
                {{"locale", "en"}});
  std::size_t programs = 0;
  std::size_t of_machine = 0;
  for (const fs::path& program : support::example_programs()) {
    const std::vector<Shown> expected = shown_by_isolint(program);
    EXPECT_EQ(shown_by_isols(verified_diagnostics(session, runs, program)), expected) << program;
    ++programs;
    of_machine += static_cast<std::size_t>(
        std::count_if(expected.begin(), expected.end(), [](const Shown& each) { return std::get<bool>(each); }));
  }
  EXPECT_GE(programs, 30u);
  EXPECT_GE(of_machine, 5u);
}

}  // namespace
}  // namespace isocnc::commands
