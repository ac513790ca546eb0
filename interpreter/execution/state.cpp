#include "interpreter/execution/state.h"

namespace isocnc::execution {

State initial_state(const Setup& setup) {
  State state;
  state.position = setup.home;
  return state;
}

ProgrammedFeed feed_in_force(const State& state) {
  return state.feed_per_minute.number > 0 ? state.feed_per_minute : state.last_feed;
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

void join(State& into, const State& other) {
  if (into.spindle != other.spindle) into.spindle = Spindle::Unknown;
  into.speed_given |= other.speed_given;
  into.feed_on_rapid |= other.feed_on_rapid;
  into.tool_known = into.tool_known && other.tool_known && into.tool == other.tool;
}

}  // namespace isocnc::execution
