#pragma once

#include <optional>
#include <string>

#include "analyzer/transforming/line_edits.h"
#include "analyzer/transforming/refusal.h"
#include "analyzer/transforming/transformation.h"
#include "interpreter/execution/block_recorder.h"

namespace isocnc::transforming {

/// Rewrites a program block by block, along one path. It executes the new blocks as it goes, since the numbers of G91
/// count from where the new program is.
class BlockTransformer {
 public:
  /// Both must outlive this.
  BlockTransformer(const ProgramMap& map, const execution::Setup& setup)
      : map_(map), setup_(setup), state_(execution::initial_state(setup)) {}

  /// The text of the next block of the path. `before` is the state of the original program before it. After an obstacle
  /// the text is that of the original.
  std::string next(const syntax::LineTree& line, const execution::State& before);

  /// Why the last block cannot be rewritten.
  const std::optional<TransformObstacle>& obstacle() const { return obstacle_; }

 private:
  using Motion = execution::BlockRecorder::Motion;

  void edit_motion(const syntax::Instruction& instruction, const Motion& motion);
  geometry::Pose target_of(const Motion& motion, const PoseMap& map) const;
  void edit_motion_g(const syntax::Instruction& instruction, const Motion& motion, const PoseMap& map);
  void edit_center(const syntax::Instruction& instruction, const Motion& motion, const PoseMap& map);
  void edit_frame(const syntax::Instruction& instruction, const execution::State& before);
  void edit_face_axes(const syntax::Instruction& instruction, const execution::State& before);
  void edit_face_angles(const syntax::Instruction& instruction, const PoseMap& map);
  void edit_compensation(const execution::State& after);
  void edit_feed();

  const ProgramMap& map_;
  const execution::Setup& setup_;
  execution::State state_;  // Of the new program.
  std::optional<TransformObstacle> obstacle_;
  const syntax::LineTree* line_ = nullptr;
  LineEdits* edits_ = nullptr;
};

}  // namespace isocnc::transforming
