#include "analyzer/check/jump_collector.h"

#include <utility>

namespace isocnc::check {

JumpCollector::JumpCollector(const JumpMap& before) : before_(&before) {
  sites_.reserve(before.sites().size());
  events_.reserve(2 * before.sites().size());
}

void JumpCollector::add(std::size_t line, const FlowEvent& event) {
  if (event.kind == FlowEvent::Kind::Jump) sites_.push_back({line, event.jump});
  JumpMap::add(events_, event);
}

void JumpCollector::add_jump(std::size_t line, const syntax::Jump& jump) {
  sites_.push_back({line, jump});
  JumpMap::add_place(events_, FlowEvent::Kind::Jump, jump.target);
}

JumpMap JumpCollector::finish() && {
  JumpMap map(std::move(sites_), before_);
  if (!map.empty()) map.follow(std::move(events_));
  return map;
}

}  // namespace isocnc::check
