#include "analyzer/shards.h"

#include <charconv>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "analyzer/formats/merged_reports.h"
#include "analyzer/lint_counts.h"
#include "analyzer/lint_output.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/same_file.h"
#include "interpreter/system/source_file.h"
#include "interpreter/text/hash.h"

namespace isocnc::analyzer {

using system::ExitStatus;
using system::SourceFile;

std::optional<Shard> Shard::read(std::string_view text) {
  const char* const end = text.data() + text.size();
  std::uint64_t number = 0;
  Shard shard;
  const auto [slash, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || slash == end || *slash != '/') return std::nullopt;
  const auto [after, count_error] = std::from_chars(slash + 1, end, shard.count);
  if (count_error != std::errc{} || after != end || number < 1 || number > shard.count) return std::nullopt;
  shard.index = number - 1;
  return shard;
}

bool Shard::holds(const std::filesystem::path& file) const {
  // Absolute first: on Windows, /parts/a.iso is a path on the current drive.
  const std::filesystem::path absolute = system::normal(system::absolute(file));
  const std::filesystem::path relative = absolute.lexically_relative(std::filesystem::current_path());
  const std::filesystem::path& named = relative.empty() ? absolute : relative;
  return text::hash_on(text::kHashStart, system::generic_name(named)) % count == index;
}

static ExitStatus refuse(std::string_view why) {
  complain(why);
  return ExitStatus::Failure;
}

ExitStatus merge_shards(const LintCommandOptions& options) {
  static constexpr dialect::Text kNone = {"--merge: name the reports to join", "--merge: indicare i rapporti da unire"};
  static constexpr dialect::Text kOverwrites = {"is one of the reports to be joined", "è uno dei rapporti da unire"};
  const dialect::Language language = options.reader_language();
  if (options.paths.empty()) return refuse(kNone.in(language));
  std::vector<SourceFile> files;
  std::vector<formats::ReportFile> reports;
  for (const std::string& path : options.paths) {
    if (!options.output.empty() && system::is_same_file(options.output, path))
      return refuse(fmt::format("{}: {}", options.output, kOverwrites.in(language)));
    auto opened =
        path == "-" ? SourceFile::read_stream(system::kStandardInput, language) : SourceFile::open(path, language);
    if (const auto* problem = std::get_if<SourceFile::Problem>(&opened))
      return refuse(fmt::format("{}: {}", path, problem->message));
    files.push_back(std::get<SourceFile>(std::move(opened)));
  }
  for (std::size_t i = 0; i < files.size(); ++i) reports.push_back({options.paths[i], files[i].text()});
  const auto merged = formats::merge_reports(reports, language);
  if (const auto* const problem = std::get_if<std::string>(&merged)) return refuse(*problem);
  const auto& report = std::get<formats::MergedReport>(merged);
  LintOutput output(options);
  output.buffer() += report.text;
  if (!output.finish()) return ExitStatus::Failure;
  return status_of({.errors = report.errors, .warnings = report.warnings, .infos = report.infos, .files = report.files},
                   options);
}

}  // namespace isocnc::analyzer
