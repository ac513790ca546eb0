#include <algorithm>

#include "debugger/requests/request.h"
#include "interpreter/text/unicode.h"

namespace isocnc::requests {

static constexpr dialect::Text kSegment{"segment {} of {}", "segmento {} di {}"};
static constexpr dialect::Text kJump{"jump from line {}", "salto dalla riga {}"};
static constexpr dialect::Text kEnd{"end of program", "fine programma"};
static constexpr std::size_t kMaxName = 80;
/// Jumps that are shown: more than anybody reads.
static constexpr std::size_t kMaxJumps = 200;

namespace {

struct StackArguments {
  dap::PageArguments page;
};

/// A frame of the stack. Its id is its place in the stack, from 1.
struct StackFrame {
  std::string name;
  std::size_t line = 0;  ///< From 0.
  bool is_jump = false;
};

void from_json(const Json& json, StackArguments& arguments) {
  arguments.page.start = member<std::int64_t>(json, "startFrame").value_or(0);
  arguments.page.count = member<std::int64_t>(json, "levels").value_or(0);
}

}  // namespace

/// The text of the line, without the blanks around it.
static std::string name_of(const Session& session, std::size_t line) {
  std::string name = text::printable(session.debuggee().text().line(line));
  name.erase(0, name.find_first_not_of(' '));
  name.erase(name.find_last_not_of(' ') + 1);
  if (name.empty()) return std::string(session.in_language(kEnd));
  if (name.size() <= kMaxName) return name;
  std::size_t end = kMaxName;
  while (text::is_inside_character(name[end])) --end;
  return name.substr(0, end) + "…";
}

/// After the last line the last one is shown.
static Json frame_json(const Session& session, std::size_t id, const StackFrame& frame) {
  const debuggee::ProgramText& program = session.debuggee().text();
  const std::size_t line = std::min(frame.line, std::max<std::size_t>(program.line_count(), 1) - 1);
  const std::string_view text = program.line(line);
  const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  Json json = {{"id", id},
               {"name", frame.name},
               {"source", session.source()},
               {"line", session.client().to_client_line(line)},
               {"column", session.client().to_client_column(text::column_of(text, begin) - 1)},
               {"endLine", session.client().to_client_line(line)},
               {"endColumn", session.client().to_client_column(text::column_of(text, text.size()) - 1)}};
  if (frame.is_jump) json["presentationHint"] = "subtle";
  return json;
}

/// The segment of an arc, the block, and below it the jumps that have led there.
static std::vector<StackFrame> stack_of(Session& session) {
  const simulation::Simulation& present = session.stopped_debuggee().present();
  std::vector<StackFrame> frames;
  if (const auto segment = present.segment())
    frames.push_back({session.in_language(kSegment, segment->number + 1, segment->count), present.line()});
  frames.push_back({name_of(session, present.line()), present.line()});
  for (const debuggee::Journal::TakenJump& jump : session.journal().jumps(present.blocks())) {
    if (frames.size() > kMaxJumps) break;
    frames.push_back({session.in_language(kJump, session.client().to_client_line(jump.from)), jump.from, true});
  }
  return frames;
}

static Json answer_stack_trace(Session& session, const StackArguments& arguments) {
  const std::vector<StackFrame> frames = stack_of(session);
  const auto [begin, end] = arguments.page.of(frames.size());
  Json shown = Json::array();
  for (std::size_t i = begin; i < end; ++i) shown.push_back(frame_json(session, i + 1, frames[i]));
  return {{"stackFrames", shown}, {"totalFrames", frames.size()}};
}

static Json stack_trace_capabilities() { return {{"supportsDelayedStackTraceLoading", true}}; }

extern const DebugRequest stack_trace = on<&answer_stack_trace>("stackTrace", stack_trace_capabilities);

}  // namespace isocnc::requests
