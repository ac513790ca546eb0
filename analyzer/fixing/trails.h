#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "analyzer/check/frontier.h"
#include "analyzer/check/report.h"

namespace isocnc::fixing {

/// How much more often each code is found in one text than in another.
class FindingDelta {
 public:
  void count(const check::Report& report, int times) { count(report.findings, 0, times); }
  /// Those from `first` on.
  void count(const std::vector<check::LocatedFinding>& findings, std::size_t first, int times) {
    for (std::size_t i = first; i < findings.size(); ++i)
      counts_[static_cast<std::size_t>(findings[i].finding.id)] += times;
  }
  int of(dialect::DiagnosticId id) const { return counts_[static_cast<std::size_t>(id)]; }

  FindingDelta& operator+=(const FindingDelta& other) { return add(other, 1); }
  FindingDelta& operator-=(const FindingDelta& other) { return add(other, -1); }

 private:
  FindingDelta& add(const FindingDelta& other, int times) {
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += times * other.counts_[i];
    return *this;
  }

  std::array<int, dialect::kDiagnosticCount> counts_{};
};

/// The effects of a change, line by line below it: where the check then stood, and what it had found so far.
class Trail {
 public:
  /// The last part of one.
  struct Rest {
    FindingDelta delta;           ///< The balance of what is found there.
    std::uint64_t next_line = 0;  ///< The line after it.
    bool has_more = false;        ///< Whether the change may still count from that line on.
  };

  /// Notes the check after each line below the change, in their order.
  void pass(std::uint64_t next_line, const check::Frontier& frontier, const FindingDelta& so_far);
  /// Ends with what followed the lines that it has passed.
  void end(const FindingDelta& so_far, const Rest& rest);

  /// Whether it is worth keeping: shorter ones are followed again in the same time.
  bool is_long() const { return passed_ >= kLong; }
  /// What it found from this line on, where the check stood as it does here; nothing when it did not, or when too few
  /// lines followed.
  std::optional<Rest> rest_from(std::uint64_t line, const check::Frontier& frontier) const;

 private:
  struct Mark {
    std::uint64_t next_line = 0;
    check::Frontier frontier;
    FindingDelta so_far;
  };

  static constexpr std::uint64_t kLong = 200;

  std::uint64_t passed_ = 0;
  std::vector<Mark> marks_;
  Rest all_;
};

/// The latest trails that were long.
class Trails {
 public:
  void keep(Trail trail);
  std::optional<Trail::Rest> rest_from(std::uint64_t line, const check::Frontier& frontier) const;

 private:
  static constexpr std::size_t kMaxTrails = 4;

  std::deque<Trail> trails_;
};

}  // namespace isocnc::fixing
