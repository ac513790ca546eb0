#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/closed_programs.h"
#include "lsp/outbox.h"
#include "lsp/rpc/loop.h"
#include "lsp/rpc/strand.h"

namespace isocnc::lsp {

/// The programs that others write into the workspace's folders, such as a CAM system: the editor reports their files,
/// and is asked for another pull of the diagnostics once they have been still for a moment. Used on the loop's thread
/// only.
class PostedPrograms {
 public:
  /// Calls `settled` after changes have settled.
  PostedPrograms(rpc::Loop& loop, rpc::Pool& pool, Outbox& outbox, documents::SettingsStore& settings,
                 std::function<void()> settled);

  /// Asks the editor to report the configuration files and, in these folders, the programs. Says it again only if other
  /// names of files are programs now. What the configurations say of names is read on another thread, since a disk may
  /// be slow.
  void watch(const ClosedPrograms::Folders& folders, bool watches_programs);
  /// The editor reports that files have been written, made or removed.
  void note_changes(const std::vector<std::string>& uris);
  /// The programs that are being written, by our own spelling of their URIs.
  std::set<std::string> unsettled() const;

 private:
  using Clock = std::chrono::steady_clock;

  void register_patterns(const std::set<std::string>& extensions);
  void settle(Clock::time_point changed);

  rpc::Loop& loop_;
  Outbox& outbox_;
  documents::SettingsStore& settings_;
  const std::function<void()> settled_;
  rpc::Strand reading_;
  std::uint64_t times_asked_ = 0;                     // To watch; the last call counts.
  std::vector<std::string> watched_;                  // The patterns that the editor knows.
  std::map<std::string, Clock::time_point> changed_;  // The last change of each program that is being written.
};

}  // namespace isocnc::lsp
