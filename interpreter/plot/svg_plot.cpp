#include "interpreter/plot/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "interpreter/text/xml.h"

namespace isocnc::plot {

using dialect::Text;
using geometry::Vec3;

/// Sizes of the picture in pixels; in each view the drawing leaves a margin for letters.
static constexpr double kViewSize = 640;
static constexpr double kDrawnSize = 580;
static constexpr double kMargin = 24;
static constexpr double kTitleHeight = 56;
static constexpr double kLegendRow = 20;
static constexpr double kLegendTop = kTitleHeight + kViewSize + kMargin + kLegendRow;
/// Length of a frame's axes, pixels.
static constexpr double kArm = 26;
/// Minimum extent that fills the view, mm; smaller drawings are not enlarged further.
static constexpr double kMinExtent = 20;
/// Maximum length in the view at which a move is drawn as a point, mm.
static constexpr double kPoint = 1e-3;

/// Colors that are distinct with every kind of color vision.
static constexpr std::string_view kColors[] = {"#6b7280", "#0072B2", "#D55E00", "#009E73",
                                               "#CC79A7", "#B8860B", "#56B4E9", "#000"};
static constexpr std::string_view kAxisColors[] = {"#c2410c", "#15803d", "#1d4ed8"};

static constexpr Text kViews[] = {{"from above (X right, Y up)", "dall'alto (X a destra, Y in su)"},
                                  {"isometric", "vista isometrica"}};
static constexpr Text kKinds[] = {{"rapid", "rapido"}, {"feed move", "lavoro"}, {"arc", "arco"}};
static constexpr Text kDot{"feed move along the view", "lavoro lungo la vista"};
static constexpr Text kFrame{"frame (X, Y, Z)", "sistema di riferimento (X, Y, Z)"};
static constexpr Text kToolless{"no tool", "nessun utensile"};
static constexpr Text kNoMotion{"The program moves nothing.", "Il programma non muove nulla."};
static constexpr std::string_view kStyles[] = {R"(stroke-width="1" stroke-dasharray="6 3" stroke-opacity="0.7")",
                                               R"(stroke-width="1.2")", R"(stroke-width="2.4")"};
static constexpr std::string_view kDotStyle = R"(stroke-width="6" stroke-linecap="round" stroke-opacity="0.8")";

static std::string_view color_of(std::size_t tool) {
  return tool == 0 ? kColors[0] : kColors[1 + (tool - 1) % (std::size(kColors) - 1)];
}

SvgPlot::SvgPlot(const PlotSubject& subject) : subject_(subject) {
  views_[0].project = [](const Vec3& p) { return Point{p.x(), -p.y()}; };
  views_[1].project = [](const Vec3& p) {
    const double cos30 = std::numbers::sqrt3 / 2;
    return Point{(p.x() - p.y()) * cos30, -(p.x() + p.y()) / 2 - p.z()};
  };
}

void SvgPlot::View::include(const Point& point) {
  if (std::exchange(is_empty, false)) minimum = maximum = point;
  minimum = {std::min(minimum.x, point.x), std::min(minimum.y, point.y)};
  maximum = {std::max(maximum.x, point.x), std::max(maximum.y, point.y)};
}

double SvgPlot::View::scale() const {
  return kDrawnSize / std::max({maximum.x - minimum.x, maximum.y - minimum.y, kMinExtent});
}

void SvgPlot::View::draw(const PathStyle& style, const Vec3& from, const Vec3& to) {
  const Point begin = project(from);
  const Point end = project(to);
  include(begin);
  include(end);
  const bool is_point = std::hypot(end.x - begin.x, end.y - begin.y) < kPoint;
  if (is_point && style.first != StepKind::Rapid && (to - from).norm() >= kPoint) {
    fmt::format_to(std::back_inserter(dots[style.second]), "M{:.3f} {:.3f}h0", end.x, end.y);
    return;
  }
  std::string& path = paths[style];
  const bool continues = !path.empty() && last == style && pen.x == begin.x && pen.y == begin.y;
  if (!continues) fmt::format_to(std::back_inserter(path), "M{:.3f} {:.3f}", begin.x, begin.y);
  fmt::format_to(std::back_inserter(path), "L{:.3f} {:.3f}", end.x, end.y);
  last = style;
  pen = end;
}

/// Whether the path from `from` to `to` passes through `point`. The machine only changes its speed there, so the point
/// need not be drawn.
static bool leads_over(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  return (point - from).cross(way).norm() <= kPoint / 10 * way.norm() && (point - from).dot(way) > 0 &&
         (to - point).dot(way) > 0;
}

void SvgPlot::add(const ToolpathStep& step) {
  if (step.kind == StepKind::Wait) return;
  Vec3 from = step.points.front().pose.tip;
  for (std::size_t i = 1; i < step.points.size(); ++i) {
    const Vec3& to = step.points[i].pose.tip;
    if (i + 1 < step.points.size() && leads_over(to, from, step.points[i + 1].pose.tip)) continue;
    for (View& view : views_) view.draw({step.kind, step.tool}, from, to);
    from = to;
  }
}

std::string SvgPlot::frames_drawn(const View& view, const Toolpath& path) {
  static constexpr std::string_view kNames = "XYZ";
  const double scale = view.scale();
  std::string svg;
  for (const auto& [frame, line] : path.frames())
    for (int axis = 0; axis < 3; ++axis) {
      const Point from = view.project(frame.origin);
      const Point to = view.project(frame.origin + kArm / scale * frame.axes.col(axis));
      if (std::hypot(to.x - from.x, to.y - from.y) * scale < kArm / 8) continue;
      fmt::format_to(std::back_inserter(svg),
                     "<path class=\"frame\" fill=\"none\" vector-effect=\"non-scaling-stroke\" stroke-width=\"1.8\" "
                     "stroke=\"{0}\" d=\"M{1:.3f} {2:.3f}L{3:.3f} {4:.3f}\"/><text x=\"{5:.3f}\" y=\"{6:.3f}\" "
                     "font-size=\"{7:.6g}\" text-anchor=\"middle\" fill=\"{0}\">{8}</text>\n",
                     kAxisColors[axis], from.x, from.y, to.x, to.y, from.x + 1.3 * (to.x - from.x),
                     from.y + 1.3 * (to.y - from.y) + 4 / scale, 11 / scale, kNames[static_cast<std::size_t>(axis)]);
    }
  return svg;
}

/// Draws the view in the center of its square.
std::string SvgPlot::drawn(const View& view, const Toolpath& path, double left) {
  const double scale = view.scale();
  std::string svg = fmt::format("<g transform=\"translate({:.2f} {:.2f}) scale({:.6g}) translate({:.3f} {:.3f})\">\n",
                                left + kViewSize / 2, kTitleHeight + kViewSize / 2, scale,
                                -(view.minimum.x + view.maximum.x) / 2, -(view.minimum.y + view.maximum.y) / 2);
  const auto draw = [&](std::string_view color, std::string_view style, std::string_view d) {
    fmt::format_to(std::back_inserter(svg),
                   "<path fill=\"none\" vector-effect=\"non-scaling-stroke\" stroke-linejoin=\"round\" stroke=\"{}\" "
                   "{} d=\"{}\"/>\n",
                   color, style, d);
  };
  for (const auto& [style, d] : view.paths)
    draw(color_of(style.second), kStyles[static_cast<std::size_t>(style.first)], d);
  for (const auto& [tool, d] : view.dots) draw(color_of(tool), kDotStyle, d);
  return svg + frames_drawn(view, path) + "</g>\n";
}

double round_length(double maximum) {
  const double power = std::pow(10, std::floor(std::log10(maximum)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= maximum) return digit * power;
  return power;
}

static std::string scale_bar(double scale, double left) {
  const double length = round_length(kViewSize / 4 / scale);
  const double y = kTitleHeight + kViewSize;
  return fmt::format(
      "<path stroke=\"#555\" fill=\"none\" d=\"M{0:.1f} {1:.1f}v6h{2:.2f}v-6\"/>"
      "<text x=\"{3:.1f}\" y=\"{4:.1f}\" fill=\"#555\">{5:g} mm</text>\n",
      left, y - 3, length * scale, left + length * scale + 8, y + 5, length);
}

static void append_row(std::string& svg, double left, double row, std::string_view color, std::string_view style,
                       std::string_view d, std::string_view text) {
  const double y = kLegendTop + kLegendRow * row;
  fmt::format_to(std::back_inserter(svg),
                 "<path stroke=\"{}\" {} d=\"M{:.0f} {:.0f}{}\"/><text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", color,
                 style, left, y, d, left + 50, y + 4, text::xml_escaped(text));
}

std::string SvgPlot::legend(const Toolpath& path) const {
  std::string svg;
  double row = 0;
  for (std::size_t i = 0; i < std::size(kKinds); ++i)
    append_row(svg, kMargin, row++, "#333", kStyles[i], "h40", kKinds[i].in(subject_.language));
  append_row(svg, kMargin, row++, "#333", kDotStyle, "m20 0h0", kDot.in(subject_.language));
  if (!path.frames().empty())
    append_row(svg, kMargin, row, kAxisColors[0], "stroke-width=\"1.8\"", "h40", kFrame.in(subject_.language));
  for (std::size_t tool = 0; tool < path.tools().size(); ++tool) {
    const auto& code = path.tools()[tool];
    append_row(svg, kMargin + 300, static_cast<double>(tool), color_of(tool), "stroke-width=\"6\"", "h40",
               code ? shown_tool(*code, subject_.tools) : std::string(kToolless.in(subject_.language)));
  }
  return svg;
}

void SvgPlot::write(system::OutputFile& output, const Toolpath& path, const PlottedRun&) {
  for (View& view : views_)
    for (const ToolpathFrame& each : path.frames()) view.include(view.project(each.frame.origin));
  const std::size_t rows = std::max<std::size_t>(path.tools().size(), std::size(kKinds) + 2);
  const double width = 2 * kViewSize + 3 * kMargin;
  const double height = kLegendTop + kLegendRow * static_cast<double>(rows);
  output.write(fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"{3:.0f}\" y=\"24\" "
      "font-size=\"16\">{2}</text>\n",
      width, height, text::xml_escaped(subject_.name), kMargin));
  const bool moves = std::any_of(views_.begin(), views_.end(),
                                 [](const View& view) { return !view.paths.empty() || !view.dots.empty(); });
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const double left = kMargin + static_cast<double>(i) * (kViewSize + kMargin);
    output.write(fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" fill=\"#555\">{}</text>\n", left, kTitleHeight - 8,
                             text::xml_escaped(kViews[i].in(subject_.language))));
    if (!moves)
      output.write(fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\" fill=\"#555\">{}</text>\n",
                               left + kViewSize / 2, kTitleHeight + kViewSize / 3,
                               text::xml_escaped(kNoMotion.in(subject_.language))));
    if (views_[i].is_empty) continue;
    output.write(drawn(views_[i], path, left));
    output.write(scale_bar(views_[i].scale(), left));
  }
  output.write(legend(path));
  output.write("</svg>\n");
}

}  // namespace isocnc::plot
