#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analyzer/fixes/fix.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::fixes {

/// Whether a word is a G of other controls for inches (G20, G700) or millimeters (G21, G710).
bool is_foreign_unit(const syntax::Word& word);

/// The rewriting of one line.
struct LineRewrite {
  std::size_t line = 0;
  std::vector<Edit> edits;  ///< The edits, all on this line.
  std::string what;         ///< The new text, for the fix's title.
};

/// The rewriting that a habit needs, line by line.
using HabitRewrites = std::vector<LineRewrite>;

/// The habits of a program. Each is found on demand, in one pass over all lines.
class Habits {
 public:
  /// The program must outlive this.
  explicit Habits(FixProgram& program) : program_(program) {}

  /// The complete rewriting for a habit. Empty if the program does not show the habit or if not all of it can be
  /// rewritten: for example, if some arcs are legal only as written, which contradicts the habit, and others are legal
  /// both ways.
  const HabitRewrites& rewrites(Habit habit);
  /// Whether some arc shows this habit of writing centers and has no other meaning.
  bool shows(Habit centers);
  /// Whether some arcs are legal both with and without this habit of writing centers, and nothing contradicts it.
  bool leaves_open(Habit centers);
  /// Whether a number in the program has commas between its thousands, such as 1,234.5.
  bool separates_thousands();

 private:
  struct FoundRewrites {
    HabitRewrites rewrites;
    bool is_shown = false;  // As shows() and leaves_open() tell; of centers only.
    bool is_open = false;
  };

  /// Valid until the next call. Separate from Program::line(), whose tree the caller may still use.
  syntax::LineTree line(std::size_t number);
  const FoundRewrites& found(Habit habit);
  void find_centers();
  HabitRewrites find_foreign_units();
  HabitRewrites find_milliseconds();

  FixProgram& program_;
  syntax::TreeStore line_;
  std::array<std::optional<FoundRewrites>, kHabitCount> found_;
  std::optional<bool> separates_thousands_;
};

}  // namespace isocnc::fixes
