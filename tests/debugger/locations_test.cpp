// Where a value was set, as a link.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debug_client.h"
#include "programs.h"

namespace isocnc::debugger {
namespace {

using testing::HasSubstr;

/// The text under a link: `8 F1000`; the line alone where no word is named.
std::string place_behind(DebugClient& client, const Json& holder) {
  if (!holder.contains("valueLocationReference")) return "(none)";
  const Json place = client.request("locations", {{"locationReference", holder.at("valueLocationReference")}});
  EXPECT_EQ(place.at("source").at("path"), client.program().generic_string());
  const int line = place.at("line");
  std::string text = kPart;
  for (int i = 1; i < line; ++i) text.erase(0, text.find('\n') + 1);
  std::string result = std::to_string(line);
  if (!place.contains("column")) return result;
  const int column = place.at("column");
  const int end = place.at("endColumn");
  return result + " " + text.substr(static_cast<std::size_t>(column - 1), static_cast<std::size_t>(end - column));
}

std::string linked(DebugClient& client, const std::string& expression) {
  return place_behind(client, client.request("evaluate", {{"expression", expression}}));
}

TEST(Locations, LeadToWhereAValueWasSet) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({11});
  client.run("configurationDone");
  EXPECT_EQ(linked(client, "F"), "9 F3000");
  EXPECT_EQ(linked(client, "S"), "5 S18000");
  EXPECT_EQ(linked(client, "T"), "4 T101001");
  EXPECT_THAT(linked(client, "V3"), testing::StartsWith("10"));
  EXPECT_EQ(linked(client, "MOTION"), "8 G01");
  EXPECT_EQ(linked(client, "PLANE"), "2 G17");
  for (const char* const unset : {"V4", "X", "FACE", "TIME", "F + 1"})
    EXPECT_EQ(linked(client, unset), "(none)") << unset;
  for (const Json& each : client.variables("Modal groups")) {
    if (each.at("name") != "motion") continue;
    EXPECT_EQ(place_behind(client, each), "8 G01");
  }
  for (const Json& each : client.variables("Registers")) {
    if (each.at("name") != "V3") continue;
    EXPECT_THAT(place_behind(client, each), testing::StartsWith("10"));
  }
}

TEST(Locations, FollowTheRunBackAndChangesByHand) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({9, 16});
  client.run("configurationDone");
  EXPECT_EQ(linked(client, "F"), "8 F1000");
  client.run("continue");
  EXPECT_EQ(linked(client, "F"), "9 F3000");
  EXPECT_EQ(linked(client, "T"), "15 T101002");
  client.request("setExpression", {{"expression", "F"}, {"value", "500"}});
  client.request("setExpression", {{"expression", "V3"}, {"value", "1"}});
  EXPECT_EQ(linked(client, "F"), "(none)");
  EXPECT_EQ(linked(client, "V3"), "(none)");
  client.run("reverseContinue");
  EXPECT_EQ(linked(client, "F"), "8 F1000");
}

TEST(Locations, LeadToTheDescriptionOfAnObstacle) {
  DebugClient client;
  client.write("isocnc.json",
               "{\"setups\": [{\"paths\": [\"*.iso\"], \"fixtures\": [\n"
               "{\"name\": \"a\", \"box\": [[900, 0, 0], [910, 10, 10]]}]}],\n"
               "\"machine\": {\"nose\": [[90, 110, 140]]}}");
  client.stop_at_start(kPart);
  for (const Json& each : client.variables("Surroundings")) {
    if (each.at("name") != "a") continue;
    const Json below =
        client.request("variables", {{"variablesReference", each.at("variablesReference")}}).at("variables");
    const Json place = client.request("locations", {{"locationReference", below.back().at("valueLocationReference")}});
    EXPECT_EQ(place.at("source").at("name"), "isocnc.json");
    EXPECT_EQ(place.at("line"), 2);
    return;
  }
  ADD_FAILURE() << "no obstacle";
}

TEST(Locations, ThatLeadNowhereAreRefused) {
  DebugClient client;
  client.stop_at_start(kPart);
  for (const std::int64_t reference : {std::int64_t{0}, std::int64_t{-7}, std::int64_t{128}, std::int64_t{1} << 40})
    EXPECT_THAT(client.refusal("locations", {{"locationReference", reference}}), HasSubstr("no place")) << reference;
}

}  // namespace
}  // namespace isocnc::debugger
