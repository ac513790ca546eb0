#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>

#include "interpreter/plot/picture.h"

namespace isocnc::plot {

/// The greatest length of the form 1, 2 or 5 times a power of ten that is at most `maximum`: for the bar of a scale.
double round_length(double maximum);

/// The path from above and in isometric view, machine coordinates, mm, as an SVG document. Rapids are dashed, arcs are
/// thicker than lines, moves along the view are dots, and the colors of the tools suit people with red-green color
/// blindness.
class SvgPlot final : public Picture {
 public:
  /// `subject` must outlive it.
  explicit SvgPlot(const PlotSubject& subject);

  void add(const ToolpathStep& step) override;
  void write(system::OutputFile& output, const Toolpath& path, const PlottedRun& run) override;

 private:
  struct Point {
    double x = 0;
    double y = 0;
  };
  /// A drawing style: kind of step and tool. Sorted by drawing order.
  using PathStyle = std::pair<StepKind, std::size_t>;

  /// The content of one view; y increases downward.
  struct View {
    Point (*project)(const geometry::Vec3& point);
    Point minimum;
    Point maximum;
    bool is_empty = true;
    std::map<PathStyle, std::string> paths;   ///< Attribute `d` of the paths.
    std::map<std::size_t, std::string> dots;  ///< Feed moves that appear as a point, by tool.
    PathStyle last{};                         ///< Style of the path at the pen.
    Point pen;

    void include(const Point& point);
    void draw(const PathStyle& style, const geometry::Vec3& from, const geometry::Vec3& to);
    double scale() const;
  };

  static std::string drawn(const View& view, const Toolpath& path, double left);
  static std::string frames_drawn(const View& view, const Toolpath& path);
  std::string legend(const Toolpath& path) const;

  const PlotSubject& subject_;
  std::array<View, 2> views_;
};

}  // namespace isocnc::plot
