#include <algorithm>

#include "debugger/requests/request.h"
#include "interpreter/syntax/unicode.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kSegment{"segment {} of {}", "segmento {} di {}"};
static constexpr dialect::Text kJump{"jump from line {}", "salto dalla riga {}"};
static constexpr dialect::Text kEnd{"end of program", "fine programma"};
static constexpr std::size_t kLongestName = 80;
/// Jumps that are shown: nobody reads more.
static constexpr std::size_t kMostJumps = 200;

/// What the line says, without what surrounds it.
static std::string name_of(const Session& session, std::uint64_t line) {
  std::string name = syntax::printable(session.debuggee().text().line(line));
  name.erase(0, name.find_first_not_of(' '));
  name.erase(name.find_last_not_of(' ') + 1);
  if (name.empty()) return std::string(session.in_language(kEnd));
  if (name.size() <= kLongestName) return name;
  std::size_t end = kLongestName;
  while (syntax::is_inside_character(name[end])) --end;
  return name.substr(0, end) + "…";
}

/// Behind the last line the last one is shown.
static Json frame(const Session& session, std::size_t id, const std::string& name, std::uint64_t place) {
  const std::uint64_t lines = session.debuggee().text().line_count();
  const std::uint64_t line = std::min(place, std::max<std::uint64_t>(lines, 1) - 1);
  const std::string_view text = session.debuggee().text().line(line);
  const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  return {{"id", id},
          {"name", name},
          {"source", session.source()},
          {"line", session.client().to_client_line(line)},
          {"column", session.client().to_client_column(syntax::column_of(text, begin) - 1)},
          {"endLine", session.client().to_client_line(line)},
          {"endColumn", session.client().to_client_column(syntax::column_of(text, text.size()) - 1)}};
}

/// The segment of an arc, the block, and below it the jumps that have led there.
static Json answer_stack_trace(Session& session, const Json& arguments) {
  const simulation::Simulation& present = session.stopped_debuggee().present();
  Json frames = Json::array();
  if (const auto segment = present.segment())
    frames.push_back(
        frame(session, 1, session.in_language(kSegment, segment->number + 1, segment->count), present.line()));
  frames.push_back(frame(session, frames.size() + 1, name_of(session, present.line()), present.line()));
  for (const session::Journal::Jump& jump : session.journal().jumps(present.blocks())) {
    if (frames.size() > kMostJumps) break;
    Json json = frame(session, frames.size() + 1,
                      session.in_language(kJump, session.client().to_client_line(jump.from)), jump.from);
    json["presentationHint"] = "subtle";
    frames.push_back(json);
  }
  const auto total = static_cast<std::int64_t>(frames.size());
  const std::int64_t begin = std::clamp<std::int64_t>(find_integer(arguments, "startFrame").value_or(0), 0, total);
  const std::int64_t levels = find_integer(arguments, "levels").value_or(0);
  const std::int64_t end = levels > 0 && levels < total - begin ? begin + levels : total;
  Json shown = Json::array();
  for (std::int64_t i = begin; i < end; ++i) shown.push_back(frames[static_cast<std::size_t>(i)]);
  return {{"stackFrames", shown}, {"totalFrames", total}};
}

static Json stack_trace_capabilities() { return {{"supportsDelayedStackTraceLoading", true}}; }

extern const Request stack_trace = {
    .command = "stackTrace", .answer = answer_stack_trace, .capabilities = stack_trace_capabilities};

}  // namespace isocnc::debugger::requests
