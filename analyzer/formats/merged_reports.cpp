#include "analyzer/formats/merged_reports.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analyzer/formats/sarif_log.h"
#include "interpreter/dialect/format.h"

namespace isocnc::formats {

using dialect::Text;
using OrderedJson = nlohmann::ordered_json;

/// Objects and arrays of a report lie in one another at most this deep.
static constexpr int kMaxDepth = 32;

static constexpr Text kNoReport = {"this is no report of isolint --format json or sarif",
                                   "non è un rapporto di isolint --format json o sarif"};
static constexpr Text kMixed = {"this report has another format than the first", "il formato non è quello del primo"};
static constexpr Text kOtherHeader = {"this report comes from another version of isolint, or is in another language",
                                      "viene da un'altra versione di isolint, oppure è in un'altra lingua"};

static constexpr Text kMissingPart = {"--merge: the report of part {} is missing",
                                      "--merge: manca il rapporto della parte {}"};

namespace {

/// Why a report cannot be joined.
struct Refusal {
  const Text& reason;
};

OrderedJson parsed(std::string_view text) {
  const auto limit_depth = [](int depth, OrderedJson::parse_event_t, OrderedJson&) {
    if (depth > kMaxDepth) throw Refusal{kNoReport};
    return true;
  };
  return OrderedJson::parse(text, limit_depth);
}

/// The findings of one file, each once, in their order.
class FindingsOfFile {
 public:
  /// Returns whether the finding is new.
  bool add(const OrderedJson& finding, const std::string& text) {
    if (!known_.insert(text).second) return false;
    findings_.push_back(finding);
    return true;
  }
  std::vector<OrderedJson>& findings() { return findings_; }

 private:
  std::set<std::string> known_;
  std::vector<OrderedJson> findings_;
};

using FindingsByFile = std::map<std::string, FindingsOfFile>;

void count(std::string_view severity, MergedReport& merged) {
  if (severity == "error") {
    ++merged.errors;
  } else if (severity == "warning") {
    ++merged.warnings;
  } else if (severity == "info" || severity == "note") {
    ++merged.infos;
  } else {
    throw Refusal{kNoReport};
  }
}

/// Joins arrays of findings.
class JsonMerger {
 public:
  void add(const OrderedJson& report) {
    for (const OrderedJson& finding : report)
      if (files_[finding.at("file").get<std::string>()].add(finding, dumped(finding)))
        count(finding.at("severity").get<std::string>(), merged_);
  }

  MergedReport finish() {
    merged_.files = files_.size();
    merged_.text = "[";
    std::string_view separator = "\n  ";
    for (auto& [name, file] : files_)
      for (const OrderedJson& finding : file.findings()) {
        merged_.text.append(separator).append(dumped(finding));
        separator = ",\n  ";
      }
    merged_.text += merged_.errors + merged_.warnings + merged_.infos == 0 ? "]\n" : "\n]\n";
    return std::move(merged_);
  }

 private:
  FindingsByFile files_;
  MergedReport merged_;
};

/// The path that a URI of ours stands for: what it is sorted by.
std::string path_of(std::string_view uri) {
  if (uri.starts_with("file://")) uri.remove_prefix(7);
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_encoded = uri[i] == '%' && i + 2 < uri.size();
    path += is_encoded ? static_cast<char>(std::stoi(std::string(uri.substr(i + 1, 2)), nullptr, 16)) : uri[i];
    if (is_encoded) i += 2;
  }
  return path;
}

/// Gives the program that a result names its number in the joined log. Files that are no programs have none.
void renumber(OrderedJson& json, std::size_t number) {
  if (json.is_object() && json.contains("artifactLocation") && json["artifactLocation"].contains("index"))
    json["artifactLocation"]["index"] = number;
  if (json.is_structured())
    for (OrderedJson& each : json) renumber(each, number);
}

/// Joins logs with one run each.
class SarifMerger {
 public:
  void add(const OrderedJson& report) {
    const OrderedJson& run = report.at("runs").at(0);
    if (run.contains("properties")) add_part(run.at("properties").at("shard").get<std::string>());
    const OrderedJson& driver = run.at("tool").at("driver");
    SarifLog::Header header{.version = driver.at("version").get<std::string>(),
                            .language = run.at("language").get<std::string>(),
                            .shard = {},
                            .rules = {}};
    for (const OrderedJson& rule : driver.at("rules")) header.rules.push_back(dumped(rule));
    if (!header_) header_ = header;
    if (header != *header_) throw Refusal{kOtherHeader};
    const OrderedJson& artifacts = run.at("artifacts");
    for (const OrderedJson& artifact : artifacts) artifacts_[path_of(uri_in(artifact))] = dumped(artifact);
    for (const OrderedJson& result : run.at("results")) {
      const OrderedJson& place = result.at("locations").at(0).at("physicalLocation").at("artifactLocation");
      OrderedJson numberless = result;
      renumber(numberless, 0);
      const std::string path = path_of(uri_in(artifacts.at(place.at("index").get<std::size_t>())));
      if (files_[path].add(numberless, dumped(numberless))) count(result.at("level").get<std::string>(), merged_);
    }
  }

  /// The first part, as `3/8`, that none of the logs is of, although some are of others of as many parts.
  std::optional<std::string> missing_part() const {
    for (const auto& [count, known] : parts_)
      for (unsigned long i = 1; i <= count; ++i)
        if (!known.contains(i)) return fmt::format("{}/{}", i, count);
    return std::nullopt;
  }

  MergedReport finish() {
    SarifLog log;
    log.begin(*header_, merged_.text);
    std::vector<std::string> artifacts;
    for (const auto& [path, artifact] : artifacts_) {
      for (OrderedJson& result : files_[path].findings()) {
        renumber(result, artifacts.size());
        log.add_result(dumped(result), merged_.text);
      }
      artifacts.push_back(artifact);
    }
    log.end(artifacts, merged_.text);
    merged_.files = artifacts.size();
    return std::move(merged_);
  }

 private:
  /// Takes the part of the files that a log is of: `2/8`.
  void add_part(const std::string& part) {
    std::size_t slash = 0;
    const unsigned long number = std::stoul(part, &slash);
    if (slash >= part.size() || part[slash] != '/') throw Refusal{kNoReport};
    parts_[std::stoul(part.substr(slash + 1))].insert(number);
  }

  static std::string uri_in(const OrderedJson& artifact) {
    return artifact.at("location").at("uri").get<std::string>();
  }

  std::optional<SarifLog::Header> header_;
  std::map<unsigned long, std::set<unsigned long>> parts_;  ///< By their number: those that the logs are of, from 1.
  std::map<std::string, std::string> artifacts_;
  FindingsByFile files_;
  MergedReport merged_;
};

}  // namespace

std::variant<MergedReport, std::string> merge_reports(std::span<const ReportFile> reports, dialect::Language language) {
  JsonMerger json;
  SarifMerger sarif;
  std::optional<bool> is_sarif;
  for (const ReportFile& report : reports) {
    const auto refuse = [&](const Text& why) { return fmt::format("{}: {}", report.name, why.in(language)); };
    try {
      const OrderedJson content = parsed(report.text);
      if (is_sarif.value_or(content.is_object()) != content.is_object()) return refuse(kMixed);
      is_sarif = content.is_object();
      if (*is_sarif) {
        sarif.add(content);
      } else {
        json.add(content);
      }
    } catch (const Refusal& refusal) {
      return refuse(refusal.reason);
    } catch (const nlohmann::json::exception&) {
      return refuse(kNoReport);
    } catch (const std::logic_error&) {  // A URI that is none.
      return refuse(kNoReport);
    }
  }
  if (const std::optional<std::string> missing = sarif.missing_part())
    return dialect::format(kMissingPart, language, *missing);
  return is_sarif.value_or(false) ? sarif.finish() : json.finish();
}

}  // namespace isocnc::formats
