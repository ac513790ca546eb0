#pragma once

#include <cstddef>
#include <vector>

#include "analyzer/check/jump_map.h"

namespace isocnc::check {

/// Collects the jumps, labels and assignments of a program as its lines are read, and makes a JumpMap of them.
class JumpCollector {
 public:
  JumpCollector() = default;
  /// `before`: the jumps before an edit, of which much stays as it was; must outlive the collector.
  explicit JumpCollector(const JumpMap& before);

  /// Adds the next event; `line` counts from the start of the program. Labels that no jump names may be left out.
  void add(std::size_t line, const FlowEvent& event);
  /// The same for each kind of event.
  void add_assignments(RegisterSet registers) { JumpMap::add_assignments(events_, registers); }
  void add_label(std::uint64_t label) { JumpMap::add_place(events_, FlowEvent::Kind::Label, label); }
  void add_jump(std::size_t line, const syntax::Jump& jump);

  /// The map of all events added. It knows the labels.
  JumpMap finish() &&;

 private:
  const JumpMap* before_ = nullptr;
  std::vector<JumpMap::Site> sites_;
  std::vector<JumpMap::ReducedEvent> events_;
};

}  // namespace isocnc::check
