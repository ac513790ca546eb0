#include "lsp/posted_programs.h"

#include <utility>

#include <fmt/format.h>

#include "analyzer/input/settling.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/configuration/shape_files.h"
#include "lsp/protocol/uri.h"
#include "lsp/rpc/on_loop.h"

namespace isocnc::lsp {

using rpc::Json;

static constexpr std::chrono::milliseconds kMoment = input::Settling<int>::kMoment;

PostedPrograms::PostedPrograms(rpc::Loop& loop, rpc::Pool& pool, Outbox& outbox, documents::SettingsStore& settings,
                               std::function<void()> settled)
    : loop_(loop), outbox_(outbox), settings_(settings), settled_(std::move(settled)), reading_(pool) {}

/// `**/*.[nN][cC]` for `.nc`: patterns have no other way to ignore case.
static std::string pattern_of(std::string_view extension) {
  static constexpr int kCaseBit = 'a' - 'A';
  std::string pattern = "**/*";
  for (const char c : extension) {
    const char lower = static_cast<char>(c | kCaseBit);
    if (lower >= 'a' && lower <= 'z') {
      pattern += fmt::format("[{}{}]", lower, static_cast<char>(lower - kCaseBit));
    } else {
      pattern += c;
    }
  }
  return pattern;
}

void PostedPrograms::watch(const ClosedPrograms::Folders& folders, bool watches_programs) {
  const std::uint64_t number = ++times_asked_;
  if (!watches_programs) return register_patterns({});
  const rpc::OnLoop<std::set<std::string>> take(loop_, [this, number](const std::set<std::string>& extensions) {
    if (number == times_asked_) register_patterns(extensions);
  });
  reading_.post([&settings = settings_, folders, take] {
    std::set<std::string> extensions;
    for (const std::filesystem::path& folder : folders) {
      const documents::DocumentSettings found = settings.of(folder / "program");
      extensions.insert(found.configuration->lint.extensions.begin(), found.configuration->lint.extensions.end());
    }
    take(std::move(extensions));
  });
}

void PostedPrograms::register_patterns(const std::set<std::string>& extensions) {
  static constexpr const char* kMethod = "workspace/didChangeWatchedFiles";
  static constexpr const char* kId = "files";
  std::vector<std::string> patterns = {fmt::format("**/{}", configuration::kFileName),
                                       fmt::format("**/*{}", configuration::kSetupExtension)};
  for (const std::string_view extension : configuration::kShapeExtensions) patterns.push_back(pattern_of(extension));
  for (const std::string& extension : extensions) patterns.push_back(pattern_of(extension));
  if (patterns == watched_) return;
  if (!watched_.empty())
    outbox_.request("client/unregisterCapability",
                    {{"unregisterations", Json::array({{{"id", kId}, {"method", kMethod}}})}});
  watched_ = std::move(patterns);
  Json watchers = Json::array();
  for (const std::string& pattern : watched_) watchers.push_back({{"globPattern", pattern}});
  const Json registration = {{"id", kId}, {"method", kMethod}, {"registerOptions", {{"watchers", watchers}}}};
  outbox_.request("client/registerCapability", {{"registrations", Json::array({registration})}});
}

void PostedPrograms::note_changes(const std::vector<std::string>& uris) {
  const Clock::time_point now = Clock::now();
  for (const std::string& uri : uris)
    if (const auto path = protocol::path_of(uri)) changed_[protocol::uri_of(*path)] = now;
  loop_.post_at(now + kMoment, [this, now] { settle(now); });
}

/// Programs that have changed again meanwhile have a later time.
void PostedPrograms::settle(Clock::time_point changed) {
  if (std::erase_if(changed_, [&](const auto& each) { return each.second == changed; }) > 0) settled_();
}

std::set<std::string> PostedPrograms::unsettled() const {
  std::set<std::string> uris;
  for (const auto& [uri, changed] : changed_) uris.insert(uri);
  return uris;
}

}  // namespace isocnc::lsp
