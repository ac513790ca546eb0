#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/plot/toolpath.h"
#include "interpreter/running/error_message.h"
#include "interpreter/sheet/path_view.h"
#include "interpreter/sheet/sheet.h"
#include "interpreter/sheet/tool_picture.h"
#include "interpreter/simulation/spindle_turn.h"
#include "interpreter/simulation/timed_run.h"
#include "interpreter/text/sha256.h"
#include "interpreter/verification/verifier.h"

namespace isocnc::sheet {

using dialect::Language;
using dialect::Text;
using geometry::Range;
using geometry::Vec3;
using Room = std::array<Range, 3>;

namespace {

constexpr Text kStops{"{} on line {}: {}", "{} alla riga {}: {}"};

/// Sizes of pictures, mm of paper.
constexpr double kAboveWidth = 100;
constexpr double kFrontWidth = 76;
constexpr double kPathHeight = 84;
constexpr double kAround = 0.03;  ///< What is shown beside the work, in proportion to it.
constexpr double kToolWidth = 9;
constexpr double kToolHeight = 13;

/// A range that grows; empty before the first value.
void include(Range& range, bool& has_value, double value) {
  if (!std::exchange(has_value, true)) range = {value, value};
  range.include({value, value});
}

/// Collects the facts of a run.
class FactCollector {
 public:
  explicit FactCollector(const SheetSubject& subject) : subject_(subject) {}

  void take(const simulation::TimedEvent& timed) {
    const double duration = timed.duration + timed.wait;
    seconds_ = std::max(seconds_, timed.start + duration);
    spindle_ = simulation::spindle_after(timed.event, spindle_, speed_);
    std::visit([&](const auto& what) { add(what, timed); }, timed.event.what);
    if (tool_ != kNone) sheet_.tools[tool_].seconds += duration;
  }

  Sheet finish() {
    sheet_.seconds = seconds_;
    sheet_.frames = frames_.frames();
    for (const auto& [number, calls] : calls_) {
      const configuration::NamedFunction* const known = subject_.machine.find_function(number);
      sheet_.functions.push_back({number, known ? known->name : "", calls});
    }
    return std::move(sheet_);
  }
  /// The room of the tip in feed moves, or in all where there are none; machine frame.
  std::optional<Room> room() const { return cut_ ? cut_ : moved_; }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// What is known while it grows.
  struct Seen {
    bool has_speed = false;
    bool has_feed = false;
  };

  template <class What>
  void add(const What&, const simulation::TimedEvent&) {}
  void add(const running::SpindleSpeedEvent& given, const simulation::TimedEvent&) { speed_ = given.speed; }
  void add(const running::FunctionEvent& function, const simulation::TimedEvent&) {
    if (dialect::is_user_function(function.number)) ++calls_[function.number];
  }
  void add(const running::FrameEvent& frame, const simulation::TimedEvent& timed) {
    frames_.take(frame, timed.event.line);
    origin_ = frame.workpiece_origin;
  }
  void add(const running::ToolEvent& event, const simulation::TimedEvent&) {
    const auto known = std::find_if(sheet_.tools.begin(), sheet_.tools.end(),
                                    [&](const SheetTool& each) { return each.code == event.tool; });
    tool_ = static_cast<std::size_t>(known - sheet_.tools.begin());
    if (known == sheet_.tools.end()) {
      sheet_.tools.push_back(described(event.tool));
      seen_.emplace_back();
    }
    ++sheet_.tools[tool_].uses;
  }
  void add(const running::MoveEvent& event, const simulation::TimedEvent& timed) {
    const Room extents = kinematics::tip_travel(subject_.machine.timed.motion, *timed.move).extents;
    frames_.take(subject_.machine.timed.motion, *timed.move, extents);
    const bool is_rapid = event.kind == execution::MoveKind::Rapid;
    for (std::optional<Room>* const room : {&moved_, &cut_}) {
      if (room == &cut_ && is_rapid) continue;
      if (!*room) *room = extents;
      for (std::size_t axis = 0; axis < extents.size(); ++axis) (**room)[axis].include(extents[axis]);
    }
    if (!is_rapid && tool_ != kNone) add_cut(running::feed_of(event), extents[2].minimum - origin_.z());
  }

  void add_cut(double feed, double z) {
    SheetTool& tool = sheet_.tools[tool_];
    Seen& seen = seen_[tool_];
    include(tool.feed, seen.has_feed, feed);
    if (spindle_.function != 5) include(tool.speed, seen.has_speed, spindle_.speed);
    tool.turns_left = tool.turns_left || spindle_.function == 4;
    tool.least_z = std::min(tool.least_z.value_or(z), z);
  }

  SheetTool described(const execution::ToolCode& code) const {
    SheetTool tool;
    tool.code = code;
    const configuration::Tool* const known = subject_.machine.find_tool(code);
    if (known != nullptr) {
      tool.name = known->name;
      tool.length = known->length;
      tool.radius = known->radius;
    }
    const verification::ToolBodies* bodies = nullptr;
    if (subject_.scene != nullptr) {
      const auto found = subject_.scene->tools.find(code);
      if (found != subject_.scene->tools.end()) bodies = &found->second;
    }
    tool.picture = picture_of_tool(bodies, known, kToolWidth, kToolHeight);
    return tool;
  }

  const SheetSubject& subject_;
  Sheet sheet_;
  std::vector<Seen> seen_;  ///< Of each tool.
  std::size_t tool_ = kNone;
  simulation::FrameLog frames_;
  Vec3 origin_ = Vec3::Zero();  ///< Of the workpiece frame in force; machine frame.
  simulation::Timing::SpindleMotion spindle_;
  double speed_ = 0;  ///< The last S.
  double seconds_ = 0;
  std::map<int, std::size_t> calls_;
  std::optional<Room> moved_;
  std::optional<Room> cut_;
};

Room shifted(Room room, const Vec3& by) {
  for (std::size_t axis = 0; axis < room.size(); ++axis) {
    room[axis].minimum += by[static_cast<Eigen::Index>(axis)];
    room[axis].maximum += by[static_cast<Eigen::Index>(axis)];
  }
  return room;
}

Room room_of(const verification::BodyShape& shape) {
  const solids::BoundingBox box = verification::bounds(shape);
  Room room;
  for (std::size_t axis = 0; axis < room.size(); ++axis) {
    const auto index = static_cast<Eigen::Index>(axis);
    room[axis] = {box.min()[index], box.max()[index]};
  }
  return room;
}

/// The bodies of the setup that have ends, in the first workpiece frame.
std::vector<SheetBody> bodies_of(const verification::Scene& scene, const Vec3& origin) {
  std::vector<SheetBody> bodies;
  for (const verification::SceneBody& body : scene.setup) {
    if (body.is_endless) continue;
    const Room room = room_of(body.shape);
    bodies.push_back({body.name, body.role, scene.is_in_workpiece_frame ? room : shifted(room, -origin)});
  }
  return bodies;
}

std::string stop_of(const running::RunResult& result, Language language) {
  if (result.ending != running::Ending::Error) return "";
  return dialect::format(kStops, language, dialect::definition(result.error.id).code, result.line + 1,
                         running::error_message(result, language));
}

/// How a body is drawn; none for one that is not.
std::optional<PenStroke> stroke_of(verification::BodyRole role) {
  switch (role) {
    case verification::BodyRole::Stock:
      return PenStroke{.color = 0x8A6D3B, .width = 0.25, .is_dashed = false, .fill = 0xF7EFDF};
    case verification::BodyRole::Fixture:
      return PenStroke{.color = 0x6B7280, .width = 0.25, .is_dashed = false, .fill = 0xE5E7EB};
    case verification::BodyRole::Target:
    case verification::BodyRole::Spoilboard:
    case verification::BodyRole::Machine:
      break;
  }
  return std::nullopt;
}

/// What lies below the blank is seen through it.
PenStroke seen_from_above(const SheetBody& body, const SheetBody* blank) {
  PenStroke stroke = *stroke_of(body.role);
  const bool is_below = blank != nullptr && &body != blank && body.room[2].maximum <= blank->room[2].minimum;
  if (!is_below) return stroke;
  stroke.is_dashed = true;
  stroke.fill.reset();
  return stroke;
}

void draw(const SheetSubject& subject, const Room& cut, const Vec3& origin, Sheet& sheet) {
  Room room = cut;
  for (const SheetBody& body : sheet.bodies) {
    if (!stroke_of(body.role)) continue;
    const Room there = shifted(body.room, origin);
    for (std::size_t axis = 0; axis < room.size(); ++axis) room[axis].include(there[axis]);
  }
  for (std::size_t axis = 0; axis < room.size(); ++axis) {
    const double zero = origin[static_cast<Eigen::Index>(axis)];
    room[axis].include({zero, zero});
    const double around = kAround * (room[axis].maximum - room[axis].minimum);
    room[axis] = {room[axis].minimum - around, room[axis].maximum + around};
  }
  const auto found = std::find_if(sheet.bodies.begin(), sheet.bodies.end(),
                                  [](const SheetBody& body) { return body.role == verification::BodyRole::Stock; });
  const SheetBody* const blank = found == sheet.bodies.end() ? nullptr : &*found;
  PathView above({.right = 0, .up = 1}, room, kAboveWidth, kPathHeight);
  PathView front({.right = 0, .up = 2}, room, kFrontWidth, kPathHeight);
  for (PathView* const view : {&above, &front}) {
    for (const verification::BodyRole role : {verification::BodyRole::Stock, verification::BodyRole::Fixture})
      for (const SheetBody& body : sheet.bodies)
        if (body.role == role)
          view->add_box(shifted(body.room, origin), view == &above ? seen_from_above(body, blank) : *stroke_of(role));
    std::size_t number = 0;
    for (const simulation::FrameExtents& frame : sheet.frames)
      if (!frame.is_face) view->add_origin(frame.frame.origin, fmt::format("{}", ++number));
  }
  plot::Toolpath path(subject.machine.timed, subject.machine.setup.home, [&](const plot::ToolpathStep& step) {
    above.add(step);
    front.add(step);
  });
  simulation::run_timed(
      subject.text, subject.run, subject.machine.timed,
      {.event = [&](const simulation::TimedEvent& timed) { path.add(timed); },
       .stretch = [&](const motion::Stretch& stretch, const simulation::TimedEvent&) { path.add(stretch); }});
  sheet.from_above = above.finish();
  sheet.from_front = front.finish();
}

}  // namespace

Sheet survey(const SheetSubject& subject) {
  FactCollector facts(subject);
  const running::RunResult result =
      simulation::run_timed(subject.text, subject.run, subject.machine.timed,
                            {.event = [&](const simulation::TimedEvent& timed) { facts.take(timed); }, .stretch = {}});
  const std::optional<Room> room = facts.room();
  Sheet sheet = facts.finish();
  sheet.program = subject.name;
  sheet.hash = text::sha256(subject.bytes);
  sheet.lines = static_cast<std::size_t>(std::count(subject.text.begin(), subject.text.end(), '\n')) +
                (subject.text.empty() || subject.text.back() == '\n' ? 0 : 1);
  sheet.machine = subject.machine.file.generic_string();
  sheet.stop = stop_of(result, subject.language);
  const Vec3 origin = verification::first_workpiece_origin(subject.text, subject.run);
  if (subject.scene != nullptr) sheet.bodies = bodies_of(*subject.scene, origin);
  if (room) draw(subject, *room, origin, sheet);
  return sheet;
}

std::pair<double, std::string> time_of(std::string_view text, const running::RunOptions& options,
                                       const simulation::TimedMachine& machine, Language language) {
  double seconds = 0;
  const running::RunResult result =
      simulation::run_timed(text, options, machine,
                            {.event =
                                 [&](const simulation::TimedEvent& timed) {
                                   seconds = std::max(seconds, timed.start + timed.duration + timed.wait);
                                 },
                             .stretch = {}});
  return {seconds, stop_of(result, language)};
}

}  // namespace isocnc::sheet
