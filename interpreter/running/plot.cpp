#include "interpreter/running/plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "interpreter/running/xml.h"

namespace isocnc::running {

using dialect::Language;
using dialect::Text;
using execution::MoveKind;
using geometry::Vec3;

/// Of each view in the picture, pixels.
static constexpr double kViewSize = 640;
static constexpr double kMargin = 24;
static constexpr double kTitleHeight = 32;
static constexpr double kLegendRow = 20;
/// An arc is drawn as chords of so many degrees at most.
static constexpr double kChordDeg = 5;
/// More are not told apart.
static constexpr std::size_t kMostFrames = 100;

/// Told apart with every kind of color vision.
static constexpr std::string_view kColors[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                               "#E69F00", "#56B4E9", "#000"};

static constexpr Text kTop{"from above (X right, Y up)", "dall'alto (X a destra, Y in su)"};
static constexpr Text kIsometric{"isometric", "vista isometrica"};
static constexpr Text kKinds[] = {{"rapid", "rapido"}, {"feed move", "lavoro"}, {"arc", "arco"}};
static constexpr Text kNoTool{"no tool", "nessun utensile"};
static constexpr std::string_view kStyles[] = {"stroke-width=\"1\" stroke-dasharray=\"6 3\" stroke-opacity=\"0.7\"",
                                               "stroke-width=\"1\"", "stroke-width=\"2.2\""};

Plot::Plot() {
  views_.resize(2);
  views_[0].project = [](const Vec3& p) { return Point{p.x(), -p.y()}; };
  views_[1].project = [](const Vec3& p) {
    const double cos30 = std::numbers::sqrt3 / 2;
    return Point{(p.x() - p.y()) * cos30, -(p.x() + p.y()) / 2 - p.z()};
  };
}

void Plot::View::include(const Point& point) {
  if (is_empty) {
    least = most = point;
    is_empty = false;
    return;
  }
  least = {std::min(least.x, point.x), std::min(least.y, point.y)};
  most = {std::max(most.x, point.x), std::max(most.y, point.y)};
}

void Plot::View::draw(const std::pair<std::size_t, MoveKind>& key, const Vec3& from, const Vec3& to) {
  std::string& path = paths[key];
  const Point begin = project(from);
  const Point end = project(to);
  const bool goes_on = !path.empty() && last == key && pen.x == begin.x && pen.y == begin.y;
  if (!goes_on) fmt::format_to(std::back_inserter(path), "M{:.3f} {:.3f}", begin.x, begin.y);
  fmt::format_to(std::back_inserter(path), "L{:.3f} {:.3f}", end.x, end.y);
  include(begin);
  include(end);
  last = key;
  pen = end;
}

static std::string name_of(const execution::ToolCode& tool) {
  return fmt::format("T{}{:02}{:03}", tool.head, tool.holder, tool.tool);
}

void Plot::add(const Event& event) {
  if (const auto* const move = std::get_if<MoveEvent>(&event.what)) return add_move(*move);
  if (const auto* const frame = std::get_if<FrameEvent>(&event.what)) return add_frame(*frame);
  if (const auto* const tool = std::get_if<ToolEvent>(&event.what)) {
    const std::string name = name_of(tool->tool);
    const auto known = std::find(tools_.begin(), tools_.end(), name);
    tool_ = static_cast<std::size_t>(known - tools_.begin()) + 1;
    if (known == tools_.end()) tools_.push_back(name);
  }
}

void Plot::add_move(const MoveEvent& move) {
  const std::pair<std::size_t, MoveKind> key(tool_, move.kind);
  const auto draw = [&](const Vec3& from, const Vec3& to) {
    for (View& view : views_) view.draw(key, from, to);
  };
  if (move.kind != MoveKind::Arc) return draw(move.from.tip, move.to.tip);
  const double sweep = move.sweep_deg * std::numbers::pi / 180;
  const Vec3 out = move.from.tip - move.center;
  const Vec3 side = move.normal.cross(out);
  const Vec3 rise = move.to.tip - (move.center + std::cos(sweep) * out + std::sin(sweep) * side);
  const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(move.sweep_deg) / kChordDeg)));
  Vec3 last = move.from.tip;
  for (int i = 1; i <= chords; ++i) {
    const double part = static_cast<double>(i) / chords;
    const Vec3 next =
        i == chords ? move.to.tip
                    : Vec3(move.center + std::cos(part * sweep) * out + std::sin(part * sweep) * side + part * rise);
    draw(last, next);
    last = next;
  }
}

void Plot::add_frame(const FrameEvent& event) {
  geometry::Frame frame;
  frame.origin = event.workpiece_origin;
  if (event.face_mounted) frame = {event.workpiece_origin + event.face.origin, event.face.axes};
  if (frames_.size() < kMostFrames && std::find(frames_.begin(), frames_.end(), frame) == frames_.end())
    frames_.push_back(frame);
}

std::string Plot::drawn(const View& view, double scale, double left, double top) const {
  std::string svg = fmt::format("<g transform=\"translate({:.2f} {:.2f}) scale({:.6g}) translate({:.3f} {:.3f})\">\n",
                                left, top, scale, -view.least.x, -view.least.y);
  for (const auto& [key, path] : view.paths)
    fmt::format_to(
        std::back_inserter(svg),
        "<path fill=\"none\" vector-effect=\"non-scaling-stroke\" stroke-linejoin=\"round\" stroke=\"{}\" {} "
        "d=\"{}\"/>\n",
        kColors[key.first % std::size(kColors)], kStyles[static_cast<std::size_t>(key.second)], path);
  const double arm = 24 / scale;
  for (const geometry::Frame& frame : frames_)
    for (int axis = 0; axis < 3; ++axis) {
      static constexpr std::string_view kAxisColors[] = {"#c00", "#080", "#00c"};
      static constexpr std::string_view kAxisNames[] = {"X", "Y", "Z"};
      const Point from = view.project(frame.origin);
      const Point to = view.project(frame.origin + arm * frame.axes.col(axis));
      fmt::format_to(std::back_inserter(svg),
                     "<path class=\"frame\" fill=\"none\" vector-effect=\"non-scaling-stroke\" stroke-width=\"1.5\" "
                     "stroke=\"{}\" d=\"M{:.3f} {:.3f}L{:.3f} {:.3f}\"><title>{}</title></path>\n",
                     kAxisColors[axis], from.x, from.y, to.x, to.y, kAxisNames[axis]);
    }
  return svg + "</g>\n";
}

std::string Plot::svg(std::string_view title, Language language) const {
  const std::size_t rows = std::max<std::size_t>(tools_.size() + 1, std::size(kKinds));
  const double width = 2 * kViewSize + 3 * kMargin;
  const double height = kTitleHeight + kViewSize + 3 * kMargin + kLegendRow * static_cast<double>(rows);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"{3:.0f}\" y=\"22\" "
      "font-size=\"16\">{2}</text>\n",
      width, height, xml_escaped(title), kMargin);
  const Text* const names[] = {&kTop, &kIsometric};
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const View& view = views_[i];
    const double left = kMargin + static_cast<double>(i) * (kViewSize + kMargin);
    fmt::format_to(std::back_inserter(svg), "<text x=\"{:.0f}\" y=\"{:.0f}\" fill=\"#555\">{}</text>\n", left,
                   kTitleHeight + 16, xml_escaped(names[i]->in(language)));
    if (view.is_empty) continue;
    const double wide = std::max({view.most.x - view.least.x, view.most.y - view.least.y, 1e-6});
    svg += drawn(view, kViewSize / wide, left, kTitleHeight + kMargin);
  }
  const double legend = kTitleHeight + kViewSize + 2 * kMargin;
  for (std::size_t i = 0; i < std::size(kKinds); ++i)
    fmt::format_to(std::back_inserter(svg),
                   "<path stroke=\"#333\" {} d=\"M{:.0f} {:.0f}h40\"/><text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n",
                   kStyles[i], kMargin, legend + kLegendRow * static_cast<double>(i), kMargin + 50,
                   legend + kLegendRow * static_cast<double>(i) + 4, kKinds[i].in(language));
  for (std::size_t i = 0; i <= tools_.size(); ++i) {
    const double y = legend + kLegendRow * static_cast<double>(i);
    fmt::format_to(std::back_inserter(svg),
                   "<path stroke=\"{}\" stroke-width=\"6\" d=\"M{:.0f} {:.0f}h40\"/><text x=\"{:.0f}\" y=\"{:.0f}\">"
                   "{}</text>\n",
                   kColors[i % std::size(kColors)], kMargin + 200, y, kMargin + 250, y + 4,
                   i == 0 ? kNoTool.in(language) : std::string_view(tools_[i - 1]));
  }
  return svg + "</svg>\n";
}

}  // namespace isocnc::running
