#include "analyzer/input/program_changes.h"

#include <algorithm>

#include "interpreter/system/file_status.h"

namespace isocnc::input {

std::optional<FileStamp> stamp_of(const std::filesystem::path& file) {
  const std::optional<system::FileStatus> status = system::status_of(file);
  if (!status || status->kind != system::FileStatus::Kind::Regular) return std::nullopt;
  return FileStamp{
      .identity = status->identity, .size = status->size, .changed = status->changed, .mode = status->mode};
}

void ProgramChanges::see(const Stamps& programs, Time now) {
  // A program that has not been there settles like one that has been removed.
  for (const auto& [program, stamp] : programs)
    programs_.try_emplace(program, Presence()).first->second.see(stamp, now);
  for (auto& [program, settling] : programs_)
    if (!programs.contains(program)) settling.see(std::nullopt, now);
}

ProgramChanges::Settled ProgramChanges::take(Time now) {
  Settled settled;
  for (auto at = programs_.begin(); at != programs_.end();) {
    const auto here = at++;
    const std::optional<Presence> taken = here->second.take(now);
    if (taken && *taken) settled.to_check.insert(here->first);
    if (taken && !*taken) settled.removed.push_back(here->first);
    if (here->second.is_settled_as(std::nullopt)) programs_.erase(here);
  }
  return settled;
}

void ProgramChanges::repeat(const std::filesystem::path& program, Time now) {
  if (const auto found = programs_.find(program); found != programs_.end()) found->second.repeat(now);
}

bool ProgramChanges::is_unsettled() const {
  return std::any_of(programs_.begin(), programs_.end(), [](const auto& each) { return each.second.is_unsettled(); });
}

std::chrono::milliseconds rest_after(std::chrono::nanoseconds pass, bool is_unsettled) {
  using std::chrono::milliseconds;
  static constexpr milliseconds kShortest{500};
  const auto taken = std::chrono::ceil<milliseconds>(pass);
  return is_unsettled ? std::max(Settling<ProgramStamp>::kMoment, 2 * taken) : std::max(kShortest, 19 * taken);
}

}  // namespace isocnc::input
