#include "analyzer/check/jump_collector.h"

#include <utility>

namespace isocnc::check {

void JumpCollector::add(std::size_t line, const FlowEvent& event) {
  if (event.kind == FlowEvent::Kind::Jump) sites_.push_back({line, event.jump});
  events_.emplace_back(event);
}

JumpMap JumpCollector::finish() && {
  JumpMap map(std::move(sites_));
  if (!map.empty()) map.follow(std::move(events_));
  return map;
}

}  // namespace isocnc::check
