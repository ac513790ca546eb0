#include "debugger/breakpoints/block_watch.h"

#include <algorithm>
#include <utility>

namespace isocnc::breakpoints {

bool BlockWatch::is_on() const {
  const bool wants_any = wants_contacts() || (breakpoints_.has_data() && !breakpoints_.limits().empty());
  return wants_any && surroundings_.are_known();
}

std::vector<InnerMoment> BlockWatch::pass_block(simulation::Simulation& simulation) const {
  debuggee::Surroundings::PassedBlock passed =
      surroundings_.pass_block(simulation, {.contacts = wants_contacts(), .limits = breakpoints_.limits()});
  std::vector<InnerMoment> moments;
  for (verification::Contact& contact : passed.contacts)
    moments.push_back({.time = contact.time, .contact = std::move(contact)});
  // Otherwise a contact stops the run where it begins alone.
  if (filters_.asks_for_depth())
    for (verification::Contact& contact : passed.deeper)
      moments.push_back({.time = contact.worst_time, .contact = std::move(contact)});
  for (const debuggee::LimitCrossing& crossing : passed.crossings)
    moments.push_back({.time = crossing.time, .contact = {}, .limit = crossing.limit});
  std::stable_sort(moments.begin(), moments.end(),
                   [](const InnerMoment& a, const InnerMoment& b) { return a.time < b.time; });
  return moments;
}

MomentVerdict BlockWatch::judge(const InnerMoment& moment, expressions::Moment at, std::uint64_t block,
                                RunDirection direction, dialect::Language language) const {
  MomentVerdict verdict;
  if (!moment.contact) {
    breakpoints_.judge_limit(moment.limit, at, block, direction, verdict.outcome);
    return verdict;
  }
  at.contact_depth = std::max(0.0, -moment.contact->distance);
  verdict.exception = filters_.find_contact(*moment.contact, at, language);
  return verdict;
}

}  // namespace isocnc::breakpoints
