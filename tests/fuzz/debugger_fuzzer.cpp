#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <unistd.h>

#include "debugger/adapter.h"
#include "require.h"

namespace isocnc::fuzz {

using debugger::Adapter;
using Json = lsp::rpc::Json;

/// Requests that a byte stands for; the byte behind it is their argument.
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
                                            "configurationDone"};

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
          {"filters", {"errors", byte % 2 == 0 ? "warnings" : "limits", byte % 3 == 0 ? "toolChange" : "firstCut"}},
          {"breakpoints",
           {{{"line", number},
             {"name", text},
             {"dataId", text},
             {"condition", byte % 3 == 0 ? text : ""},
             {"hitCondition", byte % 5 == 0 ? "%2" : ""},
             {"logMessage", byte % 7 == 0 ? "{" + text + "}" : ""}}}}};
}

/// Feeds one message, and then itself again, so that the slices of a run come in between.
class Feeder {
 public:
  Feeder(std::string_view bytes, std::string path)
      : bytes_(bytes), path_(std::move(path)), adapter_(loop_, [this](const std::string& body) { check(body); }) {}

  void run() {
    tell("initialize", Json::object());
    tell("launch", {{"program", path_}, {"stopOnEntry", true}});
    tell("configurationDone", Json::object());
    loop_.post([this] { feed(); });
    loop_.run(std::chrono::milliseconds(1000), [this] { adapter_.end(); });
    require(answered_ == asked_, "each request has one response");
  }

 private:
  void feed() {
    if (bytes_.size() < 2) return adapter_.end();
    const auto byte = static_cast<std::uint8_t>(bytes_[0]);
    tell(kCommands[byte % std::size(kCommands)], arguments_of(static_cast<std::uint8_t>(bytes_[1]), path_));
    bytes_.remove_prefix(2);
    loop_.post([this] { feed(); });
  }

  void tell(const std::string& command, const Json& arguments) {
    const Json message = {{"seq", ++asked_}, {"type", "request"}, {"command", command}, {"arguments", arguments}};
    adapter_.receive({lsp::rpc::Frame::Problem::None, message.dump()});
  }

  void check(const std::string& body) {
    const Json message = Json::parse(body);
    require(message.at("seq") == ++said_, "messages are numbered");
    if (message.at("type") == "response") require(message.at("request_seq") == ++answered_, "in the order of requests");
  }

  std::string_view bytes_;
  const std::string path_;
  std::int64_t asked_ = 0;
  std::int64_t answered_ = 0;
  std::int64_t said_ = 0;
  lsp::rpc::Loop loop_;
  Adapter adapter_;
};

/// Up to the first 0 a program, and behind it what is asked.
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
