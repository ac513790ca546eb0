#include "interpreter/verification/contact_log.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace isocnc::verification {

using namespace dialect::literals;

bool Contact::is_near_miss() const { return id == "near-miss"_diag; }
bool Contact::is_hint() const { return id == "cuts-nothing"_diag; }

static dialect::DiagnosticId contact_with(BodyRole role) {
  switch (role) {
    case BodyRole::Fixture:
      return "hits-fixture"_diag;
    case BodyRole::Target:
      return "gouges-part"_diag;
    case BodyRole::Machine:
    case BodyRole::Spoilboard:
    case BodyRole::Stock:
      break;
  }
  return "hits-machine"_diag;
}

void ContactLog::take_one(const Encounter& encounter, const StretchPlace& at, const BodyPairs& bodies,
                          const execution::ToolCode& tool) {
  const BodyPair& pair = bodies.pairs[encounter.pair];
  const Obstacle& obstacle = bodies.obstacles[pair.obstacle];
  const auto [known, is_new] = open_.try_emplace({pair.obstacle, mover_of(bodies, pair.part)});
  Episode& episode = known->second;
  if (!is_new && at.number > episode.last_stretch + 1) close(episode);
  Contact& contact = episode.contact;
  if (is_new || at.number > episode.last_stretch + 1) {
    episode = {};
    contact.distance = std::numeric_limits<double>::infinity();
    contact.tool = tool;
    contact.mover = mover_of(bodies, pair.part);
    contact.whom = obstacle.name;
    contact.described = obstacle.body->described;
  }
  episode.last_stretch = at.number;
  episode.reports_near |= pair.reports_near;
  const dialect::GivenName who = bodies.parts[pair.part].name;
  if (encounter.is_contact) {
    if (!episode.has_touched || encounter.first_touch < contact.time) {
      contact.line = at.line;
      contact.time = encounter.first_touch;
    }
    if (!episode.has_touched || encounter.last_touch >= contact.end_time) {
      contact.end_line = at.line;
      contact.end_time = encounter.last_touch;
    }
    contact.id = contact_with(obstacle.body->role);
  }
  // How near it came before the touch does not matter.
  const bool is_first_touch = encounter.is_contact && !episode.has_touched;
  episode.has_touched |= encounter.is_contact;
  if (!is_first_touch && !(encounter.distance < contact.distance)) return;
  if (!episode.has_touched) {
    contact.id = "near-miss"_diag;
    contact.line = contact.end_line = at.line;
    contact.time = contact.end_time = encounter.nearest_time;
  }
  // After a near miss the touch counts, even if it is no nearer.
  if (is_first_touch || encounter.distance < contact.distance) {
    contact.who = who;
    contact.distance = encounter.distance;
    contact.point = encounter.point;
    contact.frame = at.frame;
  }
}

void ContactLog::close(const Episode& episode) {
  if (!episode.has_touched && !episode.reports_near) return;
  if (episode.has_touched) ++count_;
  if (contacts_.size() >= kMaxContacts) {
    ++left_out_;
    return;
  }
  contacts_.push_back(episode.contact);
}

void ContactLog::close_all() {
  for (const auto& [obstacle, episode] : open_) close(episode);
  open_.clear();
}

std::vector<Contact> ContactLog::contacts() const {
  std::vector<Contact> sorted = contacts_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Contact& a, const Contact& b) {
    return a.time != b.time ? a.time < b.time : a.whom.number < b.whom.number;
  });
  // One slip with a tool repeats at an obstacle.
  using Cause = std::tuple<dialect::DiagnosticId, Mover, std::uint32_t, BodyDescription, execution::ToolCode>;
  std::map<Cause, std::int32_t> mistakes;
  for (Contact& contact : sorted) {
    const auto next = static_cast<std::int32_t>(mistakes.size());
    const Cause cause(contact.id, contact.mover, contact.whom.number, contact.described, contact.tool);
    contact.mistake = mistakes.try_emplace(cause, next).first->second;
  }
  return sorted;
}

}  // namespace isocnc::verification
