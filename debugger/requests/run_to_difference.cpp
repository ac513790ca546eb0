#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kNoReference{
    "path has to name the file to compare with, or text has to be its program",
    "path deve indicare il file con cui confrontare, o text esserne il programma"};

namespace {

struct RunToDifferenceArguments {
  std::string path;
  std::optional<std::string> text;  ///< Of a program that is no file.
  std::string name;                 ///< Of the text, for people.
};

void from_json(const Json& json, RunToDifferenceArguments& arguments) {
  arguments.path = member<std::string>(json, "path").value_or("");
  arguments.text = member<std::string>(json, "text");
  arguments.name = member<std::string>(json, "name").value_or("text");
}

}  // namespace

/// Forward or backward to the block with which the program comes to do something else than another one.
static void answer_run_to_difference(Session& session, const RunToDifferenceArguments& arguments) {
  if (arguments.text) return session.run_to_difference(arguments.name, *arguments.text);
  if (arguments.path.empty() || arguments.path.find('\0') != std::string::npos)
    throw RequestError(std::string(session.in_language(kNoReference)));
  session.run_to_difference(arguments.path);
}

extern const DebugRequest run_to_difference = on<&answer_run_to_difference>("isocnc/runToDifference");

}  // namespace isocnc::requests
