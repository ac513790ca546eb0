#include "interpreter/configuration/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/read.h"
#include "interpreter/solids/stl.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::configuration {
namespace {

namespace fs = std::filesystem;
using dialect::Language;
using geometry::Vec3;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using verification::BodyRole;
using verification::Link;
using verification::Scene;
using verification::SceneBody;

/// A binary STL file of one tetrahedron, from the origin along each axis.
std::string tetrahedron(double size = 10) {
  const Vec3 o = Vec3::Zero();
  const Vec3 x(size, 0, 0);
  const Vec3 y(0, size, 0);
  const Vec3 z(0, 0, size);
  const std::vector<solids::Triangle> triangles = {{{o, y, x}}, {{o, x, z}}, {{o, z, y}}, {{x, y, z}}};
  return solids::write_stl(triangles);
}

/// A folder with programs, which need not exist, and what describes their surroundings.
class SceneFiles : public testing::Test {
 protected:
  void write(const std::string& name, std::string_view text) { folder_.write(name, text); }
  std::string path(const std::string& name) const { return folder_.path(name); }

  std::shared_ptr<const Scene> scene(const std::string& program) {
    const Configuration& configuration = configurations_.of(path(program));
    EXPECT_THAT(configurations_.mistakes(Language::English), IsEmpty());
    return scenes_.of(configuration, path(program));
  }

  /// The mistakes, a line each, with the folder as `./`.
  std::string mistakes(Language language = Language::English) const {
    std::string said;
    for (std::string line : scenes_.mistakes(language)) {
      for (std::size_t at = 0; (at = line.find(folder_.path() + "/")) != std::string::npos;)
        line.replace(at, folder_.path().size() + 1, "./");
      said += (said.empty() ? "" : "\n") + line;
    }
    return said;
  }

  support::TemporaryFolder folder_;
  Configurations configurations_{{}, Language::English};
  Scenes scenes_{Language::English};
};

std::string bounds_of(const SceneBody& body) {
  const solids::BoundingBox box = verification::bounds(body.shape);
  return fmt::format("{:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g}", box.min().x(), box.min().y(), box.min().z(),
                     box.max().x(), box.max().y(), box.max().z());
}

std::vector<std::string> names_in(const std::vector<SceneBody>& bodies) {
  std::vector<std::string> names;
  for (const SceneBody& body : bodies) names.push_back(body.name);
  return names;
}

TEST(SetupFile, StandsBesideTheProgram) {
  EXPECT_EQ(setup_file("parts/door.iso"), fs::path("parts/door.setup.json"));
  EXPECT_EQ(setup_file("door.v2.iso"), fs::path("door.v2.setup.json"));
  EXPECT_EQ(setup_file("/a/door"), fs::path("/a/door.setup.json"));
}

TEST_F(SceneFiles, GiveNoSceneWithoutASetup) {
  EXPECT_EQ(scene("a.iso"), nullptr);
  write("isocnc.json", R"({"machine": {"nose": [[100, 150, 150]],
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 90, "radius": 5, "shape": "flat"}]},
    "setups": [{"paths": ["b.iso"]}]})");
  Configurations read({}, Language::English);
  // Where other programs have one, that is told.
  EXPECT_FALSE(scenes_.of(read.of(path("a.iso")), path("a.iso"))->has_setup);
  EXPECT_FALSE(scenes_.of(read.of(path("a.iso")), "")->has_setup);
  EXPECT_TRUE(scenes_.of(read.of(path("b.iso")), path("b.iso"))->has_setup);
  EXPECT_EQ(mistakes(), "");
}

TEST_F(SceneFiles, DescribeTheWholeScene) {
  write("mesh/clamp.stl", tetrahedron());
  write("isocnc.json", R"({
  "machine": {
    "tools": [
      {"head": 1, "holder": 2, "tool": 3, "length": 120, "radius": 5, "shape": "flat", "body": "ER"},
      {"head": 1, "holder": 2, "tool": 4, "radius": 5}],
    "holders": {"ER": [[40, 30, 50]]},
    "nose": [[120, 150, 160]],
    "bodies": [{"name": "head", "on": "C", "box": [[-1, -2, -3], [1, 2, 3]], "at": [10, 0, 0]},
               {"name": "table", "mesh": "mesh/clamp.stl"}]
  },
  "setups": [{"paths": ["*.iso"], "frame": "machine", "clearance": 7,
    "stock": {"box": [[0, 0, -18], [800, 600, 0]]},
    "spoilboard": {"top": -18, "allow": 0.5},
    "fixtures": [
      {"name": "cup", "cylinder": {"at": [1, 2, 3], "axis": [0, 5, 0], "height": 10, "diameter": 4}, "at": [0, 0, 1]},
      {"name": "clamp", "mesh": "mesh/clamp.stl", "at": [400, 0, -5]}],
    "target": {"mesh": "mesh/clamp.stl", "tolerance": 0.2}}]
})");
  const auto found = scene("deep/a.iso");
  ASSERT_NE(found, nullptr) << mistakes();
  EXPECT_EQ(found->name, path("isocnc.json"));
  EXPECT_FALSE(found->is_in_workpiece_frame);
  EXPECT_EQ(found->clearance, 7);
  EXPECT_EQ(found->target_tolerance, 0.2);
  ASSERT_TRUE(found->nose);
  EXPECT_EQ(found->nose->bottom(), 0);
  EXPECT_EQ(found->nose->top(), 120);
  EXPECT_EQ(found->nose->maximum_radius(), 80);

  ASSERT_EQ(found->tools.size(), 1U) << "a tool without a length has no bodies";
  const verification::ToolBodies& tool = found->tools.at({1, 2, 3});
  EXPECT_EQ(tool.length, 120);
  EXPECT_EQ(tool.cutter->top(), 80);
  EXPECT_EQ(tool.holder->top(), 120);
  EXPECT_EQ(tool.described.file, path("isocnc.json"));
  EXPECT_EQ(tool.described.line, 3U);
  EXPECT_EQ(tool.described.column, 6U);

  ASSERT_THAT(names_in(found->machine), ElementsAre("head", "table"));
  EXPECT_EQ(found->machine[0].on, Link::C);
  EXPECT_EQ(found->machine[0].role, BodyRole::Machine);
  EXPECT_EQ(bounds_of(found->machine[0]), "9 -2 -3 to 11 2 3");
  EXPECT_EQ(found->machine[0].described.line, 7U);
  EXPECT_EQ(found->machine[0].described.column, 15U);
  EXPECT_EQ(found->machine[1].on, Link::Machine);
  EXPECT_EQ(bounds_of(found->machine[1]), "0 0 0 to 10 10 10");

  ASSERT_THAT(names_in(found->setup), ElementsAre("cup", "clamp", "", "", ""));
  EXPECT_EQ(found->setup[0].role, BodyRole::Fixture);
  EXPECT_EQ(bounds_of(found->setup[0]), "-1 2 2 to 3 12 6");
  EXPECT_EQ(bounds_of(found->setup[1]), "400 0 -5 to 410 10 5");
  EXPECT_EQ(found->setup[1].described.line, 15U);
  EXPECT_EQ(found->setup[2].role, BodyRole::Spoilboard);
  EXPECT_EQ(bounds_of(found->setup[2]), "-100000 -100000 -118.5 to 100000 100000 -18.5");
  EXPECT_EQ(found->setup[2].described.line, 12U);
  EXPECT_EQ(found->setup[3].role, BodyRole::Target);
  EXPECT_EQ(bounds_of(found->setup[3]), "0 0 0 to 10 10 10");
  EXPECT_EQ(found->setup[4].role, BodyRole::Stock);
  EXPECT_EQ(bounds_of(found->setup[4]), "0 0 -18 to 800 600 0");
  using MeshPointer = std::shared_ptr<const solids::Mesh>;
  EXPECT_EQ(std::get<MeshPointer>(found->setup[3].shape), std::get<MeshPointer>(found->machine[1].shape));
}

TEST_F(SceneFiles, HaveDefaults) {
  write("a.setup.json", R"({"spoilboard": {"top": 3, "area": [[-1, -2], [5, 6]]}, "target": {"mesh": "t.stl"}})");
  write("t.stl", tetrahedron());
  const auto found = scene("a.iso");
  ASSERT_NE(found, nullptr) << mistakes();
  EXPECT_TRUE(found->is_in_workpiece_frame);
  EXPECT_EQ(found->clearance, 2);
  EXPECT_EQ(found->target_tolerance, 0);
  EXPECT_FALSE(found->nose);
  EXPECT_EQ(bounds_of(found->setup[0]), "-1 -2 -97 to 5 6 3");
}

TEST_F(SceneFiles, GiveTheMachineItsSceneWithoutASetup) {
  write("isocnc.json", R"({"machine": {"bodies": [{"name": "t", "box": [[0, 0, 0], [1, 1, 1]]}]},
    "setups": [{"paths": ["x.iso"], "clearance": 9}]})");
  const auto found = scene("a.iso");
  ASSERT_NE(found, nullptr);
  EXPECT_THAT(found->setup, IsEmpty());
  EXPECT_THAT(names_in(found->machine), ElementsAre("t"));
  EXPECT_EQ(found->clearance, 2);
  EXPECT_EQ(found->name, path("isocnc.json"));
  EXPECT_NE(scenes_.of(configurations_.of(path("a.iso")), ""), nullptr) << "a program without a file";
}

TEST_F(SceneFiles, CountTheLastEntryThatNamesTheProgram) {
  write("isocnc.json", R"({"setups": [
    {"paths": ["*.iso"], "clearance": 1}, {"paths": ["a.*", "sub/"], "clearance": 3}, {"paths": ["b*"], "clearance": 4},
    {"paths": ["/b2.iso"], "clearance": 5}]})");
  EXPECT_EQ(scene("c.iso")->clearance, 1);
  EXPECT_EQ(scene("a.iso")->clearance, 3);
  EXPECT_EQ(scene("sub/c.iso")->clearance, 3);
  EXPECT_EQ(scene("b1.iso")->clearance, 4);
  EXPECT_EQ(scene("b2.iso")->clearance, 5);
  EXPECT_EQ(scene("sub/b2.iso")->clearance, 4);
  EXPECT_FALSE(scene("c.nc")->has_setup);
  EXPECT_EQ(scene("C.ISO")->clearance, 1);
  EXPECT_EQ(scene("d.iso"), scene("c.iso")) << "programs share the scene of an entry";
}

TEST_F(SceneFiles, PreferTheFileBesideTheProgram) {
  write("isocnc.json", R"({"machine": {"nose": [[1, 2, 3]]}, "setups": [{"paths": ["*"], "clearance": 1,
    "fixtures": [{"name": "cup", "box": [[0, 0, 0], [1, 1, 1]]}]}]})");
  write("sub/door.setup.json",
        "// A CAM system wrote this.\n{\"$schema\": \"x\", \"clearance\": 9,\n"
        "  \"fixtures\": [{\"name\": \"pin\", \"box\": [[0, 0, 0], [1, 1, 1]]}]}");
  const auto found = scene("sub/door.iso");
  ASSERT_NE(found, nullptr) << mistakes();
  EXPECT_EQ(found->clearance, 9);
  EXPECT_EQ(found->name, path("sub/door.setup.json"));
  EXPECT_TRUE(found->nose) << "the machine is that of the configuration";
  ASSERT_THAT(names_in(found->setup), ElementsAre("pin"));
  EXPECT_EQ(found->setup[0].described.file, path("sub/door.setup.json"));
  EXPECT_EQ(found->setup[0].described.line, 2U);
  EXPECT_EQ(found->setup[0].described.column, 15U);
  EXPECT_EQ(scene("sub/door.iso"), found);
  EXPECT_EQ(scene("sub/other.iso")->clearance, 1);
}

TEST_F(SceneFiles, FindMeshesFromTheFileThatNamesThem) {
  write("isocnc.json", R"({"machine": {"bodies": [{"name": "m", "mesh": "a.stl"}]}})");
  write("a.stl", tetrahedron());
  write("sub/a.stl", tetrahedron(5));
  write("sub/p.setup.json", R"({"target": {"mesh": "a.stl"}, "fixtures": [{"name": "x", "mesh": "./a.stl"}]})");
  const auto found = scene("sub/p.iso");
  ASSERT_NE(found, nullptr) << mistakes();
  EXPECT_EQ(bounds_of(found->machine[0]), "0 0 0 to 10 10 10");
  EXPECT_EQ(bounds_of(found->setup[0]), "0 0 0 to 5 5 5");
  EXPECT_EQ(bounds_of(found->setup[1]), "0 0 0 to 5 5 5");
}

/// As a CAD system writes a mirrored part: each triangle the other way round.
TEST_F(SceneFiles, TurnMeshesRightSideOut) {
  const std::string outwards = tetrahedron();
  std::string inwards = outwards;
  for (std::size_t triangle = 0; triangle < 4; ++triangle) {
    const std::size_t second = 84 + 50 * triangle + 24;  // After the header, the normal and the first corner.
    std::swap_ranges(inwards.begin() + static_cast<std::ptrdiff_t>(second),
                     inwards.begin() + static_cast<std::ptrdiff_t>(second + 12),
                     inwards.begin() + static_cast<std::ptrdiff_t>(second + 12));
  }
  write("in.stl", inwards);
  write("isocnc.json", R"({"machine": {"bodies": [{"name": "m", "mesh": "in.stl"}]}})");
  const auto found = scene("p.iso");
  ASSERT_NE(found, nullptr) << mistakes();
  const auto& mesh = std::get<std::shared_ptr<const solids::Mesh>>(found->machine[0].shape);
  EXPECT_TRUE(mesh->topology().faces_outwards());
  EXPECT_NEAR(mesh->topology().volume, 1000. / 6, 1e-6);
}

TEST_F(SceneFiles, ReadEachMeshOnce) {
  write("a.stl", tetrahedron());
  write("isocnc.json", R"({"setups": [{"paths": ["*"], "fixtures": [
    {"name": "1", "mesh": "a.stl"}, {"name": "2", "mesh": "a.stl"}, {"name": "3", "mesh": "a.stl", "at": [1, 0, 0]},
    {"name": "4", "mesh": "a.stl", "at": [1, 0, 0]}, {"name": "5", "mesh": "a.stl", "at": [0, 0, 0]}]}]})");
  const auto found = scene("a.iso");
  ASSERT_NE(found, nullptr);
  const auto mesh = [&](std::size_t i) {
    return std::get<std::shared_ptr<const solids::Mesh>>(found->setup[i].shape).get();
  };
  EXPECT_EQ(mesh(0), mesh(1));
  EXPECT_EQ(mesh(0), mesh(4));
  EXPECT_EQ(mesh(2), mesh(3));
  EXPECT_NE(mesh(0), mesh(2));
  fs::remove(path("a.stl"));
  write("b.setup.json", R"({"fixtures": [{"name": "1", "mesh": "a.stl"}]})");
  EXPECT_NE(scene("b.iso"), nullptr);
}

TEST_F(SceneFiles, ReportAMissingMeshOnceWithItsPlace) {
  write("isocnc.json", "{\"machine\": {\"bodies\": [\n  {\"name\": \"\xC3\xA8\", \"mesh\": \"gone.stl\"}]}}");
  write("b.setup.json", R"({"clearance": 3})");
  EXPECT_EQ(scene("a.iso"), nullptr);
  EXPECT_EQ(scene("b.iso"), nullptr);
  EXPECT_EQ(scene("a.iso"), nullptr);
  EXPECT_EQ(mistakes(),
            "./isocnc.json:2:25: error: machine.bodies[0].mesh: gone.stl: cannot read: No such file or directory");
}

TEST_F(SceneFiles, RefuseFilesThatAreNoMesh) {
  const auto said_of = [&](std::string_view bytes) {
    static int count = 0;
    const std::string name = fmt::format("p{}", count++);
    write("m.stl", bytes);
    write(name + ".setup.json", R"({"target": {"mesh": "m.stl"}})");
    Scenes scenes(Language::English);
    Scenes italian(Language::Italian);
    EXPECT_EQ(scenes.of(Configuration(), path(name + ".iso")), nullptr);
    EXPECT_EQ(italian.of(Configuration(), path(name + ".iso")), nullptr);
    EXPECT_EQ(italian.mistakes(Language::Italian).size(), 1U);
    const std::string said = fmt::format("{}", fmt::join(scenes.mistakes(Language::English), "\n"));
    EXPECT_NE(italian.mistakes(Language::Italian).front().find("errore: target.mesh: m.stl"), std::string::npos);
    const std::string begin = ":1:21: error: target.mesh: ";
    EXPECT_THAT(said, HasSubstr(begin));
    return said.substr(said.find(begin) + begin.size());
  };
  const std::string good = tetrahedron();
  const auto with_count = [&](char count) {
    std::string bytes = good;
    bytes[80] = count;
    return bytes;
  };
  EXPECT_EQ(said_of(""), "m.stl is no STL file with a triangle");
  EXPECT_EQ(said_of(good.substr(0, good.size() - 1)), "m.stl ends before the 4 triangles that it states");
  EXPECT_EQ(said_of(with_count(3)), "m.stl goes on after the 3 triangles that it states");
  EXPECT_EQ(said_of(with_count(127)), "m.stl ends before the 127 triangles that it states");
  EXPECT_EQ(said_of(std::string(84, '\0')), "m.stl is no STL file with a triangle");
  EXPECT_EQ(said_of("solid a\nendsolid a\n"), "m.stl is no STL file with a triangle");
  EXPECT_EQ(said_of("solid a\nfacet\nabnormal"), "m.stl, line 3: not the word that STL has here");
  EXPECT_EQ(said_of("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x"),
            "m.stl, line 4: no number where STL has a coordinate");
  EXPECT_EQ(said_of("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2"),
            "m.stl ends within the triangle after 0 complete ones");
  std::string infinite = good;
  infinite.replace(84 + 50 + 12, 4, "\0\0\x80\x7F", 4);
  EXPECT_EQ(said_of(infinite), "m.stl, triangle 2: a coordinate that is not finite");
  std::string far = good;
  far.replace(84 + 12, 4, "\0\0\0\x50", 4);
  EXPECT_EQ(said_of(far), "m.stl, triangle 1: a coordinate that is farther away than a kilometer");
  std::string open = with_count(3);
  open.resize(open.size() - 50);
  EXPECT_EQ(said_of(open), "m.stl is open, so that it encloses nothing: 3 edges without a second triangle");
  const solids::Triangle front = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}};
  const solids::Triangle back = {{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0)}};
  EXPECT_EQ(said_of(solids::write_stl(std::vector{front, back})),
            "m.stl encloses nothing: its triangles have no volume between them");
}

TEST_F(SceneFiles, RefuseAShiftThatLeadsTooFar) {
  write("m.stl", tetrahedron(-950'000));
  write("p.setup.json", R"({"target": {"mesh": "m.stl", "at": [-60000, 0, 0]}})");
  EXPECT_EQ(scene("p.iso"), nullptr);
  EXPECT_EQ(mistakes(),
            "./p.setup.json:1:21: error: target.mesh: m.stl: its shift takes it farther away than a kilometer");
}

TEST_F(SceneFiles, NeverLeaveTheirFolder) {
  write("outside.stl", tetrahedron());
  write("other/outside.json", "{}");
  fs::create_directories(path("shop/sub"));
  fs::create_symlink(path("outside.stl"), path("shop/link.stl"));
  fs::create_directory_symlink(path(""), path("shop/up"));
  write("shop/real.stl", tetrahedron());
  fs::create_symlink("../real.stl", path("shop/sub/inside.stl"));
  const auto said_of = [&](const std::string& mesh) {
    static int count = 0;
    const std::string name = fmt::format("shop/p{}", count++);
    write(name + ".setup.json", fmt::format(R"({{"target": {{"mesh": "{}"}}}})", mesh));
    Scenes scenes(Language::English);
    const auto found = scenes.of(Configuration(), path(name + ".iso"));
    EXPECT_EQ(found == nullptr, !scenes.mistakes(Language::English).empty());
    return fmt::format("{}", fmt::join(scenes.mistakes(Language::English), "\n"));
  };
  for (const std::string mesh :
       {"../outside.stl", "sub/../../outside.stl", "/etc/passwd", "link.stl", "up/outside.stl"})
    EXPECT_THAT(said_of(mesh), HasSubstr(mesh + ": the file must be in the folder of this file, or below"));
  EXPECT_EQ(said_of("sub/inside.stl"), "");
  EXPECT_EQ(said_of("real.stl"), "");

  fs::create_symlink(path("other/outside.json"), path("shop/linked.setup.json"));
  EXPECT_EQ(scene("shop/linked.iso"), nullptr);
  EXPECT_EQ(
      mistakes(),
      "./shop/linked.setup.json: error: linked.setup.json: the file must be in the folder of this file, or below");
}

TEST_F(SceneFiles, NeverWaitForAPipe) {
  ASSERT_EQ(::mkfifo(path("pipe.stl").c_str(), 0600), 0);
  fs::create_directory(path("folder.stl"));
  write("p.setup.json", R"({"target": {"mesh": "pipe.stl"}, "stock": {"mesh": "folder.stl"}})");
  ASSERT_EQ(::mkfifo(path("q.setup.json").c_str(), 0600), 0);
  fs::create_symlink("gone", path("r.setup.json"));
  EXPECT_EQ(scene("p.iso"), nullptr);
  EXPECT_EQ(scene("q.iso"), nullptr);
  EXPECT_EQ(scene("r.iso"), nullptr);
  EXPECT_EQ(mistakes(),
            "./p.setup.json:1:21: error: target.mesh: pipe.stl is not a file\n"
            "./p.setup.json:1:52: error: stock.mesh: folder.stl is not a file\n"
            "./q.setup.json: error: not a file\n"
            "./r.setup.json: error: cannot read: No such file or directory");
}

TEST_F(SceneFiles, RefuseAMeshThatWouldFillTheMemory) {
  write("huge.stl", "");
  fs::resize_file(path("huge.stl"), kLargestMesh + 1);  // Takes no room on the disk.
  write("p.setup.json", R"({"target": {"mesh": "huge.stl"}})");
  EXPECT_EQ(scene("p.iso"), nullptr);
  EXPECT_THAT(mistakes(), HasSubstr("huge.stl is larger than any mesh: at most 512 MiB"));
}

TEST_F(SceneFiles, ReportMistakesInTheFileBesideTheProgram) {
  write("a.setup.json", "{\"paths\": [\"a\"],\n\"clearanc\": 3,\n  \"fixtures\": [{\"name\": 3}]}");
  write("b.setup.json", "[]");
  write("c.setup.json", "{\"clearance\": }");
  write("d.setup.json", "\xEF\xBB\xBF{}");
  write("e.setup.json", std::string(kLongestFile + 1, ' '));
  write("f.setup.json", "{\"spoilboard\": {\"top\": 0, \"allow\": \"\xFF\"}}");
  write("g.setup.json", R"({"stock": {"box": [[0, 0, 0], [200, 0, 20]]}})");
  for (const char* const program : {"a.iso", "b.iso", "c.iso", "d.iso", "e.iso", "f.iso", "g.iso", "a.iso"})
    EXPECT_EQ(scene(program), nullptr) << program;
  EXPECT_EQ(mistakes(),
            "./a.setup.json:1:2: error: paths: unknown key\n"
            "./a.setup.json:2:1: error: clearanc: unknown key; did you mean clearance?\n"
            "./a.setup.json:3:25: error: fixtures[0].name: this is a number, and text is needed\n"
            "./b.setup.json:1:1: error: this is a list [ ], and an object { } is needed\n"
            "./c.setup.json:1:15: error: } is out of place here\n"
            "./d.setup.json:1:1: error: a byte-order mark stands here; save the file as UTF-8 without it\n"
            "./e.setup.json: error: larger than any configuration\n"
            "./f.setup.json:1:37: error: this is not UTF-8; save the file as UTF-8\n"
            "./g.setup.json:1:19: error: stock.box: a blank has a volume: its two corners differ in X, Y and Z");
  EXPECT_THAT(mistakes(Language::Italian), HasSubstr("./a.setup.json:2:1: errore: clearanc: chiave sconosciuta"));
}

TEST_F(SceneFiles, FollowTheMachineOfAnotherFile) {
  write("machines/m.json", R"({"machine": {"bodies": [{"name": "m", "mesh": "m.stl"}]}})");
  write("machines/m.stl", tetrahedron());
  write("p/isocnc.json", R"({"setups": [{"paths": ["*"]}]})");
  Configurations given({.file = path("machines/m.json")}, Language::English);
  Configuration configuration = configurations_.of(path("p/a.iso"));
  configuration.machine = given.of(path("p/a.iso")).machine;
  const auto found = scenes_.of(configuration, path("p/a.iso"));
  ASSERT_NE(found, nullptr) << mistakes();
  EXPECT_EQ(found->machine[0].described.file, path("machines/m.json"));
  EXPECT_EQ(found->name, path("p/isocnc.json"));
}

TEST_F(SceneFiles, ServeSeveralThreads) {
  write("a.stl", tetrahedron());
  write("isocnc.json", R"({"setups": [{"paths": ["*"], "target": {"mesh": "a.stl"}}]})");
  write("p1.setup.json", R"({"target": {"mesh": "a.stl"}})");
  write("p2.setup.json", R"({"target": {"mesh": "gone.stl"}})");
  const Configuration& configuration = configurations_.of(path("p0.iso"));
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int j = 0; j < 30; ++j) {
        const auto found = scenes_.of(configuration, path(fmt::format("p{}.iso", j % 3)));
        EXPECT_EQ(found == nullptr, j % 3 == 2);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(scenes_.mistakes(Language::English).size(), 1U);
}

}  // namespace
}  // namespace isocnc::configuration
