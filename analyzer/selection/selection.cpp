#include "analyzer/selection/selection.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpreter/dialect/any_case.h"
#include "interpreter/dialect/code_set.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/near_names.h"
#include "interpreter/text/characters.h"
#include "interpreter/text/lists.h"

namespace isocnc::selection {

using dialect::CodeSet;
using dialect::equal_words;
using dialect::kDiagnosticCount;
using dialect::Language;
using dialect::Severity;
using dialect::Text;

struct SeverityOverride {
  CodeSet set;
  std::optional<Severity> severity;
};

/// The words between the commas, without empty ones.
static std::vector<std::string_view> words_of(const std::vector<std::string>& lists) {
  std::vector<std::string_view> words;
  for (const std::string_view list : lists)
    for (const std::string_view element : text::split_at_commas(list))
      if (const std::string_view word = text::trimmed(element); !word.empty()) words.push_back(word);
  return words;
}

std::string unknown_code(std::string_view code, Language language) {
  static constexpr Text kUnknown = {"unknown code:", "codice sconosciuto:"};
  return fmt::format("{} {}{} (--list-rules)", kUnknown.in(language), code,
                     dialect::did_you_mean(dialect::nearest_code(code), language));
}

static std::vector<CodeSet> code_sets(const std::vector<std::string>& lists, Language language,
                                      std::vector<std::string>& problems) {
  std::vector<CodeSet> sets;
  for (const std::string_view word : words_of(lists)) {
    if (const std::optional<CodeSet> set = dialect::find_codes(word)) {
      sets.push_back(*set);
    } else {
      problems.push_back(unknown_code(word, language));
    }
  }
  return sets;
}

/// Reads `W001=error`; adds an error to `problems` and returns nothing if that fails.
static std::optional<SeverityOverride> parse_severity_override(std::string_view word, Language language,
                                                               std::vector<std::string>& problems) {
  static constexpr Text kForm = {"{}: write CODE=error, warning, info or off",
                                 "{}: scrivere CODICE=error, warning, info oppure off"};
  const std::size_t equals = std::min(word.find('='), word.size());
  const std::string_view code = text::trimmed(word.substr(0, equals));
  const std::string_view level = text::trimmed(word.substr(std::min(equals + 1, word.size())));
  SeverityOverride severity_override;
  bool known = equal_words(level, "off");
  for (const Severity severity : {Severity::Error, Severity::Warning, Severity::Info}) {
    if (!equal_words(level, dialect::severity_name(severity, Language::English))) continue;
    severity_override.severity = severity;
    known = true;
  }
  const std::optional<CodeSet> set = dialect::find_codes(code);
  if (!known) {
    problems.push_back(dialect::format(kForm, language, word));
  } else if (!set) {
    problems.push_back(unknown_code(code, language));
  } else {
    severity_override.set = *set;
    return severity_override;
  }
  return std::nullopt;
}

/// How specifically the sets name a code; -1 if they do not.
static int exactness_for(std::size_t code, const std::vector<CodeSet>& sets) {
  int maximum = -1;
  for (const CodeSet& set : sets)
    if (set.codes[code]) maximum = std::max(maximum, static_cast<int>(set.exactness));
  return maximum;
}

Selection::Selection() {
  for (std::size_t i = 0; i < kDiagnosticCount; ++i)
    if (!dialect::kDiagnostics[i].is_off) severities_[i] = dialect::kDiagnostics[i].severity;
}

std::vector<std::string> Selection::follow(const SelectionOptions& options, Language language) {
  static constexpr Text kSelectsNothing = {"select names no code; ALL names them all",
                                           "select non indica alcun codice; ALL li indica tutti"};
  std::vector<std::string> problems;
  const std::vector<CodeSet> select = code_sets(options.select, language, problems);
  if (!options.select.empty() && select.empty() && problems.empty())
    problems.emplace_back(kSelectsNothing.in(language));
  const std::vector<CodeSet> ignore = code_sets(options.ignore, language, problems);
  std::vector<SeverityOverride> severities;
  for (const std::string_view word : words_of(options.severities))
    if (const auto severity_override = parse_severity_override(word, language, problems))
      severities.push_back(*severity_override);
  if (!problems.empty()) return problems;

  const std::array<std::optional<Severity>, kDiagnosticCount> before = severities_;
  for (std::size_t i = 0; i < kDiagnosticCount; ++i) {
    const int selected = exactness_for(i, select);
    const int ignored = exactness_for(i, ignore);
    const bool on = selected > ignored || (ignored < 0 && select.empty() && before[i]);
    int decided = -1;
    std::optional<Severity> severity = before[i] ? before[i] : dialect::kDiagnostics[i].severity;
    // A code that was off and is given a severity is shown again, unless the same options exclude it.
    bool wanted = on;
    for (const SeverityOverride& severity_override : severities) {
      if (!severity_override.set.codes[i] || static_cast<int>(severity_override.set.exactness) < decided) continue;
      decided = static_cast<int>(severity_override.set.exactness);
      severity = severity_override.severity;
      wanted = on || (ignored < 0 && select.empty());
    }
    severities_[i] = wanted ? severity : std::nullopt;
    weighed_[i] = weighed_[i] || decided >= 0;
  }
  return {};
}

check::Report Selection::shown(check::Report report) const {
  std::erase_if(report.findings, [&](const check::LocatedFinding& located) { return !shows(located.finding.id); });
  for (check::LocatedFinding& located : report.findings) located.selected = severity(located.finding);
  return report;
}

}  // namespace isocnc::selection
