#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/event.h"

namespace isocnc::running {

/// A picture of a run: the path of the tool tip from above and in isometric view, machine coordinates, mm. Rapids are
/// dashed, arcs drawn thicker than lines, and each tool has a color that people see who tell red from green badly.
class Plot {
 public:
  Plot();

  void add(const Event& event);

  /// An SVG document. `title` may hold anything.
  std::string svg(std::string_view title, dialect::Language language) const;

 private:
  struct Point {
    double x = 0;
    double y = 0;
  };

  /// What one view shows; y grows downwards.
  struct View {
    Point (*project)(const geometry::Vec3& point);
    Point least;
    Point most;
    bool is_empty = true;
    std::map<std::pair<std::size_t, execution::MoveKind>, std::string> paths;  ///< By tool; `d` of the paths.
    std::pair<std::size_t, execution::MoveKind> last{};                        ///< Whose path the pen is on.
    Point pen;

    void include(const Point& point);
    void draw(const std::pair<std::size_t, execution::MoveKind>& key, const geometry::Vec3& from,
              const geometry::Vec3& to);
  };

  void add_move(const MoveEvent& move);
  void add_frame(const FrameEvent& event);
  std::string drawn(const View& view, double scale, double left, double top) const;

  std::vector<View> views_;
  std::vector<std::string> tools_;
  std::vector<geometry::Frame> frames_;  ///< In machine coordinates.
  std::size_t tool_ = 0;
};

}  // namespace isocnc::running
