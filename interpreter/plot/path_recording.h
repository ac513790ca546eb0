#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "interpreter/plot/packed_bytes.h"
#include "interpreter/plot/picture.h"

namespace isocnc::plot {

/// The path of the tool tip in a compact form: each step and point as its difference to the previous one.
/// toolpath-view/src/toolpath.ts reads it, in the page of isorun --plot and in an editor.
class PathRecording {
 public:
  /// Both must outlive this object. The program and page of the subject are not used.
  PathRecording(const PlotSubject& subject, const timing::TimedMachine& machine);

  void add(const ToolpathStep& step);

  std::string_view steps() const { return steps_.bytes(); }
  std::string_view points() const { return points_.bytes(); }
  std::string_view turns() const { return turns_.bytes(); }  ///< Rotations of B and C, where they turn.
  /// All other data of the plot except the program text, as JSON: also what surrounds the program, and what was hit.
  std::string facts(const Toolpath& path, const PlottedRun& run) const;

 private:
  /// A point in the units of the recording: µm, 0.0001 degrees, 0.001 mm/s, 0.001 mm/min.
  struct RecordedPoint {
    std::array<std::int64_t, 3> tip{};
    std::int64_t b = 0;
    std::int64_t c = 0;
    std::int64_t speed = 0;
  };

  static RecordedPoint place(const ToolpathPoint& point);
  void add(const RecordedPoint& place, double time);

  const PlotSubject& subject_;
  const timing::TimedMachine& machine_;
  PackedBytes steps_;
  PackedBytes points_;
  PackedBytes turns_;
  RecordedPoint home_;
  RecordedPoint last_;
  /// Times are stored as differences to the previous point, in units of 10 ns, so that a shift at the start changes
  /// only one number.
  double last_time_ = 0;
  std::size_t last_line_ = 0;
  std::uint64_t last_tool_ = 0;
  std::int64_t last_feed_ = 0;
  std::uint64_t points_since_turn_ = 0;
};

/// The whole recording of one run, without what surrounds the program.
struct RecordedPath {
  std::string facts;
  std::string steps;
  std::string points;
  std::string turns;
};

/// Runs a program for its path. What is recorded ends where `options.stop` ends the run.
RecordedPath record_path(std::string_view program, const PlotSubject& subject, const running::RunOptions& options,
                         const timing::TimedMachine& machine);

}  // namespace isocnc::plot
