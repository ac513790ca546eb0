#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "debugger/breakpoints/exception_filter.h"
#include "debugger/expressions/expression.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/running/runner.h"
#include "interpreter/timing/timing.h"
#include "interpreter/verification/contact.h"

namespace isocnc::breakpoints {

/// What has stopped a run other than a breakpoint, a step or a pause.
struct Exception {
  ExceptionFilter filter = ExceptionFilter::Errors;
  std::string code;         ///< `ISO031`, or the name of the filter.
  std::string message;      ///< One line.
  std::string explanation;  ///< Full explanation of the code; may be empty.
};

/// A finding of the checker, or of a run, at its line.
struct Warning {
  dialect::DiagnosticId id = dialect::kNoDiagnostic;
  std::string message;
};

/// The exception filters that are on. They judge each block before it is executed, and contacts where they begin.
class ExceptionFilters {
 public:
  /// Warnings by line, from 0; empty until the checker has read the program.
  std::multimap<std::size_t, Warning> warnings;

  /// What a run on the machine shows, by line, from 0; empty until that run has been made.
  std::multimap<std::size_t, Warning> of_run;

  bool is_on(ExceptionFilter filter) const { return on_[static_cast<std::size_t>(filter)]; }
  /// Whether the filter of contacts depends on how deep one is.
  bool asks_for_depth() const {
    const auto& condition = conditions_[static_cast<std::size_t>(ExceptionFilter::Contacts)];
    return condition && condition->reads_depth();
  }
  /// A condition counts for filters that take one. Without, the filter stops the run in any case.
  void turn_on(ExceptionFilter filter, std::optional<expressions::Expression> condition = {}) {
    on_[static_cast<std::size_t>(filter)] = true;
    conditions_[static_cast<std::size_t>(filter)] = std::move(condition);
    ++revision_;
  }
  void turn_all_off() {
    on_ = {};
    ++revision_;
  }
  /// Another number after each change.
  std::uint64_t revision() const { return revision_; }

  /// Whether find_exception() can find anything. It need not be called otherwise.
  bool judge_blocks() const;
  /// A reason to stop before a block, other than where the machine goes in it. `before` is the moment before the block.
  std::optional<Exception> find_exception(const running::Block& block, const expressions::Moment& before,
                                          const execution::Setup& setup, dialect::Language language) const;

  /// A contact as a reason to stop, if the filter is on; `at` is the moment of the first touch. In its condition, DEPTH
  /// is how deep the contact gets in the block.
  std::optional<Exception> find_contact(const verification::Contact& contact, const expressions::Moment& at,
                                        dialect::Language language) const;

  /// Whether find_overtravel() can find anything. It need not be called otherwise.
  bool judge_motions(const timing::TimedMachine& machine) const;

 private:
  /// Whether the filter is on, and its condition holds.
  bool counts(ExceptionFilter filter, const expressions::Moment& before) const;

  std::uint64_t revision_ = 0;
  std::array<bool, kExceptionFilterCount> on_{};
  std::array<std::optional<expressions::Expression>, kExceptionFilterCount> conditions_;
};

/// What the axis limits say about a motion as the machine makes it, in inches if its block is under G70.
std::optional<Exception> find_overtravel(const kinematics::Move& move, const timing::TimedMachine& machine,
                                         bool is_in_inches, dialect::Language language);

}  // namespace isocnc::breakpoints
