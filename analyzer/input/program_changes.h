#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analyzer/input/settling.h"

namespace isocnc::input {

/// What tells one content of a file from the next without reading it.
struct FileStamp {
  std::array<std::uint64_t, 3> identity{};
  std::uint64_t size = 0;
  std::int64_t changed = 0;
  std::uint32_t mode = 0;  ///< Who may read it.

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// The stamp of a regular file; nothing if there is none of this name.
std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

/// All on which the findings of a program depend.
struct ProgramStamp {
  FileStamp program;
  std::string configuration;                       ///< The name of its file; empty: none.
  std::optional<FileStamp> configuration_content;  ///< Of that file.
  std::optional<FileStamp> baseline;

  friend bool operator==(const ProgramStamp&, const ProgramStamp&) = default;
};

/// Decides which programs a watch checks: those whose stamp is another than at their last check and has settled. Knows
/// neither files nor clocks.
class ProgramChanges {
 public:
  using Time = Settling<ProgramStamp>::Time;
  using Stamps = std::map<std::filesystem::path, ProgramStamp>;

  struct Settled {
    std::set<std::filesystem::path> to_check;  ///< New programs and changed ones.
    std::vector<std::filesystem::path> removed;
  };

  /// Takes in all programs that there are now.
  void see(const Stamps& programs, Time now);
  /// The changes that have settled; each is returned once. A program that is replaced under its name is never removed.
  Settled take(Time now);
  /// A program that has been taken could not be checked, and is to be tried again.
  void repeat(const std::filesystem::path& program, Time now);
  /// Whether there are changes that have not settled.
  bool is_unsettled() const;

 private:
  /// Nothing where there is no such program: its removal has to settle, too.
  using Presence = std::optional<ProgramStamp>;

  std::map<std::filesystem::path, Settling<Presence>> programs_;
};

/// The time to wait after a pass over all files that took so long. A watch that looks at them by itself also sees what
/// other computers write on a network drive, which the system does not report. Where there are many files, or they are
/// far away, it looks less often, so that it takes a twentieth of the time at most; while something changes, a third.
std::chrono::milliseconds rest_after(std::chrono::nanoseconds pass, bool is_unsettled);

}  // namespace isocnc::input
