#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lsp/documents/settings_store.h"
#include "lsp/features/feature.h"
#include "lsp/rpc/strand.h"

namespace isocnc::lsp {

/// The programs in the workspace's folders that the editor does not have open, found as isolint finds them. A file is
/// read again only if it or a configuration file has changed.
///
/// Member functions are called on the loop's thread; the work runs on a strand, and callbacks are called there.
class ClosedPrograms {
 public:
  using ClientPointer = std::shared_ptr<const documents::Client>;
  struct WorkspaceQuery {
    features::WorkspaceRequest request;
    /// Called with each answer as soon as it is known; may be empty.
    std::function<void(const std::string& result)> take_one;
    std::vector<std::filesystem::path> folders;
    std::set<std::string> open;  ///< URIs of the documents that the editor has open.
    ClientPointer client;
    std::shared_ptr<const std::atomic<bool>> cancelled;  ///< The code that sets it has to answer the request itself.
  };

  ClosedPrograms(rpc::Pool& pool, documents::SettingsStore& settings) : settings_(settings), strand_(pool) {}

  /// Asks one program. The result is nothing if the program is in none of the folders, or its file cannot be read.
  void ask_one(const features::Method& method, rpc::Json params, const std::string& uri,
               std::vector<std::filesystem::path> folders, ClientPointer client,
               std::shared_ptr<const std::atomic<bool>> cancelled,
               std::function<void(std::optional<std::string> result)> done);
  /// Asks each program; `done` gets all answers, in the order of the paths. A file that cannot be read gives no answer.
  void ask(WorkspaceQuery query, std::function<void(std::vector<std::string> results)> done);

 private:
  /// The inputs on which an answer depends.
  struct Cause {
    std::filesystem::file_time_type written;
    std::uintmax_t size = 0;
    std::shared_ptr<const void> settings;
    ClientPointer client;

    friend bool operator==(const Cause&, const Cause&) = default;
  };
  struct Known {
    Cause key;
    std::string answer;
  };

  using Answer = std::function<std::string(const documents::Snapshot& snapshot)>;

  std::optional<std::string> answer_of(const std::filesystem::path& program, const std::string& uri,
                                       const documents::Client& client, const std::atomic<bool>& cancelled,
                                       const Answer& answer);
  std::vector<std::filesystem::path> programs_in(const std::vector<std::filesystem::path>& folders);
  std::optional<std::string> ask(const std::filesystem::path& program, const std::string& uri,
                                 const WorkspaceQuery& query);
  void forget_all_but(const std::set<std::string>& asked, std::string_view request);

  documents::SettingsStore& settings_;
  std::map<std::pair<std::string, std::string>, Known> cache_;  // Answers by request and URI. Used on the strand only.
  rpc::Strand strand_;
};

}  // namespace isocnc::lsp
