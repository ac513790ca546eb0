#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "interpreter/removal/closer_look.h"
#include "interpreter/removal/incident.h"
#include "interpreter/removal/kept_repeats.h"
#include "interpreter/removal/motion_sweeps.h"
#include "interpreter/removal/tool_forms.h"
#include "interpreter/simulation/run_findings.h"
#include "interpreter/stock/stock.h"
#include "interpreter/timing/timing.h"

namespace isocnc::removal {

/// What of the event of a motion matters for its stretches.
struct MotionFacts {
  explicit MotionFacts(const timing::TimedEvent& event);

  std::size_t line = 0;
  bool is_in_inches = false;
  bool is_at_known_place = false;  ///< It is known where the machine is before and after it.
  bool is_move = false;            ///< Otherwise the machine is asked for nothing.
  bool is_feed = false;
  ProgrammedMotion programmed;  ///< Machine frame.
};

/// Cuts the blank along a run, and finds what goes wrong with its material. It hears what Timing tells its listeners.
/// What it finds does not depend on the number of threads. Its memory does not depend on the number of motions, but for
/// what it notes of each line.
class MaterialCheck {
 public:
  /// Refers to the machine.
  MaterialCheck(Workpiece workpiece, const timing::TimedMachine& machine, stock::Workers workers = {});

  /// Called with the stock of a moment, and its time; returns the time of the next moment, seconds. Nothing is asked
  /// where nothing has been cut.
  using Watcher = std::function<double(const stock::Stock& stock, double time)>;
  /// From now on, `watcher` sees the stock, also within motions. What is found stays the same.
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  /// Another tool is mounted, by an event, at a time, s, with a frame in force. What it is in where it is mounted is
  /// found there, if it is known where that is.
  void mount(const execution::ToolCode& code, const CuttingTool& tool, const running::Event& event, double time,
             const geometry::Frame& frame, bool is_place_known = true);
  /// Takes a stretch of motion, with its event and the frame in force. Nothing is cut where it is not known where the
  /// machine is.
  void take(const motion::Stretch& stretch, const MotionFacts& motion, const geometry::Frame& frame);
  /// Takes the part of a stretch from one path parameter to another.
  void take_part(const motion::Stretch& stretch, const MotionFacts& motion, const geometry::Frame& frame, double from,
                 double to);
  /// Takes an event that has been made.
  void take(const timing::TimedEvent& event);
  /// Takes the end of a motion, seconds: what there is to know of the event of one between known places.
  void take_end(const MotionFacts& motion, double time);
  /// Ends the run.
  void finish();

  // For a run that goes back, too. A copy that is made while nothing waits goes on by itself, and shares the stock.
  /// From now on cuts alone, and finds no incidents but of the cutter's depth: for a copy of which the stock matters.
  void stop_asking() { asks_ = false; }
  /// Cuts what waits.
  void settle() { cut_waiting(); }
  /// Forgets what has been noted of lines, stretches and incidents that are over, so that a copy takes little. From
  /// then on, what each stretch removes is noted.
  void forget_past();
  /// After settle(): what the stretches since forget_past() have removed, in their order.
  const std::vector<Removed>& removed_by_stretch() const { return by_stretch_; }
  /// Stretches that have been taken since the start of the run with a tool.
  std::size_t stretch_count() const { return cut_ + waiting_.size(); }
  /// After settle(): the incidents since forget_past(), and those that may go on, by time and as they are known so far.
  std::vector<Incident> incidents_so_far() const;

  /// After finish(): by time.
  const std::vector<Incident>& incidents() const { return incidents_; }
  std::size_t left_out() const { return kept_.left_out(); }  ///< Incidents that are not kept.
  /// After finish(), in the order of their first use.
  const std::vector<RemovedByTool>& removed_by_tool() const { return by_tool_; }
  /// After finish(): lines that removed something, in the order of the run.
  std::vector<simulation::RemovedOnLine> removed_by_line() const;
  const stock::Stock& stock() const { return stock_; }  ///< In the frame of the setup.
  /// How much thinner bodies count than they are, all around, mm, at most: what a cut may leave of what its program
  /// says. Of the tools that have been mounted.
  double skin() const { return greatest_skin_; }
  double blank_volume() const { return blank_volume_; }
  const Workpiece& workpiece() const { return workpiece_; }

 private:
  /// What the motions of a line have removed.
  struct LineWork {
    std::size_t line = 0;
    double end_time = 0;  ///< When it was done, seconds.
    Removed removed;
  };

  /// A sweep of the stretch on which an incident begins.
  struct FirstSweep {
    ToolPart part = ToolPart::Cutter;
    std::size_t sweep = 0;
  };

  /// Where a part of the tool has been when an incident has met it first.
  struct PartStart {
    geometry::Vec3 axis = geometry::Vec3::UnitZ();  ///< Of the tool.
    double reach = 0;                               ///< How far it went along its axis, mm.
    double depth = 0;                               ///< How deep it was, mm.
  };

  /// An incident that may go on.
  struct OpenIncident {
    Incident incident;
    std::size_t last_stretch = 0;  ///< Counted from the start of the run.
    std::size_t line_before = 0;   ///< Where it was met before the line of that stretch; from 0.
    bool begins_in_feed = false;
    std::size_t first_stretch = 0;  ///< Counted alike.
    double last_way = 0;            ///< Of the tip up to where it was met last, mm.
    double deepest = 0;             ///< Of the sweeps that have been compared, mm.
    std::map<ToolPart, PartStart> starts;
    std::vector<FirstSweep> first_sweeps;      ///< Of the present batch, where it begins there: one for each part.
    std::optional<double> first_touch;         ///< Of those that have been looked at, seconds.
    std::optional<std::size_t> deepest_sweep;  ///< Of the present batch, where it is worst there.
    std::optional<stock::Stock> before;        ///< As the line has found it on which the incident began.
  };
  using IncidentKey = std::pair<IncidentKind, ToolPart>;  ///< Shank, holder and nose in material are one, the shank.

  void form(const CuttingTool& tool);
  void stand(const running::Event& event, double time, const geometry::Frame& frame);
  SweepSetting setting() const;
  void show_moments();
  Cutting cutting_of(bool is_feed) const;
  void append_sweeps();
  void cut_waiting();
  void cut_before_open();
  void finish_tool();
  void cut_sweeps();
  double start_of_use(const SweepUse& use) const;
  double end_of_use(const SweepUse& use) const;
  RemovedByTool& work_of_tool();
  void account(std::size_t sweep, const stock::SweepOutcome& outcome);
  void look_at(std::size_t sweep, const stock::SweepOutcome& outcome);
  void touch(const IncidentKey& key, std::size_t sweep, const stock::SweepOutcome& outcome);
  void note_heights(const std::vector<bool>& has_cut);
  static bool does_height_help(const UncutStretch& stretch);
  void note_ways(const std::vector<bool>& has_cut);
  void end_way();
  void look_closely(stock::Stock before);
  CloserLook closer_look() const;
  static void note_first_touch(OpenIncident& episode, double time);
  void find_worst(OpenIncident& episode, const stock::Stock& before);
  void compare_with_target();
  void look_for_loose_pieces();
  void close(OpenIncident& episode);
  void close_all();
  void keep(Incident incident);
  geometry::Vec3 in_machine(const geometry::Vec3& point) const { return point + workpiece_.origin; }

  Workpiece workpiece_;
  const timing::TimedMachine& machine_;
  stock::Workers workers_;
  stock::Stock stock_;
  double blank_volume_ = 0;
  double skin_;              ///< Of the path alone.
  double greatest_skin_;     ///< Of the bodies that have been mounted.
  bool has_turned_ = false;  ///< B or C has moved, so that the axis may have strayed at a corner.
  execution::ToolCode code_;
  std::optional<ToolForms> forms_;
  std::optional<std::size_t> tool_;  ///< Index into by_tool_, once the mounted tool has removed something.
  timing::SpindleMotion spindle_;
  double spindle_speed_ = 0;
  std::optional<std::size_t> spindle_stopped_by_;
  std::size_t last_line_ = 0;  ///< Of the events.
  double last_time_ = 0;
  bool is_in_inches_ = false;  ///< At that line.
  geometry::Frame last_frame_;
  std::optional<kinematics::Path> last_path_;  ///< Of the last stretch.
  double last_place_ = 0;                      ///< Path parameter to which it has come.
  bool is_at_cut_ = false;                     ///< A cut in feed has led to the present height.
  std::vector<geometry::Frame> frames_;
  std::vector<UncutStretch> waiting_;
  std::size_t with_sweeps_ = 0;  ///< Of those that wait, the first so many have theirs.
  MotionSweeps sweeps_;          ///< Of those that wait.
  double way_taken_ = 0;         ///< Of the tip, mm.
  std::size_t cut_ = 0;          ///< Stretches that have been cut.
  std::map<IncidentKey, OpenIncident> open_;
  std::vector<OpenIncident> closed_;  ///< Of the present batch.
  /// Incidents are looked at closely up to this number: each takes some thousand sweeps.
  static constexpr std::size_t kMaxLookedAt = 500;
  std::size_t looked_at_ = 0;
  std::vector<Incident> incidents_;
  KeptRepeats<std::tuple<IncidentKind, ToolPart, execution::ToolCode>> kept_;
  std::optional<Incident> way_;  ///< Feed motions that have met nothing so far.
  Watcher watcher_;
  double next_moment_ = 0;
  bool has_cuts_to_show_ = false;
  std::vector<RemovedByTool> by_tool_;
  std::vector<LineWork> by_line_;
  bool asks_ = true;
  bool notes_stretches_ = false;
  std::vector<Removed> by_stretch_;
  std::vector<solids::BoundingBox> loose_;  ///< Where pieces have come free.
};

}  // namespace isocnc::removal
