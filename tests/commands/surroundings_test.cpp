// What surrounds a program, as isolint --verify and isorun tell it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "run_command.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr std::string_view kShop = R"({
  "machine": {
    "kinematics": {"type": "three-axis"},
    "home": {"z": 300}, "nose": [[80, 100, 100]], "holders": {"H": [[20, 40, 40]]},
    "tools": [
      {"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 10, "shape": "flat", "body": "H"},
      {"head": 1, "holder": 1, "tool": 2, "length": 80},
      {"head": 1, "holder": 1, "tool": 3, "name": "new"}]
  },
  "setups": [{"paths": ["*.iso"], "fixtures": [
    {"name": "clamp 1", "box": [[100, -20, 0], [140, 20, 30]]}]}]
})";

/// The cutter's edge is at X90 + 10 on line 3, and is free again on line 4.
constexpr std::string_view kHit =
    "M06 T101001\n"
    "G00 X0 Y0 Z10\n"
    "G01 X120 F1000\n"
    "X200\n"
    "G00 Z50\n"
    "M02\n";

constexpr std::string_view kFree =
    "M06 T101001\n"
    "G00 X0 Y0 Z40\n"
    "G01 X120 F1000\n"
    "X200\n"
    "G00 Z50\n"
    "M02\n";

class Surroundings : public testing::Test {
 protected:
  Surroundings() {
    folder_.write("isocnc.json", kShop);
    folder_.write("hit.iso", kHit);
    folder_.write("free.iso", kFree);
  }

  CommandResult run(std::vector<std::string> command) const {
    return run_command(std::move(command), {.folder = folder_.path()});
  }

  const support::TemporaryFolder folder_;
};

TEST_F(Surroundings, AreHitInAllFormats) {
  const CommandResult text = run({"isolint", "--verify", "hit.iso"});
  EXPECT_EQ(text.status, 1);
  EXPECT_THAT(text.out, AllOf(HasSubstr("error[E152]: the cutter of T101001 hits clamp 1: 20 mm deep at X"),
                              HasSubstr("--> hit.iso:3:1"), HasSubstr("= hit.iso:4:1: it lasts until here"),
                              HasSubstr("= isocnc.json:11:5: clamp 1 is described here")));
  const json finding = json::parse(run({"isolint", "--verify", "--format", "json", "hit.iso"}).out).at(0);
  EXPECT_EQ(finding.at("source"), "run");
  EXPECT_EQ(finding.at("related"),
            json::parse(R"([{"file": "hit.iso", "line": 4, "column": 1, "text": "it lasts until here"},
                            {"file": "isocnc.json", "line": 11, "column": 5, "text": "clamp 1 is described here"}])"));
  const json log = json::parse(run({"isolint", "--verify", "--format", "sarif", "hit.iso"}).out);
  const json& result = log.at("runs").at(0).at("results").at(0);
  EXPECT_EQ(result.at("properties").at("body"), "the cutter of T101001");
  EXPECT_EQ(result.at("properties").at("obstacle"), "clamp 1");
  EXPECT_EQ(result.at("properties").at("depth"), 20);
  EXPECT_EQ(result.at("relatedLocations").at(1).at("physicalLocation").at("artifactLocation").at("uri"), "isocnc.json");
}

TEST_F(Surroundings, AreToldInItalian) {
  EXPECT_THAT(run({"isolint", "--lang", "it", "--verify", "hit.iso"}).out,
              AllOf(HasSubstr("errore[E152]: la fresa T101001 urta clamp 1: entra di 20 mm in X"),
                    HasSubstr("= hit.iso:4:1: dura fino a qui")));
}

TEST_F(Surroundings, ThatAreFreeGiveNoFinding) {
  const CommandResult result = run({"isolint", "--verify", "free.iso"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, IsEmpty());
}

TEST_F(Surroundings, AreCertifiedByIsorun) {
  const CommandResult hit = run({"isorun", "--verify", "hit.iso"});
  EXPECT_EQ(hit.status, 1);
  EXPECT_THAT(hit.out, AllOf(HasSubstr("error[E152]"),
                             HasSubstr("\nverified: 4 motions, 1 contact; nothing nearer than 0.01 mm unseen in the "
                                       "setup of isocnc.json\n")));
  const CommandResult italian = run({"isorun", "--lang", "it", "--verify", "free.iso"});
  EXPECT_EQ(italian.status, 0);
  EXPECT_THAT(italian.out, HasSubstr("verificato: 4 movimenti, 0 contatti; nulla di più vicino di 0.01 mm sfugge "
                                     "nell'attrezzaggio di isocnc.json\n"));
  for (const CommandResult& each : {hit, italian}) EXPECT_THAT(each.out, Not(HasSubstr("safe")));
  folder_.write("gaps.iso",
                "M06 T101002\nG01 X10 F1000\nM06 T101003\nG01 X10\nM06 T101001\nG01 Z10 F1000\nG02 X5\nM02\n");
  EXPECT_THAT(run({"isorun", "--verify", "gaps.iso"}).out,
              HasSubstr("; not verified: T101002 has no shape, T101003 has no length, what follows the error on line"));
}

TEST_F(Surroundings, AreCertifiedOnAllPathsThatAreRun) {
  folder_.write("jump.iso",
                "M06 T101001\nG00 X0 Y0 Z40\nIF VGPL <> 1 GOTO N10\nM06 T101002\nM06 T101001\nZ10\nN10 G01 X120 F1000\n"
                "G00 Z50\nM02\n");
  const CommandResult result = run({"isolint", "--verify", "--select", "E", "jump.iso"});
  EXPECT_THAT(result.out, HasSubstr("error[E152]"));
  EXPECT_THAT(result.err, AllOf(HasSubstr(" motions on 2 paths, 1 contact; "), HasSubstr("T101002 has no shape"),
                                HasSubstr("T101002 has no holder")));
}

/// What a tool without a length leaves open on any of the paths.
TEST_F(Surroundings, TheCertificateNamesUnknownPlacesOfAllPaths) {
  folder_.write("jump.iso",
                "M06 T101001\nG00 X0 Y0 Z80\nIF VGPL = 0 GOTO N1\nM06 T101003\nG00 Z20\nM06 T101001\nG00 X9\n"
                "N1 G00 X11\nZ80\nX0\nM02\n");
  folder_.write("longer.iso",
                "M06 T101003\nG00 X0 Y0 Z20\nM06 T101001\nIF VGPL = 1 GOTO N1\nG00 Z80\nN1 G00 X5\nZ90\nM02\n");
  EXPECT_THAT(run({"isolint", "--verify", "--select", "E", "longer.iso"}).err, HasSubstr(", lines 3 to 7 (it is not"));
  EXPECT_THAT(run({"isolint", "--verify", "--select", "W162", "jump.iso"}).out,
              HasSubstr("= jump.iso:9:1: up to here it is not known where the machine is"));
  EXPECT_THAT(run({"isolint", "--verify", "--select", "E", "jump.iso"}).err,
              HasSubstr("T101003 has no length, lines 6 to 9 (it is not known where T101003 leaves the machine)"));
}

TEST_F(Surroundings, AreCertifiedByIsolint) {
  const CommandResult both = run({"isolint", "--verify", "free.iso", "hit.iso"});
  EXPECT_EQ(
      both.err,
      "free.iso: verified: 4 motions, 0 contacts; nothing nearer than 0.01 mm unseen in the setup of isocnc.json\n"
      "hit.iso: verified: 4 motions, 1 contact; nothing nearer than 0.01 mm unseen in the setup of isocnc.json\n"
      "1 error, 0 warnings in 2 files\n");
  EXPECT_THAT(both.out, Not(HasSubstr("verified")));
  EXPECT_THAT(run({"isolint", "--lang", "it", "--verify", "free.iso"}).err,
              StartsWith("free.iso: verificato: 4 movimenti, 0 contatti; "));
  EXPECT_THAT(run({"isolint", "free.iso"}).err, Not(HasSubstr("verified")));
  EXPECT_THAT(run({"isolint", "--verify", "--no-config", "free.iso"}).err, Not(HasSubstr("verified")));
  EXPECT_EQ(run({"isolint", "--verify", "--format", "concise", "free.iso"}).err, "");
  const json log = json::parse(run({"isolint", "--verify", "--format", "sarif", "free.iso", "hit.iso"}).out);
  EXPECT_THAT(log.at("runs").at(0).at("artifacts").at(1).at("properties").at("certificate").get<std::string>(),
              StartsWith("verified: 4 motions, 1 contact; "));
  const json plain = json::parse(run({"isolint", "--format", "sarif", "free.iso"}).out);
  EXPECT_FALSE(plain.at("runs").at(0).at("artifacts").at(0).contains("properties"));
}

/// The findings of isolint --verify in a program: `E152@3`.
std::vector<std::string> places_in(const std::string& report) {
  std::vector<std::string> places;
  for (const json& each : json::parse(report))
    places.push_back(each.at("code").get<std::string>() + "@" + std::to_string(each.at("line").get<int>()));
  return places;
}

TEST_F(Surroundings, CommentsAboutThemWithoutEffectAreReported) {
  const auto found = [&](const std::string& program, std::vector<std::string> options = {"--verify"}) {
    folder_.write("part.iso", program);
    options.insert(options.begin(), {"isolint", "--format", "json"});
    options.emplace_back("part.iso");
    return places_in(run(options).out);
  };
  const std::string ignored = "M06 T101001\nG00 X0 Y0 Z10\nG01 X120 F1000 ;isolint: ignore E152\nG00 Z50\nM02\n";
  const std::string useless = "M06 T101001\nG00 X0 Y0 Z40\nG01 X120 F1000 ;isolint: ignore E152\nG00 Z50\nM02\n";
  EXPECT_THAT(found(ignored), IsEmpty());
  EXPECT_THAT(found(ignored, {}), IsEmpty());
  const std::string crash = "M06 T101001\nG00 X0 Y0 Z29.7\nG01 X120 F1000 ;isolint: ignore E152\nZ10\nG00 Z50\nM02\n";
  EXPECT_THAT(found(crash), ElementsAre("E152@4"));
  EXPECT_THAT(found(useless), ElementsAre("W190@3"));
  EXPECT_THAT(found(useless, {}), IsEmpty()) << "the machine was not asked";
  EXPECT_THAT(found("(isolint: ignore-file E153)\n" + useless), ElementsAre("W190@1", "W190@4"));
  // Where the machine did not come to the line, or not all could be verified, nothing is known of it.
  EXPECT_THAT(found("M06 T101001\nG00 X0 Y0 Z40\nGOTO N10\nX1 ;isolint: ignore E152\nN10 M02\n",
                    {"--verify", "--ignore", "W108"}),
              Not(Contains("W190@4")));
  EXPECT_THAT(found("M06 T101002\nG00 X0 Y0 Z40 ;isolint: ignore E152\nM02\n"), ElementsAre("W162@1"));
  // Without a setup nobody has looked for contacts, but for joints.
  EXPECT_THAT(found(useless, {"--verify", "--no-config"}), IsEmpty());
  EXPECT_THAT(found("M06 T101001\nG00 X1 ;isolint: ignore E160\nM02\n", {"--verify", "--no-config"}),
              ElementsAre("W190@2"));
}

TEST_F(Surroundings, MakeAPlainRunFail) {
  const CommandResult result = run({"isorun", "hit.iso"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("hit.iso:3: error: the cutter of T101001 hits clamp 1"));
  EXPECT_THAT(result.out, Not(HasSubstr("verified")));
}

TEST_F(Surroundings, AreNumbersInTheJsonOfIsorun) {
  const json all = json::parse(run({"isorun", "--json", "hit.iso"}).out).at("verification");
  EXPECT_EQ(all.at("motions"), 4);
  const json& contact = all.at("contacts").at(0);
  EXPECT_EQ(contact.at("code"), "E152");
  EXPECT_EQ(contact.at("line"), 3);
  EXPECT_EQ(contact.at("endLine"), 4);
  EXPECT_EQ(contact.at("tool"), "T101001");
  EXPECT_EQ(contact.at("body"), "the cutter of T101001");
  EXPECT_EQ(contact.at("obstacle"), "clamp 1");
  EXPECT_NEAR(contact.at("depth").get<double>(), 20, 0.01);
  EXPECT_EQ(contact.at("point").size(), 3u);
  EXPECT_LT(contact.at("time").get<double>(), contact.at("endTime").get<double>());
  EXPECT_EQ(all.at("certificate").at("hardEpsilon"), 0.01);
  EXPECT_THAT(all.at("certificate").at("notVerified"), IsEmpty());
  EXPECT_FALSE(json::parse(run({"isorun", "--no-config", "--json", "hit.iso"}).out).contains("verification"));
}

TEST_F(Surroundings, InAFileBesideTheProgramOutweigh) {
  folder_.write("hit.setup.json", R"({"fixtures": [{"name": "stop", "box": [[180, -5, 0], [190, 5, 15]]}]})");
  const CommandResult result = run({"isolint", "--verify", "hit.iso"});
  EXPECT_THAT(result.out, AllOf(HasSubstr("hits stop"), Not(HasSubstr("clamp 1")),
                                HasSubstr("= hit.setup.json:1:15: stop is described here")));
  EXPECT_THAT(run({"isolint", "--no-config", "--verify", "hit.iso"}).out, Not(HasSubstr("E152")));
}

TEST_F(Surroundings, ThatAreDescribedWronglyEndWithTwo) {
  folder_.write("hit.setup.json", R"({"target": {"mesh": "gone.stl"}})");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"isolint", "--verify", "hit.iso"}, {"isorun", "hit.iso"}}) {
    const CommandResult result = run(command);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("hit.setup.json:1:21: error: target.mesh: gone.stl"));
  }
  EXPECT_EQ(run({"isolint", "hit.iso"}).status, 0) << "nobody has asked the machine";
}

TEST_F(Surroundings, AreInThePage) {
  if (run({"isorun", "--plot", "hit.html", "hit.iso"}).err.find("npm") != std::string::npos)
    GTEST_SKIP() << "this isorun draws no page";
  const std::string page = text_of_file(folder_.path() + "/hit.html");
  const std::string mark = "<script id=\"data-facts\" type=\"application/json\">";
  const std::size_t begin = page.find(mark) + mark.size();
  const json facts = json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(facts.at("scene").at("bodies").at(0).at("name"), "clamp 1");
  EXPECT_EQ(facts.at("scene").at("bodies").at(0).at("role"), "fixture");
  EXPECT_EQ(facts.at("scene").at("tools").at("T101001").at("cutter"), json::parse("[[0, 10], [80, 10]]"));
  EXPECT_EQ(facts.at("contacts").at(0).at("line"), 3);
  EXPECT_THAT(facts.at("certificate").at("en").get<std::string>(), HasSubstr("verified: 4 motions, 1 contact"));
  EXPECT_THAT(facts.at("certificate").at("it").get<std::string>(), HasSubstr("verificato: 4 movimenti, 1 contatto"));
  EXPECT_THAT(facts.at("contacts").at(0).at("message").at("en").get<std::string>(), HasSubstr("hits clamp 1"));
  EXPECT_THAT(facts.at("contacts").at(0).at("message").at("it").get<std::string>(), HasSubstr("urta clamp 1"));
}

TEST_F(Surroundings, AreVerifiedAlikeByAnyNumberOfJobs) {
  std::string program = "M06 T101001\nG00 X0 Y0 Z10\nG01 X1 F3000\n";
  const int moves = support::kTriesAll ? 6000 : 60;
  for (int i = 0; i < moves; ++i) program += "X" + std::to_string(i * 37 % 200) + " Y" + std::to_string(i % 50) + "\n";
  folder_.write("long.iso", program + "M02\n");
  const auto with = [&](const std::string& jobs) {
    return run({"isolint", "--verify", "--select", "E152,W154", "--jobs", jobs, "--format", "json", "long.iso"}).out;
  };
  const std::string one = with("1");
  EXPECT_THAT(one, HasSubstr("E152"));
  EXPECT_EQ(one, with("3"));
}

}  // namespace
}  // namespace isocnc::commands
