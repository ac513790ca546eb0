#include "debugger/session/inner_moments.h"

#include <algorithm>

namespace isocnc::session {

bool watches_blocks(const SessionState& state) {
  return state.exception_filters.is_on(breakpoints::ExceptionFilter::Contacts) && state.surroundings->are_known();
}

std::vector<InnerMoment> pass_block(const SessionState& state, simulation::Simulation& simulation) {
  std::vector<InnerMoment> moments;
  for (verification::Contact& contact : state.surroundings->pass_block(simulation))
    moments.push_back({.time = contact.time, .contact = std::move(contact)});
  return moments;
}

std::optional<breakpoints::Exception> judge_moment(const InnerMoment& moment, const SessionState& state,
                                                   const simulation::Simulation& there) {
  expressions::Moment at = state.moment_of(there);
  at.contact_depth = std::max(0.0, -moment.contact.distance);
  return state.exception_filters.find_contact(moment.contact, at, state.language());
}

}  // namespace isocnc::session
