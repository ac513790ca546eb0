// Programs with a setup, and the same with mistakes of the kinds that are made: a retract dropped, a Z with the wrong
// sign, a tool that is shorter, another frame, a fixture moved by 10 mm. What dense sampling shows to be inside an
// obstacle must be found, and what has been found must be near in the sampling.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/simulation/timed_run.h"
#include "interpreter/verification/verified_run.h"
#include "tests/support/text_of_file.h"

namespace isocnc::verification {
namespace {

using geometry::Vec3;

/// A program in a setup, with a description of the mistake that was made.
struct Case {
  std::string what;
  std::string program;
  Scene scene;
  timing::TimedMachine machine;
};

class Sampled {
 public:
  static constexpr double kGrid = 3;  ///< Distance of poses and of points of the tool, mm.

  explicit Sampled(const Case& of) : case_(of) {
    running::RunOptions options;
    options.setup.home = of.machine.home;
    simulation::run_timed(
        of.program, options, of.machine,
        {.event = [&](const timing::TimedEvent& timed) { take(timed); },
         .stretch = [&](const motion::Stretch& stretch, const timing::TimedEvent&) { waiting_.push_back(stretch); }});
  }
  /// Names of the bodies that a point of the tool, the holder or the nose is in by more than `depth`.
  std::set<std::string> hit() const { return hit_; }
  /// Names of the bodies that a point has come nearer to than the grid.
  std::set<std::string> near() const { return near_; }

 private:
  void take(const timing::TimedEvent& timed) {
    const auto* const frame = std::get_if<running::FrameEvent>(&timed.event.what);
    if (frame && !has_origin_) {
      origin_ = frame->workpiece_origin;
      has_origin_ = true;
    }
    for (const motion::Stretch& stretch : waiting_) sample(stretch);
    waiting_.clear();
    if (const auto* const tool = std::get_if<running::ToolEvent>(&timed.event.what)) mount(tool->tool);
  }

  void mount(const execution::ToolCode& code) {
    rims_.clear();
    const ToolBodies& tool = case_.scene.tools.at(code);
    for (const auto* const body : {&tool.cutter, &tool.shank, &tool.holder})
      if (*body) add_rims(**body, 0);
    if (case_.scene.nose) add_rims(*case_.scene.nose, tool.length);
  }

  void add_rims(const solids::RevolvedBody& body, double offset) {
    for (const solids::BodyPiece& piece : body.pieces()) {
      const solids::Frustum& core = piece.core;
      const int steps = std::max(1, static_cast<int>((core.top - core.bottom) / kGrid));
      for (int i = 0; i <= steps; ++i) {
        const double part = static_cast<double>(i) / steps;
        const double radius = core.bottom_radius + part * (core.top_radius - core.bottom_radius);
        const double z = offset + core.bottom + part * (core.top - core.bottom);
        const bool is_end = i == 0 || i == steps;
        for (double r = radius; r > 0 && (r == radius || is_end); r -= kGrid) rims_.emplace_back(z, r);
      }
    }
  }

  std::pair<Vec3, Vec3> place(const motion::Stretch& stretch, double part) const {
    const motion::Sample at = stretch.at(case_.machine.motion.kinematics, stretch.start + part * stretch.duration);
    constexpr double kDegree = std::numbers::pi / 180;
    const double b = at.tip.b * kDegree;
    const double c = at.tip.c * kDegree;
    return {at.tip.tip, {std::sin(b) * std::cos(c), std::sin(b) * std::sin(c), std::cos(b)}};
  }

  void sample(const motion::Stretch& stretch) {
    double travel = 0;
    constexpr int kChords = 8;
    for (int i = 0; i < kChords; ++i) {
      const auto [from, from_axis] = place(stretch, static_cast<double>(i) / kChords);
      const auto [to, to_axis] = place(stretch, static_cast<double>(i + 1) / kChords);
      travel += (to - from).norm() + 250 * (to_axis - from_axis).norm();
    }
    const int steps = std::clamp(static_cast<int>(travel / kGrid), 1, 2000);
    for (int i = 0; i <= steps; ++i) {
      const auto [tip, axis] = place(stretch, static_cast<double>(i) / steps);
      for (const SceneBody& body : case_.scene.setup) look_at(body, tip - origin_, axis);
      for (const SceneBody& body : case_.scene.machine) look_at(body, tip, axis);
    }
  }

  void look_at(const SceneBody& body, const Vec3& tip, const Vec3& axis) {
    if (body.role == BodyRole::Stock || body.role == BodyRole::Target || hit_.contains(body.name)) return;
    const solids::BoundingBox box = bounds(body.shape);
    if (box.exteriorDistance(Vec3(tip + 130 * axis)) > 250) return;
    const Vec3 u = axis.unitOrthogonal();
    const Vec3 v = axis.cross(u);
    for (const auto& [z, radius] : rims_) {
      const Vec3 middle = tip + z * axis;
      if (box.exteriorDistance(middle) > radius + kGrid) continue;
      const int count = std::max(8, static_cast<int>(2 * std::numbers::pi * radius / kGrid));
      for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * k / count;
        const double inside = depth(body.shape, middle + radius * (std::cos(angle) * u + std::sin(angle) * v));
        if (inside > 0.02) hit_.insert(body.name);
        if (inside > -2 * kGrid) near_.insert(body.name);
      }
    }
  }

  /// How deep a point is inside a convex body; negative outside.
  static double depth(const BodyShape& shape, const Vec3& point) {
    if (const auto* const box = std::get_if<solids::Cuboid>(&shape))
      return std::min((point - box->minimum).minCoeff(), (box->maximum - point).minCoeff());
    if (const auto* const cylinder = std::get_if<solids::Cylinder>(&shape)) {
      const Vec3 from = point - cylinder->at.origin;
      const double along = from.dot(cylinder->at.axis);
      const double across = (from - along * cylinder->at.axis).norm();
      return std::min({along, cylinder->height - along, cylinder->radius - across});
    }
    double inside = std::numeric_limits<double>::infinity();
    for (const solids::Triangle& triangle : std::get<std::shared_ptr<const solids::Mesh>>(shape)->triangles())
      inside = std::min(inside, triangle.area_vector().normalized().dot(triangle.corners[0] - point));
    return inside;
  }

  const Case& case_;
  std::vector<std::pair<double, double>> rims_;  // Height and radius.
  std::vector<motion::Stretch> waiting_;
  Vec3 origin_ = Vec3::Zero();
  bool has_origin_ = false;
  std::set<std::string> hit_;
  std::set<std::string> near_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) { return fmt::format("{}\n", fmt::join(lines, "\n")); }

/// The case, and all of its mutants.
std::vector<Case> mutants_of(const Case& original) {
  std::vector<Case> all = {original};
  const std::vector<std::string> lines = lines_of(original.program);
  const auto add_program = [&](std::string what, const std::vector<std::string>& changed) {
    Case mutant = original;
    mutant.what = std::move(what);
    mutant.program = joined(changed);
    all.push_back(std::move(mutant));
  };
  static const std::regex kZ(R"(Z(-?)([0-9.]+))");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (line.starts_with(";") || line.starts_with("(")) continue;
    if (line.find("G00 Z") != std::string::npos) {
      std::vector<std::string> changed = lines;
      changed[i] = "G00";
      changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(i));
      add_program(fmt::format("line {} dropped: {}", i + 1, line), changed);
    }
    std::smatch match;
    if (line.find("G92") == std::string::npos && line.find("G29") == std::string::npos &&
        std::regex_search(line, match, kZ)) {
      std::vector<std::string> changed = lines;
      changed[i] = match.prefix().str() + (match.length(1) > 0 ? "Z" : "Z-") + match[2].str() + match.suffix().str();
      add_program(fmt::format("sign of Z on line {}: {}", i + 1, line), changed);
    }
    if (line.find("G92 X") == std::string::npos || line.find("Z0") != std::string::npos) continue;
    for (const Vec3& shift : {Vec3(10, 0, 0), Vec3(-10, 0, 0), Vec3(0, 10, 0), Vec3(0, 0, -30), Vec3(0, 0, 30)}) {
      Case mutant = original;  // The panel lies elsewhere than the program thinks.
      mutant.what = fmt::format("frame shifted by {} {} {}", shift.x(), shift.y(), shift.z());
      for (SceneBody& body : mutant.scene.setup)
        if (auto* const box = std::get_if<solids::Cuboid>(&body.shape)) {
          box->minimum += shift;
          box->maximum += shift;
        }
      all.push_back(std::move(mutant));
    }
  }
  for (std::size_t i = 0; i < original.scene.setup.size(); ++i)
    for (const Vec3& shift : {Vec3(10, 0, 0), Vec3(-10, 0, 0), Vec3(0, 10, 0), Vec3(0, -10, 0), Vec3(0, 0, 10)}) {
      Case mutant = original;
      SceneBody& body = mutant.scene.setup[i];
      mutant.what = fmt::format("{} moved by {} {} {}", body.name, shift.x(), shift.y(), shift.z());
      if (auto* const box = std::get_if<solids::Cuboid>(&body.shape)) {
        box->minimum += shift;
        box->maximum += shift;
      } else if (auto* const cylinder = std::get_if<solids::Cylinder>(&body.shape)) {
        cylinder->at.origin += shift;
      } else {
        continue;
      }
      all.push_back(std::move(mutant));
    }
  for (auto& [code, tool] : original.scene.tools) {
    Case mutant = original;
    mutant.what = fmt::format("tool of {} mm shorter by 60", tool.length);
    ToolBodies& shorter = mutant.scene.tools[code];
    shorter.length -= 60;
    shorter.holder.reset();
    mutant.machine.tool_lengths[code] = shorter.length;
    all.push_back(std::move(mutant));
  }
  return all;
}

class SeededFaults : public testing::TestWithParam<const char*> {};

TEST_P(SeededFaults, AreFoundAndNothingElse) {
  const std::filesystem::path file =
      std::filesystem::path(ISOCNC_SOURCE_DIR) / "examples/setups" / (std::string(GetParam()) + ".iso");
  configuration::Configurations configurations({}, dialect::Language::English);
  configuration::Scenes scenes(dialect::Language::English);
  const configuration::Configuration& configuration = configurations.of(file);
  const auto scene = scenes.of(configuration, file);
  ASSERT_NE(scene, nullptr);
  const Case original{.what = "original",
                      .program = text_of_file(file.string()),
                      .scene = *scene,
                      .machine = configuration.machine.timed};
  int found = 0;
  for (Case& each : mutants_of(original)) {
    running::RunOptions options;
    options.setup.home = each.machine.home;
    // The material and the finished part of the mutants are not asked about: this is about hard bodies.
    if (each.what != "original")
      std::erase_if(each.scene.setup, [](const SceneBody& body) { return body.role == BodyRole::Target; });
    const VerifiedRun run = verified_run(each.program, options, each.machine, &each.scene, {},
                                         {.is_cut = each.what == "original", .resolution = {}, .max_dexels = {}});
    std::set<std::string> told;
    for (const Contact& contact : run.contacts)
      if (!contact.is_near_miss() && !contact.is_of_material) told.emplace(contact.whom.in(dialect::Language::English));
    const Sampled sampled(each);
    for (const std::string& name : sampled.hit()) EXPECT_TRUE(told.contains(name)) << each.what << ": " << name;
    for (const std::string& name : told) EXPECT_TRUE(sampled.near().contains(name)) << each.what << ": " << name;
    if (each.what == "original") {
      EXPECT_TRUE(told.empty()) << *told.begin();
      EXPECT_TRUE(std::all_of(run.contacts.begin(), run.contacts.end(),
                              [](const Contact& contact) { return contact.is_near_miss() || contact.is_hint(); }));
    }
    found += sampled.hit().empty() ? 0 : 1;
  }
  EXPECT_GT(found, 1);
}

INSTANTIATE_TEST_SUITE_P(Examples, SeededFaults, testing::Values("panel", "tilted", "trim"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace isocnc::verification
