#include "interpreter/verification/contact_log.h"

#include <algorithm>

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
  if (at.number != at_.number) settle();
  at_ = at;
  const BodyPair& pair = bodies.pairs[encounter.pair];
  const Obstacle& obstacle = bodies.obstacles[pair.obstacle];
  const Mover mover = mover_of(bodies, pair.part);
  Visit& visit = visits_.emplace_back(
      Visit{.place = {pair.obstacle, mover}, .part = pair.part, .reports_near = pair.reports_near});
  visit.encounter = encounter;
  visit.is_rough = obstacle.body->core && !pair.core && bodies.parts[pair.part].of_spindle == removal::ToolPart::Cutter;
  visit.contact.id = encounter.is_contact() ? contact_with(obstacle.body->role) : "near-miss"_diag;
  visit.contact.tool = tool;
  visit.contact.who = bodies.parts[pair.part].name;
  visit.contact.whom = obstacle.name;
  visit.contact.mover = mover;
  visit.contact.described = obstacle.body->described;
}

/// Puts the encounters of the present stretch where they belong.
void ContactLog::settle() {
  std::stable_sort(visits_.begin(), visits_.end(), [](const Visit& a, const Visit& b) { return a.place < b.place; });
  const std::span<const Visit> all(visits_);
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first + 1;
    while (end < all.size() && all[end].place == all[first].place) ++end;
    settle(all.subspan(first, end - first));
    first = end;
  }
  visits_.clear();
}

/// Takes what happens at one obstacle on the present stretch.
void ContactLog::settle(std::span<const Visit> visits) {
  Episode& episode = episodes_[visits.front().place];
  const bool is_next_stretch = at_.number <= episode.last_stretch + 1;
  std::vector<VisitTouch> touches;
  for (const Visit& visit : visits)
    for (const Touch& touch : visit.encounter.touches) touches.push_back({.visit = &visit, .touch = &touch});
  std::stable_sort(touches.begin(), touches.end(), [](const VisitTouch& a, const VisitTouch& b) {
    return a.touch->first != b.touch->first ? a.touch->first < b.touch->first : a.touch->last > b.touch->last;
  });
  if (episode.is_open && (!is_next_stretch || episode.is_apart)) close(episode);
  for (const VisitTouch& touch : touches) {
    // Two parts of a mover hand a contact over, and at rest between two stretches it lasts.
    constexpr double kSameTime = 1e-6;  // s
    const bool lasts = touch.touch->first <= episode.contact.end_time + kSameTime ||
                       (is_next_stretch && episode.is_together && touch.touch->from_start);
    if (episode.is_open && episode.has_touched && !lasts) close(episode);
    take_touch(episode, touch);
  }
  for (const Visit& visit : visits) {
    if (!episode.has_touched) take_near(episode, visit);
    episode.reports_near |= visit.reports_near;
  }
  episode.is_together =
      std::any_of(touches.begin(), touches.end(), [](const VisitTouch& each) { return each.touch->to_end; });
  episode.is_apart = !episode.is_together && std::all_of(visits.begin(), visits.end(),
                                                         [](const Visit& each) { return each.encounter.ends_apart; });
  episode.last_stretch = at_.number;
}

/// Where one stretch ends and the next begins, the distance is the same but for rounding, mm.
static constexpr double kSame = 1e-5;

void ContactLog::take_touch(Episode& episode, const VisitTouch& touch) const {
  // How near it came before the touch does not matter.
  const bool is_first = !episode.is_open || !episode.has_touched;
  const bool is_rough = touch.visit->is_rough;
  const bool is_deeper =
      is_first ||
      (is_rough == episode.is_rough ? touch.touch->distance < episode.contact.distance - kSame : episode.is_rough);
  Contact& contact = episode.contact;
  if (is_first) {
    contact = touch.visit->contact;
    contact.line = at_.line;
    contact.time = touch.touch->first;
    contact.frame = at_.frame;
    contact.is_in_inches = at_.is_in_inches;
  }
  if (is_first || touch.touch->last >= contact.end_time) {
    contact.end_line = at_.line;
    contact.end_time = touch.touch->last;
  }
  episode.is_open = episode.has_touched = true;
  const double depth = is_rough ? 0 : std::max(0.0, -touch.touch->distance);
  take_depth(
      contact.levels,
      {.line = at_.line,
       .part = touch.visit->part,
       .depth = depth,
       .frame = at_.frame,
       .is_in_inches = at_.is_in_inches,
       .who = touch.visit->contact.who,
       .deepest = {.depth = depth, .line = at_.line, .time = touch.touch->deepest_time, .point = touch.touch->point}});
  if (!is_deeper) return;
  episode.is_rough = is_rough;
  contact.who = touch.visit->contact.who;
  contact.distance = touch.touch->distance;
  contact.worst_line = at_.line;
  contact.worst_time = touch.touch->deepest_time;
  contact.point = touch.touch->point;
}

void ContactLog::take_near(Episode& episode, const Visit& visit) const {
  const Encounter& encounter = visit.encounter;
  if (episode.is_open && !(encounter.distance < episode.contact.distance - kSame)) return;
  episode.is_open = true;
  Contact& contact = episode.contact;
  contact = visit.contact;
  contact.line = contact.end_line = contact.worst_line = at_.line;
  contact.time = contact.end_time = contact.worst_time = encounter.nearest_time;
  contact.distance = encounter.distance;
  contact.point = encounter.point;
  contact.frame = at_.frame;
  contact.is_in_inches = at_.is_in_inches;
  contact.levels = {{.line = at_.line, .frame = at_.frame, .is_in_inches = at_.is_in_inches, .who = contact.who}};
}

void ContactLog::close(Episode& episode) {
  const Episode closed = std::exchange(episode, Episode());
  if (!closed.is_open || (!closed.has_touched && !closed.reports_near)) return;
  if (closed.has_touched) ++count_;
  if (kept_.keeps(cause_of(closed.contact))) contacts_.push_back(closed.contact);
}

ContactLog::ContactCause ContactLog::cause_of(const Contact& contact) {
  return {contact.id, contact.mover, contact.whom.number, contact.described, contact.tool};
}

void ContactLog::close_all() {
  settle();
  for (auto& [place, episode] : episodes_) close(episode);
  episodes_.clear();
}

std::vector<Contact> ContactLog::contacts() const {
  std::vector<Contact> sorted = contacts_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Contact& a, const Contact& b) {
    return a.time != b.time ? a.time < b.time : a.whom.number < b.whom.number;
  });
  std::map<ContactCause, std::int32_t> mistakes;
  for (Contact& contact : sorted) {
    const auto next = static_cast<std::int32_t>(mistakes.size());
    contact.mistake = mistakes.try_emplace(cause_of(contact), next).first->second;
  }
  return sorted;
}

}  // namespace isocnc::verification
