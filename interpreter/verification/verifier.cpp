#include "interpreter/verification/verifier.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "interpreter/running/runner.h"
#include "interpreter/text/characters.h"

namespace isocnc::verification {

using geometry::Vec3;

/// Stretches that are examined one after another, by one thread. Each part starts without knowledge of distances, so
/// that the result is the same however many threads there are.
static constexpr std::size_t kPart = 1024;
/// Stretches that wait at most.
static constexpr std::size_t kBatch = 4 * kPart;

Verifier::Verifier(const Scene& scene, const timing::TimedMachine& machine, const Vec3& origin,
                   WorkTogether work_together, const MaterialOptions& material)
    : scene_(scene),
      machine_(machine),
      origin_(origin),
      work_together_(std::move(work_together)),
      joints_(inverse(machine.motion.kinematics, kinematics::coordinates(machine.home), 0)),
      bodies_(pairs_of(scene, machine.motion.kinematics, {}, origin)) {
  certificate_.epsilon = kContactDistance / 2;
  certificate_.scene = scene.name;
  certificate_.has_setup = scene.has_setup;
  certificate_.is_setup_empty = scene.has_setup && scene.setup.empty();
  certificate_.has_nose = scene.nose.has_value();
  for (const MachineBodies& each : scene.at_home.touching)
    certificate_.touching.emplace_back(scene.machine[each.moving].name, scene.machine[each.other].name);
  std::optional<removal::Workpiece> workpiece = workpiece_of(scene, origin, material);
  if (!workpiece) return;
  if (workpiece->window) certificate_.window = workpiece->window;
  // Where many programs are verified, the window may be beside the blank of one.
  certificate_.is_window_empty = stock::bounds_of(workpiece->blank, workpiece->window).isEmpty();
  if (certificate_.is_window_empty) return;
  if (const auto coarser = coarser_spacing(*workpiece)) {
    certificate_.gaps.push_back({.gap = Gap::ResolutionTooFine, .line = 0, .spacing = *coarser});
    return;
  }
  material_.emplace(*std::move(workpiece), machine, work_together_);
}

void Verifier::take(const motion::Stretch& stretch, const removal::MotionFacts& motion) {
  if (stretch.ends_move) ++certificate_.motions;
  if (!is_place_known_ && motion.is_at_known_place) arrive_at_known_place();
  stretches_.push_back(stretch);
  waiting_.push_back({.line = motion.line, .frame = frames_.size() - 1, .is_in_inches = motion.is_in_inches});
  if (material_) material_->take(stretch, motion, frames_.back());
  if (stretches_.size() == kBatch) examine_waiting();
}

void Verifier::take(const timing::TimedEvent& event) {
  if (const auto* const frame = std::get_if<running::FrameEvent>(&event.event.what)) frames_.push_back(frame->in_force);
  if (const auto* const tool = std::get_if<running::ToolEvent>(&event.event.what)) mount(tool->tool, event);
  // Without a stretch, too: what is no motion with a length of 0 may be one.
  if (event.move && !event.is_at_known_place()) {
    note_unknown_place(event.event.line);
    is_unknown_before_ = event.unknown_offset && !event.unknown_offset->along.isZero(0);
  }
  if (material_) material_->take(event);
}

void Verifier::take_end(const removal::MotionFacts& motion, double time) {
  if (material_) material_->take_end(motion, time);
}

MountedTool mounted_tool(const Scene& scene, const timing::TimedMachine& machine, const execution::ToolCode& tool,
                         bool is_place_known) {
  const auto known = scene.tools.find(tool);
  const timing::ToolLength length = machine.length_of(tool);
  return {.bodies = known == scene.tools.end() ? nullptr : &known->second,
          .name = tool == execution::ToolCode() ? std::string() : running::tool_name(tool),
          .length = length.mm,
          .is_place_known = length.is_known && is_place_known};
}

/// The machine as it stands at `time`.
static motion::Stretch rest_at(const kinematics::Coordinates& joints, double tool_length, double time) {
  motion::Stretch rest{.start = time, .phase_count = 1};
  rest.path.is_of_joints = true;
  rest.path.c[0] = joints;
  rest.path.tool_length = tool_length;
  return rest;
}

void Verifier::mount(const execution::ToolCode& tool, const timing::TimedEvent& timed) {
  const running::Event& event = timed.event;
  const double time = timed.start + timed.duration;
  examine_waiting();
  log_.close_all();
  const bool has_known_length = machine_.length_of(tool).is_known;
  if (!timed.ends_at_known_place && !machine_.length_of(tool_).is_known && !is_unknown_before_) unknown_after_ = tool_;
  is_unknown_before_ = timed.unknown_offset && !timed.unknown_offset->along.isZero(0);
  if (timed.ends_at_known_place || !has_known_length) {
    unknown_from_.reset();
  } else if (!unknown_from_) {
    unknown_from_ = event.line;
    is_unknown_noted_ = false;
  }
  tool_ = tool;
  const MountedTool mounted = mounted_tool(scene_, machine_, tool, timed.ends_at_known_place);
  is_place_known_ = mounted.is_place_known;
  bodies_ = pairs_of(scene_, machine_.motion.kinematics, mounted, origin_);
  if (material_)
    material_->mount(tool, cutting_tool(scene_, mounted), event, time, frames_.back(), timed.ends_at_known_place);
  // What the tool touches where it is mounted.
  stretches_.push_back(rest_at(joints_, mounted.length, time));
  waiting_.push_back({.line = event.line, .frame = frames_.size() - 1, .is_in_inches = event.is_in_inches});
  // Where it is mounted, it may touch something.
  if (unknown_from_ && tool != execution::ToolCode()) note_unknown_place(event.line);
  const bool has_length = mounted.length > 0;
  const bool has_shape = mounted.bodies && mounted.bodies->cutter;
  const bool is_empty = mounted.name.empty();  // After T000000 nothing of a tool is there.
  const bool has_holder = mounted.bodies && mounted.bodies->holder;
  if (is_empty || (has_length && has_shape && has_holder) || !known_gaps_.insert(tool).second) return;
  if (has_length && !has_holder) certificate_.bare_tools.push_back(mounted.name);
  if (has_length && has_shape) return;
  certificate_.gaps.push_back({.gap = has_length ? Gap::ToolWithoutShape : Gap::ToolWithoutLength,
                               .line = event.line,
                               .name = dialect::GivenName::of({mounted.name, mounted.name})});
}

/// Compares from here on what is on the spindle, too.
void Verifier::arrive_at_known_place() {
  examine_waiting();
  unknown_from_.reset();
  is_place_known_ = true;
  bodies_ = pairs_of(scene_, machine_.motion.kinematics, mounted_tool(scene_, machine_, tool_), origin_);
}

/// Notes that a line is not verified for that reason.
void Verifier::note_unknown_place(std::size_t line) {
  if (!unknown_from_) return;
  std::vector<UnknownPlaces>& all = certificate_.unknown_places;
  const std::string after = running::tool_name(unknown_after_);
  auto known = std::find_if(all.begin(), all.end(), [&](const UnknownPlaces& each) { return each.after == after; });
  if (known == all.end()) known = all.insert(all.end(), {.after = after, .lines = {}});
  if (!std::exchange(is_unknown_noted_, true)) known->lines.emplace_back(*unknown_from_, line);
  known->lines.back().second = line;
}

void Verifier::examine_waiting() {
  std::vector<Examined> parts((stretches_.size() + kPart - 1) / kPart);
  stock::for_each_number(work_together_, parts.size(), [&](std::size_t i) {
    const std::span all(stretches_);
    const std::size_t count = std::min(kPart, all.size() - i * kPart);
    parts[i] = examine(all.subspan(i * kPart, count), bodies_, machine_.motion.kinematics);
  });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto place_of = [&](std::size_t stretch) -> StretchPlace {
      const std::size_t index = i * kPart + stretch;
      const WaitingStretch& waiting = waiting_[index];
      return {examined_ + index, waiting.line, frames_[waiting.frame], waiting.is_in_inches};
    };
    log_.take(parts[i].encounters, place_of, bodies_, tool_);
    for (const std::size_t undecided : parts[i].undecided) {
      const std::size_t line = waiting_[i * kPart + undecided].line;
      const auto is_known = [&](const Unverified& each) { return each.gap == Gap::Undecided; };
      if (std::none_of(certificate_.gaps.begin(), certificate_.gaps.end(), is_known))
        certificate_.gaps.push_back({.gap = Gap::Undecided, .line = line});
    }
  }
  examined_ += stretches_.size();
  if (!stretches_.empty()) {
    const motion::Stretch& last = stretches_.back();
    joints_ = last.at(machine_.motion.kinematics, last.start + last.duration).joints;
  }
  stretches_.clear();
  waiting_.clear();
  frames_ = {frames_.back()};
}

void Verifier::finish() {
  examine_waiting();
  log_.close_all();
  contacts_ = log_.contacts();
  certificate_.contacts = log_.contact_count();
  certificate_.more_contacts = log_.left_out();
  if (material_) finish_material();
}

void Verifier::finish_material() {
  material_->finish();
  constexpr double kDiagonal = 1.4142135623730951;
  certificate_.soft_disc = kDiagonal * material_->stock().spacing() + 2 * material_->skin();
  certificate_.soft_depth = material_->skin() + double{stock::Tile::kTouch};
  std::int32_t mistakes = 0;
  for (const Contact& contact : contacts_) mistakes = std::max(mistakes, contact.mistake + 1);
  // One slip repeats with a tool at one height, or until the spindle turns.
  using Cause = std::tuple<removal::IncidentKind, removal::ToolPart, execution::ToolCode, std::int64_t>;
  std::map<Cause, std::int32_t> numbers;
  for (const removal::Incident& incident : material_->incidents()) {
    Contact contact = contact_of(incident, scene_);
    std::int64_t where = std::llround(incident.level * 10);
    if (incident.kind == removal::IncidentKind::SpindleStopped)
      where = static_cast<std::int64_t>(incident.shaped_by.value_or(0));
    if (incident.volume) where = static_cast<std::int64_t>(numbers.size());  // Each for itself.
    const auto next = mistakes + static_cast<std::int32_t>(numbers.size());
    const Cause cause(incident.kind, incident.part, incident.tool, where);
    contact.mistake = numbers.try_emplace(cause, next).first->second;
    if (dialect::definition(contact.id).severity == dialect::Severity::Error) ++certificate_.contacts;
    contacts_.push_back(contact);
  }
  std::stable_sort(contacts_.begin(), contacts_.end(),
                   [](const Contact& a, const Contact& b) { return a.time < b.time; });
  certificate_.more_contacts += material_->left_out();
}

/// Whether the number that begins a text is 92. Blanks and comments mean nothing within a number, and a comment that is
/// not closed takes the rest of its line.
static bool begins_with_92(std::string_view text) {
  static constexpr std::string_view kDigits = "92";
  std::size_t known = 0;
  for (std::size_t at = 0; at < text.size() && !text::is_line_end(text[at]); ++at) {
    const char c = text[at];
    if (c == kDigits[known]) {
      if (++known == kDigits.size()) return true;
    } else if (c == '(') {
      while (at + 1 < text.size() && !text::is_line_end(text[at + 1]) && text[at] != ')') ++at;
    } else if (!text::is_blank(c) && !(known == 0 && (c == '0' || c == '+'))) {
      return false;
    }
  }
  return false;
}

/// Whether a program may have a G92; a glance that saves a run of those that have none. It misses none, and takes those
/// in comments as well.
static bool may_set_origin(std::string_view text) {
  for (const char letter : {'G', 'g'})
    for (std::size_t at = text.find(letter); at != std::string_view::npos; at = text.find(letter, at + 1))
      if (begins_with_92(text.substr(at + 1))) return true;
  return false;
}

Vec3 first_workpiece_origin(std::string_view text, const running::RunOptions& options) {
  if (!may_set_origin(text)) return Vec3::Zero();
  running::RunOptions silent = options;
  silent.before_block = nullptr;
  const running::Program program(text);
  running::Runner runner(program, silent);
  bool has_face = false;
  while (!runner.has_ended()) {
    runner.step();
    for (const running::Event& event : runner.events()) {
      const auto* const frame = std::get_if<running::FrameEvent>(&event.what);
      if (!frame) continue;
      // A face frame and its end leave the workpiece frame as it is.
      if (!frame->face_mounted && !std::exchange(has_face, false)) return frame->workpiece_origin;
      has_face = frame->face_mounted;
    }
  }
  return Vec3::Zero();
}

}  // namespace isocnc::verification
