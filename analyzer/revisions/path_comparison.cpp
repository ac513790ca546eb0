#include "analyzer/revisions/path_comparison.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "analyzer/check/jump_map.h"
#include "analyzer/revisions/revision_report.h"
#include "analyzer/selection/verified.h"
#include "analyzer/selection/vgpl_values.h"
#include "interpreter/dialect/format.h"

namespace isocnc::revisions {

using namespace dialect::literals;
using dialect::Text;
using selection::VgplValues;
using OrderedJson = nlohmann::ordered_json;

static constexpr Text kAllPaths{"all {} combinations of paths", "tutte le {} combinazioni di vie"};
static constexpr Text kAnyValue{"any VGPL", "qualsiasi VGPL"};
static constexpr Text kNotCompared{"not compared: {}; more than {} combinations of paths are told apart\n",
                                   "non confrontati: {}; si distinguono più di {} combinazioni di vie\n"};
static constexpr Text kOtherRegisters{
    "not compared: other values of {}, which an IF compares and the program does not set; --set gives them one\n",
    "non confrontati: altri valori di {}, che un IF confronta e il programma non imposta; --set ne dà uno\n"};

namespace {

/// The values of VGPL that lead two programs along pairs of paths.
class VgplPairs {
 public:
  explicit VgplPairs(const RevisionPair& pair) : VgplPairs(pair, constants_of(pair)) {}

  /// Takes out both runs; returns the values that lead along both paths.
  std::string take(const simulation::TakenPath& of_old, const simulation::TakenPath& of_new) {
    VgplValues::CellSet cells = old_.cells_along(of_old);
    const VgplValues::CellSet of_new_cells = new_.cells_along(of_new);
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = cells[i] && of_new_cells[i];
    old_.close(cells);
    for (const int each : old_.unassigned_registers(of_old)) registers_.insert(each);
    for (const int each : new_.unassigned_registers(of_new)) registers_.insert(each);
    return old_.in_words(cells);
  }
  std::optional<double> next() const { return old_.next(); }
  std::string open_values() const { return next() ? old_.in_words(old_.open_cells()) : ""; }
  const std::set<int>& registers() const { return registers_; }

 private:
  VgplPairs(const RevisionPair& pair, const std::vector<double>& constants)
      : old_(pair.old_revision.text, constants), new_(pair.new_revision.text, constants) {}

  static std::vector<double> constants_of(const RevisionPair& pair) {
    std::vector<double> constants = VgplValues(pair.old_revision.text).constants();
    const std::vector<double> more = VgplValues(pair.new_revision.text).constants();
    constants.insert(constants.end(), more.begin(), more.end());
    return constants;
  }

  VgplValues old_;  ///< Its cells are open until both have been run.
  VgplValues new_;
  std::set<int> registers_;
};

}  // namespace

bool PathComparison::is_same() const {
  return std::all_of(paths.begin(), paths.end(), [](const ComparedPaths& each) { return each.is_same; });
}

/// A program without M02 has been run to its end.
static std::optional<PathComparison::StoppedRun> stop_of(const comparison::RecordedRun& run) {
  const std::string_view code = comparison::error_of(run);
  if (code.empty() || code == dialect::definition("m02-missing"_diag).code) return std::nullopt;
  return PathComparison::StoppedRun{code, run.actions.back().line};
}

PathComparison compare_on_paths(const RevisionPair& pair, const CompareOptions& options, std::uint32_t set_registers,
                                const comparison::TextStyle& style) {
  PathComparison result;
  VgplPairs values(pair);
  std::optional<double> vgpl = options.run.vgpl;
  while (vgpl && result.paths.size() < selection::kMaxVerifiedPaths) {
    CompareOptions with_value = options;
    with_value.run.vgpl = *vgpl;
    const RevisionComparison compared = compare(pair, with_value);
    result.paths.push_back({.values = values.take(compared.old_run.path, compared.new_run.path),
                            .vgpl = *vgpl,
                            .is_same = compared.is_same(),
                            .stop = stop_of(compared.old_run.recorded),
                            .text = text_of(compared, style),
                            .json = to_json(compared, style.language)});
    vgpl = values.next();
  }
  result.not_compared = values.open_values();
  for (const int each : values.registers())
    if ((set_registers & check::register_bit(each)) == 0) result.registers.push_back(each);
  return result;
}

/// Each line after two blanks.
static std::string indented(const std::string& text) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    result += "  " + text.substr(begin, end - begin);
    begin = end;
  }
  return result;
}

std::string text_of(const PathComparison& compared, const comparison::TextStyle& style) {
  std::string text;
  std::vector<bool> is_shown(compared.paths.size());
  for (std::size_t i = 0; i < compared.paths.size(); ++i) {
    if (is_shown[i]) continue;
    std::vector<std::string> values;
    for (std::size_t k = i; k < compared.paths.size(); ++k) {
      const PathComparison::ComparedPaths& paths = compared.paths[k];
      if (paths.text != compared.paths[i].text) continue;
      is_shown[k] = true;
      values.push_back(paths.values.empty() ? std::string(kAnyValue.in(style.language)) : paths.values);
    }
    const bool is_of_all = values.size() > 1 && values.size() == compared.paths.size() && compared.not_compared.empty();
    const std::string heading = is_of_all ? dialect::format(kAllPaths, style.language, values.size())
                                          : fmt::format("{}", fmt::join(values, ", "));
    const std::string& of_paths = compared.paths[i].text;
    const bool is_one_line = of_paths.find('\n') + 1 == of_paths.size();
    text += fmt::format("{}{}:{}{}", style.paint(comparison::kBold), heading, style.paint(comparison::kReset),
                        is_one_line ? ' ' + of_paths : '\n' + indented(of_paths));
  }
  if (!compared.not_compared.empty())
    text += dialect::format(kNotCompared, style.language, compared.not_compared, compared.paths.size());
  std::vector<std::string> names;
  for (const int each : compared.registers) names.push_back(fmt::format("V{}", each));
  if (!names.empty()) text += dialect::format(kOtherRegisters, style.language, fmt::join(names, ", "));
  return text;
}

std::string json_of(const PathComparison& compared) {
  const OrderedJson& first = compared.paths.front().json;
  OrderedJson json = {{"same", compared.is_same() && compared.is_complete()},
                      {"old", first["old"]},
                      {"new", first["new"]},
                      {"changes", OrderedJson::array()},
                      {"findings", OrderedJson::array()},
                      {"paths", OrderedJson::array()}};
  for (const PathComparison::ComparedPaths& paths : compared.paths) {
    for (const std::string_view key : {"changes", "findings"})
      for (const OrderedJson& each : paths.json[key])
        if (std::find(json[key].begin(), json[key].end(), each) == json[key].end()) json[key].push_back(each);
    OrderedJson each = {{"vgpl", paths.vgpl},
                        {"values", paths.values.empty() ? OrderedJson() : OrderedJson(paths.values)}};
    each.update(paths.json);
    json["paths"].push_back(std::move(each));
  }
  OrderedJson not_compared;
  if (!compared.is_complete()) {
    not_compared["values"] = compared.not_compared.empty() ? OrderedJson() : OrderedJson(compared.not_compared);
    not_compared["registers"] = OrderedJson::array();
    for (const int each : compared.registers) not_compared["registers"].push_back(fmt::format("V{}", each));
  }
  json["notCompared"] = std::move(not_compared);
  return json.dump() + '\n';
}

}  // namespace isocnc::revisions
