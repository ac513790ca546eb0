#include "interpreter/outline/outline_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/outline/covered_area.h"
#include "interpreter/plot/toolpath.h"
#include "interpreter/simulation/timed_run.h"
#include "interpreter/text/unicode.h"
#include "interpreter/verification/verifier.h"

namespace isocnc::outline {

using dialect::Text;
using geometry::Vec3;

/// Height above all feed moves, mm.
static constexpr double kAboveWork = 5;

static constexpr Text kTitle{"; around {}, at Z{}, spindle off: {}", "; intorno a {}, a Z{}, mandrino fermo: {}"};
static constexpr Text kNoRadius{"; not widened for {}: its radius is not known",
                                "; non allargato per {}: il suo raggio non si conosce"};
static constexpr Text kBelowWork{
    "; lower than the highest feed move, at Z{}: look whether the way around is free",
    "; piu' in basso del movimento di lavoro piu' alto, a Z{}: controllare che il giro sia libero"};
static constexpr Text kRectangle{"the rectangle", "il rettangolo"};
static constexpr Text kHull{"the convex outline", "il contorno convesso"};
static constexpr Text kPath{"the outline", "il contorno"};

std::optional<OutlineShape> outline_shape(std::string_view name) {
  if (name == "rectangle") return OutlineShape::Rectangle;
  if (name == "hull") return OutlineShape::Hull;
  if (name == "path") return OutlineShape::Path;
  return std::nullopt;
}

namespace {

/// What a program cuts, in the machine frame.
struct CutJob {
  CoveredArea area;
  double highest_feed = -std::numeric_limits<double>::infinity();  ///< Of the tip.
  double highest = -std::numeric_limits<double>::infinity();       ///< Of the tip, with a tool.
  std::optional<execution::ToolCode> tool;                         ///< The first that cuts.
  OutlinePoint start = OutlinePoint::Zero();                       ///< Where it begins to cut.
  std::vector<execution::ToolCode> without_radius;
  running::RunResult run;
};

CutJob survey(std::string_view text, const OutlineOptions& options) {
  CutJob job;
  const std::map<execution::ToolCode, double>& radii = options.machine.tool_radii;
  const auto add = [&](const plot::ToolpathStep& step, const std::optional<execution::ToolCode>& tool) {
    if (!tool) return;
    const bool is_feed = step.kind == plot::StepKind::Feed || step.kind == plot::StepKind::Arc;
    const auto radius = radii.find(*tool);
    const bool moves = is_feed || step.kind == plot::StepKind::Rapid;
    if (moves)
      for (const plot::ToolpathPoint& point : step.points) job.highest = std::max(job.highest, point.pose.tip.z());
    if (!is_feed) return;
    if (job.area.is_empty()) {
      job.tool = tool;
      job.start = step.points.front().pose.tip.head<2>();
    }
    if (radius == radii.end() &&
        std::find(job.without_radius.begin(), job.without_radius.end(), *tool) == job.without_radius.end())
      job.without_radius.push_back(*tool);
    for (std::size_t i = 0; i + 1 < step.points.size(); ++i) {
      const Vec3& from = step.points[i].pose.tip;
      const Vec3& to = step.points[i + 1].pose.tip;
      job.area.add(from.head<2>(), to.head<2>(), radius == radii.end() ? 0 : radius->second);
      job.highest_feed = std::max({job.highest_feed, from.z(), to.z()});
    }
  };
  const plot::Toolpath* tools = nullptr;
  plot::Toolpath path(options.machine, options.run.setup.home,
                      [&](const plot::ToolpathStep& step) { add(step, tools->tools()[step.tool]); });
  tools = &path;
  job.run = simulation::run_timed(
      text, options.run, options.machine,
      {.event = [&](const timing::TimedEvent& timed) { path.add(timed); },
       .stretch = [&](const motion::Stretch& stretch, const timing::TimedEvent&) { path.add(stretch); }});
  return job;
}

/// A rectangle, larger by less than 0.1 mm, with coordinates that one likes to read.
Contour rounded_out(Contour rectangle) {
  constexpr double kNoise = 1e-6;
  const OutlinePoint middle = (rectangle[0] + rectangle[2]) / 2;
  for (OutlinePoint& corner : rectangle)
    for (int axis = 0; axis < 2; ++axis) {
      const double tenths = corner[axis] * 10;
      corner[axis] = (corner[axis] < middle[axis] ? std::floor(tenths + kNoise) : std::ceil(tenths - kNoise)) / 10;
    }
  return rectangle;
}

std::vector<Contour> contours(const CoveredArea& area, OutlineShape shape) {
  switch (shape) {
    case OutlineShape::Rectangle:
      return {rounded_out(area.rectangle())};
    case OutlineShape::Hull:
      return {area.hull()};
    case OutlineShape::Path:
      return area.contours();
  }
  return {};
}

/// Leaves out corners that are written as the one before: a plunge of a tool without a radius has but one.
void merge_corners(Contour& contour) {
  constexpr double kWritten = 5e-4;  // mm
  const auto is_same = [](const OutlinePoint& a, const OutlinePoint& b) {
    return (a - b).cwiseAbs().maxCoeff() < kWritten;
  };
  contour.erase(std::unique(contour.begin(), contour.end(), is_same), contour.end());
  while (contour.size() > 1 && is_same(contour.front(), contour.back())) contour.pop_back();
}

/// Each contour begins at its corner next to where the way there comes from: first `start`, then the last contour.
void order(std::vector<Contour>& contours, OutlinePoint start) {
  for (auto next = contours.begin(); next != contours.end(); ++next) {
    auto nearest = next;
    std::size_t corner = 0;
    double least = std::numeric_limits<double>::infinity();
    for (auto each = next; each != contours.end(); ++each)
      for (std::size_t i = 0; i < each->size(); ++i)
        if (const double away = ((*each)[i] - start).squaredNorm(); away < least) {
          least = away;
          nearest = each;
          corner = i;
        }
    std::iter_swap(next, nearest);
    std::rotate(next->begin(), next->begin() + static_cast<std::ptrdiff_t>(corner), next->end());
    start = next->front();
  }
}

std::string shown(double value) { return fmt::format("{}", std::round(value * 1000) / 1000 + 0.0); }

std::string at(const OutlinePoint& point) { return "X" + shown(point.x()) + " Y" + shown(point.y()); }

const Text& name_of(OutlineShape shape) {
  return shape == OutlineShape::Rectangle ? kRectangle : shape == OutlineShape::Hull ? kHull : kPath;
}

}  // namespace

std::variant<std::string, OutlineRefusal> outline_program(std::string_view text, const OutlineOptions& options) {
  CutJob job = survey(text, options);
  if (job.run.ending != running::Ending::ProgramEnd || job.area.is_empty()) return OutlineRefusal{job.run};
  const Vec3 origin = verification::first_workpiece_origin(text, options.run);
  const geometry::Pose& home = options.run.setup.home;
  const double highest_work = job.highest_feed - origin.z();
  const double least = std::max(highest_work + kAboveWork, options.run.setup.clearance.value_or(-1e9));
  const double height = options.height.value_or(std::ceil(least * 10) / 10);
  const double reach = options.machine.highest_tip(*job.tool, home.b, home.c);
  const double top = std::max(std::floor((std::min(job.highest, reach) - origin.z()) * 1000) / 1000, height);

  std::string program;
  const auto add = [&](std::string_view line) { program.append(line).append("\n"); };
  add(dialect::format(kTitle, options.language, text::ascii(options.name), shown(height),
                      name_of(options.shape).in(options.language)));
  for (const execution::ToolCode& tool : job.without_radius)
    add(dialect::format(kNoRadius, options.language, running::tool_name(tool)));
  if (height < highest_work) add(dialect::format(kBelowWork, options.language, shown(highest_work)));
  add("G71 G90");
  if (origin != Vec3::Zero()) add("G92 " + at(origin.head<2>()) + " Z" + shown(origin.z()));
  add("M06 " + running::tool_name(*job.tool));
  add("G00 Z" + shown(top));
  if (home.b != 0 || home.c != 0) add("B0 C0");
  std::vector<Contour> all = contours(job.area, options.shape);
  std::for_each(all.begin(), all.end(), merge_corners);
  order(all, job.start);
  const auto in_frame = [&](const OutlinePoint& point) { return at(point - origin.head<2>()); };
  bool is_first = true;
  for (const Contour& contour : all) {
    add((is_first ? "" : "G00 ") + in_frame(contour.front()));
    if (height != top) add("Z" + shown(height));
    const std::size_t corners = contour.size();
    if (corners > 1) add("G01 " + in_frame(contour[1]) + " F" + shown(options.feed));
    for (std::size_t i = 2; corners > 1 && i <= corners; ++i) add(in_frame(contour[i % corners]));
    if (height != top) add("G00 Z" + shown(top));
    is_first = false;
  }
  add("M02");
  return program;
}

}  // namespace isocnc::outline
