#include "analyzer/selection/baseline.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analyzer/selection/fingerprint.h"
#include "analyzer/selection/selection.h"
#include "interpreter/dialect/format.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/source_file.h"
#include "interpreter/text/counted_bytes.h"
#include "interpreter/text/unicode.h"

namespace isocnc::selection {

namespace fs = std::filesystem;
using dialect::DiagnosticId;
using dialect::Language;
using dialect::Text;
using text::CountedBytes;

static constexpr std::uint64_t kVersion = 1;

Baseline::Baseline(const fs::path& file) : folder_(system::normal(system::absolute(file)).parent_path()) {}

std::string Baseline::name_of(std::string_view program) const {
  return text::printable(system::generic_name(system::normal(system::absolute(program)).lexically_relative(folder_)));
}

void Baseline::add(std::string_view program, std::string_view text, const check::Report& report) {
  if (report.findings.empty()) return;
  std::vector<std::pair<std::size_t, DiagnosticId>> places;
  for (const check::LocatedFinding& located : report.findings) {
    places.emplace_back(located.line, located.finding.id);
    for (const check::Repetition& again : report.repetitions_of(located)) places.emplace_back(again.line, again.id);
  }
  std::sort(places.begin(), places.end());
  LineCounts& counts = programs_[name_of(program)];
  syntax::LineFinder lines(text);
  Fingerprints fingerprints;
  for (const auto& [line, id] : places) ++counts[{id, fingerprints.next(id, lines.line(line)).line_hash}];
}

check::Report Baseline::without_known(check::Report report, std::string_view program, std::string_view text) const {
  const auto known = programs_.find(name_of(program));
  if (known == programs_.end()) return report;
  syntax::LineFinder lines(text);
  Fingerprints fingerprints;
  std::erase_if(report.findings, [&](const check::LocatedFinding& located) {
    const Fingerprint print = fingerprints.next(located.finding.id, lines.line(located.line));
    const auto count = known->second.find({located.finding.id, print.line_hash});
    return count != known->second.end() && print.occurrence <= count->second;
  });
  return report;
}

/// Writes one finding per line, so that versions of the file can be compared.
std::string Baseline::to_json() const {
  std::string text = fmt::format("{{\n  \"version\": {},\n  \"findings\": [", kVersion);
  bool first = true;
  for (const auto& [program, counts] : programs_)
    for (const auto& [key, count] : counts) {
      fmt::format_to(
          std::back_inserter(text), "{}\n    {{\"file\": {}, \"code\": \"{}\", \"line\": \"{:016x}\", \"count\": {}}}",
          first ? "" : ",", nlohmann::json(program).dump(), dialect::definition(key.first).code, key.second, count);
      first = false;
    }
  return text + (first ? "]\n}\n" : "\n  ]\n}\n");
}

/// Reads a baseline from JSON, value by value, and stops at the first invalid one.
class BaselineReader final : public nlohmann::json_sax<nlohmann::json> {
 public:
  BaselineReader(Baseline& baseline, Language language) : baseline_(baseline), language_(language) {}

  /// The reason why it stopped.
  const std::string& mistake() const { return mistake_; }

  bool null() override { return misplaced(); }
  bool boolean(bool) override { return misplaced(); }
  bool number_integer(number_integer_t) override { return misplaced(); }
  bool number_float(number_float_t, const string_t&) override { return misplaced(); }
  bool binary(binary_t&) override { return misplaced(); }

  bool number_unsigned(number_unsigned_t value) override {
    if (place_ == JsonLevel::Finding && key_ == "count" && value > 0) {
      count_ = value;
      return true;
    }
    if (place_ != JsonLevel::Top || key_ != "version") return misplaced();
    version_ = value;
    return value == kVersion ||
           fail({"no version of baselines that is known here", "versione di baseline sconosciuta"});
  }

  bool string(string_t& value) override {
    if (place_ != JsonLevel::Finding) return misplaced();
    if (key_ == "file") {
      file_ = value;
      return true;
    }
    if (key_ == "code") {
      code_ = dialect::find_diagnostic(value);
      if (!code_) mistake_ = unknown_code(value, language_);
      return code_.has_value();
    }
    if (key_ != "line") return misplaced();
    std::uint64_t hash = 0;
    const auto read = std::from_chars(value.data(), value.data() + value.size(), hash, 16);
    if (value.empty() || read.ec != std::errc() || read.ptr != value.data() + value.size()) return misplaced();
    line_ = hash;
    return true;
  }

  bool start_object(std::size_t) override {
    if (place_ == JsonLevel::Outside && !version_) {
      place_ = JsonLevel::Top;
      return true;
    }
    if (place_ != JsonLevel::Findings) return misplaced();
    place_ = JsonLevel::Finding;
    file_.reset();
    code_.reset();
    line_.reset();
    count_.reset();
    key_.clear();
    return true;
  }

  bool key(string_t& value) override {
    static constexpr std::string_view kTopKeys[] = {"version", "findings"};
    static constexpr std::string_view kFindingKeys[] = {"file", "code", "line", "count"};
    key_ = value;
    const auto is_one_of = [&](const auto& keys) {
      return std::find(std::begin(keys), std::end(keys), key_) != std::end(keys);
    };
    if (place_ == JsonLevel::Top ? is_one_of(kTopKeys) : is_one_of(kFindingKeys)) return true;
    static constexpr Text kUnknown = {"unknown key: ", "chiave sconosciuta: "};
    mistake_ = std::string(kUnknown.in(language_)) + key_;
    return false;
  }

  bool end_object() override {
    if (place_ == JsonLevel::Top) {
      place_ = JsonLevel::Outside;
      if (!version_) return missing("version");
      return has_findings_ || missing("findings");
    }
    place_ = JsonLevel::Findings;
    if (!file_) return missing("file");
    if (!code_) return missing("code");
    if (!line_) return missing("line");
    if (!count_) return missing("count");
    baseline_.programs_[*file_][{*code_, *line_}] += *count_;
    return true;
  }

  bool start_array(std::size_t) override {
    if (place_ != JsonLevel::Top || key_ != "findings") return misplaced();
    place_ = JsonLevel::Findings;
    has_findings_ = true;
    return true;
  }

  bool end_array() override {
    place_ = JsonLevel::Top;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
    // nlohmann says "[json.exception...] parse error at line 1, column 2: syntax error ..."; the position is reported
    // separately.
    const std::string_view what = error.what();
    const std::size_t column = std::min(what.find("column "), what.size());
    const std::size_t reason = what.find(": ", column);
    static constexpr Text kNoJson = {"not JSON: ", "non è JSON: "};
    mistake_ = std::string(kNoJson.in(language_)) +
               std::string(reason == std::string_view::npos ? what : what.substr(reason + 2));
    return false;
  }

 private:
  enum class JsonLevel : std::uint8_t { Outside, Top, Findings, Finding };

  bool fail(const Text& why) {
    mistake_ = why.in(language_);
    return false;
  }
  bool misplaced() {
    if (place_ == JsonLevel::Outside || place_ == JsonLevel::Findings)
      return fail({"an object was expected here", "qui ci vuole un oggetto"});
    static constexpr Text kWrong = {"not a value of {}", "non è un valore di {}"};
    mistake_ = dialect::format(kWrong, language_, key_);
    return false;
  }
  bool missing(std::string_view key) {
    static constexpr Text kMissing = {"{} is missing from what ends here", "manca {} in ciò che finisce qui"};
    mistake_ = dialect::format(kMissing, language_, key);
    return false;
  }

  Baseline& baseline_;
  const Language language_;
  JsonLevel place_ = JsonLevel::Outside;
  std::string key_;
  std::optional<std::uint64_t> version_;
  bool has_findings_ = false;
  std::optional<std::string> file_;
  std::optional<DiagnosticId> code_;
  std::optional<std::uint64_t> line_;
  std::optional<std::uint64_t> count_;
  std::string mistake_;
};

std::variant<Baseline, std::string> Baseline::read(const fs::path& file, Language language) {
  const auto opened = system::SourceFile::open(file, language);
  if (const auto* problem = std::get_if<system::SourceFile::Problem>(&opened))
    return fmt::format("{}: {}", system::generic_name(file), problem->message);
  const std::string_view text = std::get<system::SourceFile>(opened).text();
  const char* const end = text.data() + text.size();
  const char* furthest = text.data();
  Baseline baseline(file);
  BaselineReader reader(baseline, language);
  if (nlohmann::json::sax_parse(CountedBytes(text.data(), furthest), CountedBytes(end, furthest), &reader))
    return baseline;
  // After a number the parser has read one byte more, which may be the line end.
  const auto line = 1 + std::count(text.data(), std::max(text.data(), furthest - 1), '\n');
  return fmt::format("{}:{}: {}", system::generic_name(file), line, reader.mistake());
}

}  // namespace isocnc::selection
