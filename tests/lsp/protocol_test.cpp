#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "session.h"

/// The protocol itself: the order of messages, and the answers to invalid ones.
namespace isocnc::lsp {
namespace {

int error_code(const Json& response) { return response.at("error").at("code"); }

TEST(Lifecycle, ShutdownAndExitAreCleanEverythingElseIsNot) {
  Session clean;
  clean.start();
  EXPECT_EQ(clean.request("shutdown"), nullptr);
  EXPECT_EQ(clean.end(), 0);
  Session hasty;
  hasty.start();
  EXPECT_EQ(hasty.end(), 1);
  Session disconnected;
  disconnected.start();
  EXPECT_EQ(disconnected.end(false), 1);
  Session never_started;
  EXPECT_EQ(never_started.end(), 1);
}

TEST(Lifecycle, PendingRequestsHaveTheirAnswersBeforeThatToShutdown) {
  Session session;
  session.start();
  std::string text = "M06 T101001\n";
  for (int i = 0; i < 20'000; ++i) text += "G01 X1 Y2 F100\n";
  session.open(kUri, text);
  const Json params = {{"textDocument", {{"uri", kUri}}}};
  std::set<Json> pending = {session.ask("textDocument/diagnostic", params), session.ask("isocnc/toolpath", params)};
  const Json shutdown = session.ask("shutdown");
  session.notify("exit");
  session.wait_for_end();
  const auto next_response = [&] {
    return session.wait_for([](const Json& message) { return message.contains("id") && !message.contains("method"); });
  };
  for (Json response = next_response(); response["id"] != shutdown; response = next_response()) {
    EXPECT_TRUE(response.contains("result") || error_code(response) == -32800) << response;
    pending.erase(response["id"]);
  }
  EXPECT_TRUE(pending.empty());
}

TEST(Lifecycle, RequestsOutOfPlaceAreRefused) {
  Session session;
  EXPECT_EQ(error_code(session.respond("textDocument/hover")), -32002);
  session.open(kUri, "M02\n");  // A notification before `initialize`, which is dropped.
  session.start();
  EXPECT_EQ(error_code(session.respond("initialize", {{"capabilities", Json::object()}})), -32600);
  EXPECT_EQ(error_code(session.respond("textDocument/hover", {{"textDocument", {{"uri", kUri}}}})), -32602);
  session.request("shutdown");
  EXPECT_EQ(error_code(session.respond("textDocument/hover")), -32600);
  EXPECT_EQ(error_code(session.respond("shutdown")), -32600);
  EXPECT_EQ(session.end(), 0);
}

struct BadMessage {
  const char* body;
  int code;
  const char* id;
};

TEST(Messages, WhatIsWrongIsAnsweredAsTheProtocolAsks) {
  const BadMessage kMessages[] = {
      {"", -32700, "null"},
      {"{", -32700, "null"},
      {"\xff\xfe", -32700, "null"},
      {"[]", -32600, "null"},
      {"3", -32600, "null"},
      {"null", -32600, "null"},
      {"{}", -32600, "null"},
      {R"({"id":7})", -32600, "7"},
      {R"({"id":8,"method":5})", -32600, "8"},
      {R"({"id":{},"method":"x"})", -32600, "null"},
      {R"({"id":null,"method":"x"})", -32600, "null"},
      {R"({"id":9,"method":"x","params":3})", -32600, "9"},
      {R"({"id":"ten","method":"no/such"})", -32601, "\"ten\""},
      {R"({"id":11,"method":"$/no/such"})", -32601, "11"},
      {R"({"id":12,"method":"textDocument/hover","params":[]})", -32602, "12"},
      {R"({"id":13,"method":"textDocument/hover","params":{"textDocument":{"uri":"file:///nowhere/part.iso"}}})",
       -32602, "13"},
      {R"({"id":14,"method":"textDocument/hover","params":{"textDocument":{"uri":"file:///nowhere/part.iso"},)"
       R"("position":{"line":-1,"character":0}}})",
       -32602, "14"},
      {R"({"id":15,"method":"workspace/executeCommand","params":{"command":"no.such"}})", -32602, "15"},
  };
  Session session;
  session.start();
  session.open(kUri, "G01 X10\n");
  for (const BadMessage& message : kMessages) {
    session.send_raw(message.body);
    const Json response = session.wait_for([](const Json& each) { return each.contains("error"); });
    EXPECT_EQ(response.at("id"), Json::parse(message.id)) << message.body;
    EXPECT_EQ(error_code(response), message.code) << message.body;
  }
  session.receive({rpc::MessageFrame::FramingError::NoLength, {}});
  EXPECT_EQ(error_code(session.response_to(nullptr)), -32700);
  session.receive({rpc::MessageFrame::FramingError::TooLong, {}});
  EXPECT_EQ(error_code(session.response_to(nullptr)), -32700);
  // Invalid notifications get no answer and have no effect.
  session.send_raw(R"({"method":"no/such"})");
  session.send_raw(R"({"method":"textDocument/didOpen","params":{}})");
  session.send_raw(R"({"method":"textDocument/didChange","params":{"textDocument":{"uri":"file:///other"}}})");
  session.send_raw(R"({"id":99,"result":null})");
  EXPECT_EQ(session.request("textDocument/diagnostic", {{"textDocument", {{"uri", kUri}}}})["kind"], "full");
}

/// An editor whose user deletes the second half of a character sends the first.
TEST(Messages, AnEditWithHalfACharacterIsMade) {
  Session session;
  session.start();
  session.open(kUri, "(a)\nM02\n");
  session.send_raw(
      R"({"method":"textDocument/didChange","params":{"textDocument":{"uri":"file:///nowhere/part.iso","version":2},)"
      R"("contentChanges":[{"range":{"start":{"line":0,"character":1},"end":{"line":0,"character":2}},"text":"\ud83d"}]}})");
  session.edit(kUri, 3, {change(1, 0, 1, 3, "Q")});
  Session other;
  other.start();
  other.open(kUri, "(\xEF\xBF\xBD)\nQ\n");
  EXPECT_EQ(session.request("isocnc/syntaxTree", document_params()),
            other.request("isocnc/syntaxTree", document_params()));
}

TEST(Messages, WhatNestsTooDeeplyIsRefused) {
  constexpr int kDepth = 500'000;
  const std::string nested = std::string(kDepth, '[') + std::string(kDepth, ']');
  Session session;
  session.start();
  session.open(kUri, "G01 X10\n");
  for (const std::string method : {"codeAction/resolve", "completionItem/resolve", "textDocument/hover"}) {
    session.send_raw(R"({"id":7,"method":")" + method + R"(","params":{"data":{"uri":"file:///part.iso","x":)" +
                     nested + "}}}");
    EXPECT_EQ(error_code(session.response_to(nullptr)), -32700) << method;
  }
  EXPECT_EQ(session.request("textDocument/diagnostic", {{"textDocument", {{"uri", kUri}}}})["kind"], "full");
}

TEST(Lifecycle, TheClientsFirstKnownEncodingIsTaken) {
  const std::pair<Json, const char*> kCases[] = {
      {Json::object(), "utf-16"},
      {{{"general", {{"positionEncodings", Json::array()}}}}, "utf-16"},
      {{{"general", {{"positionEncodings", {"utf-7", "utf-32", "utf-16"}}}}}, "utf-32"},
      {{{"general", {{"positionEncodings", {"utf-8", "utf-16"}}}}}, "utf-8"},
  };
  for (const auto& [capabilities, encoding] : kCases) {
    Session session;
    EXPECT_EQ(session.start(capabilities)["capabilities"]["positionEncoding"], encoding);
  }
}

/// Waits for the progress of one work from start to end. Returns its token.
Json reported_work(Session& session, const std::string& title) {
  const Json token = session.wait_for("window/workDoneProgress/create")["params"]["token"];
  const Json begin = session.wait_for("$/progress")["params"];
  EXPECT_EQ(begin["token"], token);
  EXPECT_EQ(begin["value"]["kind"], "begin");
  EXPECT_EQ(begin["value"]["title"], title);
  const Json end = session.wait_for("$/progress")["params"];
  EXPECT_EQ(end["token"], token);
  EXPECT_EQ(end["value"]["kind"], "end");
  return token;
}

TEST(Progress, IsReportedWhileALongProgramIsOpenedOrRun) {
  Session session;
  session.start({{"window", {{"workDoneProgress", true}}}});
  std::string text;
  while (text.size() < (16u << 20))
    text += "(a long comment, so that few lines make a long program: 0123456789012345678901234567890123456789)\n";
  session.open(kUri, text);
  std::set<Json> tokens{reported_work(session, "opening part.iso")};
  for (int i = 0; i < 2; ++i) {
    session.request("isocnc/toolpath", {{"textDocument", {{"uri", kUri}}}});
    tokens.insert(reported_work(session, "running part.iso"));
  }
  EXPECT_EQ(tokens.size(), 3u);
  session.open("file:///nowhere/short.iso", "M02\n");
  session.request("isocnc/toolpath", {{"textDocument", {{"uri", "file:///nowhere/short.iso"}}}});
  EXPECT_FALSE(session.has([](const Json& message) { return message.value("method", "") == "$/progress"; }));
}

TEST(Diagnostics, ArePushedForEachVersionAndTakenBackAtTheEnd) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nG01 X10\nM02\n");
  const Json first = session.diagnostics(kUri, 1);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0]["code"], "ISO066");
  EXPECT_EQ(first[0]["range"], Json::parse(R"({"start":{"line":1,"character":0},"end":{"line":1,"character":3}})"));
  session.edit(kUri, 2, {change(1, 7, 1, 7, " F2000")});
  EXPECT_EQ(session.diagnostics(kUri, 2), Json::array());
  session.close(kUri);
  EXPECT_EQ(session.wait_for("textDocument/publishDiagnostics")["params"]["diagnostics"], Json::array());
}

TEST(Diagnostics, ArePulledByResultId) {
  Session session;
  session.start({{"textDocument", {{"diagnostic", Json::object()}}}});
  session.open(kUri, "M06 T101001\nG01 X10\nM02\n");
  const Json params = {{"textDocument", {{"uri", kUri}}}};
  const Json full = session.request("textDocument/diagnostic", params);
  EXPECT_EQ(full["kind"], "full");
  EXPECT_EQ(full["items"].size(), 1u);
  Json again = params;
  again["previousResultId"] = full["resultId"];
  EXPECT_EQ(session.request("textDocument/diagnostic", again)["kind"], "unchanged");
  session.edit(kUri, 2, {change(1, 7, 1, 7, " F2000")});
  EXPECT_EQ(session.request("textDocument/diagnostic", again)["items"], Json::array());
}

TEST(Requests, AreCancelledOrAnsweredNeverBoth) {
  Session session;
  session.start();
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "G01 X1 Y2 F100\n";
  session.open(kUri, text);
  const Json params = {{"textDocument", {{"uri", kUri}}}};
  const std::int64_t cancelled = session.ask("textDocument/diagnostic", params);
  session.notify("$/cancelRequest", {{"id", cancelled}});
  const std::int64_t kept = session.ask("textDocument/diagnostic", params);
  EXPECT_TRUE(session.response_to(kept).contains("result"));
  const Json response = session.response_to(cancelled);
  EXPECT_TRUE(response.contains("result") || error_code(response) == -32800) << response;
  session.notify("$/cancelRequest", {{"id", "no such"}});
  EXPECT_EQ(session.request("shutdown"), nullptr);
}

}  // namespace
}  // namespace isocnc::lsp
