#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/geometry/range.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/running/event.h"

namespace isocnc::summary {

/// The range of the tip's positions while a frame was in force, in its coordinates; mm.
struct FrameExtents {
  std::size_t line = 0;  ///< From 0: the G92 of a workpiece frame, or the G24, G28 or G29 of a face frame.
  bool is_face = false;
  geometry::Frame frame;  ///< In the machine frame.
  std::array<geometry::Range, 3> extents;
};

/// Follows the frames of a run and the range of the tip in each. A workpiece frame restored by G27 counts as the same
/// frame. The machine frame, in force before any G92, is not recorded.
class FrameLog {
 public:
  void take(const running::FrameEvent& event, std::size_t line);
  /// `extents`: in the machine frame.
  void take(const kinematics::Machine& machine, const kinematics::Move& move,
            const std::array<geometry::Range, 3>& extents);

  /// In the order of the first motion in each frame. A typical part has a few; of longer lists the first ones are kept.
  const std::vector<FrameExtents>& frames() const { return frames_; }
  /// Number of further frames with motions.
  std::size_t left_out() const { return left_out_; }

 private:
  struct InForce {
    std::optional<std::size_t> line;  ///< None: the machine frame.
    geometry::Frame frame;
    std::optional<std::size_t> place;  ///< Index in frames_; past its end for a frame left out.
  };

  std::vector<FrameExtents> frames_;
  std::size_t left_out_ = 0;
  InForce workpiece_;
  std::optional<InForce> face_;
};

}  // namespace isocnc::summary
