#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/configuration/make_scene.h"
#include "interpreter/configuration/read.h"
#include "interpreter/configuration/show.h"
#include "interpreter/running/runner.h"
#include "interpreter/summary/summary.h"
#include "require.h"

namespace isocnc::fuzz {

/// Each kind of motion and of stop; short paths, since long ones take the planner time and show nothing more.
static constexpr const char* kProgram =
    "M06 T101001\nM100\nS12000 M03\nG00 X100 Y50 Z20\nG01 Z19 F3000 G09\nX101 Y51\nX102 Y50\nG02 X103 Y50 R0.5\n"
    "G03 X103 Y50 I102.8 J50\nG49\nG01 X103.5 Z18 B1 C2\nG93\nX104 B2 C4 F60\nG02 X105 Y51 R1 B3 F60\n"
    "G48\nG94\nG00 Z50 B0 C0\nM05\nM06 T102002\nM03 S9000\nG04 P0.5\nG29 B90 C90\nG01 X5 Y5 Z5 F99999\nG27\nM05\nM02\n";

/// Whatever machine a file describes, a program on it takes a time that is a number, and has its summary.
static void run_on(const configuration::MachineConfiguration& machine, bool is_summed_up) {
  summary::Summary summary(machine.timed);
  double last = 0;
  timing::Timing timing(machine.timed, {.event = [&](const timing::TimedEvent& timed) {
                          require(timed.start >= last - 1e-9 * last, "events come in the order of their times");
                          require(timed.duration >= 0 && std::isfinite(timed.start + timed.duration),
                                  "times are numbers");
                          last = timed.start;
                          if (is_summed_up) summary.add(timed);
                        }});
  running::RunOptions options;
  options.setup = machine.setup;
  options.stop_at_errors = false;
  const auto result = running::run(kProgram, options, [&](const running::Event& event) { timing.take(event); });
  timing.finish();
  require(std::isfinite(timing.time()), "a run ends");
  if (!is_summed_up) return;
  summary.finish(result, timing.time(), timing.joints(), {});
  require(!summary.json("-", dialect::Language::English).empty(), "a run has its summary");
}

static void require_mistakes_within(std::string_view text, const std::vector<configuration::Mistake>& mistakes) {
  for (const configuration::Mistake& mistake : mistakes) {
    require(mistake.at <= text.size(), "a mistake is within the file");
    require(!mistake.message(dialect::Language::English).empty(), "a mistake has its message");
  }
}

static void require_body(const verification::SceneBody& body) {
  const solids::BoundingBox box = verification::bounds(body.shape);
  require(box.min().allFinite() && box.max().allFinite(), "a body is somewhere");
  require((box.max() - box.min()).minCoeff() >= 0, "a body is not inside out");
}

/// All of a tool is between the tip and the spindle nose, and the holder ends there.
static void require_tool(const verification::ToolBodies& tool) {
  const double slack = 1e-9 * tool.length;
  for (const auto* const body : {&tool.cutter, &tool.shank, &tool.holder})
    require(!*body || ((*body)->bottom() >= -slack && (*body)->top() <= tool.length + slack), "a tool has its length");
  require(!tool.holder || std::abs(tool.holder->top() - tool.length) <= slack, "a holder ends at the nose");
  require(!tool.shank || !tool.holder || tool.shank->top() <= tool.holder->bottom() + slack,
          "a shank ends at the holder");
}

/// What a file without mistakes describes has bodies. All meshes are one triangle, and all stocks one box.
static void make_scene(const configuration::MachineConfiguration& machine,
                       const std::optional<configuration::LocatedSetup>& setup) {
  static const auto kMesh = std::make_shared<const solids::Mesh>(
      std::vector<solids::Triangle>{{{geometry::Vec3(0, 0, 0), geometry::Vec3(1, 0, 0), geometry::Vec3(0, 1, 0)}}});
  static const auto kStock =
      std::make_shared<const stock::Stock>(solids::Cuboid{geometry::Vec3(0, 0, 0), geometry::Vec3(3, 2, 1)}, 0.5);
  const auto require_below = [](const configuration::ShapeRequest& request) {
    require(!request.shape.name.starts_with('/') && !request.shape.name.starts_with(".."), "a shape is below its file");
  };
  const configuration::ShapeSource shapes{.mesh =
                                              [&](const configuration::ShapeRequest& request) {
                                                require_below(request);
                                                return kMesh;
                                              },
                                          .stock =
                                              [&](const configuration::ShapeRequest& request) {
                                                require_below(request);
                                                return kStock;
                                              }};
  const verification::Scene scene = configuration::make_scene(machine, setup, shapes);
  require(scene.machine.size() == machine.bodies.size(), "each body of the machine is there");
  for (const verification::SceneBody& body : scene.machine) require_body(body);
  for (const verification::SceneBody& body : scene.setup) require_body(body);
  for (const auto& [code, tool] : scene.tools) require_tool(tool);
  require(scene.nose.has_value() == machine.nose.has_value(), "the nose is there");
  if (!setup) return;
  const std::size_t parts = setup->setup.fixtures.size() + (setup->setup.stock ? 1 : 0) +
                            (setup->setup.spoilboard ? 1 : 0) + (setup->setup.target ? 1 : 0);
  require(scene.setup.size() == parts, "each body of the setup is there");
}

static void make_scenes(const configuration::Configuration& configuration) {
  make_scene(configuration.machine, std::nullopt);
  for (const configuration::DescribedSetup& setup : configuration.setups)
    make_scene(configuration.machine,
               configuration::LocatedSetup{.setup = setup, .file = configuration.file, .folder = configuration.folder});
}

/// The same text as the file beside a program.
static void read_as_setup(std::string_view text) {
  const configuration::ReadSetup read = configuration::read_setup(text);
  require_mistakes_within(text, read.mistakes);
  if (!read.mistakes.empty()) return;
  configuration::Configuration configuration;
  configuration.setups.push_back(read.setup);
  make_scenes(configuration);
}

/// What is read can be shown, and read again it is the same.
static void read_twice(std::string_view text) {
  const configuration::ReadConfiguration read = configuration::read_configuration(text, "/shop");
  require_mistakes_within(text, read.mistakes);
  if (!read.mistakes.empty()) return;
  const std::string shown = configuration::to_json(read.configuration);
  const configuration::ReadConfiguration again = configuration::read_configuration(shown, "/shop");
  require(again.mistakes.empty(), "what is shown is right");
  require(configuration::to_json(again.configuration) == shown, "what is shown says all of it");
  make_scenes(read.configuration);
  run_on(read.configuration.machine, text.size() % 16 == 0);  // How far axes go takes long to find out.
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = isocnc::fuzz::as_text(data, size);
  isocnc::fuzz::read_as_setup(text);
  isocnc::fuzz::read_twice(text);
  return 0;
}
