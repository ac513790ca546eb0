#include "analyzer/selection/verified.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "analyzer/selection/joined_runs.h"
#include "analyzer/selection/vgpl_values.h"

namespace isocnc::selection {

using verification::Certificate;
using verification::Contact;
using verification::Mover;
using verification::Unverified;
using verification::VerifiedRun;

VerifiedRun verified(std::string_view text, const ProgramSettings& settings, const verification::Scene* scene,
                     const VerifyOptions& options) {
  const configuration::MachineConfiguration& machine = settings.configuration.machine;
  return verified_on_paths(text, {.setup = machine.setup, .stop = options.stop}, machine.timed, scene, options.together,
                           options.material);
}

/// Adds what no run has shown because of a jump.
static void add_gaps(VerifiedRun& run, const VgplValues& values) {
  std::vector<simulation::RunFinding>& findings = run.outcome.findings;
  for (const simulation::RunFinding& each : values.findings()) {
    const auto is_before = [](const simulation::RunFinding& a, const simulation::RunFinding& b) {
      return std::pair(a.line, a.finding.span.begin) < std::pair(b.line, b.finding.span.begin);
    };
    findings.insert(std::upper_bound(findings.begin(), findings.end(), each, is_before), each);
  }
  if (!run.certificate) return;
  const std::vector<verification::Unverified> gaps = values.gaps();
  run.certificate->gaps.insert(run.certificate->gaps.end(), gaps.begin(), gaps.end());
}

namespace {

/// Makes the certificate of all runs.
class JoinedCertificates {
 public:
  explicit JoinedCertificates(VerifiedRun& first) : first_(first) { note(first.contacts); }

  /// Takes another run.
  void add(const VerifiedRun& run) {
    if (!first_.certificate || !run.certificate) return;
    Certificate& all = *first_.certificate;
    const Certificate& other = *run.certificate;
    ++all.paths;
    all.motions += other.motions;
    all.contacts += note(run.contacts);
    all.more_contacts += other.more_contacts;
    if (!all.stopped_at) all.stopped_at = other.stopped_at;
    for (const Unverified& gap : other.gaps) {
      const auto is_same = [&](const Unverified& each) {
        return each.gap == gap.gap && each.name.number == gap.name.number;
      };
      if (std::none_of(all.gaps.begin(), all.gaps.end(), is_same)) all.gaps.push_back(gap);
    }
    for (const verification::UnknownPlaces& places : other.unknown_places) add(places, all.unknown_places);
    for (const std::string& tool : other.bare_tools)
      if (std::find(all.bare_tools.begin(), all.bare_tools.end(), tool) == all.bare_tools.end())
        all.bare_tools.push_back(tool);
  }

 private:
  using KnownContact = std::tuple<dialect::DiagnosticId, std::size_t, std::size_t, std::uint32_t, Mover>;

  static void add(const verification::UnknownPlaces& places, std::vector<verification::UnknownPlaces>& all) {
    const auto is_same = [&](const verification::UnknownPlaces& each) { return each.after == places.after; };
    const auto known = std::find_if(all.begin(), all.end(), is_same);
    if (known == all.end()) {
      all.push_back(places);
      return;
    }
    known->lines.insert(known->lines.end(), places.lines.begin(), places.lines.end());
    std::sort(known->lines.begin(), known->lines.end());
    auto last = known->lines.begin();  // What overlaps becomes one.
    for (auto each = last + 1; each != known->lines.end(); ++each) {
      if (each->first <= last->second)
        last->second = std::max(last->second, each->second);
      else
        *++last = *each;
    }
    known->lines.erase(last + 1, known->lines.end());
  }

  /// Returns how many of these have not been known; near misses and hints do not count.
  std::size_t note(const std::vector<Contact>& contacts) {
    std::size_t added = 0;
    for (const Contact& each : contacts) {
      if (dialect::definition(each.id).severity != dialect::Severity::Error) continue;
      if (known_.emplace(each.id, each.line, each.end_line, each.whom.number, each.mover).second) ++added;
    }
    return added;
  }

  VerifiedRun& first_;
  std::set<KnownContact> known_;
};

}  // namespace

VerifiedRun verified_on_paths(std::string_view text, const running::RunOptions& options,
                              const timing::TimedMachine& machine, const verification::Scene* scene,
                              const verification::WorkTogether& together,
                              const verification::MaterialOptions& material) {
  VerifiedRun first = verification::verified_run(text, options, machine, scene, together, material);
  if (first.outcome.runs.front().decisions.empty()) return first;  // Most programs have no jump.
  VgplValues values(text);
  values.take(first.outcome.runs.front());
  std::optional<double> vgpl = values.next();
  if (vgpl) {
    JoinedRuns joined;
    JoinedCertificates certificates(first);
    joined.add(std::move(first.outcome));
    for (std::size_t paths = 1; vgpl && paths < kMaxVerifiedPaths; ++paths) {
      if (options.stop && options.stop()) break;
      running::RunOptions other = options;
      other.vgpl = *vgpl;
      VerifiedRun run = verification::verified_run(text, other, machine, scene, together, material);
      values.take(run.outcome.runs.front());
      certificates.add(run);
      joined.add(std::move(run.outcome));
      vgpl = values.next();
    }
    first.outcome = std::move(joined).finish();
  }
  add_gaps(first, values);
  return first;
}

void add_other_paths(VerifiedRun& run, std::string_view text) {
  if (run.outcome.runs.front().decisions.empty()) return;
  VgplValues values(text);
  values.take(run.outcome.runs.front());
  add_gaps(run, values);
}

}  // namespace isocnc::selection
