#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "debugger/dap/arguments.h"
#include "debugger/dap/step.h"

/// What the messages of the debug adapter protocol are made of, as far as requests share it. What one request alone
/// needs stands in its own file.
namespace isocnc::dap {

/// `{"source": {"path": ...}}`: the file that a request is about.
struct SourceArguments {
  std::string path;  ///< Empty for none.
};

/// `{"format": {"hex": true}}`: how values are to be shown.
struct FormatArguments {
  bool is_hexadecimal = false;
};

/// `{"start": 10, "count": 5}`: a part of a list; without a count all from the start on.
struct PageArguments {
  std::int64_t start = 0;
  std::int64_t count = 0;

  struct PageRange {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  PageRange of(std::size_t size) const;
};

/// `{"granularity": "instruction"}`: how far a step goes.
struct StepArguments {
  Step step = Step::Block;
};

/// When a breakpoint counts and what it does then, as the client writes it.
struct RuleArguments {
  std::optional<std::string> condition;
  std::optional<std::string> hit_condition;
  std::optional<std::string> log_message;
};

/// A breakpoint as a response describes it. What is empty is left out.
struct BreakpointBody {
  std::optional<std::int64_t> id;
  bool is_verified = false;
  std::string message;               ///< Why it is not verified.
  std::optional<std::int64_t> line;  ///< As the client counts.
  std::optional<Json> source;
};

struct BreakpointsBody {
  std::vector<BreakpointBody> breakpoints;
};

/// What an expression has come to.
struct ValueBody {
  std::string value;
};

// These throw ArgumentError. Each reads its members from the arguments of the whole request, but for RuleArguments,
// which reads those of one breakpoint.
void from_json(const Json& json, SourceArguments& arguments);
void from_json(const Json& json, FormatArguments& arguments);
void from_json(const Json& json, StepArguments& arguments);
void from_json(const Json& json, RuleArguments& arguments);

void to_json(Json& json, const BreakpointBody& breakpoint);
void to_json(Json& json, const BreakpointsBody& body);
void to_json(Json& json, const ValueBody& body);

}  // namespace isocnc::dap
