#include "interpreter/sheet/path_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interpreter/plot/svg_plot.h"

namespace isocnc::sheet {

using geometry::Vec3;

/// Colors that are distinct with every kind of color vision, also where they are printed in gray.
static constexpr std::uint32_t kColors[] = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xB8860B, 0x56B4E9,
                                            0x000000, 0x7B3F00, 0x5B4B9F, 0x7A9A01, 0xA50F15, 0x00868B};
static constexpr std::uint32_t kRapidColor = 0x9AA0A6;
static constexpr std::uint32_t kAxisColor = 0xC2410C;
static constexpr std::uint32_t kNoToolColor = 0x333333;
static constexpr double kDot = 1;           ///< The width of a plunge from above, mm of paper.
static constexpr double kFinestCell = 0.1;  ///< mm of paper.
static constexpr std::size_t kMaxSegments = 60'000;
static constexpr double kAxisLength = 4;  ///< mm of paper.
static constexpr double kBarHeight = 6;   ///< Room for the scale, mm of paper.
static constexpr double kDrawingMargin = 1;
static constexpr double kTopMargin = kAxisLength + 1;  ///< The work often begins at the zero, whose axis goes up.
static constexpr double kMinRoom = 10;                 ///< mm of the machine that fill the picture at least.

/// How often the colors have been used before.
static std::size_t round_of(std::size_t place) { return place / std::size(kColors); }

PenStroke stroke_of_tool(std::size_t place) {
  PenStroke stroke{.color = kColors[place % std::size(kColors)], .width = 0.25};
  // Long dashes, with one more dot after each from round to round.
  for (std::size_t round = 0; round < round_of(place); ++round)
    stroke.dashes.insert(stroke.dashes.end(), {round == 0 ? 1.8 : 0.1, 0.7});
  return stroke;
}

std::vector<double> fine_dashes() { return {0.8, 0.5}; }

PathView::PathView(const Axes& axes, const std::array<geometry::Range, 3>& room, double max_width, double max_height)
    : axes_(axes), room_(room), cell_(kFinestCell) {
  for (geometry::Range& range : room_) {
    const double lacking = kMinRoom - (range.maximum - range.minimum);
    if (lacking <= 0) continue;
    range.minimum -= lacking / 2;
    range.maximum += lacking / 2;
  }
  const auto size = [&](int axis) {
    const geometry::Range& range = room_[static_cast<std::size_t>(axis)];
    return range.maximum - range.minimum;
  };
  scale_ = std::min((max_width - 2 * kDrawingMargin) / size(axes.right),
                    (max_height - kTopMargin - kDrawingMargin - kBarHeight) / size(axes.up));
  drawing_.width = max_width;
  drawing_.height = size(axes.up) * scale_ + kTopMargin + kDrawingMargin + kBarHeight;
}

PaperPoint PathView::on_paper(const Vec3& place) const {
  const geometry::Range& right = room_[static_cast<std::size_t>(axes_.right)];
  const geometry::Range& up = room_[static_cast<std::size_t>(axes_.up)];
  return {kDrawingMargin + (place[axes_.right] - right.minimum) * scale_,
          kTopMargin + (up.maximum - place[axes_.up]) * scale_};
}

PathView::PaperCell PathView::cell_of(const PaperPoint& point) const {
  return {static_cast<std::int32_t>(std::lround(point.x / cell_)),
          static_cast<std::int32_t>(std::lround(point.y / cell_))};
}

PaperPoint PathView::point_of(const PaperCell& cell) const { return {cell.first * cell_, cell.second * cell_}; }

void PathView::add_box(const std::array<geometry::Range, 3>& room, const PenStroke& stroke) {
  const auto corner = [&](bool is_right, bool is_up) {
    Vec3 place = Vec3::Zero();
    const geometry::Range& right = room[static_cast<std::size_t>(axes_.right)];
    const geometry::Range& up = room[static_cast<std::size_t>(axes_.up)];
    place[axes_.right] = is_right ? right.maximum : right.minimum;
    place[axes_.up] = is_up ? up.maximum : up.minimum;
    return on_paper(place);
  };
  drawing_.lines.push_back(
      {stroke,
       {corner(false, false), corner(true, false), corner(true, true), corner(false, true), corner(false, false)}});
}

void PathView::add(const plot::ToolpathStep& step) {
  if (step.kind == plot::StepKind::Wait) return;
  const std::size_t style = step.kind == plot::StepKind::Rapid ? 0 : step.tool + 1;
  const Vec3& start = step.points.front().pose.tip;
  PaperPoint from = on_paper(start);
  double seen = 0;  // The length of the way as one sees it.
  double length = 0;
  for (std::size_t i = 1; i < step.points.size(); ++i) {
    const Vec3& tip = step.points[i].pose.tip;
    const PaperPoint to = on_paper(tip);
    seen += std::hypot(to.x - from.x, to.y - from.y) / scale_;
    length += (tip - step.points[i - 1].pose.tip).norm();
    if (cell_of(to) != cell_of(from))
      if (const auto part = clipped(from, to)) add_segment({style, cell_of(part->first), cell_of(part->second)});
    from = to;
  }
  // A plunge is a point in the view from above.
  constexpr double kAlongTheView = 1e-3;
  if (style != 0 && length > 0 && seen < kAlongTheView * length && clipped(from, from))
    dots_.emplace(style, cell_of(from));
}

std::optional<std::pair<PaperPoint, PaperPoint>> PathView::clipped(const PaperPoint& from, const PaperPoint& to) const {
  double first = 0;
  double last = 1;
  const auto cut = [&](double begin, double way, double end) {
    // What is left lies in begin + t way from 0 to `end`.
    if (way == 0) return begin >= 0 && begin <= end;
    const double enters = (way > 0 ? -begin : end - begin) / way;
    const double leaves = (way > 0 ? end - begin : -begin) / way;
    first = std::max(first, enters);
    last = std::min(last, leaves);
    return first <= last;
  };
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  if (!cut(from.x, dx, drawing_.width) || !cut(from.y, dy, drawing_.height - kBarHeight)) return std::nullopt;
  return std::pair(PaperPoint{from.x + first * dx, from.y + first * dy},
                   PaperPoint{from.x + last * dx, from.y + last * dy});
}

void PathView::add_segment(const PaperSegment& segment) {
  if (segment.from == segment.to) return;
  const auto bits = [](const PaperCell& cell) {
    return static_cast<std::uint64_t>(static_cast<std::uint16_t>(cell.first)) << 16U |
           static_cast<std::uint16_t>(cell.second);
  };
  const std::uint64_t low = bits(std::min(segment.from, segment.to));
  const std::uint64_t high = bits(std::max(segment.from, segment.to));
  const std::uint64_t key = (low << 32U | high) ^ (static_cast<std::uint64_t>(segment.style) * 0x9E3779B97F4A7C15ULL);
  if (!drawn_.insert(key).second) return;
  segments_.push_back(segment);
  if (segments_.size() > kMaxSegments) coarsen();
}

/// Cells become twice as wide.
void PathView::coarsen() {
  std::vector<PaperSegment> finer = std::exchange(segments_, {});
  const std::set<std::pair<std::size_t, PaperCell>> finer_dots = std::exchange(dots_, {});
  drawn_.clear();
  const auto points_of = [&](const PaperCell& cell) { return point_of(cell); };
  std::vector<std::pair<PaperPoint, PaperPoint>> lines;
  for (const PaperSegment& each : finer) lines.emplace_back(points_of(each.from), points_of(each.to));
  std::vector<PaperPoint> dots;
  for (const auto& [style, cell] : finer_dots) dots.push_back(points_of(cell));
  cell_ *= 2;
  for (std::size_t i = 0; i < finer.size(); ++i)
    add_segment({finer[i].style, cell_of(lines[i].first), cell_of(lines[i].second)});
  std::size_t dot = 0;
  for (const auto& [style, cell] : finer_dots) dots_.emplace(style, cell_of(dots[dot++]));
}

void PathView::add_origin(const Vec3& origin, std::string name) {
  const PaperPoint at = on_paper(origin);
  if (!clipped(at, at)) return;
  const PenStroke stroke{.color = kAxisColor, .width = 0.4};
  origins_.lines.push_back({stroke, {{at.x, at.y - kAxisLength}, at, {at.x + kAxisLength, at.y}}});
  origins_.texts.push_back({{at.x + 0.8, at.y - 0.8}, std::move(name)});
}

static PenStroke stroke_of_style(std::size_t style) {
  if (style == 0) return {.color = kRapidColor, .width = 0.12, .fill = {}, .dashes = fine_dashes()};
  return style == 1 ? PenStroke{.color = kNoToolColor, .width = 0.25} : stroke_of_tool(style - 2);
}

/// A plunge of a tool: a dot; with a ring in place of dashes, and a dot in that for more of them.
static std::vector<DrawnLine> dot_of_style(std::size_t style, const PaperPoint& at) {
  const std::size_t round = style == 1 ? 0 : round_of(style - 2);
  const std::uint32_t color = stroke_of_style(style).color;
  std::vector<DrawnLine> dot{{{.color = color, .width = kDot}, {at}}};
  if (round > 0) dot.push_back({{.color = 0xFFFFFF, .width = 0.6 * kDot}, {at}});
  if (round > 1) dot.push_back({{.color = color, .width = 0.3 * kDot}, {at}});
  return dot;
}

Drawing PathView::finish() {
  std::stable_sort(segments_.begin(), segments_.end(),
                   [](const PaperSegment& a, const PaperSegment& b) { return a.style < b.style; });
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const PaperSegment& segment = segments_[i];
    const bool goes_on = i > 0 && segments_[i - 1].style == segment.style && segments_[i - 1].to == segment.from;
    if (!goes_on) drawing_.lines.push_back({stroke_of_style(segment.style), {point_of(segment.from)}});
    drawing_.lines.back().points.push_back(point_of(segment.to));
  }
  for (const auto& [style, cell] : dots_)
    for (DrawnLine& part : dot_of_style(style, point_of(cell))) drawing_.lines.push_back(std::move(part));
  drawing_.lines.insert(drawing_.lines.end(), origins_.lines.begin(), origins_.lines.end());
  drawing_.texts = std::move(origins_.texts);
  const double length = plot::round_length((drawing_.width - 2 * kDrawingMargin) / 3 / scale_);
  const double y = drawing_.height - 2;
  const double right = kDrawingMargin + length * scale_;
  drawing_.lines.push_back(
      {{.color = 0x555555, .width = 0.2}, {{kDrawingMargin, y - 1}, {kDrawingMargin, y}, {right, y}, {right, y - 1}}});
  drawing_.texts.push_back({{right + 1, y}, fmt::format("{:g} mm", length)});
  return std::move(drawing_);
}

}  // namespace isocnc::sheet
