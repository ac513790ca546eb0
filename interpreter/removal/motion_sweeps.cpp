#include "interpreter/removal/motion_sweeps.h"

#include <algorithm>

namespace isocnc::removal {

using geometry::Vec3;
using solids::RevolvedBody;
using stock::Sweep;
using stock::SweepPath;
using stock::SweepPurpose;
using Role = SweepRole;

/// Ways on which nothing may be cut, of which the rest is removed later, at most.
static constexpr std::size_t kMostPassed = 256;
/// Pieces of a rapid that wait for its end, at most.
static constexpr std::size_t kMostOfRapid = 4096;
/// What is cut of a wall counts as a pass of its depth if it is wider than this part of the cutter's radius: what a
/// finishing pass takes off a stepped wall does not.
static constexpr double kRimShare = 0.1;
/// How far one piece may be from those for which it stands, along a dexel while the axis rests, mm.
static constexpr double kHeightTolerance = 0.001;
/// Stretches whose sweeps one thread makes at once, and the least for which that is worth it.
static constexpr std::size_t kPart = 256;
static constexpr std::size_t kLeastPart = 64;

/// An eighth of the spacing by the pieces of paths and of motions that turn the axis, and a little for rounding.
double rim_of(double spacing) { return spacing / 8 + 0.002; }

double depth_limit(const SweepSetting& setting) { return setting.forms.tool().max_depth + rim_of(setting.spacing); }

const RevolvedBody* removing_cutter(const ToolForms& forms, Cutting cutting) {
  const bool is_thinner = cutting != Cutting::Allowed && forms.passing_cutter();
  return is_thinner ? forms.passing_cutter() : forms.cutter();
}

SweepPath placed(const ToolForms& forms, const SweepPath& tip, SweepRole role) {
  const bool is_nose = role == Role::Nose || role == Role::NoseNear;
  return is_nose ? shifted_along_axis(tip, forms.tool().length) : tip;
}

bool may_meet(const SweepSetting& setting, const RevolvedBody& body, const SweepPath& path, double margin) {
  const double top = setting.top + margin;
  if (const auto* const turning = std::get_if<stock::TurningPath>(&path)) {
    const auto middle = [&](const solids::AxisPlacement& at) { return (at.origin + body.middle() * at.axis).z(); };
    // While the axis turns, the middle of the body leaves its chord.
    const double bulge = std::abs(body.middle()) * (1 - turning->from.axis.dot(turning->to.axis));
    return std::min(middle(turning->from), middle(turning->to)) - bulge - body.sphere_radius() < top;
  }
  const Vec3 axis = axis_of(path);
  const double lowest = lowest_along(path, Vec3(0, 0, 1));
  if (axis.z() == 1) return lowest + body.bottom() < top;
  return lowest + body.middle() * axis.z() - body.sphere_radius() < top;
}

/// A long tool needs many pieces while its axis turns, but where only the cutter may come near the blank, those that it
/// needs are enough.
void divide(const SweepSetting& setting, const UncutStretch& stretch, double to, std::vector<TipPath>& pieces) {
  const ToolForms& forms = setting.forms;
  const double tolerance = setting.spacing * kPathShare;
  const double reach = forms.reach();
  const double cutter_reach = forms.cutter_reach();
  const auto append = [&](const ToolReach& of) {
    pieces.clear();
    append_tip_paths(setting.kinematics, stretch.stretch.path, stretch.from, to, of, tolerance, pieces);
    for (TipPath& piece : pieces) piece.path = moved(std::move(piece.path), -setting.origin);
  };
  if (stretch.is_standing) {
    const solids::AxisPlacement at = placement_on(setting.kinematics, stretch.stretch.path, stretch.from);
    const solids::AxisPlacement in_workpiece{at.origin - setting.origin, at.axis};
    pieces = {{.path = stock::StraightPath{in_workpiece, in_workpiece.origin}}};
    return;
  }
  if (!(cutter_reach > 0)) return append({.distance = reach});
  append(
      {.distance = cutter_reach, .top = setting.top + setting.origin.z(), .radius = forms.cutter()->maximum_radius()});
  if (!(cutter_reach < reach)) return;
  if (pieces.empty() || !std::holds_alternative<stock::TurningPath>(pieces.front().path)) return;
  // How far a point of the tool may be from where these pieces have it: within the tolerance at both ends of what
  // matters of the cutter, and beyond as on a line through them. Where one piece stands for several, it is off as much
  // again.
  const double error = 4 * tolerance * reach / pieces.front().reach;
  const bool is_cutter_alone = std::none_of(pieces.begin(), pieces.end(), [&](const TipPath& piece) {
    const auto is_near = [&](const RevolvedBody* body, Role role) {
      return body && may_meet(setting, *body, placed(forms, piece.path, role), error);
    };
    return is_near(forms.shank(), Role::Shank) || is_near(forms.shank_with_wall(), Role::ShankWall) ||
           is_near(forms.holder(), Role::Holder) || is_near(forms.holder_with_clearance(), Role::HolderNear) ||
           is_near(forms.nose(), Role::Nose) || is_near(forms.nose_with_clearance(), Role::NoseNear);
  });
  if (!is_cutter_alone) append({.distance = reach});
}

/// Whether a path bends by more than 10 degrees between two path parameters.
static bool bends(const kinematics::Path& path, double from, double to) {
  if (path.kind == kinematics::PathKind::Polynomial && !is_rounded_corner(path)) return false;
  const Vec3 before = path.at(from).first.head<3>();
  const Vec3 after = path.at(to).first.head<3>();
  return before.dot(after) < 0.985 * before.norm() * after.norm();
}

/// Appends to sweeps, of given stretches.
class MotionSweeps::SweepWriter {
 public:
  SweepWriter(MotionSweeps& all, const SweepSetting& setting, std::span<const UncutStretch> waiting)
      : all_(all), setting_(setting), forms_(setting.forms), waiting_(waiting) {}

  /// Sets what is known of the stretch now, which is one of those that wait.
  void append(UncutStretch& stretch) {
    const auto index = static_cast<std::size_t>(&stretch - waiting_.data());
    divide(setting_, stretch, stretch.to, pieces_);
    if (stretch.is_feed) append_rapid();
    if (!pieces_.empty()) append_pieces(stretch, index);
    // An open part begins with a stretch, so that it is clear which ones may be cut before it.
    if (all_.joined_ && all_.joined_->first == index && all_.joined_->from != stretch.from) append_joined();
    if (!(stretch.stretch.ends_move || stretch.is_standing)) return;
    append_joined();
    append_rapid();
  }

  /// Whether a motion has had a path.
  bool has_paths() const { return has_paths_; }

  void append_joined() {
    if (!all_.joined_) return;
    const JoinedPieces& joined = *all_.joined_;
    const PathOfSweeps path{joined.path.path(), joined.first, joined.from, joined.last, joined.to};
    all_.joined_.reset();
    append_sweeps(path, Cutting::Allowed);
  }

  /// Appends the sweeps of a rapid, which has phases of acceleration and jerk. How deep the cutter goes counts from the
  /// material before all of it: else each phase would meet what the one before has left.
  void append_rapid() {
    if (all_.rapid_.empty()) return;
    change_cutting(Cutting::InRapid, all_.rapid_.front().second);
    const auto path_of = [](const std::pair<TipPath, std::size_t>& each) {
      const auto& [piece, stretch] = each;
      return PathOfSweeps{piece.path, stretch, piece.from, stretch, piece.to};
    };
    for (const auto& each : all_.rapid_) append_sweep(forms_.passing_cutter(), path_of(each), Role::RapidCutter);
    for (const auto& each : all_.rapid_) append_sweeps(path_of(each), Cutting::InRapid);
    all_.rapid_.clear();
  }

  /// Before a motion that begins with a stretch.
  void change_cutting(Cutting cutting, std::size_t stretch) {
    if (cutting != all_.cutting_ || all_.passed_.size() >= kMostPassed) append_rest(stretch);
    all_.cutting_ = cutting;
  }

 private:
  void append_pieces(UncutStretch& stretch, std::size_t index) {
    stretch.travel = end_of(pieces_.back().path) - start_of(pieces_.front().path).origin;
    if (all_.joined_ && stretch.stretch.tag != all_.joined_->tag) append_joined();
    if (all_.rapid_.size() >= kMostOfRapid) append_rapid();
    const bool is_in_phases = !stretch.is_feed && setting_.asks;
    for (const TipPath& piece : pieces_) {
      stretch.length += length_of(piece.path);
      if (is_in_phases)
        all_.rapid_.emplace_back(piece, index);
      else if (stretch.is_feed && stretch.cutting == Cutting::Allowed)
        join(piece, index);
      else
        append_sweeps({piece.path, index, piece.from, index, piece.to}, stretch.cutting);
    }
  }

  /// Adds a piece of a feed motion to those before it, of which one sweep is made.
  void join(const TipPath& piece, std::size_t stretch) {
    const JoinedPath::Tolerance tolerance{.aside = setting_.spacing * kPathShare, .in_height = kHeightTolerance};
    if (all_.joined_ && all_.joined_->path.add(piece, tolerance)) {
      all_.joined_->last = stretch;
      all_.joined_->to = piece.to;
      return;
    }
    append_joined();
    all_.joined_ = {.path = JoinedPath(piece),
                    .tag = waiting_[stretch].stretch.tag,
                    .first = stretch,
                    .from = piece.from,
                    .last = stretch,
                    .to = piece.to};
  }

  /// Removes the rest of what the cutter has gone through on the motions before, once they are over.
  void append_rest(std::size_t stretch) {
    const auto index = static_cast<std::uint32_t>(stretch);
    for (Sweep& each : all_.take_rest(forms_)) {
      all_.sweeps_.push_back(std::move(each));
      all_.uses_.push_back({index, index, Role::Rest, 0, 0});
    }
  }

  void append_sweeps(const PathOfSweeps& path, Cutting cutting) {
    has_paths_ = true;
    change_cutting(cutting, path.first);
    const RevolvedBody* const cutter = removing_cutter(forms_, cutting);
    if (cutter && cutter != forms_.cutter() && may_meet(setting_, *cutter, path.tip))
      all_.passed_.push_back({path.tip, tag_of(path)});
    if (!setting_.asks) return append_sweep(cutter, path, Role::Cut);
    // append_rapid() asks for all of its pieces first.
    if (cutting == Cutting::InRapid && all_.rapid_.empty())
      append_sweep(forms_.passing_cutter(), path, Role::RapidCutter);
    if (cutting == Cutting::Standing) append_sweep(forms_.passing_cutter(), path, Role::StandingCutter);
    append_sweep(cutter, path, Role::Cut);
    append_sweep(forms_.shank(), path, Role::Shank);
    append_sweep(forms_.shank_with_wall(), path, Role::ShankWall);
    append_sweep(forms_.holder(), path, Role::Holder);
    append_sweep(forms_.holder_with_clearance(), path, Role::HolderNear);
    append_sweep(forms_.nose(), path, Role::Nose);
    append_sweep(forms_.nose_with_clearance(), path, Role::NoseNear);
  }

  void append_sweep(const RevolvedBody* body, const PathOfSweeps& of, Role role) {
    if (!body) return;
    SweepPath path = placed(forms_, of.tip, role);
    if (!may_meet(setting_, *body, path)) return;
    // With its clearance or its wall, the body that has just been appended.
    const bool is_grown = role == Role::ShankWall || role == Role::HolderNear || role == Role::NoseNear;
    const std::vector<SweepUse>& uses = all_.uses_;
    const bool contains_last = is_grown && !uses.empty() && uses.back().last == of.last &&
                               uses.back().from == of.from &&
                               static_cast<int>(uses.back().role) + 1 == static_cast<int>(role);
    all_.sweeps_.push_back({.body = body,
                            .path = std::move(path),
                            .tag = tag_of(of),
                            .purpose = role == Role::Cut ? SweepPurpose::Cut : SweepPurpose::Find,
                            .side_rim = std::max(setting_.skin, body->maximum_radius() * kRimShare),
                            .end_rim = role == Role::Cut ? end_rim(of) : 0,
                            .depth_limit = depth_limit(setting_),
                            .contains_last = contains_last});
    all_.uses_.push_back(
        {static_cast<std::uint32_t>(of.first), static_cast<std::uint32_t>(of.last), role, of.from, of.to});
  }

  stock::CutTag tag_of(const PathOfSweeps& path) const { return static_cast<stock::CutTag>(waiting_[path.last].line); }

  /// Of a short way in full material only the crescent in front of the body is new: there, half of it counts. But where
  /// the machine turns round a corner, another pass may have gone a little less far.
  double end_rim(const PathOfSweeps& path) const {
    const double half = length_of(path.tip) / 2;
    if (half >= setting_.skin) return setting_.skin;
    for (std::size_t i = path.first; i <= path.last; ++i) {
      const UncutStretch& each = waiting_[i];
      if (bends(each.stretch.path, i == path.first ? path.from : each.from, i == path.last ? path.to : each.to))
        return setting_.skin;
    }
    return half;
  }

  MotionSweeps& all_;
  const SweepSetting& setting_;
  const ToolForms& forms_;
  std::span<const UncutStretch> waiting_;
  std::vector<TipPath> pieces_;
  bool has_paths_ = false;
};

namespace {

/// Stretches that follow one another. Of those that are independent, sweeps can be made without knowing those before.
struct StretchRun {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool is_independent = false;
};

/// Whole feed motions that may cut are independent; the last motion may go on, as the first may have begun before.
std::vector<StretchRun> runs_of(std::span<const UncutStretch> waiting, std::size_t first) {
  std::vector<StretchRun> runs;
  for (std::size_t begin = first, end = 0; begin < waiting.size(); begin = end) {
    const UncutStretch& each = waiting[begin];
    for (end = begin + 1; end < waiting.size() && waiting[end].stretch.tag == each.stretch.tag; ++end) {
    }
    const bool is_independent =
        begin > first && end < waiting.size() && each.is_feed && each.cutting == Cutting::Allowed && !each.is_standing;
    const bool goes_on = !runs.empty() && runs.back().is_independent == is_independent &&
                         !(is_independent && runs.back().end - runs.back().begin >= kPart);
    if (goes_on) {
      runs.back().end = end;
    } else {
      runs.push_back({begin, end, is_independent});
    }
  }
  for (StretchRun& run : runs) run.is_independent = run.is_independent && run.end - run.begin >= kLeastPart;
  return runs;
}

}  // namespace

void MotionSweeps::append(const SweepSetting& setting, std::span<UncutStretch> waiting, std::size_t first,
                          const stock::Workers& workers) {
  const std::vector<StretchRun> runs =
      workers ? runs_of(waiting, first) : std::vector<StretchRun>{{first, waiting.size(), false}};
  std::vector<MotionSweeps> parts(runs.size());
  std::vector<char> have_paths(runs.size());
  stock::for_each_number(workers, runs.size(), [&](std::size_t i) {
    if (!runs[i].is_independent) return;
    SweepWriter writer(parts[i], setting, waiting);
    for (UncutStretch& each : waiting.subspan(runs[i].begin, runs[i].end - runs[i].begin)) writer.append(each);
    writer.append_joined();
    have_paths[i] = static_cast<char>(writer.has_paths());
  });
  SweepWriter writer(*this, setting, waiting);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].is_independent) {
      for (UncutStretch& each : waiting.subspan(runs[i].begin, runs[i].end - runs[i].begin)) writer.append(each);
      continue;
    }
    if (have_paths[i] == 0) continue;
    writer.append_joined();
    writer.append_rapid();
    writer.change_cutting(Cutting::Allowed, runs[i].begin);
    sweeps_.insert(sweeps_.end(), parts[i].sweeps_.begin(), parts[i].sweeps_.end());
    uses_.insert(uses_.end(), parts[i].uses_.begin(), parts[i].uses_.end());
  }
}

void MotionSweeps::append_rest_of_motion(const SweepSetting& setting, std::span<const UncutStretch> waiting) {
  SweepWriter writer(*this, setting, waiting);
  writer.append_joined();
  writer.append_rapid();
}

std::vector<Sweep> MotionSweeps::take_rest(const ToolForms& forms) {
  std::vector<Sweep> rest;
  for (PassedPath& each : passed_)
    rest.push_back({.body = forms.cutter(), .path = std::move(each.path), .tag = each.tag});
  passed_.clear();
  return rest;
}

std::optional<MotionSweeps::OpenPart> MotionSweeps::open_part() const {
  if (joined_) return OpenPart{.first = joined_->first, .paths = {joined_->path.path()}};
  if (rapid_.empty()) return std::nullopt;
  OpenPart open{.first = rapid_.front().second, .paths = {}};
  for (const auto& [piece, stretch] : rapid_) open.paths.push_back(piece.path);
  return open;
}

void MotionSweeps::clear() {
  sweeps_.clear();
  uses_.clear();
  if (joined_) {
    joined_->last -= joined_->first;
    joined_->first = 0;
  }
  const std::size_t gone = rapid_.empty() ? 0 : rapid_.front().second;
  for (auto& [piece, stretch] : rapid_) stretch -= gone;
}

}  // namespace isocnc::removal
