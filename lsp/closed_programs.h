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
#include "lsp/rpc/on_loop.h"

namespace isocnc::lsp {

/// The programs in the workspace's folders that the editor does not have open, found as isolint finds them. A file is
/// read again only if it or a configuration file has changed. It belongs to a strand (rpc::StrandBound in Server).
class ClosedPrograms {
 public:
  using Folders = std::vector<std::filesystem::path>;
  struct WorkspaceQuery {
    features::WorkspaceRequest request;
    /// Gets each answer as soon as it is known; may be empty.
    std::optional<rpc::OnWorker<std::string>> take_one;
    Folders folders;
    std::set<std::string> open;       ///< URIs of the documents that the editor has open.
    std::set<std::string> unsettled;  ///< URIs of programs that are being written: their earlier answers count.
    protocol::ClientPointer client;
    std::shared_ptr<const std::atomic<bool>> cancelled;  ///< The code that sets it has to answer the request itself.
  };

  explicit ClosedPrograms(documents::SettingsStore& settings) : settings_(settings) {}

  /// The answer of one program. Nothing if the program is in none of the folders, or its file cannot be read, or the
  /// request has been cancelled.
  std::optional<std::string> answer_of(const features::Method& method, const rpc::Json& params, const std::string& uri,
                                       const Folders& folders, const protocol::Client& client,
                                       const std::atomic<bool>& cancelled);
  /// The answers of all programs, in the order of the paths, without those whose file cannot be read. Nothing if the
  /// request has been cancelled.
  std::optional<std::vector<std::string>> answers(const WorkspaceQuery& query);

 private:
  /// The inputs on which an answer depends.
  struct AnswerInputs {
    std::filesystem::file_time_type written;
    std::uintmax_t size = 0;
    std::shared_ptr<const void> settings;
    protocol::ClientPointer client;

    friend bool operator==(const AnswerInputs&, const AnswerInputs&) = default;
  };
  struct Known {
    AnswerInputs key;
    std::string answer;
  };

  using MakeAnswer = std::function<std::string(const documents::Snapshot& snapshot)>;

  std::optional<std::string> read_and_answer(const std::filesystem::path& program, const std::string& uri,
                                             const protocol::Client& client, const std::atomic<bool>& cancelled,
                                             const MakeAnswer& answer);
  std::vector<std::filesystem::path> programs_in(const Folders& folders);
  std::optional<std::string> cached_answer(const std::filesystem::path& program, const std::string& uri,
                                           const WorkspaceQuery& query);
  void forget_all_but(const std::set<std::string>& asked, std::string_view request);

  documents::SettingsStore& settings_;
  std::map<std::pair<std::string, std::string>, Known> cache_;  // Answers by request and URI.
};

}  // namespace isocnc::lsp
