#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analyzer/fixes/fix.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::fixes {

/// What is rewritten on one line.
struct LineRewrite {
  std::uint64_t line = 0;
  std::vector<Edit> edits;  ///< On this line.
  std::string what;         ///< What is written there.
};

/// What a habit has to have rewritten, line by line.
using HabitRewrites = std::vector<LineRewrite>;

/// The habits of a program, found when they are first asked for, each by one look at all lines.
class Habits {
 public:
  /// The program must outlive this.
  explicit Habits(Program& program) : program_(program) {}

  /// All that has to be rewritten. Empty where the program does not show the habit, or where not all of it can be
  /// rewritten: for instance where arcs that fit only as they are written contradict it, and others are legal both
  /// ways.
  const HabitRewrites& rewrites(Habit habit);
  /// Whether a place of the program has the habit and cannot be meant otherwise.
  bool shows(Habit habit);
  /// Whether places of the program are legal as they are and with the habit, and nothing contradicts it.
  bool leaves_open(Habit habit);
  /// Whether a number of the program has commas between its thousands: 1,234.5.
  bool separates_thousands();

 private:
  struct Found {
    HabitRewrites rewrites;
    bool is_shown = false;
    bool is_open = false;
  };

  /// Valid until the next call. Program::line() may be in use by who asks for a habit.
  syntax::LineTree line(std::uint64_t number);
  const Found& found(Habit habit);
  void find_centers();
  Found find_foreign_units();
  Found find_milliseconds();

  Program& program_;
  syntax::TreeStore line_;
  std::array<std::optional<Found>, kHabitCount> found_;
  std::optional<bool> separates_thousands_;
};

}  // namespace isocnc::fixes
