#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debug_client.h"
#include "programs.h"

namespace isocnc::debugger {
namespace {

using testing::HasSubstr;

TEST(Protocol, SaysWhatItCan) {
  DebugClient client;
  const Json capabilities = client.request("initialize", {{"adapterID", "isocnc"}, {"locale", "it"}});
  for (const char* const name : {"supportsConfigurationDoneRequest",
                                 "supportsFunctionBreakpoints",
                                 "supportsConditionalBreakpoints",
                                 "supportsHitConditionalBreakpoints",
                                 "supportsEvaluateForHovers",
                                 "supportsStepBack",
                                 "supportsSetVariable",
                                 "supportsGotoTargetsRequest",
                                 "supportsCompletionsRequest",
                                 "supportsRestartRequest",
                                 "supportsExceptionInfoRequest",
                                 "supportsTerminateRequest",
                                 "supportsDataBreakpoints",
                                 "supportsLogPoints",
                                 "supportsSetExpression",
                                 "supportsBreakpointLocationsRequest",
                                 "supportsSteppingGranularity",
                                 "supportsLoadedSourcesRequest",
                                 "supportsValueFormattingOptions",
                                 "supportsCancelRequest",
                                 "supportsExceptionFilterOptions"})
    EXPECT_EQ(capabilities.value(name, false), true) << name;
  EXPECT_EQ(capabilities.at("exceptionBreakpointFilters").size(), 7u);
}

TEST(Protocol, AnswersWhatIsAskedBeforeItDisconnects) {
  DebugClient client;
  client.stop_at_start(kPart);
  const std::int64_t asked[] = {client.ask("next"), client.ask("evaluate", {{"expression", "X"}}),
                                client.ask("disconnect")};
  client.wait_for_end();
  for (const std::int64_t seq : asked) {
    const Json response = client.wait_for([](const Json& message) { return message["type"] == "response"; });
    EXPECT_EQ(response["request_seq"], seq) << response;
  }
}

/// Whatever comes, an answer or a word to the user comes back, and the adapter goes on.
class HostileMessages : public testing::TestWithParam<std::string> {};

TEST_P(HostileMessages, MessagesDoNoHarm) {
  DebugClient client;
  client.stop_at_start(kPart);
  client.send_raw(GetParam());
  EXPECT_EQ(client.line(), 2);
  EXPECT_EQ(client.run("next").at("reason"), "step");
  EXPECT_EQ(client.end(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, HostileMessages,
    testing::Values(
        "", "{", "null", "[]", "7", "{}", "\xff\xfe", R"({"type":"request"})", R"({"seq":1,"type":"request"})",
        R"({"seq":"a","type":"request","command":"next"})", R"({"seq":1,"type":"response","command":"next"})",
        R"({"seq":1,"type":"request","command":7})", R"({"seq":1,"type":"request","command":"fly"})",
        R"({"seq":1,"type":"request","command":"variables","arguments":7})",
        R"({"seq":1,"type":"request","command":"variables","arguments":{"variablesReference":1e300}})",
        R"({"seq":1,"type":"request","command":"variables","arguments":{"variablesReference":-5}})",
        R"({"seq":1,"type":"request","command":"variables","arguments":{"variablesReference":99999999999999999999}})",
        R"({"seq":1,"type":"request","command":"variables","arguments":{"variablesReference":1,"start":-9,"count":-9}})",
        R"({"seq":1,"type":"request","command":"stackTrace","arguments":{"startFrame":9999,"levels":-1}})",
        R"({"seq":1,"type":"request","command":"setBreakpoints","arguments":{"source":7,"breakpoints":{}}})",
        R"({"seq":1,"type":"request","command":"setBreakpoints","arguments":{"breakpoints":[{"line":-3}]}})",
        R"({"seq":1,"type":"request","command":"setBreakpoints","arguments":{"breakpoints":[7,null,"a"]}})",
        R"({"seq":1,"type":"request","command":"setFunctionBreakpoints","arguments":{"breakpoints":[7]}})",
        R"({"seq":1,"type":"request","command":"setDataBreakpoints","arguments":{"breakpoints":[{"dataId":"Z ="}]}})",
        R"({"seq":1,"type":"request","command":"setExceptionBreakpoints","arguments":{"filters":[7,"x"]}})",
        R"({"seq":1,"type":"request","command":"goto","arguments":{"targetId":-1}})",
        R"({"seq":1,"type":"request","command":"goto","arguments":{"targetId":9223372036854775807}})",
        R"({"seq":1,"type":"request","command":"gotoTargets","arguments":{"line":9223372036854775807}})",
        R"({"seq":1,"type":"request","command":"breakpointLocations","arguments":{"line":1,"endLine":-7}})",
        R"({"seq":1,"type":"request","command":"completions","arguments":{"text":"","column":-99}})",
        R"({"seq":1,"type":"request","command":"completions","arguments":{"text":"\u00e8","column":1}})",
        R"({"seq":1,"type":"request","command":"evaluate","arguments":{"expression":"W","context":"hover"}})",
        R"({"seq":1,"type":"request","command":"evaluate","arguments":{"expression":"","context":"repl"}})",
        R"({"seq":1,"type":"request","command":"evaluate","arguments":{"expression":"G02 X\u0000","context":"repl"}})",
        R"({"seq":1,"type":"request","command":"launch","arguments":{"program":"x"}})",
        R"({"seq":1,"type":"request","command":"initialize"})",
        R"({"seq":1,"type":"request","command":"configurationDone"})",
        R"({"seq":1,"type":"request","command":"exceptionInfo"})"));

TEST(Protocol, AMessageThatNestsTooDeeplyDoesNoHarm) {
  constexpr int kDepth = 500'000;
  DebugClient client;
  client.stop_at_start(kPart);
  client.send_raw(R"({"seq":1,"type":"request","command":"restart","arguments":{"arguments":)" +
                  std::string(kDepth, '[') + std::string(kDepth, ']') + "}}");
  EXPECT_EQ(client.run("next").at("reason"), "step");
  EXPECT_EQ(client.end(), 0);
}

TEST(Protocol, RefusesWhatIsOutOfOrder) {
  DebugClient client;
  EXPECT_THAT(client.refusal("launch", {{"program", "x"}}), HasSubstr("initialize"));
  client.request("initialize");
  for (const char* const command : {"configurationDone", "next", "continue", "stackTrace", "scopes", "restart",
                                    "terminate", "pause", "reverseContinue", "stepOut", "exceptionInfo"})
    EXPECT_THAT(client.refusal(command), HasSubstr("no program has been launched")) << command;
  EXPECT_THAT(client.refusal("evaluate", {{"expression", "X"}}), HasSubstr("no program"));
  EXPECT_EQ(client.end(), 0);
}

struct BadLaunch {
  Json arguments;
  std::string message;
};

class BadLaunches : public testing::TestWithParam<BadLaunch> {};

TEST_P(BadLaunches, AreRefusedAndTheNextOneIsNot) {
  DebugClient client;
  client.request("initialize");
  Json arguments = {{"program", client.write("a.iso", kPart).string()}};
  arguments.update(GetParam().arguments);
  EXPECT_THAT(client.refusal("launch", arguments), HasSubstr(GetParam().message));
  client.request("launch", {{"program", client.write("a.iso", kPart).string()}});
}

INSTANTIATE_TEST_SUITE_P(
    All, BadLaunches,
    testing::Values(BadLaunch{{{"program", nullptr}}, "program"}, BadLaunch{{{"program", 7}}, "program"},
                    BadLaunch{{{"program", "/nowhere/x.iso"}}, "cannot read"},
                    BadLaunch{{{"program", "/"}}, "cannot read"}, BadLaunch{{{"machine", "/nowhere/m.json"}}, "m.json"},
                    BadLaunch{{{"speed", -1}}, "speed"}, BadLaunch{{{"speed", "fast"}}, "speed"},
                    BadLaunch{{{"registers", {{"V31", 1}}}}, "V31"}, BadLaunch{{{"registers", {{"X", 1}}}}, "X"},
                    BadLaunch{{{"registers", 3}}, "registers"}, BadLaunch{{{"startAtLine", 0}}, "startAtLine"},
                    BadLaunch{{{"decimals", 40}}, "decimals"}));

TEST(Protocol, SpeaksTheLanguageOfTheClient) {
  DebugClient client(std::nullopt);
  client.request("initialize", {{"locale", "it-IT"}});
  const auto refusal = [&](const Json& more) {
    Json arguments = {{"program", client.write("a.iso", kPart).string()}};
    arguments.update(more);
    return client.refusal("launch", arguments);
  };
  EXPECT_EQ(refusal({{"stopOnEntry", "yes"}}), "stopOnEntry non è del tipo giusto");
  EXPECT_THAT(refusal({{"speed", -1}}), HasSubstr("speed non può essere"));
  EXPECT_THAT(refusal({{"program", "/nowhere/x.iso"}}), HasSubstr("non si può leggere"));
  client.write("isocnc.json", R"({"language": "en", "machine": {"axes": 7}})");
  EXPECT_THAT(refusal(Json::object()), HasSubstr("is needed")) << "the configuration decides";
}

/// One breakpoint that cannot be read leaves the others alone.
TEST(Protocol, AMistakeInAListConcernsItsElementAlone) {
  DebugClient client(std::nullopt);
  client.write("isocnc.json", R"({"language": "it"})");
  client.launch(kPart);
  const Json breakpoints =
      client.request("setFunctionBreakpoints", {{"breakpoints", {{{"name", "M06"}}, {{"name", 7}}, Json::object()}}})
          .at("breakpoints");
  ASSERT_EQ(breakpoints.size(), 3u);
  EXPECT_EQ(breakpoints.at(0).at("verified"), true);
  EXPECT_EQ(breakpoints.at(1).at("message"), "name non è del tipo giusto");
  EXPECT_EQ(breakpoints.at(2).at("message"), "manca name");
}

TEST(Protocol, ARequestThatTakesAStandingMachineIsRefusedWhileItRuns) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X0\nG01 X90000 F1\nM02\n", {{"speed", 1}});
  client.request("configurationDone");
  EXPECT_THAT(client.refusal("next"), HasSubstr("running"));
  EXPECT_THAT(client.refusal("setExpression", {{"expression", "V1"}, {"value", "1"}}), HasSubstr("running"));
  EXPECT_EQ(client.request("threads").at("threads").size(), 1u);
  client.run("pause");
  client.request("stackTrace", {{"threadId", 1}});
}

TEST(Protocol, AProgramThatChangesOnDiskIsDebuggedAsItWas) {
  DebugClient client;
  client.stop_at_start(kPart);
  std::filesystem::remove(client.program());
  client.run("next");
  EXPECT_EQ(client.event("loadedSource").at("reason"), "removed");
  EXPECT_EQ(client.set_lines({9}).at(0).at("verified"), true);
  client.run("continue");
  EXPECT_EQ(client.line(), 9);
  EXPECT_THAT(client.refusal("restart"), HasSubstr("cannot read"));
}

TEST(Protocol, ARunReportsAProgramThatChanges) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X0\nG01 X90000 F1\nM02\n", {{"speed", 1}});
  client.request("configurationDone");
  // As where times are whole seconds, such as on some network drives.
  const auto time = std::filesystem::last_write_time(client.program());
  client.write("program.iso", "M02\n; another one");
  std::filesystem::last_write_time(client.program(), time);
  EXPECT_EQ(client.event("loadedSource").at("reason"), "changed");
  EXPECT_FALSE(client.has_event("stopped"));
}

TEST(Protocol, ARestartThatFailsLeavesTheRunAsItIs) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X0\nG01 X90000 F1\nM02\n", {{"speed", 1}});
  client.request("configurationDone");
  std::filesystem::remove(client.program());
  EXPECT_THAT(client.refusal("restart"), HasSubstr("cannot read"));
  EXPECT_EQ(client.run("pause").at("reason"), "pause");
}

TEST(Protocol, ARestartCanBringArgumentsOfItsOwn) {
  DebugClient client;
  client.stop_at_start(kPart);
  const std::string other = client.write("other.iso", "M06 T101001\nG00 X7\nM02\n").string();
  const Json arguments = {{"program", other}, {"startAtLine", 3}};
  EXPECT_EQ(client.run("restart", {{"arguments", arguments}}).at("reason"), "entry");
  EXPECT_EQ(client.line(), 3);
  EXPECT_EQ(client.evaluate("X"), "7");
}

TEST(Protocol, TheProgramIsTheOneSource) {
  DebugClient client;
  {
    DebugClient early;
    early.request("initialize");
    EXPECT_EQ(early.request("loadedSources").at("sources"), Json::array());
  }
  client.stop_at_start(kPart);
  const Json sources = client.request("loadedSources").at("sources");
  ASSERT_EQ(sources.size(), 1u);
  EXPECT_EQ(sources.at(0).at("path"), client.program().string());
  client.write("program.iso", "; another one");
  EXPECT_EQ(client.request("source", {{"source", sources.at(0)}, {"sourceReference", 0}}).at("content"), kPart)
      << "as it is being run";
  EXPECT_EQ(client.refusal("source", {{"source", {{"path", "/nowhere/x.iso"}}}}), "there is no such source");
}

TEST(Protocol, ASearchThatIsCancelledIsAPause) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X0\nG01 X90000 F1\nM02\n", {{"speed", 1}});
  client.request("configurationDone");
  client.request("cancel", {{"requestId", 1}});  // Answered at once, as all are: there is nothing to be cancelled.
  EXPECT_FALSE(client.has_event("stopped"));
  EXPECT_EQ(client.run("cancel", {{"progressId", "1"}}).at("reason"), "pause");
}

TEST(Protocol, TerminateEndsTheRun) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X0\nG01 X90000 F1\nM02\n", {{"speed", 1}});
  client.request("configurationDone");
  client.request("terminate");
  EXPECT_EQ(client.event("exited").at("exitCode"), 0);
  client.event("terminated");
}

TEST(Protocol, AClientThatGoesAwayEndsTheAdapter) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X0\nG01 X90000 F1\nM02\n", {{"speed", 1}});
  client.request("configurationDone");
  EXPECT_EQ(client.end(false), 1);
}

TEST(Protocol, LinesCountAsTheClientSays) {
  DebugClient client;
  const auto program = client.write("a.iso", kPart);
  client.request("initialize", {{"linesStartAt1", false}});
  client.request("launch", {{"program", program.string()}, {"stopOnEntry", true}});
  client.run("configurationDone");
  EXPECT_EQ(client.line(), 1);
}

}  // namespace
}  // namespace isocnc::debugger
