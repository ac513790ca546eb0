#include "interpreter/verification/verified_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "interpreter/simulation/compensation.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::verification {

using namespace dialect::literals;
using simulation::RunFinding;

/// A value as a message shows it: with as few digits, too. `unit` is 1 or a decimal part of it.
static double rounded(double value, double unit) { return std::round(value / unit) / std::round(1 / unit); }

namespace {

/// How a finding tells lengths: in mm, or in inches where the block that it stands at is under G70. What a person
/// types or compares with the program is in the unit of the program.
class ShownLengths {
 public:
  explicit ShownLengths(bool is_in_inches)
      : mm_per_unit_(dialect::mm_per_unit(is_in_inches)), step_(is_in_inches ? 0.0001 : 0.01) {}

  double smallest() const { return step_; }
  double of(double mm) const { return rounded(mm / mm_per_unit_, step_); }
  /// Not lower than it is.
  double at_least(double mm) const {
    constexpr double kNoise = 1e-6;                                                      // Steps.
    return std::ceil(mm / mm_per_unit_ / step_ - kNoise) / std::round(1 / step_) + 0.0;  // No -0.
  }
  geometry::Vec3 of(const geometry::Vec3& point) const { return {of(point.x()), of(point.y()), of(point.z())}; }

 private:
  double mm_per_unit_;
  double step_;
};

}  // namespace

/// The finding that tells what goes wrong with the material.
static syntax::Finding finding_about_material(const Contact& contact) {
  const ShownLengths lengths(contact.is_in_inches);
  const geometry::Vec3 point = lengths.of(contact.frame.to_inner(contact.point));
  const double amount = lengths.of(std::max(0.0, -contact.distance));
  syntax::Finding finding{.id = contact.id,
                          .is_in_inches = contact.is_in_inches,
                          .values = {amount, point.x(), point.y(), point.z(), rounded(contact.worst_time, 0.1)},
                          .names = {contact.who, contact.whom}};
  if (contact.id == "cuts-nothing"_diag) finding.values[0] = contact.is_in_inches ? amount : std::round(amount);
  if (contact.id == "cut-too-deep"_diag) finding.values[5] = lengths.of(contact.limit);
  if (contact.id == "material-left"_diag) finding.values[4] = lengths.of(contact.limit);
  if (contact.volume) finding.values[5] = rounded(*contact.volume / 1000, 0.01);
  if (contact.enough) {
    finding.values[5] = lengths.at_least(*contact.enough);
  } else if (contact.id == "rapid-in-material"_diag) {
    finding.cause = "rapid-in-material/at-any-height"_cause.number;
  } else if (contact.id == "holder-in-material"_diag) {
    finding.cause = "holder-in-material/at-any-height"_cause.number;
  }
  if (contact.is_of_edge) finding.cause = "cut-too-deep/edge-too-short"_cause.number;
  return finding;
}

syntax::Finding finding_of(const Contact& contact) {
  if (contact.is_of_material && !contact.is_near_miss()) return finding_about_material(contact);
  const ShownLengths lengths(contact.is_in_inches);
  const geometry::Vec3 point = lengths.of(contact.frame.to_inner(contact.point));
  const double signed_amount = contact.is_near_miss() ? contact.distance : -contact.distance;
  const double amount = std::max(lengths.smallest(), lengths.of(signed_amount));
  return {
      .id = contact.id,
      .is_in_inches = contact.is_in_inches,
      .values = {amount, point.x(), point.y(), point.z(), rounded(contact.worst_time, 0.1)},
      .names = {contact.who, contact.whom},
      .described = contact.described.file.empty() ? dialect::GivenPlace() : dialect::GivenPlace::of(contact.described)};
}

static dialect::Cause cause_of(Gap gap) {
  switch (gap) {
    case Gap::ToolWithoutShape:
      return "not-verified/tool-without-shape"_cause;
    case Gap::ToolWithoutLength:
      return "not-verified/tool-without-length"_cause;
    case Gap::OtherPaths:
      return "not-verified/other-paths"_cause;
    case Gap::OtherRegisters:
      return "not-verified/other-registers"_cause;
    case Gap::ResolutionTooFine:
      return "not-verified/resolution-too-fine"_cause;
    case Gap::SetupMistaken:
      return "not-verified/setup-mistaken"_cause;
    case Gap::Undecided:
      break;
  }
  return "not-verified/undecided"_cause;
}

syntax::Finding finding_of(const Unverified& gap) {
  const dialect::Cause cause = cause_of(gap.gap);
  return {.id = cause.id,
          .cause = cause.number,
          .values = {static_cast<double>(gap.paths), gap.spacing},
          .names = {gap.name}};
}

namespace {

/// A line on which a contact is told.
struct ToldContact {
  const removal::DepthLevel* level = nullptr;
  const Contact* contact = nullptr;
  double distance = 0;    ///< Of the contact, from the level on up to the next one of its part; as Contact's.
  bool is_worst = false;  ///< Whether that is where the contact is worst.
  std::size_t worst = 0;  ///< Index of that which is worst of the same mistake from this line on.
};

}  // namespace

/// The level that holds the worst place of a contact.
static const removal::DepthLevel& worst_level(const Contact& contact) {
  const auto holds = [&](const removal::DepthLevel& level) {
    return level.who == contact.who && level.line <= contact.worst_line;
  };
  const auto found = std::find_if(contact.levels.rbegin(), contact.levels.rend(), holds);
  return found == contact.levels.rend() ? contact.levels.front() : *found;
}

/// Where findings about contacts stand, by line. Of one mistake the first one that is shown stands for all, so that
/// each tells the worst of those from it on.
static std::vector<ToldContact> told_contacts(const std::vector<Contact>& contacts) {
  std::vector<ToldContact> told;
  for (const Contact& contact : contacts) {
    const removal::DepthLevel& worst = worst_level(contact);
    for (const removal::DepthLevel& level : contact.levels) {
      const bool is_worst = &level == &worst;
      told.push_back({.level = &level,
                      .contact = &contact,
                      .distance = is_worst ? contact.distance : -level.deepest.depth,
                      .is_worst = is_worst});
    }
  }
  std::stable_sort(told.begin(), told.end(),
                   [](const ToldContact& a, const ToldContact& b) { return a.level->line < b.level->line; });
  std::map<std::int32_t, std::size_t> worst;
  for (std::size_t i = told.size(); i-- > 0;) {
    std::size_t& known = worst.try_emplace(told[i].contact->mistake, i).first->second;
    if (!(told[known].distance < told[i].distance)) known = i;
    told[i].worst = known;
  }
  return told;
}

/// A contact as it is worst from a line on.
static Contact shown_contact(const ToldContact& worst) {
  Contact shown = *worst.contact;
  if (worst.is_worst) return shown;
  shown.who = worst.level->who;
  shown.distance = worst.distance;
  shown.worst_line = worst.level->deepest.line;
  shown.worst_time = worst.level->deepest.time;
  shown.point = worst.level->deepest.point;
  // What the worst place is in may be of another line.
  if (shown.id != "cuts-with-spindle-stopped"_diag) shown.shaped_by.reset();
  return shown;
}

/// The finding about a contact on a line, without a span.
static RunFinding finding_on(const ToldContact& told, const ToldContact& worst) {
  const removal::DepthLevel& level = *told.level;
  Contact shown = shown_contact(worst);
  if (shown.enough) {
    const geometry::Vec3 place = shown.frame.to_inner(shown.point);
    shown.enough = level.frame.to_inner(shown.frame.to_outer({place.x(), place.y(), *shown.enough})).z();
  }
  shown.frame = level.frame;
  shown.is_in_inches = level.is_in_inches;
  RunFinding found{.line = level.line, .finding = finding_of(shown), .mistake = told.contact->mistake};
  if (told.contact->end_line > level.line) found.last_line = told.contact->end_line;
  if (shown.worst_line != level.line) found.worst_line = shown.worst_line;
  if (shown.shaped_by != level.line) found.shaped_by = shown.shaped_by;
  return found;
}

/// Adds what a scene has shown to the findings of a run, in their order.
static void add_findings(simulation::RunOutcome& outcome, const std::vector<Contact>& contacts,
                         const Certificate& certificate, std::string_view text) {
  std::vector<RunFinding> found;
  std::int32_t mistakes = 0;
  for (const RunFinding& each : outcome.findings) mistakes = std::max(mistakes, each.mistake + 1);
  const std::vector<ToldContact> told = told_contacts(contacts);
  for (const ToldContact& each : told) {
    found.push_back(finding_on(each, told[each.worst]));
    found.back().mistake += mistakes;
  }
  for (const Unverified& gap : certificate.gaps) {
    found.push_back({.line = gap.line, .finding = finding_of(gap)});
    for (const UnknownPlaces& each : certificate.unknown_places)
      if (gap.gap == Gap::ToolWithoutLength && gap.name.in(dialect::Language::English) == each.after)
        found.back().last_line = each.lines.back().second;
  }
  const auto by_line = [](const RunFinding& a, const RunFinding& b) { return a.line < b.line; };
  std::stable_sort(found.begin(), found.end(), by_line);
  syntax::LineFinder lines(text);
  for (RunFinding& each : found)
    each.finding.span = simulation::motion_span(syntax::ParsedLine(lines.line(each.line)).tree());
  outcome.findings.insert(outcome.findings.end(), found.begin(), found.end());
  const auto place = [](const RunFinding& each) {
    return std::tuple(each.line, each.finding.span.begin, each.finding.id, each.mistake);
  };
  std::stable_sort(outcome.findings.begin(), outcome.findings.end(),
                   [&](const RunFinding& a, const RunFinding& b) { return place(a) < place(b); });
  // Each once on its line.
  const auto is_same = [&](const RunFinding& a, const RunFinding& b) { return a.mistake >= 0 && place(a) == place(b); };
  outcome.findings.erase(std::unique(outcome.findings.begin(), outcome.findings.end(), is_same),
                         outcome.findings.end());
}

void add_gap(VerifiedRun& run, const Unverified& gap, std::string_view text) {
  RunFinding found{.line = gap.line, .finding = finding_of(gap)};
  found.finding.span = simulation::motion_span(syntax::ParsedLine(syntax::LineFinder(text).line(gap.line)).tree());
  std::vector<RunFinding>& findings = run.outcome.findings;
  const auto is_before = [](const RunFinding& a, const RunFinding& b) { return a.line < b.line; };
  findings.insert(std::lower_bound(findings.begin(), findings.end(), found, is_before), found);
  if (run.certificate) run.certificate->gaps.push_back(gap);
}

VerifiedRun verified_outcome(simulation::RunOutcome outcome, Verifier& verifier, std::string_view text,
                             const running::RunResult& result) {
  verifier.finish();
  VerifiedRun verified{
      .outcome = std::move(outcome), .contacts = verifier.contacts(), .certificate = verifier.certificate()};
  if (const removal::MaterialCheck* const material = verifier.material())
    verified.material = MaterialReport{.blank_volume = material->blank_volume(),
                                       .by_tool = material->removed_by_tool(),
                                       .by_line = material->removed_by_line(),
                                       .stock = material->stock(),
                                       .origin = material->workpiece().origin};
  if (result.ending == running::Ending::Error) verified.certificate->stopped_at = result.line;
  if (result.ending == running::Ending::Until) verified.certificate->ended_before = result.line;
  verified.outcome.has_scene = true;
  verified.outcome.has_stock = verifier.material() != nullptr;
  if (verified.material) verified.outcome.removed = verified.material->by_line;
  add_findings(verified.outcome, verified.contacts, *verified.certificate, text);
  return verified;
}

VerifiedRun verified_run(std::string_view text, running::RunOptions options, const timing::TimedMachine& machine,
                         const Scene* scene, WorkTogether work_together, const MaterialOptions& material) {
  if (!scene) return {.outcome = simulation::outcome_of_run(text, std::move(options), machine)};
  simulation::RunFindings findings(machine);
  Verifier verifier(*scene, machine, first_workpiece_origin(text, options), std::move(work_together), material);
  timing::Timing timing(machine, {.event =
                                      [&](const timing::TimedEvent& timed) {
                                        if (timed.move) {
                                          kinematics::MadeMove made(machine.motion, *timed.move);
                                          findings.take(timed.event, made);
                                        }
                                        verifier.take(timed);
                                      },
                                  .stretch =
                                      [&](const motion::Stretch& stretch, const timing::TimedEvent& timed) {
                                        verifier.take(stretch, removal::MotionFacts(timed));
                                      }});
  simulation::Compensation compensation(machine);
  const simulation::Compensation::Listeners compensated{
      .event = [&](const running::Event& event) { timing.take(event); },
      .warning = [&](const simulation::RunWarning& warning) { findings.take(warning); }};
  options.before_block = [&](const running::Block& block) { findings.take(block); };
  const running::RunResult result = run(text, options, [&](const running::Event& event) {
    findings.take(event);
    compensation.take(event, compensated);
  });
  compensation.finish(compensated);
  timing.finish();
  return verified_outcome(findings.outcome(text, result), verifier, text, result);
}

}  // namespace isocnc::verification
