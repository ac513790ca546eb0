// What remains of the blank: forward, backward and within blocks it is that of a run up to there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "debug_client.h"
#include "debugger/debuggee/surroundings.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/stock/stock_file.h"
#include "interpreter/verification/verified_run.h"
#include "tests/golden/golden_program.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::debugger {
namespace {

using debuggee::Debuggee;
using debuggee::MaterialHistory;
using simulation::Simulation;
using testing::ElementsAre;
using testing::HasSubstr;

/// A contact, as a verification and a debugger tell it.
struct ToldContact {
  std::size_t line = 0;
  std::string code;
  double time = 0;

  friend bool operator==(const ToldContact& a, const ToldContact& b) {
    return a.line == b.line && a.code == b.code && std::abs(a.time - b.time) < 1e-3;
  }
  friend void PrintTo(const ToldContact& contact, std::ostream* out) {
    *out << fmt::format("line {} at {} s: {}", contact.line + 1, contact.time, contact.code);
  }
};

std::vector<ToldContact> told(const std::vector<verification::Contact>& contacts) {
  std::vector<ToldContact> all;
  for (const verification::Contact& each : contacts) {
    const dialect::DiagnosticDef& row = dialect::definition(each.id);
    if (each.is_of_material && row.severity == dialect::Severity::Error && !each.is_near_miss())
      all.push_back({each.line, std::string(row.code), each.time});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::abs(a.time - b.time) < 1e-6 ? a.code < b.code : a.time < b.time;
  });
  return all;
}

/// A program in a scene, that is to be debugged.
struct Work {
  std::string text;
  running::RunOptions options;
  timing::TimedMachine machine;
  std::shared_ptr<const verification::Scene> scene;

  verification::VerifiedRun verified() const { return verification::verified_run(text, options, machine, scene.get()); }
};

/// A debuggee with what surrounds it.
class DebuggedWork {
 public:
  explicit DebuggedWork(const Work& work)
      : debuggee(debuggee::ProgramText(work.text), work.options, work.machine),
        surroundings(
            debuggee, [scene = work.scene] { return scene; },
            [&work] { return verification::first_workpiece_origin(work.text, work.options); }) {}

  MaterialHistory& material() const { return *surroundings.material(); }
  /// The stock at the present, as bytes, and what the block has removed.
  std::string bytes() const {
    return stock::write_stock(material().stock_at(debuggee.present())) +
           fmt::format(" {}", material().removed_at(debuggee.present()).volume);
  }
  std::vector<verification::Contact> contacts_of(Simulation& simulation) const {
    return surroundings.pass_block(simulation, {.contacts = true, .limits = {}}).contacts;
  }

  Debuggee debuggee;
  debuggee::Surroundings surroundings;
};

std::vector<ToldContact> contacts_forward(const Work& work) {
  const DebuggedWork debugged(work);
  Simulation simulation = debugged.debuggee.present();
  std::vector<verification::Contact> all;
  while (!simulation.has_ended())
    for (const auto& each : debugged.contacts_of(simulation)) all.push_back(each);
  return told(all);
}

/// A block at a time, the last one first.
std::vector<ToldContact> contacts_backward(const Work& work) {
  DebuggedWork debugged(work);
  while (!debugged.debuggee.present().has_ended()) debugged.debuggee.step_block();
  std::vector<verification::Contact> all;
  for (std::uint64_t block = debugged.debuggee.present().blocks() + 1; block-- > 0;)
    debugged.debuggee.find_simulated_back(block, block + 1, [&](Simulation& simulation) {
      for (const auto& each : debugged.contacts_of(simulation)) all.push_back(each);
      return false;
    });
  return told(all);
}

TEST(MaterialContacts, OfGoldenProgramsAreThoseOfAVerification) {
  std::map<std::string, int> counts;
  for (const std::filesystem::path& file : golden::golden_files()) {
    if (!file.filename().string().starts_with("E15") || file.parent_path().filename() != "runs") continue;
    for (const golden::Part& part : golden::read_golden(file)) {
      if (!part.scene) continue;
      Work work{.text = part.program,
                .options = {},
                .machine = part.machine,
                .scene = std::make_shared<const verification::Scene>(*part.scene)};
      work.options.setup = part.setup;
      work.options.vgpl = part.vgpl;
      work.machine.home = part.setup.home;
      const std::vector<ToldContact> expected = told(work.verified().contacts);
      for (const ToldContact& each : expected) ++counts[each.code];
      if (work.scene->setup.empty()) continue;
      EXPECT_EQ(contacts_forward(work), expected) << part.name;
      EXPECT_EQ(contacts_backward(work), expected) << part.name;
    }
  }
  for (const char* const code : {"E150", "E151", "E158"}) EXPECT_GE(counts[code], 1) << code;
}

/// A blank that is cut by a short edge, a thin shank and a wide holder.
constexpr const char* kBlankMachine = R"({
  "machine": {
    "home": {"z": 300},
    "holders": {"wide": [[40, 50, 50]]},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 10, "shape": "flat", "cutLength": 20,
               "shank": 20, "body": "wide"},
              {"head": 1, "holder": 1, "tool": 2, "length": 120, "radius": 4, "shape": "ball", "cutLength": 15,
               "shank": 12, "body": "wide"}],
    "nose": [[60, 90, 90]]},
  "setups": [{"paths": ["*.iso"], "clearance": 0, "resolution": 1,
              "stock": {"box": [[0, 0, 0], [200, 100, 40]]}}]})";

Work work_of(const std::string& text, const char* machine = kBlankMachine) {
  const support::TemporaryFolder folder;
  folder.write("isocnc.json", machine);
  const std::filesystem::path file = folder.write("program.iso", text);
  configuration::Configurations configurations({}, dialect::Language::English);
  const configuration::Configuration configuration = configurations.in_folder(file.parent_path());
  configuration::Scenes scenes(dialect::Language::English);
  Work work{
      .text = text, .options = {}, .machine = configuration.machine.timed, .scene = scenes.of(configuration, file)};
  work.options.setup = configuration.machine.setup;
  return work;
}

/// With another kind of kinematics.
std::string machine_of(const std::string& kind) {
  std::string machine = kBlankMachine;
  const std::string turns = kind == "head" ? R"("head", "pivot": 150)" : R"("table")";
  if (kind != "three-axis")
    machine.insert(machine.find("\"holders\""), R"("kinematics": {"type": )" + turns + "},\n    ");
  return machine;
}

/// Into the blank in feed and in rapid, as deep as the holder, with the spindle stopped, and through what is free.
std::string random_cuts(support::Random& random, int count, bool turns = false) {
  const auto x = [&] { return random.between(-200, 2200) / 10.0; };
  const auto y = [&] { return random.between(-200, 1200) / 10.0; };
  std::string text = "M06 T101001\nS12000 M03\nG00 X-30 Y-30 Z60\n";
  int radius = 0;
  for (int i = 0; i < count; ++i) {
    switch (random.between(turns ? -2 : 0, 9)) {
      case -2:
        text += fmt::format("G00 B{} C{}\n", random.between(-40, 40), random.between(-90, 90));
        break;
      case -1:
        text += fmt::format("G49\nG01 X{} B{} C{} F3000\nG48\n", x(), random.between(-40, 40), random.between(-90, 90));
        break;
      case 0:
        text += fmt::format("G00 X{} Y{}\n", x(), y());
        break;
      case 1:
        text += fmt::format("G00 Z{}\n", random.between(20, 60));
        break;
      case 2:
        radius = random.between(5, 30);
        text += fmt::format("G91 G03 X{} Y0 I{} J0 F6000\nG90\n", 2 * radius, radius);
        break;
      case 3:
        text += fmt::format("M05\nM06 T10100{}\n{}", random.between(1, 2), random.between(0, 3) ? "M03\n" : "");
        break;
      case 4:
        text += random.between(0, 1) ? "M05\n" : "M03\n";
        break;
      case 5:
        text += fmt::format("G01 Z{} F2000\n", random.between(-25, 45));
        break;
      case 6:
        text += "G04 P1\n";
        break;
      default:
        text += fmt::format("G01 X{} Y{} F5000\n", x(), y());
    }
  }
  return text + "G00 Z90\nM05\nM02\n";
}

class MaterialOfKinematics : public testing::TestWithParam<const char*> {
 protected:
  /// While B and C turn, cutting takes long.
  static bool turns() { return std::string(GetParam()) != "three-axis"; }
  static Work random_work(support::Random& random) {
    return work_of(random_cuts(random, 25, turns()), machine_of(GetParam()).c_str());
  }
};

INSTANTIATE_TEST_SUITE_P(All, MaterialOfKinematics, testing::Values("three-axis", "head", "table"));

TEST_P(MaterialOfKinematics, IsHitWhereAVerificationTellsIt) {
  std::map<std::string, int> counts;
  for (const std::uint64_t seed : support::seeds(turns() ? 2 : 20)) {
    support::Random random(seed);
    const Work work = random_work(random);
    const verification::VerifiedRun verified = work.verified();
    const std::vector<ToldContact> expected = told(verified.contacts);
    for (const ToldContact& each : expected) ++counts[each.code];
    EXPECT_EQ(contacts_forward(work), expected) << work.text;
    EXPECT_EQ(contacts_backward(work), expected) << work.text;
    if (testing::Test::HasFailure()) return;
  }
  if (support::kTriesAll) {
    for (const char* const code : {"E150", "E151", "E158"}) EXPECT_GE(counts[code], turns() ? 0 : 5) << code;
    EXPECT_GE(counts.size(), 2u);
  }
}

/// A run to the same moment, of which nothing has been asked before.
std::string fresh_bytes(const Work& work, const Simulation& moment) {
  DebuggedWork fresh(work);
  const std::uint64_t whole = moment.blocks() - (moment.is_in_block() ? 1 : 0);
  while (!fresh.debuggee.present().has_ended() && fresh.debuggee.present().blocks() < whole)
    fresh.debuggee.step_block();
  if (moment.is_in_block()) {
    fresh.debuggee.step_instruction();
    fresh.debuggee.advance_to_moment(moment.time());
  }
  if (moment.has_ended() && !fresh.debuggee.present().has_ended()) fresh.debuggee.step_block();
  return fresh.bytes();
}

void walk(support::Random& random, Debuggee& walker) {
  switch (random.between(0, 6)) {
    case 0:
    case 1:
      return walker.step_block();
    case 2:
      return walker.step_instruction();
    case 3:
      return walker.step_back();
    case 4:
      return walker.step_instruction_back();
    case 5:
      walker.step_instruction();
      return walker.advance_to_moment(walker.present().time() + random.between(1, 500) / 1000.0);
    default:
      return walker.go_to_block(static_cast<std::uint64_t>(random.between(0, 45)));
  }
}

TEST_P(MaterialOfKinematics, OfAWalkIsThatOfAFreshRun) {
  for (const std::uint64_t seed : support::seeds(turns() ? 1 : 6)) {
    support::Random random(seed);
    const Work work = random_work(random);
    DebuggedWork walker(work);
    for (int step = 0; step < 40; ++step) {
      walk(random, walker.debuggee);
      ASSERT_TRUE(walker.bytes() == fresh_bytes(work, walker.debuggee.present())) << "step " << step << "\n"
                                                                                  << work.text;
    }
    while (!walker.debuggee.present().has_ended()) walker.debuggee.step_block();
    const std::string end = stock::write_stock(walker.material().stock_at(walker.debuggee.present()));
    EXPECT_TRUE(end == stock::write_stock(work.verified().material->stock)) << work.text;
  }
}

/// However few copies are kept, they lead to the same, and take no more than they may.
TEST(Material, IsTheSameWithFewCopies) {
  std::string text = "M06 T101001\nS12000 M03\nG00 X-30 Y0 Z60\nG01 Z30 F3000\n";
  for (int i = 0; i < 200; ++i) text += fmt::format("X{} Y{}\n", i % 2 == 0 ? 230 : -30, i / 2);
  text += "G00 Z90\nM02\n";
  const Work work = work_of(text);
  DebuggedWork many(work);
  const MaterialHistory::CopyLimits limits{.bytes = 1 << 20, .spacing = 16, .nearby = 4};
  DebuggedWork few(work);
  const auto workpiece = verification::workpiece_of(*work.scene, geometry::Vec3::Zero(), {});
  MaterialHistory sparse(few.debuggee, *work.scene, *workpiece, limits);
  const MaterialHistory::CopyLimits no_limits{.spacing = 16, .nearby = 4};
  MaterialHistory dense(few.debuggee, *work.scene, *workpiece, no_limits);
  support::Random random(7);
  for (int step = 0; step < 30; ++step) {
    const auto block = static_cast<std::uint64_t>(step == 0 ? 204 : random.between(0, 204));
    many.debuggee.go_to_block(block);
    few.debuggee.go_to_block(block);
    const std::string expected = stock::write_stock(many.material().stock_at(many.debuggee.present()));
    ASSERT_TRUE(stock::write_stock(sparse.stock_at(few.debuggee.present())) == expected) << block;
    ASSERT_TRUE(stock::write_stock(dense.stock_at(few.debuggee.present())) == expected) << block;
    EXPECT_LE(sparse.memory(), limits.bytes + limits.bytes / 4);
  }
  EXPECT_GT(dense.memory(), 2 * limits.bytes);
}

/// What is run by hand cuts, too, also before the program; going back undoes it.
TEST(Material, IsCutByHand) {
  const Work work = work_of("M06 T101001\nS12000 M03\nG00 X50 Y50 Z60\nG01 X60 F3000\nG00 Z90\nM02\n");
  DebuggedWork debugged(work);
  Debuggee& debuggee = debugged.debuggee;
  for (int i = 0; i < 4; ++i) debuggee.step_block();
  const std::string before = debugged.bytes();
  ASSERT_FALSE(debuggee.run_by_hand("G01 Z30 F1000\nG00 Z60\n").error);
  debugged.surroundings.forget_from(debuggee.present().blocks());
  const double removed = debugged.material().removed_at(debuggee.present()).volume;
  EXPECT_NEAR(removed, std::numbers::pi * 100 * 10, 30);
  EXPECT_FALSE(debugged.material().is_in_cut(debuggee.present()));
  const std::string after = debugged.bytes();
  debuggee.step_block();
  debuggee.step_block();
  debuggee.go_to_block(4);
  EXPECT_TRUE(debugged.bytes() == after);
  debuggee.step_back();
  debugged.surroundings.forget_from(debuggee.present().blocks());
  EXPECT_TRUE(debugged.bytes() == before);

  DebuggedWork early(work);
  ASSERT_FALSE(early.debuggee.run_by_hand("M06 T101001\nS9000 M03\nG00 X50 Y50 Z60\nG01 Z30 F1000\nG00 Z60\n").error);
  early.surroundings.forget_from(0);
  EXPECT_NEAR(early.material().removed_at(early.debuggee.present()).volume, std::numbers::pi * 100 * 10, 30);
}

TEST(Material, IsNotCutBeforeSomebodyAsks) {
  const Work work = work_of("M06 T101001\nS12000 M03\nG00 X50 Y50 Z60\nG01 Z30 F3000\nX60\nG00 Z90\nM02\n");
  const DebuggedWork debugged(work);
  EXPECT_TRUE(debugged.surroundings.has_material());
  const debuggee::SurroundingsLimit clearance{.value = 5};
  Simulation simulation = debugged.debuggee.present();
  while (!simulation.has_ended()) {
    debugged.surroundings.pass_block(simulation, {.contacts = false, .limits = {clearance}});
    debugged.surroundings.depth_of(simulation);
  }
  EXPECT_FALSE(debugged.surroundings.is_material_cut());
  EXPECT_GT(debugged.material().stock_at(simulation).volume(), 0);
  EXPECT_TRUE(debugged.surroundings.is_material_cut());
}

/// Blocks that are shorter than the dexels are apart, so that not each of them meets one.
TEST(Material, IsInCutOverShortBlocks) {
  // Along the edge of the blank, over one row of dexels.
  std::string text = "M06 T101001\nS12000 M03\nG00 X50 Y-9.2 Z60\nG01 Z35 F3000\n";
  for (int i = 1; i <= 100; ++i) text += fmt::format("X{:.2f}\n", 50 + i * 0.15);
  for (int i = 1; i <= 100; ++i) text += fmt::format("X{:.2f}\n", 65 - i * 0.15);
  const Work work = work_of(text + "G00 Z90\nM02\n");
  DebuggedWork debugged(work);
  std::vector<std::uint64_t> without;  // Blocks that remove nothing, though the cutter goes on.
  for (std::uint64_t block = 0; block < 204; ++block) {
    debugged.debuggee.step_block();
    const Simulation& present = debugged.debuggee.present();
    const double removed = debugged.material().removed_at(present).volume;
    if (block >= 4 && block < 104 && removed == 0) without.push_back(block);
    const bool is_in_cut = debugged.material().is_in_cut(present);
    if (block >= 6 && block < 104) {
      EXPECT_TRUE(is_in_cut) << block;
    }
    if (block > 111) {
      EXPECT_FALSE(is_in_cut) << block;
    }
    DebuggedWork fresh(work);
    if (block % 17 != 0) continue;
    fresh.debuggee.go_to_block(present.blocks());
    EXPECT_EQ(fresh.material().is_in_cut(fresh.debuggee.present()), is_in_cut) << block;
  }
  EXPECT_FALSE(without.empty());
}

/// A slot 5 mm deep, with a way back through it and a rest in it.
constexpr const char* kSlot =
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X-30 Y50 Z60\n"
    "Z35\n"
    "G01 X100 F6000\n"  // 5: from X-10 on it cuts
    "G04 P1\n"
    "X150\n"  // 7
    "G00 X-30\n"
    "X200\n"  // 9: E150, from X150 on
    "Z60\n"
    "M02\n";

class MaterialInSession : public testing::Test {
 protected:
  void launch(const std::string& program = kSlot, const char* machine = kBlankMachine) {
    client.write("isocnc.json", machine);
    client.launch(program);
  }
  void watch(const std::vector<std::string>& limits) {
    Json breakpoints = Json::array();
    for (const std::string& limit : limits) breakpoints.push_back({{"dataId", limit}});
    for (const Json& each :
         Json(client.request("setDataBreakpoints", {{"breakpoints", breakpoints}}).at("breakpoints")))
      EXPECT_EQ(each.at("verified"), true) << each;
  }
  double number(const std::string& expression) { return std::stod(client.evaluate(expression + ",9")); }

  DebugClient client;
};

TEST_F(MaterialInSession, IsShownWithWhatTheBlockDoes) {
  launch();
  client.set_lines({5, 6, 8, 9});
  client.run("configurationDone");
  EXPECT_EQ(client.evaluate("REMOVED"), "0");
  EXPECT_EQ(client.variable("Material", "Left of the blank"), "100 %");
  client.run("continue");
  // 100 mm and half a disc before the center.
  EXPECT_NEAR(number("REMOVED"), 5 * (2 * 10 * 100 + std::numbers::pi * 50), 60);
  EXPECT_EQ(client.evaluate("INCUT"), "1");
  EXPECT_EQ(client.variable("Material", "INCUT"), "1");
  EXPECT_EQ(client.variable("Material", "Depth of cut"), "5");
  EXPECT_EQ(client.variable("Material", "REMOVED"), client.evaluate("REMOVED"));
  EXPECT_EQ(client.evaluate("DEPTH"), "0");  // The material is no obstacle.
  client.run("continue");
  EXPECT_NEAR(number("REMOVED"), 5 * 2 * 10 * 50, 60);
  const std::string removed = client.evaluate("REMOVED,9");
  client.run("continue");
  EXPECT_EQ(client.evaluate("REMOVED"), "0");
  EXPECT_EQ(client.evaluate("INCUT"), "0");
  client.run("stepBack");
  EXPECT_EQ(client.evaluate("REMOVED,9"), removed);
}

TEST_F(MaterialInSession, IsNotKnownWithoutABlank) {
  launch(kSlot, R"({"machine": {"home": {"z": 300}},
                    "setups": [{"paths": ["*.iso"], "fixtures": [{"name": "a", "box": [[0, 0, 0], [1, 1, 1]]}]}]})");
  client.set_lines({5});
  client.run("configurationDone");
  EXPECT_EQ(client.evaluate("REMOVED"), "-");
  EXPECT_EQ(client.evaluate("INCUT >= 0"), "0");
  EXPECT_THROW(client.variables("Material"), std::runtime_error);
}

TEST_F(MaterialInSession, CountsInConditionsAndMessages) {
  launch();
  client.set_breakpoints({{{"line", 6}, {"logMessage", "{REMOVED,0} mm3, {INCUT}"}},
                          {{"line", 8}, {"condition", "INCUT = 1 && REMOVED > 4900 && REMOVED < 5100"}},
                          {{"line", 9}, {"condition", "INCUT = 1"}}});
  client.run("configurationDone");
  EXPECT_EQ(client.line(), 8);
  Json output = client.event("output");
  while (output.at("category") != "console") output = client.event("output");
  EXPECT_THAT(output.at("output").get<std::string>(), testing::MatchesRegex("10[78][0-9][0-9] mm3, 1\n"));
}

TEST_F(MaterialInSession, IsAmongCompletions) {
  launch();
  std::vector<std::string> labels;
  for (const Json& each : Json(client.request("completions", {{"text", "RE"}, {"column", 3}}).at("targets")))
    labels.push_back(each.at("label"));
  EXPECT_THAT(labels, testing::Contains("REMOVED"));
}

struct WatchCase {
  std::string limit;
  std::string holds;                ///< What holds where the run stops.
  std::vector<std::string> places;  ///< Lines, and X to a millimeter.
};

class MaterialWatches : public testing::TestWithParam<WatchCase> {};

TEST_P(MaterialWatches, StopTheRunInsideTheBlockForwardAndBackward) {
  DebugClient client;
  client.write("isocnc.json", kBlankMachine);
  client.launch(kSlot);
  EXPECT_EQ(client.request("dataBreakpointInfo", {{"name", GetParam().limit}}).at("dataId"), GetParam().limit);
  client.request("setDataBreakpoints", {{"breakpoints", {{{"dataId", GetParam().limit}}}}});
  client.set_lines({11});
  const auto place = [&] {
    if (!GetParam().holds.empty()) {
      EXPECT_EQ(client.evaluate(GetParam().holds), "1");
    }
    return fmt::format("{} X{} at {}", client.line(), client.evaluate("X,0"), client.evaluate("TIME,9"));
  };
  std::vector<std::string> on;
  std::vector<std::string> places;
  for (Json stopped = client.run("configurationDone"); stopped.at("reason") == "data breakpoint";
       stopped = client.run("continue")) {
    on.push_back(place());
    places.push_back(on.back().substr(0, on.back().find(" at")));
  }
  EXPECT_EQ(places, GetParam().places);
  EXPECT_EQ(client.line(), 11);
  client.set_lines({});
  std::vector<std::string> back;
  while (client.run("reverseContinue").at("reason") == "data breakpoint") back.push_back(place());
  std::reverse(back.begin(), back.end());
  EXPECT_EQ(on, back);
}

INSTANTIATE_TEST_SUITE_P(All, MaterialWatches,
                         testing::Values(WatchCase{"REMOVED > 785", "REMOVED > 785", {"5 X0", "7 X108", "9 X158"}},
                                         WatchCase{"REMOVED >= 5000", "REMOVED >= 5000", {"5 X42"}},
                                         WatchCase{"REMOVED < 100", "REMOVED < 100", {"6 X100", "8 X150", "10 X200"}},
                                         WatchCase{
                                             "INCUT", "", {"5 X-10", "6 X100", "7 X100", "8 X150", "9 X150", "9 X197"}},
                                         WatchCase{"INCUT = 1", "INCUT = 1", {"5 X-10", "7 X100", "9 X150"}},
                                         WatchCase{"INCUT < 1", "INCUT < 1", {"6 X100", "8 X150", "9 X197"}}));

TEST_F(MaterialInSession, IsWatchedAtALimitAlone) {
  launch();
  for (const char* const wrong :
       {"REMOVED", "REMOVED = 5", "INCUT = 2", "INCUT + 1", "REMOVED > V3", "INCUT <> 1", "REMOVED > 5 && X > 1"})
    EXPECT_TRUE(client.request("dataBreakpointInfo", {{"name", wrong}}).at("dataId").is_null()) << wrong;
}

TEST_F(MaterialInSession, StopsWhereItIsHit) {
  launch();
  client.request(
      "setExceptionBreakpoints",
      {{"filters", Json::array()}, {"filterOptions", {{{"filterId", "contacts"}, {"condition", "DEPTH > 4"}}}}});
  const Json stopped = client.run("configurationDone");
  EXPECT_EQ(stopped.at("text"), "E150");
  EXPECT_THAT(stopped.at("description").get<std::string>(), HasSubstr("material"));
  EXPECT_EQ(client.line(), 9);
  EXPECT_NEAR(number("X"), 150, 1);
  const std::string time = client.evaluate("TIME,9");
  client.set_lines({11});
  EXPECT_EQ(client.run("continue").at("reason"), "breakpoint");
  EXPECT_EQ(client.run("reverseContinue").at("text"), "E150");
  EXPECT_EQ(client.evaluate("TIME,9"), time);
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "entry");
}

/// A change by hand is a change of what is cut.
TEST_F(MaterialInSession, IsThatOfTheRunAsItIsNow) {
  launch(
      "M06 T101001\nS12000 M03\nG00 X-30 Y50 Z60\nZ35\nIF V1 = 1 GOTO N10\nG01 X100 F6000\nM02\nN10 G01 X0 "
      "F6000\nM02\n");
  client.set_lines({5, 7, 9});
  client.run("configurationDone");
  client.run("continue");
  EXPECT_EQ(client.line(), 7);
  EXPECT_GT(number("REMOVED"), 10000);
  client.run("reverseContinue");
  EXPECT_EQ(client.line(), 5);
  client.request("setExpression", {{"expression", "V1"}, {"value", "1"}});
  client.run("continue");
  EXPECT_EQ(client.line(), 9);
  EXPECT_NEAR(number("REMOVED"), 5 * std::numbers::pi * 50, 30);
  client.run("reverseContinue");
  client.evaluate("G00 Z60", "repl");
  client.run("continue");
  EXPECT_EQ(client.evaluate("REMOVED"), "0");
}

}  // namespace
}  // namespace isocnc::debugger
