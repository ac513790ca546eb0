#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "debugger/breakpoints/block_watch.h"
#include "debugger/breakpoints/breakpoints.h"
#include "debugger/breakpoints/exception_filters.h"
#include "debugger/dap/client.h"
#include "debugger/debuggee/debuggee.h"
#include "debugger/debuggee/journal.h"
#include "debugger/debuggee/surroundings.h"
#include "debugger/session/launch_options.h"
#include "interpreter/configuration/configuration.h"
#include "interpreter/dialect/format.h"

namespace isocnc::session {

using rpc::Json;

/// What the parts of a session share: the client, the program that is debugged, and what its run stops at.
struct SessionState {
  dap::ClientProfile client;
  std::optional<dialect::Language> commanded_language;  ///< Of the command line; overrules all others.
  LaunchOptions launch_options;
  configuration::Configuration configuration;
  std::shared_ptr<debuggee::Debuggee> debuggee;          ///< Null before a launch and after the end.
  std::shared_ptr<debuggee::Surroundings> surroundings;  ///< Of the debuggee.
  debuggee::Journal journal;
  breakpoints::Breakpoints breakpoints;
  breakpoints::ExceptionFilters exception_filters;
  std::optional<breakpoints::Exception> exception;  ///< Reason of the present stop, where it is one.

  bool is_launched() const { return debuggee != nullptr; }
  /// The present of the debuggee, which is launched.
  expressions::Moment moment() const;
  /// A moment of the debuggee's run, which a simulation has reached.
  expressions::Moment moment_of(const simulation::Simulation& simulation) const;
  /// Where a run of the debuggee, which is launched, stops within blocks.
  breakpoints::BlockWatch block_watch() { return {exception_filters, breakpoints, *surroundings}; }
  /// Whether the file is that of the program, even if it has been removed since.
  bool is_program(const std::filesystem::path& file) const;
  /// The program, as a `Source` of the protocol.
  Json source() const;

  dialect::Language language() const;
  std::string_view in_language(const dialect::Text& text) const { return text.in(language()); }
  template <class Value, class... Values>
  std::string in_language(const dialect::Text& text, const Value& value, const Values&... values) const {
    return dialect::format(text, language(), value, values...);
  }
};

}  // namespace isocnc::session
