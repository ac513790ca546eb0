#include "interpreter/sheet/path_view.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace isocnc::sheet {

using geometry::Vec3;

/// Colors that are distinct with every kind of color vision, also where they are printed in gray.
static constexpr std::uint32_t kColors[] = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xB8860B, 0x56B4E9, 0x000000};
static constexpr std::uint32_t kRapidColor = 0x9AA0A6;
static constexpr std::uint32_t kAxisColor = 0xC2410C;
static constexpr std::uint32_t kNoToolColor = 0x333333;
static constexpr double kDot = 1;     ///< The width of a plunge from above, mm of paper.
static constexpr double kCell = 0.1;  ///< mm of paper.
/// What is left out of fuller pictures is not seen on paper.
static constexpr std::size_t kMaxSegments = 60'000;
static constexpr double kAxisLength = 4;  ///< mm of paper.
static constexpr double kBarHeight = 6;   ///< Room for the scale, mm of paper.
static constexpr double kDrawingMargin = 1;
static constexpr double kMinRoom = 10;  ///< mm of the machine that fill the picture at least.

std::uint32_t color_of_tool(std::size_t place) { return kColors[place % std::size(kColors)]; }

PathView::PathView(const Axes& axes, const std::array<geometry::Range, 3>& room, double max_width, double max_height)
    : axes_(axes), room_(room) {
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
                    (max_height - 2 * kDrawingMargin - kBarHeight) / size(axes.up));
  drawing_.width = max_width;
  drawing_.height = size(axes.up) * scale_ + 2 * kDrawingMargin + kBarHeight;
}

PaperPoint PathView::on_paper(const Vec3& place) const {
  const geometry::Range& right = room_[static_cast<std::size_t>(axes_.right)];
  const geometry::Range& up = room_[static_cast<std::size_t>(axes_.up)];
  return {kDrawingMargin + (place[axes_.right] - right.minimum) * scale_,
          kDrawingMargin + (up.maximum - place[axes_.up]) * scale_};
}

PathView::PaperCell PathView::cell_of(const PaperPoint& point) {
  return {static_cast<std::int32_t>(std::lround(point.x / kCell)),
          static_cast<std::int32_t>(std::lround(point.y / kCell))};
}

PaperPoint PathView::point_of(const PaperCell& cell) { return {cell.first * kCell, cell.second * kCell}; }

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
  PaperPoint from = on_paper(step.points.front().pose.tip);
  bool is_drawn = false;
  for (std::size_t i = 1; i < step.points.size(); ++i) {
    const PaperPoint to = on_paper(step.points[i].pose.tip);
    if (cell_of(to) == cell_of(from)) continue;
    if (const auto seen = clipped(from, to)) add_segment(style, cell_of(seen->first), cell_of(seen->second));
    from = to;
    is_drawn = true;
  }
  // A plunge is a point in the view from above.
  if (!is_drawn && style != 0 && clipped(from, from)) dots_.emplace(style, cell_of(from));
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

void PathView::add_segment(std::size_t style, const PaperCell& from, const PaperCell& to) {
  if (drawn_.size() >= kMaxSegments) return;
  const auto bits = [](const PaperCell& cell) {
    return static_cast<std::uint64_t>(static_cast<std::uint16_t>(cell.first)) << 16U |
           static_cast<std::uint16_t>(cell.second);
  };
  const PaperCell& low = std::min(from, to);
  const PaperCell& high = std::max(from, to);
  const std::uint64_t key =
      (bits(low) << 32U | bits(high)) ^ (static_cast<std::uint64_t>(style) * 0x9E3779B97F4A7C15ULL);
  if (!drawn_.insert(key).second) return;
  std::vector<std::vector<PaperPoint>>& rows = rows_[style];
  const auto pen = pens_.find(style);
  if (pen == pens_.end() || pen->second != from) rows.push_back({point_of(from)});
  rows.back().push_back(point_of(to));
  pens_[style] = to;
}

void PathView::add_origin(const Vec3& origin, std::string name) {
  const PaperPoint at = on_paper(origin);
  if (!clipped(at, at)) return;
  const PenStroke stroke{.color = kAxisColor, .width = 0.4};
  origins_.lines.push_back({stroke, {{at.x, at.y - kAxisLength}, at, {at.x + kAxisLength, at.y}}});
  origins_.texts.push_back({{at.x + 0.8, at.y - 0.8}, std::move(name)});
}

/// The greatest length of the form 1, 2 or 5 times a power of ten that is at most `maximum`.
static double round_length(double maximum) {
  const double power = std::pow(10, std::floor(std::log10(maximum)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= maximum) return digit * power;
  return power;
}

/// Of feed moves.
static std::uint32_t color_of_style(std::size_t style) { return style == 1 ? kNoToolColor : color_of_tool(style - 2); }

Drawing PathView::finish() {
  for (auto& [style, rows] : rows_) {
    const PenStroke stroke = style == 0 ? PenStroke{.color = kRapidColor, .width = 0.12, .is_dashed = true}
                                        : PenStroke{.color = color_of_style(style), .width = 0.25};
    for (std::vector<PaperPoint>& row : rows) drawing_.lines.push_back({stroke, std::move(row)});
  }
  for (const auto& [style, cell] : dots_)
    drawing_.lines.push_back({{.color = color_of_style(style), .width = kDot}, {point_of(cell)}});
  drawing_.lines.insert(drawing_.lines.end(), origins_.lines.begin(), origins_.lines.end());
  drawing_.texts = std::move(origins_.texts);
  const double length = round_length((drawing_.width - 2 * kDrawingMargin) / 3 / scale_);
  const double y = drawing_.height - 2;
  const double right = kDrawingMargin + length * scale_;
  drawing_.lines.push_back(
      {{.color = 0x555555, .width = 0.2}, {{kDrawingMargin, y - 1}, {kDrawingMargin, y}, {right, y}, {right, y - 1}}});
  drawing_.texts.push_back({{right + 1, y}, fmt::format("{:g} mm", length)});
  return std::move(drawing_);
}

}  // namespace isocnc::sheet
