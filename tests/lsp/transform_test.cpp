#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client_text.h"
#include "session.h"

namespace isocnc::lsp {
namespace {

using testing::HasSubstr;

constexpr const char* kLeftUri = "file:///nowhere/left.iso";
constexpr std::string_view kLeftPart = "M06 T101001\r\nG00 X10 Y0 Z5 ; \xC3\xA8 \r\nG02 X20 Y10 I20 J0 F500\r\nM02\r\n";

Json transform_command(Json argument) {
  argument["uri"] = kLeftUri;
  return {{"command", "isocnc.transform"}, {"arguments", {std::move(argument)}}};
}

TEST(Transform, EditsTheDocument) {
  const std::pair<Json, std::string_view> cases[] = {
      {{{"mirror", "X"}, {"about", 400}},
       "M06 T101001\r\nG00 X790 Y0 Z5 ; \xC3\xA8 \r\nG03 X780 Y10 I780 J0 F500\r\nM02\r\n"},
      {{{"mirror", "Y"}, {"about", 5.5}, {"scaleFeed", 2}},
       "M06 T101001\r\nG00 X10 Y11 Z5 ; \xC3\xA8 \r\nG03 X20 Y1 I20 J11 F1000\r\nM02\r\n"},
      {{{"rotate", 90}, {"about", {0, 0}}},
       "M06 T101001\r\nG00 X0 Y10 Z5 ; \xC3\xA8 \r\nG02 X-10 Y20 I0 J20 F500\r\nM02\r\n"},
      {{{"shift", {1, 2, 3}}}, "M06 T101001\r\nG00 X11 Y2 Z8 ; \xC3\xA8 \r\nG02 X21 Y12 I21 J2 F500\r\nM02\r\n"},
  };
  for (const auto& [argument, after] : cases) {
    Session session;
    session.start();
    session.open(kLeftUri, std::string(kLeftPart));
    session.ask("workspace/executeCommand", transform_command(argument));
    const Json edits = session.wait_for("workspace/applyEdit")["params"]["edit"]["changes"][kLeftUri];
    EXPECT_EQ(edits.size(), 2u) << argument;
    EXPECT_EQ(ClientText(std::string(kLeftPart)).with(edits), after) << argument;
  }
}

TEST(Transform, RepeatsTheDocument) {
  Session session;
  session.start();
  session.open(kLeftUri, std::string(kLeftPart));
  session.ask("workspace/executeCommand", transform_command({{"repeat", {1, 2, 0, 50}}}));
  const Json edits = session.wait_for("workspace/applyEdit")["params"]["edit"]["changes"][kLeftUri];
  EXPECT_EQ(ClientText(std::string(kLeftPart)).with(edits),
            "M06 T101001\r\nG00 X10 Y0 Z5 ; \xC3\xA8 \r\nG02 X20 Y10 I20 J0 F500\r\n(copy 2 of 2: X+0 Y+50)\r\n"
            "M06 T101001\r\nG00 X10 Y50 Z5 ; \xC3\xA8 \r\nG02 X20 Y60 I20 J50 F500\r\nM02\r\n");
}

TEST(Transform, RefusesWithTheLine) {
  Session session;
  session.start();
  session.open(kLeftUri, "M06 T101001\nG00 Y0 Z5\nG01 Y5 F100\nM02\n");
  const Json error =
      session.respond("workspace/executeCommand", transform_command({{"mirror", "X"}, {"about", 400}}))["error"];
  EXPECT_EQ(error["code"], -32803);
  EXPECT_THAT(error["message"].get<std::string>(), HasSubstr("line 3: the feed move starts at a place"));
}

TEST(Transform, RefusesParametersThatAreNone) {
  Session session;
  session.start();
  session.open(kLeftUri, std::string(kLeftPart));
  const Json wrong[] = {
      Json::object(),
      {{"mirror", "X"}},
      {{"mirror", "Z"}, {"about", 1}},
      {{"mirror", "X"}, {"about", "1"}},
      {{"mirror", "X"}, {"about", 1e9}},
      {{"repeat", {1, 1, 5, 5}}},
      {{"repeat", {2.5, 1, 5, 5}}},
      {{"repeat", {1000, 2, 5, 5}}},
      {{"repeat", {2, 2, 5}}},
      {{"mirror", "X"}, {"about", 1}, {"shift", {1, 2}}},
      {{"rotate", 90}, {"about", 1}},
      {{"rotate", 90}, {"about", {1, 2, 3}}},
      {{"shift", {1}}},
      {{"shift", {1, 2, 3, 4}}},
      {{"scaleFeed", 0}},
      {{"scaleFeed", nullptr}},
  };
  for (const Json& argument : wrong)
    EXPECT_EQ(session.respond("workspace/executeCommand", transform_command(argument))["error"]["code"], -32602)
        << argument;
}

}  // namespace
}  // namespace isocnc::lsp
