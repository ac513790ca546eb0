#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "analyzer/check/frontier.h"
#include "analyzer/check/report.h"

namespace isocnc::fixing {

/// The difference between two texts in the number of findings of each code.
class FindingDelta {
 public:
  void count(const check::Report& report, int times) { count(report.findings, 0, times); }
  /// Counts the findings from index `first` on.
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

/// The effects of a change, line by line below it: the check's frontier and the findings so far.
class Trail {
 public:
  /// The part of a trail from some line on.
  struct TrailRest {
    FindingDelta delta;         ///< The difference in findings in that part.
    std::size_t next_line = 0;  ///< The first line after that part.
    bool has_more = false;      ///< Whether there may be further effects from that line on.
  };

  /// Records the check after a line below the change; lines must ascend.
  void pass(std::size_t next_line, const check::Frontier& frontier, const FindingDelta& so_far);
  /// Ends the trail; `rest` follows the recorded lines.
  void end(const FindingDelta& so_far, const TrailRest& rest);

  /// Whether the trail is long enough to keep; a short one is recomputed as fast.
  bool is_long() const { return passed_ >= kLong; }
  /// The rest from this line on, if the trail had the same frontier there. Nothing if it had not, or if too few lines
  /// followed.
  std::optional<TrailRest> rest_from(std::size_t line, const check::Frontier& frontier) const;

 private:
  struct TrailMark {
    std::size_t next_line = 0;
    check::Frontier frontier;
    FindingDelta so_far;
  };

  static constexpr std::size_t kLong = 200;

  std::size_t passed_ = 0;
  std::vector<TrailMark> marks_;
  TrailRest all_;
};

/// The latest long trails.
class Trails {
 public:
  void keep(Trail trail);
  std::optional<Trail::TrailRest> rest_from(std::size_t line, const check::Frontier& frontier) const;

 private:
  static constexpr std::size_t kMaxTrails = 4;

  std::deque<Trail> trails_;
};

}  // namespace isocnc::fixing
