#include "debugger/session/inner_moments.h"

#include <algorithm>
#include <utility>

namespace isocnc::session {

static bool wants_contacts(const SessionState& state) {
  return state.exception_filters.is_on(breakpoints::ExceptionFilter::Contacts);
}

bool watches_blocks(const SessionState& state) {
  const bool wants_any = wants_contacts(state) || (state.breakpoints.has_data() && !state.breakpoints.limits().empty());
  return wants_any && state.surroundings->are_known();
}

std::vector<InnerMoment> pass_block(const SessionState& state, simulation::Simulation& simulation) {
  debuggee::Surroundings::PassedBlock passed = state.surroundings->pass_block(
      simulation, {.contacts = wants_contacts(state), .limits = state.breakpoints.limits()});
  std::vector<InnerMoment> moments;
  for (verification::Contact& contact : passed.contacts)
    moments.push_back({.time = contact.time, .contact = std::move(contact)});
  for (const debuggee::LimitCrossing& crossing : passed.crossings)
    moments.push_back({.time = crossing.time, .contact = {}, .limit = crossing.limit});
  std::stable_sort(moments.begin(), moments.end(),
                   [](const InnerMoment& a, const InnerMoment& b) { return a.time < b.time; });
  return moments;
}

MomentVerdict judge_moment(const InnerMoment& moment, SessionState& state, const simulation::Simulation& there,
                           std::uint64_t block, breakpoints::RunDirection direction) {
  MomentVerdict verdict;
  expressions::Moment at = state.moment_of(there);
  if (!moment.contact) {
    state.breakpoints.judge_limit(moment.limit, at, block, direction, verdict.outcome);
    return verdict;
  }
  at.contact_depth = std::max(0.0, -moment.contact->distance);
  verdict.exception = state.exception_filters.find_contact(*moment.contact, at, state.language());
  return verdict;
}

}  // namespace isocnc::session
