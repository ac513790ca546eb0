#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "interpreter/timing/timing.h"
#include "interpreter/verification/contact_log.h"
#include "interpreter/verification/material.h"

namespace isocnc::verification {

/// Runs `work` on one or several threads at once, and returns when all have ended.
using WorkTogether = std::function<void(const std::function<void()>& work)>;

/// Compares the motions of a run with a scene. It hears what Timing tells its listeners. What it finds does not depend
/// on the number of threads, and its memory not on the number of motions.
class Verifier {
 public:
  /// Refers to the machine and the scene. `origin` is that of the first workpiece frame, machine frame, mm.
  Verifier(const Scene& scene, const timing::TimedMachine& machine, const geometry::Vec3& origin,
           WorkTogether work_together = {}, const MaterialOptions& material = {});

  /// Takes a stretch of a motion.
  void take(const motion::Stretch& stretch, const removal::MotionFacts& motion);
  /// Takes an event that has been made.
  void take(const timing::TimedEvent& event);
  /// Takes the end of a motion, seconds: what there is to know of the event of one between known places.
  void take_end(const removal::MotionFacts& motion, double time);
  /// Ends the run.
  void finish();

  /// After finish(): sorted by time.
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// After finish().
  const Certificate& certificate() const { return certificate_; }
  /// After finish(). Null if the scene describes no stock, or it does not fit the memory.
  const removal::MaterialCheck* material() const { return material_ ? &*material_ : nullptr; }
  removal::MaterialCheck* material() { return material_ ? &*material_ : nullptr; }

 private:
  /// A stretch that waits for being examined.
  struct WaitingStretch {
    std::size_t line = 0;
    std::size_t frame = 0;  ///< Index of the frame in force.
    bool is_in_inches = false;
  };

  void mount(const execution::ToolCode& tool, const timing::TimedEvent& event);
  void arrive_at_known_place();
  void note_unknown_place(std::size_t line);
  void examine_waiting();
  void finish_material();

  const Scene& scene_;
  const timing::TimedMachine& machine_;
  geometry::Vec3 origin_;
  WorkTogether work_together_;
  execution::ToolCode tool_;
  bool is_place_known_ = true;         ///< Of the machine: whether bodies_ has what is on its spindle.
  execution::ToolCode unknown_after_;  ///< The tool that makes it unknown.
  bool is_unknown_before_ = false;     ///< It has been unknown before the mounted tool as well.
  /// The line of the tool change from which on the machine is, with a tool of known length, nobody knows where.
  std::optional<std::size_t> unknown_from_;
  bool is_unknown_noted_ = false;  ///< In the certificate.
  std::set<execution::ToolCode> known_gaps_;
  kinematics::Coordinates joints_;  ///< At the end of the last stretch that has been examined.
  BodyPairs bodies_;
  std::vector<geometry::Frame> frames_ = {geometry::Frame()};  ///< Those of the stretches that wait.
  std::vector<motion::Stretch> stretches_;
  std::vector<WaitingStretch> waiting_;
  std::size_t examined_ = 0;  ///< Stretches that have been examined.
  ContactLog log_;
  std::optional<removal::MaterialCheck> material_;
  std::vector<Contact> contacts_;
  Certificate certificate_;
};

/// A tool that a machine mounts, with its bodies in a scene. `is_place_known` says whether it is known where the
/// machine is; a tool whose length is not known is nowhere. The result refers to the scene.
MountedTool mounted_tool(const Scene& scene, const timing::TimedMachine& machine, const execution::ToolCode& tool,
                         bool is_place_known = true);

/// The origin of the first workpiece frame that a run sets (G92); machine frame, mm. 0 if it sets none.
geometry::Vec3 first_workpiece_origin(std::string_view text, const running::RunOptions& options);

}  // namespace isocnc::verification
