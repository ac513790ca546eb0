#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <unistd.h>

#include "lsp/feature_list.h"
#include "lsp/protocol/uri.h"
#include "lsp/server.h"
#include "require.h"

namespace isocnc::fuzz {

using lsp::Server;
using Json = rpc::Json;

/// The notifications and requests of an editor; all that the features answer follow.
static constexpr const char* kOwn[] = {"textDocument/didOpen",
                                       "textDocument/didChange",
                                       "textDocument/didChange",
                                       "textDocument/didChange",
                                       "textDocument/didClose",
                                       "textDocument/didSave",
                                       "workspace/didChangeConfiguration",
                                       "workspace/didChangeWatchedFiles",
                                       "workspace/didChangeWorkspaceFolders",
                                       "$/cancelRequest",
                                       ""};  // Waits until all has been answered.

static constexpr const char* kTexts[] = {"X",          "1",         "\n",   "\r\n",      "(",
                                         ")",          ";isolint",  " ",    "G02 X5 R1", "M06 T101001\nG01 F500\n",
                                         "G41\n",      "G27\nG92 ", "V3=2", "N10\n",     "IF V3 > 1 GOTO N10\n",
                                         "\xC3\xA0",   "M02\n",     "G91 ", "G24 X10\n", "\xF0\x9F\x98\x80",
                                         "G71 G71\nM", "",          "%\n",  "G28",       "G01 Z-5\nG00 Z50\nM05\n",
                                         "\xFF"};

static constexpr const char* kProgram =
    "M06 T101001\nS18000 M03\nG00 X0 Y0 Z5\nG01 Z-2 F1500\nV1 = 3\nIF V1 > 2 GOTO N10\nX10 Y10\n"
    "N10 G02 X20 Y20 R10\nG71 G71\nG00 Z50\nM02\n";
static constexpr const char* kConfiguration =
    R"({"machine": {"axes": {"X": {"limits": [0, 3000]}}}, "lint": {"severity": {"W1": "warning"}}})";

/// The names of what features answer, in their order.
struct Answered {
  std::vector<std::string> methods;
  std::set<std::string> commands;
};

static const Answered& answered_by_features() {
  static const Answered kAnswered = [] {
    Answered answered;
    for (const features::Feature* const feature : lsp::all_features()) {
      for (const auto& method : feature->methods) answered.methods.emplace_back(method.name);
      for (const auto& request : feature->workspace_requests) answered.methods.emplace_back(request.name);
      for (const auto& command : feature->commands) answered.commands.emplace(command.name);
    }
    answered.methods.insert(answered.methods.end(), answered.commands.begin(), answered.commands.end());
    return answered;
  }();
  return kAnswered;
}

/// Of this process, with a program and a configuration, removed at its end.
static const std::filesystem::path& folder() {
  static const std::filesystem::path kFolder =
      std::filesystem::temp_directory_path() / ("isols-fuzz-" + std::to_string(::getpid()));
  [[maybe_unused]] static const bool kMade = [] {
    std::filesystem::create_directories(kFolder);
    std::ofstream(kFolder / "closed.iso") << kProgram;
    std::ofstream(kFolder / "isocnc.json") << kConfiguration;
    return std::atexit([] { std::filesystem::remove_all(kFolder); }) == 0;
  }();
  return kFolder;
}

/// Each range in a message ends after its start; edits of one text do not overlap.
static void check_ranges(const Json& json) {
  const auto place = [](const Json& position) {
    return std::pair(position.at("line").get<std::int64_t>(), position.at("character").get<std::int64_t>());
  };
  const auto is_range = [](const Json& each) {
    return each.is_object() && each.contains("start") && each.contains("end") && each["start"].is_object();
  };
  if (is_range(json)) require(place(json["start"]) <= place(json["end"]), "ranges end after their start");
  if (json.is_array() && !json.empty() && json[0].is_object() && json[0].contains("newText")) {
    std::multimap<std::pair<std::int64_t, std::int64_t>, std::pair<std::int64_t, std::int64_t>> edits;
    for (const Json& edit : json) edits.emplace(place(edit["range"]["start"]), place(edit["range"]["end"]));
    auto last_end = std::pair<std::int64_t, std::int64_t>();
    for (const auto& [begin, end] : edits) {
      require(begin >= last_end, "edits of one text do not overlap");
      last_end = end;
    }
  }
  if (json.is_structured())
    for (const Json& each : json) check_ranges(each);
}

/// An editor that types without waiting. It feeds one message, and then itself again, so that answers come in between.
class Typist {
 public:
  explicit Typist(std::string_view bytes)
      : bytes_(bytes), server_(loop_, [this](const std::string& body) { check(body); }) {}

  void run() {
    const unsigned abilities = number();
    hangs_up_ = (abilities & 1u) != 0;
    ask("initialize", {{"processId", nullptr},
                       {"capabilities", capabilities(abilities)},
                       {"workspaceFolders", Json::array({{{"uri", uri("")}, {"name", "parts"}}})}});
    notify("initialized", Json::object());
    open(0, kProgram);
    loop_.post([this] { feed(); });
    loop_.run(std::chrono::seconds(1), [] {});
    if (hangs_up_) return;
    require(open_.empty(), "each request has an answer");
    require(server_.exit_status() == 0, "the end is clean");
  }

 private:
  unsigned number() {
    if (bytes_.empty()) return 0;
    const auto value = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return value;
  }
  /// One that the fuzzer knows, or some of its own bytes.
  std::string text() {
    const unsigned choice = number();
    if (choice < 128) return kTexts[choice % std::size(kTexts)];
    const std::string taken(bytes_.substr(0, choice % 64));
    bytes_.remove_prefix(taken.size());
    return taken;
  }
  static std::string uri(const char* name) { return protocol::uri_of(folder() / name); }
  static std::string uri_of_document(unsigned choice) {
    static constexpr const char* kNames[] = {"part.iso", "part.iso",    "part.iso", "other.iso",
                                             "part.iso", "isocnc.json", "part.iso", "closed.iso"};
    return uri(kNames[choice % std::size(kNames)]);
  }

  static Json capabilities(unsigned abilities) {
    static constexpr const char* kEncodings[] = {"utf-16", "utf-8", "utf-32"};
    const bool is_able = (abilities & 2u) != 0;
    Json properties = Json::array();
    if ((abilities & 4u) != 0) properties.push_back("edit");
    return {{"general", {{"positionEncodings", {kEncodings[(abilities >> 3) % 3]}}}},
            {"workspace",
             {{"didChangeWatchedFiles", {{"dynamicRegistration", is_able}}},
              {"workspaceEdit", {{"documentChanges", is_able}, {"resourceOperations", {"create"}}}},
              {"semanticTokens", {{"refreshSupport", is_able}}}}},
            {"window", {{"workDoneProgress", is_able}}},
            {"textDocument",
             {{"codeAction", {{"resolveSupport", {{"properties", properties}}}}},
              {"documentSymbol", {{"hierarchicalDocumentSymbolSupport", is_able}}},
              {"publishDiagnostics", {{"relatedInformation", is_able}}},
              {"rename", {{"prepareSupport", is_able}}},
              {"completion", {{"completionItem", {{"snippetSupport", is_able}}}}}}}};
  }

  void feed() {
    if (is_waiting_ && !open_.empty()) return;  // The step continues with the last answer.
    is_waiting_ = false;
    if (bytes_.size() < 4 || ++fed_ > kMaxMessages) return leave();
    const std::vector<std::string>& methods = answered_by_features().methods;
    const std::size_t choice = number() % (std::size(kOwn) + methods.size());
    if (choice < std::size(kOwn)) {
      act(kOwn[choice]);
    } else {
      ask_feature(methods[choice - std::size(kOwn)]);
    }
    loop_.post([this] { feed(); });
  }

  /// Wherever the server is at that moment, or when it has answered everything.
  void leave() {
    if (hangs_up_) return server_.end();
    if (!open_.empty()) {
      is_waiting_ = true;
      return;
    }
    if (std::exchange(is_leaving_, true)) return notify("exit", nullptr);
    is_waiting_ = true;  // The answer comes before ask() returns.
    ask("shutdown", nullptr);
  }

  void act(const std::string& method) {
    if (method.empty()) {
      is_waiting_ = true;
      return;
    }
    const unsigned document = number();
    const Json named = {{"uri", uri_of_document(document)}, {"version", ++version_}};
    if (method == "textDocument/didOpen") return open(document, text());
    if (method == "textDocument/didChange") {
      Json changes = Json::array();
      do {
        Json change = {{"range", range()}, {"text", text()}};
        if (number() % 16 == 1) change.erase("range");
        changes.push_back(change);
      } while (number() % 4 == 1);
      return notify(method, {{"textDocument", named}, {"contentChanges", changes}});
    }
    if (method == "$/cancelRequest") return notify(method, {{"id", asked_ - document % 4}});
    notify(method, {{"textDocument", named},
                    {"settings", {{"isocnc", {{"language", document % 2 == 0 ? "it" : "en"}}}}},
                    {"changes", Json::array({named})},
                    {"event",
                     {{"added", Json::array({{{"uri", uri(document % 2 == 0 ? "" : "gone")}}})},
                      {"removed", Json::array({{{"uri", uri("")}}})}}}});
  }

  void open(unsigned document, const std::string& text) {
    notify("textDocument/didOpen",
           {{"textDocument",
             {{"uri", uri_of_document(document)}, {"languageId", "isocnc"}, {"version", ++version_}, {"text", text}}}});
  }

  Json position() {
    const unsigned line = number() % 24;
    return {{"line", line}, {"character", number() % 32}};
  }
  Json range() {
    Json start = position();
    return {{"start", start}, {"end", position()}};
  }

  void ask_feature(const std::string& method) {
    const unsigned document = number();
    const Json where = range();
    if (method.ends_with("/resolve")) {
      const auto item =
          items_.empty() ? Json({{"data", {{"uri", uri("part.iso")}}}}) : items_[document % items_.size()];
      return ask(method, item);
    }
    const std::string uri = uri_of_document(document);
    const Json of_command = {{"uri", uri}, {"line", where["start"]["line"]}, {"vgpl", document % 3}};
    if (answered_by_features().commands.contains(method))
      return ask("workspace/executeCommand", {{"command", method}, {"arguments", Json::array({of_command})}});
    static constexpr const char* kNames[] = {"N20", "V7", "N10", "V0", "x", "", "N1 N2"};
    ask(method, {{"textDocument", {{"uri", uri}}},
                 {"position", where["start"]},
                 {"positions", {where["start"], where["end"]}},
                 {"range", where},
                 {"line", where["end"]["line"]},
                 {"context",
                  {{"diagnostics", diagnostics_},
                   {"includeDeclaration", document % 2 == 0},
                   {"triggerKind", 1},
                   {"stoppedLocation", where}}},
                 {"newName", kNames[document % std::size(kNames)]},
                 {"query", document % 2 == 0 ? "" : "t1"},
                 {"ch", document % 2 == 0 ? "\n" : "("},
                 {"options", {{"tabSize", 2}, {"insertSpaces", true}}},
                 {"previousResultId", last_result_},
                 {"previousResultIds", Json::array({{{"uri", uri}, {"value", last_result_}}})}});
  }

  void ask(const std::string& method, const Json& params) {
    open_.insert(++asked_);
    send({{"jsonrpc", "2.0"}, {"id", asked_}, {"method", method}, {"params", params}});
  }
  void notify(const std::string& method, const Json& params) {
    send({{"jsonrpc", "2.0"}, {"method", method}, {"params", params}});
  }
  void send(const Json& message) { server_.receive({rpc::MessageFrame::FramingError::None, rpc::write(message)}); }

  void check(const std::string& body) {
    const Json message = Json::parse(body);
    check_ranges(message);
    if (message.contains("method")) {
      if (message["method"] == "textDocument/publishDiagnostics") diagnostics_ = message["params"]["diagnostics"];
      require(message["method"] != "window/logMessage", "nothing goes wrong within");
      return;
    }
    require(open_.erase(message.at("id").get<std::int64_t>()) == 1, "a request has one answer");
    require(message.contains("result") != message.contains("error"), "a result or an error");
    if (message.contains("error")) {
      constexpr int kInternal = -32603;
      constexpr int kNoMethod = -32601;
      const int code = message["error"]["code"];
      require(code != kInternal && code != kNoMethod, "errors have their reason");
    } else {
      remember(message["result"]);
    }
    if (is_waiting_ && open_.empty()) loop_.post([this] { feed(); });
  }

  /// What the client may come back with.
  void remember(const Json& result) {
    if (!result.is_structured()) return;
    if (result.is_object() && result.contains("resultId")) last_result_ = result["resultId"];
    const Json& list = result.is_object() && result.contains("items") ? result["items"] : result;
    std::vector<Json> items;
    if (list.is_array())
      for (const Json& each : list)
        if (each.is_object() && each.contains("data") && items.size() < 64) items.push_back(each);
    if (!items.empty()) items_ = std::move(items);
  }

  /// More of them find little more, and take long.
  static constexpr int kMaxMessages = 128;

  std::string_view bytes_;
  int fed_ = 0;
  bool hangs_up_ = false;
  bool is_waiting_ = false;
  bool is_leaving_ = false;
  std::int64_t asked_ = 0;
  std::int64_t version_ = 0;
  std::set<std::int64_t> open_;  // Requests without an answer.
  std::vector<Json> items_;
  Json diagnostics_ = Json::array();
  std::string last_result_;
  rpc::Loop loop_;
  Server server_;  // Last: its threads leave tasks for the loop.
};

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::Typist(isocnc::fuzz::as_text(data, size)).run();
  return 0;
}
