#include "interpreter/removal/material_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/kinematics/numbers.h"
#include "interpreter/removal/left_material.h"
#include "interpreter/removal/loose_pieces.h"
#include "interpreter/timing/spindle_turn.h"

namespace isocnc::removal {

using geometry::Vec3;
using solids::RevolvedBody;
using stock::Stock;
using stock::Sweep;
using stock::SweepOutcome;
using stock::SweepPath;
using stock::SweepPurpose;
using Role = SweepRole;

/// Stretches that wait at most.
static constexpr std::size_t kBatch = 4096;
/// Seconds between the moments at which a watcher is asked first.
static constexpr double kShortestMoment = 0.05;
/// Where nothing is cut, that many of these are left out at once.
static constexpr double kMaxMomentsApart = 10;

/// What a cut may leave of what its program says, mm: at a rounded corner as much more as the corner strays, be it at
/// the end of a slot or at the bottom of a hole. Later motions come as near as the program says.
static double skin_of(double spacing, const timing::TimedMachine& machine) {
  return rim_of(spacing) + machine.motion.corner_tolerance;
}

MaterialCheck::MaterialCheck(Workpiece workpiece, const timing::TimedMachine& machine, stock::Workers workers)
    : workpiece_(std::move(workpiece)),
      machine_(machine),
      workers_(std::move(workers)),
      stock_(workpiece_.blank, workpiece_.spacing, workpiece_.window),
      blank_volume_(stock_.volume()),
      skin_(skin_of(stock_.spacing(), machine)),
      greatest_skin_(skin_) {}

void MaterialCheck::mount(const execution::ToolCode& code, const CuttingTool& tool, const running::Event& event,
                          double time, const geometry::Frame& frame, bool is_place_known) {
  finish_tool();
  close_all();
  if (!by_line_.empty()) look_for_loose_pieces();
  code_ = code;
  tool_.reset();
  // A wall of a cut is known to within a spacing.
  form(tool);
  if (is_place_known) stand(event, time, frame);
}

/// Makes the bodies of the mounted tool, while nothing waits.
void MaterialCheck::form(const CuttingTool& tool) {
  const CutSkin skin{skin_, has_turned_ ? machine_.motion.corner_tolerance_deg * kinematics::kRadians : 0};
  // A wall of a cut is known to within a spacing.
  forms_.emplace(tool, skin, stock_.spacing(), workpiece_.clearance);
  greatest_skin_ = std::max(greatest_skin_, forms_->greatest_skin());
}

/// Compares the mounted tool where it stands.
void MaterialCheck::stand(const running::Event& event, double time, const geometry::Frame& frame) {
  // Without its length, nothing on the spindle is at its place.
  const double length = forms_->tool().length;
  if (!last_path_ || !(length > 0)) return;
  const kinematics::Kinematics& kinematics = machine_.motion.kinematics;
  const kinematics::Coordinates joints = last_path_->joints_at(kinematics, last_place_).value;
  motion::Stretch rest{.start = time, .phase_count = 1};
  rest.path.is_of_joints = true;
  rest.path.c[0] = joints;
  rest.path.tool_length = length;
  last_frame_ = frame;
  frames_ = {frame};  // Nothing waits.
  waiting_.push_back({.stretch = rest,
                      .cutting = Cutting::InRapid,
                      .line = event.line,
                      .frame = 0,
                      .is_in_inches = event.is_in_inches,
                      .is_standing = true});
}

MotionFacts::MotionFacts(const timing::TimedEvent& event)
    : line(event.event.line),
      is_in_inches(event.event.is_in_inches),
      is_at_known_place(event.is_at_known_place()),
      is_move(event.move.has_value()),
      is_feed(is_move && event.move->feed.kind != kinematics::FeedKind::Rapid) {
  if (!is_move) return;
  const kinematics::Move& move = *event.move;
  const bool turns = move.from.b != move.to.b || move.from.c != move.to.c;
  programmed = {
      .from = move.from.tip, .to = move.to.tip, .is_line = !move.is_arc && (!turns || move.controls_tool_point)};
}

void MaterialCheck::take_end(const MotionFacts& motion, double time) {
  last_line_ = motion.line;
  is_in_inches_ = motion.is_in_inches;
  last_time_ = time;
}

void MaterialCheck::take(const timing::TimedEvent& event) {
  if (const auto* const speed = std::get_if<running::SpindleSpeedEvent>(&event.event.what))
    spindle_speed_ = speed->speed;
  const auto before = spindle_;
  take_end(MotionFacts(event), event.start + event.duration);
  spindle_ = timing::spindle_after(event.event, spindle_, spindle_speed_);
  if (before.function != 5 && spindle_.function == 5) spindle_stopped_by_ = event.event.line;
}

void MaterialCheck::take(const motion::Stretch& stretch, const MotionFacts& motion, const geometry::Frame& frame) {
  take_part(stretch, motion, frame, stretch.phases[0].from, stretch.parameter_at(stretch.start + stretch.duration));
}

void MaterialCheck::take_part(const motion::Stretch& stretch, const MotionFacts& motion, const geometry::Frame& frame,
                              double from, double to) {
  last_path_ = stretch.path;
  last_place_ = to;
  if (!forms_ || !motion.is_move || !motion.is_at_known_place) return;
  if (!has_turned_ && turns_axis(machine_.motion.kinematics, stretch.path)) {
    cut_waiting();
    has_turned_ = true;
    form(CuttingTool(forms_->tool()));
  }
  last_frame_ = frame;
  if (frames_.empty() || !(frames_.back() == frame)) frames_.push_back(frame);
  waiting_.push_back({.stretch = stretch,
                      .from = from,
                      .to = to,
                      .cutting = cutting_of(motion.is_feed),
                      .line = motion.line,
                      .frame = frames_.size() - 1,
                      .is_in_inches = motion.is_in_inches,
                      .is_feed = motion.is_feed,
                      .programmed = motion.programmed,
                      .spindle_stopped_by = spindle_stopped_by_});
  if (watcher_) show_moments();
  if (waiting_.size() >= kBatch) cut_before_open();
}

SweepSetting MaterialCheck::setting() const {
  return {.forms = *forms_,
          .kinematics = machine_.motion.kinematics,
          .origin = workpiece_.origin,
          .spacing = stock_.spacing(),
          .top = stock_.bounds().max().z(),
          .skin = skin_,
          .asks = asks_};
}

/// Shows the moments before the last stretch that waits, and those within it. What is cut up to a moment within it is
/// cut from a copy, so that the stock itself does not depend on when somebody looks.
void MaterialCheck::show_moments() {
  const double end = waiting_.back().stretch.start + waiting_.back().stretch.duration;
  if (next_moment_ > end) return;
  const UncutStretch last = waiting_.back();
  const motion::Stretch& stretch = last.stretch;
  waiting_.pop_back();
  cut_before_open();
  std::vector<TipPath> pieces;
  for (; next_moment_ <= end; has_cuts_to_show_ = false) {
    const double moment = next_moment_;
    Stock partial = stock_;
    bool is_cut = has_cuts_to_show_;
    if (moment > stretch.start && forms_->cutter()) {
      const auto cut = [&](const SweepPath& path) {
        const Sweep sweep{
            .body = removing_cutter(*forms_, last.cutting), .path = path, .tag = static_cast<stock::CutTag>(last.line)};
        if (may_meet(setting(), *sweep.body, sweep.path)) is_cut = partial.apply({&sweep, 1}).front().meets() || is_cut;
      };
      if (const auto open = sweeps_.open_part()) std::for_each(open->paths.begin(), open->paths.end(), cut);
      divide(setting(), last, stretch.parameter_at(moment), pieces);
      for (const TipPath& piece : pieces) cut(piece.path);
    }
    if (is_cut) {
      next_moment_ = std::max(watcher_(partial, moment), std::nextafter(moment, HUGE_VAL));
    } else {
      // Nothing to see before the end of the stretch.
      next_moment_ = std::max(moment + kShortestMoment, std::min(end, moment + kShortestMoment * kMaxMomentsApart));
    }
  }
  waiting_.push_back(last);
  if (frames_.empty()) frames_.push_back(last_frame_);
  waiting_.back().frame = frames_.size() - 1;
}

/// Whether the cutter may cut on a motion.
Cutting MaterialCheck::cutting_of(bool is_feed) const {
  if (!is_feed) return Cutting::InRapid;
  return spindle_.function == 5 ? Cutting::Standing : Cutting::Allowed;
}

/// Makes the sweeps of what waits.
void MaterialCheck::append_sweeps() {
  if (!forms_) return;
  sweeps_.append(setting(), waiting_, with_sweeps_, workers_);
  for (; with_sweeps_ < waiting_.size(); ++with_sweeps_) {
    UncutStretch& each = waiting_[with_sweeps_];
    each.rise = frames_[each.frame].axes.col(2).dot(each.travel);
    each.way = way_taken_;
    way_taken_ += each.length;
  }
}

void MaterialCheck::cut_waiting() {
  append_sweeps();
  if (forms_) sweeps_.append_rest_of_motion(setting(), waiting_);
  cut_sweeps();
}

/// Cuts what waits, and the rest of what the mounted tool has passed through, before it goes.
void MaterialCheck::finish_tool() {
  cut_waiting();
  if (!forms_) return;
  const std::vector<Sweep> rest = sweeps_.take_rest(*forms_);
  for (const SweepOutcome& outcome : stock_.apply(rest, workers_)) {
    if (!outcome.meets()) continue;
    work_of_tool().removed.add({.volume = outcome.volume});
    has_cuts_to_show_ = true;
  }
}

/// Cuts what waits but for the stretches whose sweeps wait for more of their motion, so that the sweeps do not depend
/// on when it is called.
void MaterialCheck::cut_before_open() {
  append_sweeps();
  const auto open = sweeps_.open_part();
  const auto first = waiting_.begin() + static_cast<std::ptrdiff_t>(open ? open->first : waiting_.size());
  std::vector<UncutStretch> kept(first, waiting_.end());
  waiting_.erase(first, waiting_.end());
  cut_sweeps();
  // All of them are of one motion.
  for (UncutStretch& each : kept) each.frame = 0;
  waiting_ = std::move(kept);
  with_sweeps_ = waiting_.size();
}

void MaterialCheck::cut_sweeps() {
  std::vector<bool> has_cut(waiting_.size());
  if (notes_stretches_) by_stretch_.resize(by_stretch_.size() + waiting_.size());
  if (!sweeps_.sweeps().empty()) {
    const Stock before = stock_;
    const std::vector<SweepOutcome> outcomes = stock_.apply(sweeps_.sweeps(), workers_);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const SweepUse& use = sweeps_.uses()[i];
      if (use.role == Role::Cut || use.role == Role::Rest) account(i, outcomes[i]);
      if (use.role == Role::Cut && outcomes[i].meets())
        for (std::uint32_t stretch = use.first; stretch <= use.last; ++stretch) has_cut[stretch] = true;
      if (outcomes[i].meets()) look_at(i, outcomes[i]);
    }
    note_heights(has_cut);
    look_closely(before);
  } else {
    note_heights(has_cut);
  }
  has_cuts_to_show_ = has_cuts_to_show_ || std::find(has_cut.begin(), has_cut.end(), true) != has_cut.end();
  note_ways(has_cut);
  cut_ += waiting_.size();
  waiting_.clear();
  with_sweeps_ = 0;
  sweeps_.clear();
  if (frames_.size() > 1) frames_.erase(frames_.begin(), frames_.end() - 1);
}

/// How wide a cut is that takes `volume` on a way of this length across the axis.
static double width_of_cut(double volume, double depth, double length, double diameter) {
  if (!(depth > 0)) return 0;
  const double area = volume / depth;
  // Of a plunge, the hole's diameter.
  if (length < diameter / 20) return std::min(diameter, 2 * std::sqrt(area / std::numbers::pi));
  return std::min(diameter, area / length);
}

static double length_across_axis(const SweepPath& path) {
  if (const auto* const straight = std::get_if<stock::StraightPath>(&path))
    return straight->from.axis.cross(straight->to - straight->from.origin).norm();
  return length_of(path);
}

/// How a cut is, of what it has removed. The dexels measure the depth of a cut from above. Where the tool lies flatter,
/// they measure across it, which is the width, and the depth follows from the volume.
static Removed removed_by(const SweepOutcome& outcome, const SweepPath& path, double diameter) {
  const bool is_at_rim = !(outcome.inside_depth > 0);
  Removed removed{
      .volume = outcome.volume, .depth = is_at_rim ? outcome.depth : outcome.inside_depth, .is_at_rim = is_at_rim};
  const double length = length_across_axis(path);
  const double steepness = std::abs(axis_of(path).z());
  if (!is_lying(axis_of(path))) {
    removed.width = width_of_cut(outcome.volume, removed.depth, length, diameter);
    return removed;
  }
  removed.depth = 0;
  const bool is_plunge = length < diameter / 20 && length_of(path) > length;
  // At the begin of a slot the crescent before the cutter is not as wide as the slot.
  const bool is_straight = std::holds_alternative<stock::StraightPath>(path);
  if (!is_plunge && (!is_straight || length < diameter / 2)) return removed;
  removed.width = std::min(diameter, outcome.length * std::sqrt(1 - steepness * steepness));
  // Slivers, as an earlier cut has left them, have no depth.
  if (removed.width < diameter / 20) return {.volume = outcome.volume};
  const double area = is_plunge ? removed.width * removed.width * std::numbers::pi / 4 : removed.width * length;
  removed.depth = area > 0 ? outcome.volume / area : 0;
  return removed;
}

/// What the mounted tool has removed.
RemovedByTool& MaterialCheck::work_of_tool() {
  if (!tool_) {
    const auto known =
        std::find_if(by_tool_.begin(), by_tool_.end(), [&](const RemovedByTool& each) { return each.tool == code_; });
    tool_ = static_cast<std::size_t>(known - by_tool_.begin());
    if (known == by_tool_.end()) by_tool_.push_back({.tool = code_});
  }
  return by_tool_[*tool_];
}

/// Notes what a cut has removed.
void MaterialCheck::account(std::size_t sweep, const SweepOutcome& outcome) {
  if (!outcome.meets()) return;
  const SweepUse& use = sweeps_.uses()[sweep];
  const UncutStretch& stretch = waiting_[use.last];
  const Removed removed = use.role == Role::Rest ? Removed{.volume = outcome.volume}
                                                 : removed_by(outcome, sweeps_.sweeps()[sweep].path,
                                                              2 * sweeps_.sweeps()[sweep].body->maximum_radius());
  if (notes_stretches_) by_stretch_[by_stretch_.size() - waiting_.size() + use.last].add(removed);
  RemovedByTool& tool = work_of_tool();
  tool.removed.add(removed);
  if (use.role == Role::Rest) return;
  const double end_time = end_of_use(use);
  tool.seconds += end_time - start_of_use(use);
  if (by_line_.empty() || by_line_.back().line != stretch.line) by_line_.push_back({.line = stretch.line});
  by_line_.back().end_time = end_time;
  by_line_.back().removed.add(removed);
}

void MaterialCheck::look_at(std::size_t sweep, const SweepOutcome& outcome) {
  switch (sweeps_.uses()[sweep].role) {
    case Role::Cut:
      if (outcome.inside_depth > depth_limit(setting())) {
        SweepOutcome inside = outcome;
        inside.depth = outcome.inside_depth;
        inside.point = outcome.inside_point;
        touch({IncidentKind::CutTooDeep, ToolPart::Cutter}, sweep, inside);
      }
      break;
    case Role::Rest:
      break;
    case Role::RapidCutter:
      return touch({IncidentKind::RapidInMaterial, ToolPart::Cutter}, sweep, outcome);
    case Role::StandingCutter:
      return touch({IncidentKind::SpindleStopped, ToolPart::Cutter}, sweep, outcome);
    case Role::Shank:
      return touch({IncidentKind::BodyInMaterial, ToolPart::Shank}, sweep, outcome);
    case Role::ShankWall:
      return touch({IncidentKind::EdgeTooShort, ToolPart::Shank}, sweep, outcome);
    case Role::Holder:
      return touch({IncidentKind::BodyInMaterial, ToolPart::Holder}, sweep, outcome);
    case Role::HolderNear:
      return touch({IncidentKind::NearMaterial, ToolPart::Holder}, sweep, outcome);
    case Role::Nose:
      return touch({IncidentKind::BodyInMaterial, ToolPart::Nose}, sweep, outcome);
    case Role::NoseNear:
      return touch({IncidentKind::NearMaterial, ToolPart::Nose}, sweep, outcome);
  }
}

void MaterialCheck::touch(const IncidentKey& key, std::size_t sweep, const SweepOutcome& outcome) {
  const SweepUse& use = sweeps_.uses()[sweep];
  const UncutStretch& first_stretch = waiting_[use.first];
  const UncutStretch& stretch = waiting_[use.last];
  const std::size_t number = cut_ + use.first;
  const bool is_body = key.first == IncidentKind::BodyInMaterial;
  const auto [known, is_new] = open_.try_emplace({key.first, is_body ? ToolPart::Shank : key.second});
  OpenIncident& episode = known->second;
  // A short motion may meet no dexel.
  const double shortest = 2 * stock_.spacing();
  const bool goes_on =
      !is_new && (number <= episode.last_stretch + 1 || first_stretch.way < episode.last_way + shortest);
  if (!is_new && !goes_on) close(episode);
  if (!goes_on) {
    episode = {.incident = {.kind = key.first,
                            .part = key.second,
                            .line = stretch.line,
                            .time = start_of_use(use),
                            .tool = code_},
               .line_before = stretch.line,
               .begins_in_feed = stretch.is_feed,
               .first_stretch = number};
    if (key.first == IncidentKind::SpindleStopped) episode.incident.shaped_by = first_stretch.spindle_stopped_by;
  }
  Incident& incident = episode.incident;
  // On the way straight up, a body that does not cut is deepest where that begins.
  double length = 0;
  double rise = 0;
  for (std::size_t i = use.first; i <= use.last; ++i) {
    length += waiting_[i].length;
    rise += waiting_[i].rise;
  }
  const bool is_way_out = goes_on && is_body && length > 0 && rise > 0.999 * length;
  if (goes_on && stretch.line != incident.end_line) episode.line_before = incident.end_line;
  const std::size_t line = is_way_out ? episode.line_before : stretch.line;
  const double time = is_way_out ? first_stretch.stretch.start : start_of_use(use);
  const auto is_of_part = [&](const FirstSweep& each) { return each.part == key.second; };
  if (number == episode.first_stretch &&
      std::none_of(episode.first_sweeps.begin(), episode.first_sweeps.end(), is_of_part))
    episode.first_sweeps.push_back({.part = key.second, .sweep = sweep});
  episode.last_stretch = cut_ + use.last;
  episode.last_way = stretch.way + stretch.length;
  incident.end_line = stretch.line;
  incident.end_time = end_of_use(use);
  // Dexels do not measure along a tool that lies: there, how far it goes does. It counts for bodies that do not cut as
  // well: a motion meets what it passes alone, and a plunge in two motions is as deep as one.
  const SweepPath& path = sweeps_.sweeps()[sweep].path;
  const Vec3 axis = axis_of(path);
  const bool lies = is_lying(axis);
  const double reach = -lowest_along(path, axis);
  const double deep = lies ? reach : outcome.depth;
  const PartStart first{.axis = axis, .reach = reach, .depth = lies ? 0 : deep};
  const PartStart& start = episode.starts.try_emplace(key.second, first).first->second;
  const bool is_comparable = lies || (is_body && start.axis.dot(axis) > 1 - 1e-9);
  double depth = is_comparable ? std::max(0.0, start.depth + reach - start.reach) : 0;
  if (!lies && !is_way_out) depth = std::max(depth, deep);
  // Of what stays near, the nearest place says all.
  if (incident.levels.empty() || key.first != IncidentKind::NearMaterial)
    take_depth(incident.levels, {.line = line,
                                 .part = static_cast<std::size_t>(key.second),
                                 .depth = depth,
                                 .frame = frames_[stretch.frame],
                                 .is_in_inches = stretch.is_in_inches,
                                 .deepest = {.depth = (lies ? depth : deep) + forms_->skin(key.second),
                                             .line = line,
                                             .time = time,
                                             .point = in_machine(outcome.point)}});
  if (goes_on && !(deep > episode.deepest)) return;
  episode.deepest = deep;
  incident.part = key.second;
  incident.amount = outcome.depth;
  incident.point = in_machine(outcome.point);
  incident.frame = frames_[stretch.frame];
  incident.is_in_inches = stretch.is_in_inches;
  incident.worst_line = line;
  incident.worst_time = time;
  episode.deepest_sweep = sweep;
}

/// Feed motions that meet nothing, one after another, are one.
void MaterialCheck::note_ways(const std::vector<bool>& has_cut) {
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const UncutStretch& each = waiting_[i];
    if (!each.is_feed || has_cut[i]) {
      end_way();
      continue;
    }
    if (!way_)
      way_ = {.kind = IncidentKind::CutsNothing,
              .line = each.line,
              .time = each.stretch.start,
              .tool = code_,
              .is_in_inches = each.is_in_inches};
    way_->end_line = each.line;
    way_->end_time = each.stretch.start + each.stretch.duration;
    way_->amount += each.length;
  }
}

void MaterialCheck::end_way() {
  // A way outside the window may have met something.
  if (way_ && way_->amount > workpiece_.longest_air_cut && !workpiece_.window) keep(*way_);
  way_.reset();
}

/// Which stretches begin at a height to which a cut in feed has led.
void MaterialCheck::note_heights(const std::vector<bool>& has_cut) {
  constexpr double kLevel = 0.01;  // mm
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    UncutStretch& each = waiting_[i];
    each.is_from_cut = is_at_cut_;
    if (each.is_standing || (each.is_feed && has_cut[i])) {
      is_at_cut_ = true;
    } else if (std::abs(each.rise) > kLevel && !is_rounded_corner(each.stretch.path)) {
      is_at_cut_ = false;
    }
  }
}

/// Whether a higher Z would have kept a stretch out of the material: not where the tool is mounted, not on the way out
/// of the material, and not from the place where a cut has ended: its depth is what the workpiece needs.
bool MaterialCheck::does_height_help(const UncutStretch& stretch) {
  if (stretch.is_standing) return false;
  if (stretch.is_feed) return true;
  const bool leads_down = stretch.rise < -0.01 && !is_rounded_corner(stretch.stretch.path);
  const bool leads_out = stretch.rise > 0.7 * stretch.length && stretch.length > 0;
  return !leads_out && (leads_down || !stretch.is_from_cut);
}

/// Goes through the batch once more, up to the sweeps in question: each is compared with the stock as it was then.
void MaterialCheck::look_closely(Stock before) {
  enum class About : std::uint8_t { Before, FirstTouch, Worst };
  struct Question {
    std::size_t sweep;
    OpenIncident* episode;
    About about;
  };
  // What the line itself has cut before it was found to touch anything, at most a skin, has not shaped it.
  const auto first_of_line = [&](std::size_t sweep) {
    const auto line = [&](std::size_t each) { return waiting_[sweeps_.uses()[each].last].line; };
    while (sweep > 0 && line(sweep - 1) == line(sweep)) --sweep;
    return sweep;
  };
  std::vector<Question> questions;
  const auto ask = [&](OpenIncident& episode) {
    if (!episode.first_sweeps.empty())
      questions.push_back({first_of_line(episode.first_sweeps.front().sweep), &episode, About::Before});
    for (const FirstSweep& first : episode.first_sweeps)
      questions.push_back({first.sweep, &episode, About::FirstTouch});
    if (episode.deepest_sweep) questions.push_back({*episode.deepest_sweep, &episode, About::Worst});
  };
  for (auto& [key, episode] : open_) ask(episode);
  for (OpenIncident& episode : closed_) ask(episode);
  std::stable_sort(questions.begin(), questions.end(),
                   [](const Question& a, const Question& b) { return a.sweep < b.sweep; });
  std::size_t done = 0;
  std::vector<Sweep> cuts;
  for (const Question& question : questions) {
    if (looked_at_ >= kMaxLookedAt) break;
    cuts.clear();
    for (; done < question.sweep; ++done)
      if (sweeps_.sweeps()[done].purpose == SweepPurpose::Cut) cuts.push_back(sweeps_.sweeps()[done]);
    if (!cuts.empty()) before.apply(cuts, workers_);
    switch (question.about) {
      case About::Before:
        question.episode->before = before;
        break;
      case About::FirstTouch:
        note_first_touch(*question.episode, closer_look().first_touch(question.sweep, before));
        break;
      case About::Worst:
        ++looked_at_;
        find_worst(*question.episode, before);
        break;
    }
  }
  for (auto& [key, episode] : open_) {
    episode.first_sweeps.clear();
    episode.deepest_sweep.reset();
  }
  for (OpenIncident& episode : closed_) keep(episode.incident);
  closed_.clear();
}

/// When the machine is at the start of a sweep, seconds.
double MaterialCheck::start_of_use(const SweepUse& use) const { return waiting_[use.first].stretch.time_at(use.from); }

double MaterialCheck::end_of_use(const SweepUse& use) const { return waiting_[use.last].stretch.time_at(use.to); }

CloserLook MaterialCheck::closer_look() const { return {setting(), machine_.motion.rapid_motion, sweeps_, waiting_}; }

void MaterialCheck::note_first_touch(OpenIncident& episode, double time) {
  episode.first_touch = std::min(time, episode.first_touch.value_or(time));
  episode.incident.time = *episode.first_touch;
}

/// Takes over what is known exactly of the worst place; nothing of what is known roughly is deeper.
static void tell_exactly(Incident& incident) {
  for (DepthLevel& level : incident.levels) {
    level.deepest.depth = std::min(level.deepest.depth, incident.amount);
    if (level.part != static_cast<std::size_t>(incident.part) || level.deepest.line != incident.worst_line) continue;
    level.deepest.time = incident.worst_time;
    level.deepest.point = incident.point;
  }
}

void MaterialCheck::find_worst(OpenIncident& episode, const Stock& before) {
  const std::size_t index = *episode.deepest_sweep;
  const SweepUse& use = sweeps_.uses()[index];
  const SweepPath& path = sweeps_.sweeps()[index].path;
  Incident& incident = episode.incident;
  const CloserLook look = closer_look();
  const auto set_shaper = [&] {
    const Vec3 point = incident.point - workpiece_.origin;
    if (incident.kind == IncidentKind::SpindleStopped) return;
    incident.shaped_by.reset();
    // As it was found: meanwhile the motion itself has cut.
    const Stock& found = episode.before ? *episode.before : before;
    if (const auto tag = found.cut_by(point.x(), point.y())) incident.shaped_by = *tag;
  };
  if (use.role != Role::Cut) {
    // The batch has found roughly how deep.
    const SweepOutcome exact = ask(before, *sweeps_.sweeps()[index].body, path);
    incident.amount = exact.depth;
    incident.point = in_machine(exact.point);
  }
  set_shaper();
  switch (incident.kind) {
    case IncidentKind::RapidInMaterial:
    case IncidentKind::SpindleStopped:
    case IncidentKind::BodyInMaterial: {
      // The whole body meets more than what counts of it.
      const SweepOutcome whole = ask(before, *whole_body(forms_->tool(), incident.part), path);
      if (incident.kind == IncidentKind::RapidInMaterial)
        incident.follows_body = look.has_body_been_there(index, before);
      incident.amount = whole.depth;
      incident.point = in_machine(whole.point);
      break;
    }
    case IncidentKind::EdgeTooShort: {
      const double edge = forms_->tool().cutter->top();
      incident.limit = edge;
      // The dexels do not measure along a tool that lies.
      const Vec3 axis = axis_of(path);
      if (is_lying(axis)) incident.amount = enough_rise(before, *sweeps_.sweeps()[index].body, path, axis).value_or(0);
      incident.amount += edge;
      break;
    }
    case IncidentKind::CutTooDeep:
      incident.limit = forms_->tool().max_depth;
      break;
    case IncidentKind::NearMaterial: {
      double clear = 0;
      double near = workpiece_.clearance;
      for (int i = 0; i < 10; ++i) {
        const double middle = (clear + near) / 2;
        (meets(before, grown(*whole_body(forms_->tool(), incident.part), middle), path) ? near : clear) = middle;
      }
      incident.amount = near;
      break;
    }
    default:
      break;
  }
  const Vec3 up = incident.frame.axes.col(2);
  const double lowest = lowest_along(look.tip_path(index), up);
  incident.level = lowest + up.dot(workpiece_.origin - incident.frame.origin);
  const bool is_hit = incident.kind == IncidentKind::RapidInMaterial || incident.kind == IncidentKind::BodyInMaterial;
  if (!is_hit) return;
  // Of rapids, in what the first of them has found: they have cut since.
  const bool is_of_rapids = incident.kind == IncidentKind::RapidInMaterial && episode.before;
  const Stock& found = is_of_rapids ? *episode.before : before;
  const bool lies = is_lying(up) || is_lying(axis_of(path));
  if (!lies) {
    // On the way up, the place before it counts. Where a block ends, the next one begins, and its line would be shown.
    if (incident.worst_line == waiting_[use.last].line) {
      const double time = look.first_time_as_deep(index, before, incident.amount);
      incident.worst_time = std::max(start_of_use(use), std::min(time, end_of_use(use) - 1e-6));
    }
    tell_exactly(incident);
  }
  incident.enough.reset();
  // The dexels do not measure along a tool that lies, and beside them the material, or the edge of a tilted tool, goes
  // on for half a spacing, or up to the next one.
  const double upright = std::abs(axis_of(path).z());
  const double edge = stock_.spacing() * std::sqrt(1 - upright * upright) * upright;
  const double aside = std::max(stock_.spacing() / 2 * (1 - std::abs(up.z())), edge / std::max(std::abs(up.z()), 0.5));
  const double margin = forms_->skin(incident.part) + aside;
  if (lies) {
    const std::optional<double> rise = enough_rise(found, *sweeps_.sweeps()[index].body, path, up);
    if (rise) incident.amount = *rise + margin;
  }
  if (!episode.begins_in_feed && !does_height_help(waiting_[use.last])) return;
  const std::optional<double> enough = look.enough_level(index, found, incident.frame, margin);
  if (enough) incident.enough = std::ceil((*enough - 0.01) * 10) / 10 + 0.0;  // No -0.
}

void MaterialCheck::close(OpenIncident& episode) {
  // What the present batch has shown of it is still to be looked at.
  if (!episode.first_sweeps.empty() || episode.deepest_sweep) {
    closed_.push_back(episode);
  } else {
    keep(episode.incident);
  }
}

void MaterialCheck::close_all() {
  end_way();
  for (auto& [key, episode] : open_) close(episode);
  open_.clear();
}

void MaterialCheck::keep(Incident incident) {
  if (kept_.keeps({incident.kind, incident.part, incident.tool})) incidents_.push_back(std::move(incident));
}

/// Whether an incident says what another one of the same moment says better: a tool that is too deep is so with all of
/// its parts.
static bool is_said_by(const Incident& each, const Incident& other) {
  // The cutter removes in rapid what the shank would still meet: its contact ends on the way.
  if (each.follows_body)
    return other.kind == IncidentKind::BodyInMaterial && each.tool == other.tool && other.time <= each.time &&
           other.end_line >= each.line;
  const bool is_meanwhile = each.tool == other.tool && each.time <= other.end_time && other.time <= each.end_time;
  if (!is_meanwhile) return false;
  // What a rapid meets later does not say what has begun before it.
  const bool is_of_rapid =
      other.kind == IncidentKind::RapidInMaterial && (other.time <= each.time || other.line == each.line);
  const bool is_begun_by_rapid = is_of_rapid && !other.follows_body;
  switch (each.kind) {
    case IncidentKind::NearMaterial:
      return other.kind == IncidentKind::BodyInMaterial || other.kind == IncidentKind::RapidInMaterial ||
             (other.kind == IncidentKind::NearMaterial && other.part < each.part);
    case IncidentKind::EdgeTooShort:
      return other.kind == IncidentKind::BodyInMaterial || other.kind == IncidentKind::CutTooDeep || is_begun_by_rapid;
    case IncidentKind::CutTooDeep:
      // Also one on the way out of where a shank is, which goes with that.
      return is_of_rapid;
    case IncidentKind::BodyInMaterial:
      return is_begun_by_rapid;
    default:
      return false;
  }
}

static void drop_said_twice(std::vector<Incident>& incidents) {
  const std::vector<Incident> all = incidents;  // By time.
  double longest = 0;
  for (const Incident& each : all) longest = std::max(longest, each.end_time - each.time);
  std::erase_if(incidents, [&](const Incident& each) {
    const auto first =
        each.follows_body ? all.begin() : std::partition_point(all.begin(), all.end(), [&](const Incident& other) {
          return other.time < each.time - longest;
        });
    for (auto other = first; other != all.end() && other->time <= each.end_time; ++other)
      if (is_said_by(each, *other)) return true;
    return false;
  });
}

void MaterialCheck::compare_with_target() {
  if (!workpiece_.target) return;
  for (const LeftRegion& region : left_on_target(stock_, *workpiece_.target, workpiece_.tolerance)) {
    const std::size_t line = region.last_cut.value_or(static_cast<stock::CutTag>(last_line_));
    keep({.kind = IncidentKind::MaterialLeft,
          .line = line,
          .end_line = line,
          .time = last_time_,
          .end_time = last_time_,
          .tool = code_,
          .amount = region.height,
          .volume = region.volume,
          .limit = workpiece_.tolerance,
          .point = in_machine(region.point),
          .frame = last_frame_,
          .is_in_inches = is_in_inches_});
  }
}

void MaterialCheck::look_for_loose_pieces() {
  for (const stock::StockPiece& piece : loose_pieces(stock_, workpiece_)) {
    const auto is_known = [&](const solids::BoundingBox& box) { return box.contains(piece.bounds); };
    if (std::any_of(loose_.begin(), loose_.end(), is_known)) continue;
    loose_.push_back(piece.bounds);
    Incident incident{.kind = IncidentKind::LoosePiece,
                      .line = stock::last_cut_beside(piece).value_or(static_cast<stock::CutTag>(last_line_)),
                      .time = last_time_,
                      .tool = code_,
                      .amount = piece.bounds.sizes().z(),
                      .volume = piece.volume,
                      .point = in_machine(piece.bounds.center()),
                      .frame = last_frame_,
                      .is_in_inches = is_in_inches_};
    const auto cut = std::partition_point(by_line_.begin(), by_line_.end(),
                                          [&](const LineWork& each) { return each.line < incident.line; });
    if (cut != by_line_.end() && cut->line == incident.line) incident.time = cut->end_time;
    incident.end_line = incident.line;
    incident.end_time = incident.time;
    keep(incident);
  }
}

void MaterialCheck::forget_past() {
  incidents_.clear();
  kept_ = {};
  looked_at_ = 0;
  by_line_.clear();
  by_stretch_.clear();
  notes_stretches_ = true;
}

std::vector<simulation::RemovedOnLine> MaterialCheck::removed_by_line() const {
  std::vector<simulation::RemovedOnLine> lines;
  for (const auto& [line, end_time, removed] : by_line_)
    lines.push_back({line, removed.volume, removed.depth, removed.width});
  return lines;
}

std::vector<Incident> MaterialCheck::incidents_so_far() const {
  std::vector<Incident> all = incidents_;
  for (const auto& [key, episode] : open_) all.push_back(episode.incident);
  std::stable_sort(all.begin(), all.end(), [](const Incident& a, const Incident& b) { return a.time < b.time; });
  drop_said_twice(all);
  return all;
}

void MaterialCheck::finish() {
  finish_tool();
  if (watcher_ && has_cuts_to_show_) watcher_(stock_, last_time_);
  close_all();
  look_for_loose_pieces();
  std::stable_sort(incidents_.begin(), incidents_.end(),
                   [](const Incident& a, const Incident& b) { return a.time < b.time; });
  drop_said_twice(incidents_);
  compare_with_target();
}

}  // namespace isocnc::removal
