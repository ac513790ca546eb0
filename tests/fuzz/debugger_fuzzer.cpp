#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <unistd.h>

#include "debugger/adapter.h"
#include "debugger/requests/request.h"
#include "require.h"

namespace isocnc::fuzz {

using debugger::Adapter;
using Json = rpc::Json;

/// Requests that a byte stands for, in the order that the seeds rely on.
static constexpr const char* kCommands[] = {"next",
                                            "stepIn",
                                            "stepOut",
                                            "stepBack",
                                            "continue",
                                            "reverseContinue",
                                            "pause",
                                            "restart",
                                            "goto",
                                            "variables",
                                            "scopes",
                                            "stackTrace",
                                            "exceptionInfo",
                                            "evaluate",
                                            "threads",
                                            "source",
                                            "completions",
                                            "setBreakpoints",
                                            "setVariable",
                                            "setExpression",
                                            "gotoTargets",
                                            "terminate",
                                            "setFunctionBreakpoints",
                                            "setDataBreakpoints",
                                            "setExceptionBreakpoints",
                                            "breakpointLocations",
                                            "dataBreakpointInfo",
                                            "loadedSources",
                                            "cancel",
                                            "launch",
                                            "configurationDone",
                                            "disconnect",
                                            ""};  // Asks for nothing: what runs goes on for a while.

/// These, and after them all others that there are; the byte after that of a request is its argument.
static const std::vector<std::string>& commands() {
  static const std::vector<std::string> kAll = [] {
    std::vector<std::string> all(std::begin(kCommands), std::end(kCommands));
    for (const requests::DebugRequest* const request : requests::all_requests())
      if (std::find(all.begin(), all.end(), request->command) == all.end()) all.emplace_back(request->command);
    return all;
  }();
  return kAll;
}

static constexpr const char* kTexts[] = {
    "X",         "V3",  "Z < 0 && S > 0", "G00 X5", "G91 G909", "M06 T101001", "V3=2",      "(",   "X,x",
    "G02 X5 R1", "M06", "T101001",        "Z = 0",  "OVERRIDE", "F",           "Registers", "G41", "IF V3 > 1 GOTO N5"};

static Json arguments_of(std::uint8_t byte, const std::string& path) {
  const std::string text = kTexts[byte % std::size(kTexts)];
  const int number = byte % 40;
  return {{"threadId", 1},
          {"targetId", number},
          {"variablesReference", number},
          {"line", number},
          {"column", number % 5},
          {"endLine", number + 3},
          {"text", text},
          {"name", text},
          {"value", text},
          {"expression", text},
          {"context", byte % 2 == 0 ? "repl" : "watch"},
          {"granularity", byte % 2 == 0 ? "instruction" : "line"},
          {"source", {{"path", path}}},
          {"progressId", "1"},
          {"filters",
           {"errors", byte % 2 == 0 ? "warnings" : "limits", byte % 3 == 0 ? "toolChange" : "firstCut",
            byte % 5 == 0 ? "contacts" : "run"}},
          {"breakpoints",
           {{{"line", number},
             {"name", text},
             {"dataId", text},
             {"condition", byte % 3 == 0 ? text : ""},
             {"hitCondition", byte % 5 == 0 ? "%2" : ""},
             {"logMessage", byte % 7 == 0 ? "{" + text + "}" : ""}}}}};
}

static Json launch_arguments(std::uint8_t options, const std::string& path) {
  Json arguments = {{"program", path},
                    {"stopOnEntry", (options & 1u) == 0},
                    {"breakOnWarnings", (options & 2u) != 0},
                    {"noDebug", (options & 4u) != 0},
                    {"vgpl", options % 3},
                    {"registers", {{"V3", options % 5}}},
                    {"decimals", options % 13}};
  if ((options & 8u) != 0) arguments["startAtLine"] = 1 + options / 16;
  return arguments;
}

/// Feeds one message, and then itself again, so that the slices of a run come in between.
class Feeder {
 public:
  Feeder(std::string_view bytes, std::string path)
      : bytes_(bytes), path_(std::move(path)), adapter_(loop_, [this](const std::string& body) { check(body); }) {}

  void run() {
    const std::uint8_t options = number();
    send("initialize", {{"linesStartAt1", (options & 16u) == 0},
                        {"columnsStartAt1", (options & 32u) == 0},
                        {"supportsInvalidatedEvent", (options & 64u) != 0},
                        {"supportsProgressReporting", true},
                        {"locale", (options & 128u) != 0 ? "it" : "en"}});
    send("launch", launch_arguments(number(), path_));
    send("configurationDone", Json::object());
    loop_.post([this] { feed(); });
    loop_.run(std::chrono::milliseconds(1000), [this] { adapter_.end(); });
    require(answered_ == asked_, "each request has one response");
  }

 private:
  std::uint8_t number() {
    if (bytes_.empty()) return 0;
    const auto value = static_cast<std::uint8_t>(bytes_.front());
    bytes_.remove_prefix(1);
    return value;
  }

  void feed() {
    if (bytes_.size() < 2) return adapter_.end();
    const std::string& command = commands()[number() % commands().size()];
    const std::uint8_t argument = number();
    if (command.empty()) return wait(argument % 32);
    Json arguments = arguments_of(argument, path_);
    if (command == "restart" && argument % 2 == 0) arguments["arguments"] = launch_arguments(argument, path_);
    send(command, arguments);
    loop_.post([this] { feed(); });
  }

  /// For so many slices of a run.
  void wait(int turns) {
    loop_.post([this, turns] { turns > 0 ? wait(turns - 1) : feed(); });
  }

  void send(const std::string& command, const Json& arguments) {
    const Json message = {{"seq", ++asked_}, {"type", "request"}, {"command", command}, {"arguments", arguments}};
    adapter_.receive({rpc::MessageFrame::FramingError::None, message.dump()});
  }

  void check(const std::string& body) {
    const Json message = Json::parse(body);
    require(message.at("seq") == ++output_, "messages are numbered");
    if (message.at("type") == "response") require(message.at("request_seq") == ++answered_, "in the order of requests");
  }

  std::string_view bytes_;
  const std::string path_;
  std::int64_t asked_ = 0;
  std::int64_t answered_ = 0;
  std::int64_t output_ = 0;
  rpc::Loop loop_;
  Adapter adapter_;
};

/// Up to the first 0 a program, then how it is launched and what is asked.
static void debug(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  const std::string path =
      (std::filesystem::temp_directory_path() / ("isodap-fuzz-" + std::to_string(::getpid()) + ".iso")).string();
  std::ofstream(path, std::ios::binary) << bytes.substr(0, end);
  Feeder(bytes.substr(std::min(end + 1, bytes.size())), path).run();
  std::filesystem::remove(path);
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::debug(isocnc::fuzz::as_text(data, size));
  return 0;
}
