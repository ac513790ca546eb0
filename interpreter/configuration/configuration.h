#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/configuration/mistake.h"
#include "interpreter/configuration/path_patterns.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/dialect/house_watch.h"
#include "interpreter/dialect/lint_thresholds.h"
#include "interpreter/execution/setup.h"
#include "interpreter/geometry/vectors.h"
#include "interpreter/timing/timing.h"

namespace isocnc::configuration {

/// Default extensions of program files.
inline const std::array<std::string, 5> kProgramExtensions{".iso", ".nc", ".cnc", ".tap", ".ngc"};

// What surrounds a program, as files describe it; make_scene makes bodies of it. Lengths in mm.

/// Rows of numbers, all of the length that their key wants.
using NumberRows = std::vector<std::vector<double>>;

/// Rows with a name chosen by the author.
struct NamedRows {
  std::string name;
  NumberRows rows;
};

/// A file that holds a shape: an STL file, or a stock.
struct ShapeFile {
  std::string name;        ///< Path from the folder of the file that names it.
  std::string key;         ///< Path of the key that names it, such as `setups[0].target.mesh`.
  DescriptionPlace place;  ///< Of its value.
};

struct DescribedCylinder {
  std::optional<geometry::Vec3> at;    ///< Center of the foot; always set in a valid file.
  std::optional<geometry::Vec3> axis;  ///< From the foot; without it, Z. Of any length but 0.
  double height = 0;
  double diameter = 0;
};

/// One of a box, a cylinder and a mesh.
struct DescribedShape {
  std::optional<NumberRows> box;  ///< Two corners: the lower one, the upper one.
  std::optional<DescribedCylinder> cylinder;
  std::optional<ShapeFile> mesh;
  std::optional<geometry::Vec3> at;  ///< Shift of the shape.
};

/// A fixture, or a body of the machine.
struct DescribedBody {
  std::string name;
  std::string on = "machine";  ///< Of a body of the machine: the part that carries it.
  DescribedShape shape;
  DescriptionPlace place;
};

/// The blank.
struct DescribedStock {
  DescribedShape shape;                ///< Its `at` also shifts what an earlier setup has left.
  std::optional<ShapeFile> from;       ///< What an earlier setup has left, instead of a shape: a file of `--stock-out`.
  std::optional<bool> is_turned_over;  ///< Whether that lies turned over about the X axis.
  std::optional<int> quarter_turns;    ///< How far that is turned about Z, after being turned over.
  DescriptionPlace place;
};

struct DescribedSpoilboard {
  double top = 0;
  double allow = 0;                ///< How far cuts may go into it.
  std::optional<NumberRows> area;  ///< Two corners in X and Y; without it, as large as is useful.
  DescriptionPlace place;
};

struct DescribedTarget {
  std::optional<ShapeFile> mesh;  ///< Always set in a valid file.
  std::optional<geometry::Vec3> at;
  double tolerance = 0;
  DescriptionPlace place;
};

/// What stands around the programs of certain paths, or around one program.
struct DescribedSetup {
  std::vector<std::string> paths;  ///< Empty for the setup of one program.
  PathPatterns patterns;           ///< Parsed form of `paths`.
  std::string frame = "workpiece";
  std::optional<DescribedStock> stock;
  std::optional<DescribedSpoilboard> spoilboard;
  std::vector<DescribedBody> fixtures;
  std::optional<DescribedTarget> target;
  std::optional<double> resolution;  ///< Of the stock.
  double clearance = 2;
};

/// A tool of the machine. Lengths in mm.
struct Tool {
  execution::ToolCode code;
  std::string name;
  std::optional<double> length;
  std::optional<double> radius;
  std::string shape;                  ///< `flat`, `ball`, `bull`, `cone`, `drill`, `disc`; empty: not known.
  std::optional<NumberRows> profile;  ///< z, radius; instead of a shape.
  std::optional<double> corner_radius;
  std::optional<double> tip_angle;  ///< Degrees.
  std::optional<double> cut_length;
  std::optional<double> max_depth;
  std::optional<double> shank;  ///< Diameter.
  std::string body;             ///< Name of the holder; empty: none.
  DescriptionPlace place;
};

/// A named user M function.
struct NamedFunction {
  int number = 0;
  std::string name;
  double seconds = 0;  ///< Duration in seconds for which the machine waits.
};

/// Rapids of the default machine, mm/min and degrees/min.
std::array<double, execution::kAxisCount> default_rapids();

struct MachineConfiguration {
  execution::Setup setup;  ///< Tools and functions are copies of the members below.
  /// The machine's motion. Travel, rapids and kind are copies from `setup` and the members below, as are tools and
  /// functions.
  timing::TimedMachine timed;
  std::array<double, execution::kAxisCount> rapids = default_rapids();  ///< mm/min, degrees/min.
  std::string kind = "head";                                            ///< `three-axis`, `head`, `table`.
  std::string rapid_motion = "interpolated";                            ///< Or `independent`.
  std::optional<std::vector<Tool>> tools;
  std::optional<std::vector<NamedFunction>> functions;
  std::vector<NamedRows> holders;     ///< Height, lower diameter, upper diameter, from the collet's face up.
  std::optional<NumberRows> nose;     ///< The same, from the spindle nose up.
  std::vector<DescribedBody> bodies;  ///< In machine coordinates with all axes at 0.
  std::filesystem::path file;         ///< The file that describes the machine, as shown to users; empty without one.
  std::filesystem::path folder;       ///< Its folder, absolute and without symlinks.

  /// The tool, or the M function by its number as written, in the configuration; null if it is not listed.
  const Tool* find_tool(const execution::ToolCode& code) const;
  const NamedFunction* find_function(double number) const;
};

/// A selection of diagnostic codes.
struct CodeSelection {
  std::vector<std::string> select;
  std::vector<std::string> ignore;
  std::vector<std::pair<std::string, std::string>> severity;  ///< Pairs of a code and error, warning, info or off.
};

/// A selection for certain programs only.
struct FileOverrides {
  std::vector<std::string> paths;
  PathPatterns patterns;  ///< Parsed form of `paths`.
  CodeSelection selection;
};

/// Whether a file of this name is a program: whether it has one of the extensions, with their dot; case does not
/// matter.
bool is_program_name(std::string_view name, std::span<const std::string> extensions);

/// A rule of the shop, as it is written; the reader makes watches of it.
struct DescribedHouseRule {
  std::string id;
  dialect::HouseWatch::BilingualText message;
  std::string severity;  ///< `error`, `warning`, `info`; empty: `warning`.
  // Patterns: one of these is given.
  std::vector<std::string> require;
  std::vector<std::string> forbid;
  std::string comment;
  std::vector<std::string> head;
  std::vector<std::string> end;
  std::optional<double> speed_from;
  std::optional<double> speed_to;
  std::optional<double> feed_from;
  std::optional<double> feed_to;
  std::optional<double> lowest_z;
  // What belongs to a pattern.
  std::vector<std::string> before;
  std::vector<std::string> since;
  std::vector<std::string> after;
  std::vector<std::string> until;
  std::vector<std::string> tools;
};

struct Lint {
  CodeSelection selection;
  dialect::LintThresholds thresholds;
  std::vector<DescribedHouseRule> house_rules;
  std::vector<dialect::HouseWatch> house_watches;  ///< What they watch for.
  std::vector<FileOverrides> files;                ///< Later entries override earlier ones.
  /// Extensions with their dot.
  std::vector<std::string> extensions{kProgramExtensions.begin(), kProgramExtensions.end()};
  std::vector<std::string> exclude;
  PathPatterns excluded;  ///< Parsed form of `exclude`.
};

struct Renumber {
  static constexpr int kMaxNumber = 1'000'000'000;

  int start = 10;
  int step = 10;
  bool all_lines = false;
};

/// Format options of programs; those of the command line override them.
struct Format {
  static constexpr int kMaxDecimals = 15;

  bool word_order = false;
  std::optional<int> decimals;
  std::optional<int> g_digits;
  std::string modal = "keep";
  std::optional<Renumber> renumber;
};

/// The content of an isocnc.json. Omitted keys, or all without a file, have their defaults.
struct Configuration {
  MachineConfiguration machine;
  Lint lint;
  Format format;
  std::optional<dialect::Language> language;
  std::vector<DescribedSetup> setups;  ///< Of those for a program, the last one counts.
  std::filesystem::path file;          ///< Path as shown to users; empty without a file.
  std::filesystem::path folder;        ///< Its folder, absolute and without symlinks.
};

}  // namespace isocnc::configuration
