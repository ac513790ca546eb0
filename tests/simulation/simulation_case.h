#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "interpreter/simulation/simulation.h"
#include "random_run.h"

namespace isocnc::simulation {

/// A program with the options and the machine that its simulations refer to.
class Case {
 public:
  explicit Case(std::string text, double vgpl = 0, bool stop_at_errors = true, bool limits_jerk = false)
      : text_(std::move(text)),
        program_(text_),
        machine_(machine_of_tests(limits_jerk)),
        options_(options_for(machine_)) {
    options_.vgpl = vgpl;
    options_.stop_at_errors = stop_at_errors;
  }
  /// A random program on a machine with or without a jerk limit.
  explicit Case(support::Random& random)
      : Case(RandomRun(random).text(random.between(1, 3)), random.between(0, 2), true, random.one_in(4)) {}
  Simulation start() const { return Simulation(program_, options_, machine_); }
  std::string_view text() const { return text_; }
  const running::RunOptions& options() const { return options_; }
  const timing::TimedMachine& machine() const { return machine_; }

 private:
  std::string text_;
  running::Program program_;
  timing::TimedMachine machine_;
  running::RunOptions options_;
};

}  // namespace isocnc::simulation
