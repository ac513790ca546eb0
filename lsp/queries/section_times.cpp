#include "lsp/queries/section_times.h"

#include <cmath>
#include <variant>

#include <fmt/format.h>

namespace isocnc::queries {

namespace {

/// Adds up the events of a run.
struct Adder {
  void add(const timing::TimedEvent& timed) {
    if (std::holds_alternative<running::ToolEvent>(timed.event.what)) {
      line = timed.event.line;
      sections.try_emplace(line, TimedSection{.start = timed.start});
    }
    TimedSection& section = sections[line];
    section.seconds += timed.duration + timed.wait;
    if (timed.move) add(*timed.move, std::get<running::MoveEvent>(timed.event.what), section);
  }

  void add(const kinematics::Move& move, const running::MoveEvent& event, TimedSection& section) const {
    const kinematics::TipTravel travel = kinematics::tip_travel(machine.motion, move);
    section.mm += travel.length;
    if (event.kind == execution::MoveKind::Rapid) return;
    if (!section.has_feed_move) section.cut = travel.extents;
    section.has_feed_move = true;
    for (std::size_t axis = 0; axis < section.cut.size(); ++axis) section.cut[axis].include(travel.extents[axis]);
  }

  const timing::TimedMachine& machine;
  Sections sections;
  std::size_t line = 0;
};

}  // namespace

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::shared_ptr<SectionTimes> SectionTimes::of(const documents::Snapshot& snapshot) {
  auto& times = snapshot.memory<std::shared_ptr<SectionTimes>>();
  if (!times) times = std::make_shared<SectionTimes>();
  return times;
}

std::shared_ptr<const Sections> SectionTimes::known(std::int64_t version,
                                                    const configuration::MachineConfiguration& machine) {
  const std::lock_guard lock(mutex_);
  return version == version_ && &machine == machine_ ? sections_ : nullptr;
}

std::shared_ptr<const Sections> SectionTimes::known(const documents::Snapshot& snapshot) {
  return known(snapshot.version(), snapshot.configuration().machine);
}

std::shared_ptr<const Sections> SectionTimes::time(const TimedProgram& program, const std::function<bool()>& stop) {
  if (auto found = known(program.version(), program.machine())) return found;
  Adder adder{.machine = program.machine().timed};
  const running::RunResult result =
      program.run(stop, {.event = [&](const timing::TimedEvent& timed) { adder.add(timed); }, .stretch = {}});
  if (result.ending == running::Ending::Error) adder.sections.erase(adder.line);
  const std::lock_guard lock(mutex_);
  version_ = program.version();
  machine_ = &program.machine();
  sections_ = std::make_shared<const Sections>(std::move(adder.sections));
  return sections_;
}

}  // namespace isocnc::queries
