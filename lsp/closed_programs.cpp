#include "lsp/closed_programs.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <variant>

#include "analyzer/input/files.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/source_file.h"
#include "lsp/documents/analyzed_document.h"
#include "lsp/documents/snapshot.h"
#include "lsp/protocol/uri.h"

namespace isocnc::lsp {

/// The version of documents that are not open in the editor.
static constexpr std::int64_t kNoVersion = -1;

std::vector<std::filesystem::path> ClosedPrograms::programs_in(const Folders& folders) {
  // Keep the configurations alive while the search uses them.
  std::vector<std::shared_ptr<const void>> owners;
  const auto rules = [&](const std::filesystem::path& folder) -> input::SearchRules {
    const documents::DocumentSettings settings = settings_.of(folder / "program");
    if (owners.empty() || owners.back() != settings.owner) owners.push_back(settings.owner);
    const configuration::Lint& lint = settings.configuration->lint;
    return {lint.extensions, &lint.excluded};
  };
  std::vector<std::string> paths;
  paths.reserve(folders.size());
  for (const std::filesystem::path& folder : folders) paths.push_back(system::generic_name(folder));
  // A folder that cannot be read is not reported: the user sees it in the editor's view of the folders.
  return input::select_files(paths, rules, dialect::Language::English).files;
}

/// Nothing where the file cannot be read, or the answer is not wanted any more.
std::optional<std::string> ClosedPrograms::read_and_answer(const std::filesystem::path& program, const std::string& uri,
                                                           const protocol::Client& client,
                                                           const std::atomic<bool>& cancelled,
                                                           const MakeAnswer& answer) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(program, error)) return std::nullopt;  // Reading a pipe would block.
  const auto opened = system::SourceFile::open_unmapped(program, dialect::Language::English);
  const auto* const source = std::get_if<system::SourceFile>(&opened);
  if (source == nullptr) return std::nullopt;
  documents::AnalyzedDocument document(uri, settings_);
  document.open(kNoVersion, source->text());
  try {
    return answer(documents::Snapshot(document, client, documents::Interest{&cancelled, nullptr}));
  } catch (const rpc::Error&) {
    return std::nullopt;
  }
}

/// Nothing where the file cannot be read, or the answer is not wanted any more.
std::optional<std::string> ClosedPrograms::cached_answer(const std::filesystem::path& program, const std::string& uri,
                                                         const WorkspaceQuery& query) {
  Known& known = cache_[{std::string(query.request.name), uri}];
  if (query.unsettled.contains(uri)) return known.answer.empty() ? std::nullopt : std::optional(known.answer);
  std::error_code error;
  AnswerInputs key{.written = std::filesystem::last_write_time(program, error),
                   .size = error ? 0 : std::filesystem::file_size(program, error),
                   .settings = settings_.of(program).owner,
                   .client = query.client};
  if (error) return std::nullopt;
  if (known.key == key) return known.answer;
  known = {};
  auto answer = read_and_answer(
      program, uri, *query.client, *query.cancelled,
      [&](const documents::Snapshot& snapshot) { return query.request.answer(snapshot, rpc::Json::object()); });
  if (answer) known = {std::move(key), *answer};
  return answer;
}

static bool is_below(const std::filesystem::path& folder, const std::filesystem::path& program) {
  const std::filesystem::path inside = program.lexically_relative(folder);
  return !inside.empty() && *inside.begin() != "..";
}

/// Whether a program lies in one of the folders, both by its name and with symbolic links resolved.
static bool is_in_one_of(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& program) {
  return std::any_of(folders.begin(), folders.end(), [&](const std::filesystem::path& folder) {
    return is_below(folder, program) && is_below(configuration::real_path(folder), configuration::real_path(program));
  });
}

std::optional<std::string> ClosedPrograms::answer_of(const features::Method& method, const rpc::Json& params,
                                                     const std::string& uri, const Folders& folders,
                                                     const protocol::Client& client,
                                                     const std::atomic<bool>& cancelled) {
  const auto program = protocol::path_of(uri);
  if (!program || cancelled.load() || !is_in_one_of(folders, *program)) return std::nullopt;
  return read_and_answer(*program, uri, client, cancelled,
                         [&](const documents::Snapshot& snapshot) { return method.answer(snapshot, params); });
}

/// Drops the answers of programs that have been removed, or are open now.
void ClosedPrograms::forget_all_but(const std::set<std::string>& asked, std::string_view request) {
  std::erase_if(cache_, [&](const auto& known) {
    const auto& [name, uri] = known.first;
    return name == request && !asked.contains(uri);
  });
}

std::optional<std::vector<std::string>> ClosedPrograms::answers(const WorkspaceQuery& query) {
  std::vector<std::string> results;
  std::set<std::string> asked;
  for (const std::filesystem::path& program : programs_in(query.folders)) {
    if (query.cancelled->load()) return std::nullopt;
    const std::string uri = protocol::uri_of(program);
    if (query.open.contains(uri)) continue;
    asked.insert(uri);
    auto answer = cached_answer(program, uri, query);
    if (!answer) continue;
    if (query.take_one) (*query.take_one)(*answer);
    results.push_back(std::move(*answer));
  }
  forget_all_but(asked, query.request.name);
  return results;
}

}  // namespace isocnc::lsp
