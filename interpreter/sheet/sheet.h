#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/geometry/range.h"
#include "interpreter/running/runner.h"
#include "interpreter/sheet/drawing.h"
#include "interpreter/summary/frame_extents.h"
#include "interpreter/verification/scene.h"

namespace isocnc::sheet {

/// A tool in the order of its first use. Lengths in mm.
struct SheetTool {
  execution::ToolCode code;
  std::string name;              ///< In the configuration; empty if it is not there.
  std::optional<double> length;  ///< From the spindle nose to the tip.
  std::optional<double> radius;
  geometry::Range speed;          ///< Revolutions per minute while it cuts under M03; 0 to 0: never.
  geometry::Range left_speed;     ///< The same under M04.
  geometry::Range feed;           ///< Of feed moves, mm/min; 0 to 0: none.
  std::optional<double> least_z;  ///< Of the tip in feed moves, in the workpiece frame that is in force; none without.
  double seconds = 0;             ///< With its tool changes.
  std::size_t uses = 0;           ///< How many operations begin with its M06.
  std::string values;             ///< The values of VGPL that lead to it, where the first run does not; else empty.
  Drawing picture;                ///< Its outline; empty where nothing is known of its shape.
};

/// A user M function that the program calls.
struct SheetFunction {
  int number = 0;
  std::string name;  ///< In the configuration; may be empty.
  std::size_t calls = 0;
  std::string values;  ///< As of SheetTool.
};

/// A body of the setup, as a box along the axes.
struct SheetBody {
  std::string name;
  verification::BodyRole role = verification::BodyRole::Fixture;
  bool is_endless = false;              ///< It has no ends but for its top.
  std::array<geometry::Range, 3> room;  ///< In the first workpiece frame, or the machine's without one, mm.
};

/// A path on which values of VGPL lead the program.
struct SheetPath {
  std::string values;  ///< As conditions: `VGPL = 1`, `VGPL < 1`.
  double seconds = 0;
  std::string stop;  ///< The error that ends it before its end, and its line; empty for none.
};

/// A finding in the words of isolint.
struct SheetFinding {
  std::size_t line = 0;  ///< From 0.
  dialect::Severity severity = dialect::Severity::Warning;
  std::string code;
  std::string message;
};

/// What a setup sheet says of a program. Lengths in mm, times in seconds.
struct Sheet {
  std::string program;  ///< Its name.
  std::string hash;     ///< SHA-256 of its bytes.
  std::size_t lines = 0;
  std::string machine;  ///< The file that describes it; empty for none.
  double seconds = 0;   ///< Cycle time with the tool that is mounted first.
  std::string stop;     ///< The error that ends the run before its end, and its line; empty for none.
  std::string values;   ///< What the run begins with: `VGPL = 2, V3 = 7`; empty where that is 0.
  std::optional<geometry::Vec3> first_zero;   ///< Of the first workpiece frame, in the machine frame; none without one.
  std::vector<summary::FrameExtents> frames;  ///< With the room that the tip takes in each.
  std::size_t frames_left_out = 0;
  /// The room of the tip before any frame is set, machine frame; none without a feed move there.
  std::optional<std::array<geometry::Range, 3>> machine_room;
  std::vector<SheetTool> tools;
  std::vector<SheetFunction> functions;  ///< By their numbers.
  std::vector<SheetBody> bodies;
  Drawing from_above;  ///< X to the right, Y up.
  Drawing from_front;  ///< X to the right, Z up.
  // What others find out.
  std::vector<int> registers;          ///< Those that an IF compares though the program does not set them.
  std::vector<SheetPath> paths;        ///< Empty where no IF compares VGPL.
  bool has_other_paths = false;        ///< Other values of VGPL may lead elsewhere.
  std::vector<SheetFinding> findings;  ///< In the order of the program.
};

/// What is asked of a run.
struct SheetSubject {
  std::string_view text;
  std::string name;        ///< Of the program.
  std::string_view bytes;  ///< Of its file, with what comes before the text.
  running::RunOptions run;
  const configuration::MachineConfiguration& machine;
  const verification::Scene* scene = nullptr;  ///< What surrounds the program; null if nothing is known of it.
  dialect::Language language = dialect::Language::English;
};

/// Runs the program twice, for the facts and for the pictures, and returns what the runs say.
Sheet survey(const SheetSubject& subject);

/// Runs the program once more, with other values of VGPL in `subject`, which `values` says as conditions. Adds the path
/// to the sheet, and the tools and functions of that run; what the tools do there widens their ranges.
void add_path(Sheet& sheet, const SheetSubject& subject, const std::string& values);

/// The sheet as a page for browsers, in one file, which is printed on A4 or Letter.
std::string html_of(const Sheet& sheet, dialect::Language language);

/// The sheet as a PDF on A4. Characters that its fonts do not have, beyond those of Western Europe, become `?`.
std::string pdf_of(const Sheet& sheet, dialect::Language language);

}  // namespace isocnc::sheet
