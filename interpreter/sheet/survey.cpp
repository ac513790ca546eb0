#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/plot/toolpath.h"
#include "interpreter/running/error_message.h"
#include "interpreter/sheet/path_view.h"
#include "interpreter/sheet/sheet.h"
#include "interpreter/sheet/tool_picture.h"
#include "interpreter/simulation/timed_run.h"
#include "interpreter/system/paths.h"
#include "interpreter/text/sha256.h"
#include "interpreter/timing/spindle_turn.h"
#include "interpreter/verification/verifier.h"

namespace isocnc::sheet {

using dialect::Language;
using dialect::Text;
using geometry::Range;
using geometry::Vec3;
using Room = std::array<Range, 3>;

namespace {

constexpr Text kStops{"{} on line {}: {}", "{} alla riga {}: {}"};
constexpr Text kUntil{"the run ends before line {}, as asked",
                      "l'esecuzione finisce prima della riga {}, come richiesto"};

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

  void take(const timing::TimedEvent& timed) {
    const double duration = timed.duration + timed.wait;
    seconds_ = std::max(seconds_, timed.start + duration);
    spindle_ = timing::spindle_after(timed.event, spindle_, speed_);
    std::visit([&](const auto& what) { add(what, timed); }, timed.event.what);
    if (tool_ != kNone) sheet_.tools[tool_].seconds += duration;
  }

  Sheet finish() {
    sheet_.seconds = seconds_;
    sheet_.frames = frames_.frames();
    sheet_.frames_left_out = frames_.left_out();
    if (cuts_in_machine_) sheet_.machine_room = machine_room_;
    for (const auto& [number, calls] : calls_) {
      const configuration::NamedFunction* const known = subject_.machine.find_function(number);
      sheet_.functions.push_back({number, known ? known->name : "", calls, ""});
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
    bool has_left_speed = false;
    bool has_feed = false;
  };

  template <class What>
  void add(const What&, const timing::TimedEvent&) {}
  void add(const running::SpindleSpeedEvent& given, const timing::TimedEvent&) { speed_ = given.speed; }
  void add(const running::FunctionEvent& function, const timing::TimedEvent&) {
    if (dialect::is_user_function(function.number)) ++calls_[function.number];
  }
  void add(const running::FrameEvent& frame, const timing::TimedEvent& timed) {
    frames_.take(frame, timed.event.line);
    origin_ = frame.workpiece_origin;
    has_frame_ = true;
  }
  void add(const running::ToolEvent& event, const timing::TimedEvent&) {
    const auto known = std::find_if(sheet_.tools.begin(), sheet_.tools.end(),
                                    [&](const SheetTool& each) { return each.code == event.tool; });
    tool_ = static_cast<std::size_t>(known - sheet_.tools.begin());
    if (known == sheet_.tools.end()) {
      sheet_.tools.push_back(described(event.tool));
      seen_.emplace_back();
    }
    ++sheet_.tools[tool_].uses;
  }
  void add(const running::MoveEvent& event, const timing::TimedEvent& timed) {
    const Room extents = kinematics::tip_travel(subject_.machine.timed.motion, *timed.move).extents;
    frames_.take(subject_.machine.timed.motion, *timed.move, extents);
    const bool is_rapid = event.kind == execution::MoveKind::Rapid;
    for (std::optional<Room>* const room : {&moved_, &cut_}) {
      if (room == &cut_ && is_rapid) continue;
      if (!*room) *room = extents;
      for (std::size_t axis = 0; axis < extents.size(); ++axis) (**room)[axis].include(extents[axis]);
    }
    if (!has_frame_) {
      if (!machine_room_) machine_room_ = extents;
      for (std::size_t axis = 0; axis < extents.size(); ++axis) (*machine_room_)[axis].include(extents[axis]);
      cuts_in_machine_ = cuts_in_machine_ || !is_rapid;
    }
    if (!is_rapid && tool_ != kNone) add_cut(running::feed_of(event), extents[2].minimum - origin_.z());
  }

  void add_cut(double feed, double z) {
    SheetTool& tool = sheet_.tools[tool_];
    Seen& seen = seen_[tool_];
    include(tool.feed, seen.has_feed, feed);
    if (spindle_.function == 3) include(tool.speed, seen.has_speed, spindle_.speed);
    if (spindle_.function == 4) include(tool.left_speed, seen.has_left_speed, spindle_.speed);
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
  summary::FrameLog frames_;
  Vec3 origin_ = Vec3::Zero();  ///< Of the workpiece frame in force; machine frame.
  timing::SpindleMotion spindle_;
  double speed_ = 0;  ///< The last S.
  double seconds_ = 0;
  std::map<int, std::size_t> calls_;
  std::optional<Room> moved_;
  std::optional<Room> cut_;
  bool has_frame_ = false;
  std::optional<Room> machine_room_;
  bool cuts_in_machine_ = false;
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

/// The bodies of the setup, in the first workpiece frame.
std::vector<SheetBody> bodies_of(const verification::Scene& scene, const Vec3& origin) {
  std::vector<SheetBody> bodies;
  for (const verification::SceneBody& body : scene.setup) {
    const Room room = room_of(body.shape);
    bodies.push_back(
        {body.name, body.role, body.is_endless, scene.is_in_workpiece_frame ? room : shifted(room, -origin)});
  }
  return bodies;
}

std::string stop_of(const running::RunResult& result, Language language) {
  if (result.ending == running::Ending::Until) return dialect::format(kUntil, language, result.line + 1);
  if (result.ending != running::Ending::Error) return "";
  return dialect::format(kStops, language, dialect::definition(result.error.id).code, result.line + 1,
                         running::error_message(result, language));
}

/// How a body is drawn; none for one that is not.
std::optional<PenStroke> stroke_of(verification::BodyRole role) {
  switch (role) {
    case verification::BodyRole::Stock:
      return PenStroke{.color = 0x8A6D3B, .width = 0.25, .fill = 0xF7EFDF};
    case verification::BodyRole::Fixture:
      return PenStroke{.color = 0x6B7280, .width = 0.25, .fill = 0xE5E7EB};
    case verification::BodyRole::Target:
    case verification::BodyRole::Spoilboard:
    case verification::BodyRole::Machine:
      break;
  }
  return std::nullopt;
}

/// Where the zeros of the workpiece are, each with its numbers in the table.
std::vector<std::pair<Vec3, std::string>> numbered_zeros(const Sheet& sheet) {
  std::vector<std::pair<Vec3, std::string>> zeros;
  std::size_t number = 0;
  for (const summary::FrameExtents& frame : sheet.frames) {
    if (frame.is_face) continue;
    const std::string name = fmt::format("{}", ++number);
    const auto same =
        std::find_if(zeros.begin(), zeros.end(), [&](const auto& zero) { return zero.first == frame.frame.origin; });
    if (same == zeros.end()) {
      zeros.emplace_back(frame.frame.origin, name);
    } else if (same->second.size() < 12) {
      same->second += ", " + name;
    }
  }
  return zeros;
}

/// What lies below the blank is seen through it.
PenStroke seen_from_above(const SheetBody& body, const SheetBody* blank) {
  PenStroke stroke = *stroke_of(body.role);
  const bool is_below = blank != nullptr && &body != blank && body.room[2].maximum <= blank->room[2].minimum;
  if (!is_below) return stroke;
  stroke.dashes = fine_dashes();
  stroke.fill.reset();
  return stroke;
}

/// What the pictures show, machine frame: what is cut, blank and fixtures; none if there is nothing.
std::optional<Room> shown_room(std::optional<Room> room, const std::vector<SheetBody>& bodies, const Vec3& origin) {
  for (const SheetBody& body : bodies) {
    if (!stroke_of(body.role)) continue;
    const Room there = shifted(body.room, origin);
    if (!room) room = there;
    for (std::size_t axis = 0; axis < there.size(); ++axis) (*room)[axis].include(there[axis]);
  }
  return room;
}

void draw(const SheetSubject& subject, Room room, const Vec3& origin, Sheet& sheet) {
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
    for (const auto& [place, names] : numbered_zeros(sheet)) view->add_origin(place, names);
  }
  plot::Toolpath path(subject.machine.timed, subject.machine.setup.home, [&](const plot::ToolpathStep& step) {
    above.add(step);
    front.add(step);
  });
  simulation::run_timed(
      subject.text, subject.run, subject.machine.timed,
      {.event = [&](const timing::TimedEvent& timed) { path.add(timed); },
       .stretch = [&](const motion::Stretch& stretch, const timing::TimedEvent&) { path.add(stretch); }});
  sheet.from_above = above.finish();
  sheet.from_front = front.finish();
}

}  // namespace

static std::string values_of(const running::RunOptions& run) {
  std::string values;
  const auto add = [&](const std::string& name, double value) {
    if (value != 0) values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", name, value);
  };
  add("VGPL", run.vgpl);
  for (std::size_t i = 1; i < run.registers.size(); ++i) add(fmt::format("V{}", i), run.registers[i]);
  return values;
}

Sheet survey(const SheetSubject& subject) {
  FactCollector facts(subject);
  std::optional<Vec3> first_zero;
  const running::RunResult result =
      simulation::run_timed(subject.text, subject.run, subject.machine.timed,
                            {.event =
                                 [&](const timing::TimedEvent& timed) {
                                   facts.take(timed);
                                   const auto* const frame = std::get_if<running::FrameEvent>(&timed.event.what);
                                   if (frame != nullptr && !frame->face_mounted && !first_zero)
                                     first_zero = frame->workpiece_origin;
                                 },
                             .stretch = {}});
  const std::optional<Room> room = facts.room();
  Sheet sheet = facts.finish();
  sheet.program = subject.name;
  sheet.hash = text::sha256(subject.bytes);
  sheet.lines = static_cast<std::size_t>(std::count(subject.text.begin(), subject.text.end(), '\n')) +
                (subject.text.empty() || subject.text.back() == '\n' ? 0 : 1);
  sheet.machine = system::generic_name(subject.machine.file);
  sheet.stop = stop_of(result, subject.language);
  sheet.values = values_of(subject.run);
  sheet.first_zero = first_zero;
  const Vec3 origin = verification::first_workpiece_origin(subject.text, subject.run);
  if (subject.scene != nullptr) sheet.bodies = bodies_of(*subject.scene, origin);
  if (const std::optional<Room> shown = shown_room(room, sheet.bodies, origin)) draw(subject, *shown, origin, sheet);
  return sheet;
}

/// Widens a range, where 0 to 0 is none.
static void widen(Range& range, const Range& other) {
  if (other.maximum <= 0) return;
  if (range.maximum <= 0) range = other;
  range.include(other);
}

void add_path(Sheet& sheet, const SheetSubject& subject, const std::string& values) {
  FactCollector facts(subject);
  const running::RunResult result =
      simulation::run_timed(subject.text, subject.run, subject.machine.timed,
                            {.event = [&](const timing::TimedEvent& timed) { facts.take(timed); }, .stretch = {}});
  Sheet path = facts.finish();
  sheet.paths.push_back({values, path.seconds, stop_of(result, subject.language)});
  for (SheetTool& tool : path.tools) {
    const auto known = std::find_if(sheet.tools.begin(), sheet.tools.end(),
                                    [&](const SheetTool& each) { return each.code == tool.code; });
    if (known == sheet.tools.end()) {
      tool.values = values;
      sheet.tools.push_back(std::move(tool));
      continue;
    }
    widen(known->speed, tool.speed);
    widen(known->left_speed, tool.left_speed);
    widen(known->feed, tool.feed);
    if (tool.least_z) known->least_z = std::min(known->least_z.value_or(*tool.least_z), *tool.least_z);
    if (!known->values.empty() && values != known->values) known->values += ", " + values;
  }
  for (SheetFunction& function : path.functions) {
    const auto known = std::find_if(sheet.functions.begin(), sheet.functions.end(),
                                    [&](const SheetFunction& each) { return each.number == function.number; });
    if (known == sheet.functions.end()) {
      function.values = values;
      sheet.functions.push_back(std::move(function));
    } else if (!known->values.empty()) {
      known->values += ", " + values;
    }
  }
}

}  // namespace isocnc::sheet
