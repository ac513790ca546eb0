#include "interpreter/execution/state.h"

namespace isocnc::execution {

State initial_state(const Setup& setup) {
  State state;
  state.position = setup.home;
  return state;
}

ProgrammedFeed feed_in_force(const State& state) {
  const bool is_per_minute = state.feed_per_minute.number > 0 || !state.feed_per_minute.is_known;
  return is_per_minute ? state.feed_per_minute : state.last_feed;
}

bool judged_alike(const State& a, const State& b) {
  return a.position == b.position && a.unknown == b.unknown && a.in_force == b.in_force && a.written == b.written &&
         a.in_doubt == b.in_doubt && a.workpiece_origin == b.workpiece_origin && a.face == b.face &&
         a.face_mounted == b.face_mounted && a.workpiece_unknown == b.workpiece_unknown &&
         a.face_undefined == b.face_undefined && a.face_unplaced == b.face_unplaced &&
         a.dismount_tolerated == b.dismount_tolerated && a.tool_selected == b.tool_selected &&
         a.tool_reported == b.tool_reported && a.feed_given == b.feed_given && a.feed_reported == b.feed_reported &&
         a.exact_stop_fits == b.exact_stop_fits && a.lack == b.lack && a.tool_prepared == b.tool_prepared &&
         a.motion_illegible == b.motion_illegible && a.ended == b.ended;
}

static void join(ProgrammedFeed& into, const ProgrammedFeed& other) { into.is_known = into.is_known && into == other; }

void join(State& into, const State& other) {
  join(into.feed_per_minute, other.feed_per_minute);
  join(into.last_feed, other.last_feed);
  into.speed_known = into.speed_known && other.speed_known && into.spindle_speed == other.spindle_speed;
  if (into.spindle != other.spindle) into.spindle = Spindle::Unknown;
  into.speed_given |= other.speed_given;
  into.feed_on_rapid |= other.feed_on_rapid;
  into.tool_known = into.tool_known && other.tool_known && into.tool == other.tool;
  if (into.tool == ToolCode{})
    into.tool = other.tool;  // With no tool on all paths alone it is known that there is none.
}

}  // namespace isocnc::execution
