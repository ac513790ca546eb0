#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/configuration/json_value.h"
#include "interpreter/configuration/keys.h"
#include "interpreter/tool_library/library_tool.h"

/// What the readers of all formats share.
namespace isocnc::tool_library {

inline constexpr double kInch = 25.4;  // mm.

/// The lengths of tools and holders that make sense, in mm.
inline constexpr double kLongest = 1e4;

/// A file of a library while it is read. Collects what is wrong with it.
class LibraryFile {
 public:
  LibraryFile(std::string name, std::string text, dialect::Language language)
      : name_(std::move(name)), text_(std::move(text)), language_(language) {}

  std::string_view text() const { return text_; }
  dialect::Language language() const { return language_; }

  /// `key` is where in the library: `data[3].geometry.DC`, or `line`.
  void fail(std::size_t at, std::string key, const dialect::Text& text, std::vector<configuration::Named> names = {});
  /// The first hundred, one a line.
  const std::vector<std::string>& mistakes() const { return mistakes_; }
  /// One that has its file and its place already.
  void add_mistake(std::string mistake) { mistakes_.push_back(std::move(mistake)); }
  /// Reads the entry of one tool, by a function that returns it if there is one. What is wrong with the entry belongs
  /// to the tool alone, which is then there in any case.
  template <class Read>
  std::optional<LibraryTool> entry(Read read) {
    std::vector<std::string> of_file = std::exchange(mistakes_, {});
    std::optional<LibraryTool> tool = read();
    if (!tool && !mistakes_.empty()) tool.emplace();
    if (tool) tool->mistakes = std::move(mistakes_);
    mistakes_ = std::move(of_file);
    return tool;
  }

 private:
  std::string name_;
  std::string text_;
  dialect::Language language_;
  std::vector<std::string> mistakes_;
};

namespace problems {
inline constexpr dialect::Text kNeedsLength{"{0} is no length of a tool: above 0 and at most 10000 mm",
                                            "{0} non è una lunghezza di un utensile: sopra 0 e fino a 10000 mm"};
inline constexpr dialect::Text kNeedsNumber{"{0} is a text: a number alone is needed here, without quotes",
                                            "{0} è un testo: qui ci vuole solo un numero, senza virgolette"};
inline constexpr dialect::Text kNeedsAngle{"{0} is no angle of a tool: above 0 and below 180 degrees",
                                           "{0} non è un angolo di un utensile: sopra 0 e sotto 180 gradi"};
inline constexpr dialect::Text kUnknownUnit{"{0} is no unit known here: {1}", "{0} non è un'unità nota qui: {1}"};
}  // namespace problems

/// The text with its ASCII letters small.
std::string in_small_letters(std::string_view text);

/// A length in mm without the noise of a conversion.
double tidy(double length);

/// The member of an object; null if there is none, or no object.
const configuration::JsonValue* member_of(const configuration::JsonValue& object, std::string_view key);
/// A text without blanks around it.
std::string_view trimmed(std::string_view text);
/// The text of a member, likewise; empty if there is none.
std::string text_of(const configuration::JsonValue& object, std::string_view key);

/// Lengths and angles of an object in JSON, in the unit of its library.
class JsonTool {
 public:
  /// `path` names the object in messages; `millimeters` is how many a unit of length has.
  JsonTool(const configuration::JsonValue& object, std::string path, double millimeters, LibraryFile& file)
      : object_(object), path_(std::move(path)), millimeters_(millimeters), file_(file) {}

  /// In mm. A member that is 0 or null says nothing; a mistake if it is no length.
  std::optional<double> length(std::string_view key) const;
  /// In degrees, likewise.
  std::optional<double> angle(std::string_view key) const;

 private:
  void fail(std::string_view key, const configuration::JsonValue& value, const dialect::Text& why) const;

  const configuration::JsonValue& object_;
  std::string path_;
  double millimeters_;
  LibraryFile& file_;
};

/// A flat end, or with a corner radius a rounded one, up to a ball.
void set_end_mill(configuration::Tool& tool, std::optional<double> corner_radius);
/// A cone up to the radius of the tool. `tip_angle` is the whole angle in degrees, `tip_radius` 0 for a sharp tip.
void set_cone(configuration::Tool& tool, double tip_angle, double tip_radius);
/// A cone that gets wider from the tip, by an angle to the axis in degrees, over the cutting length.
void set_taper(configuration::Tool& tool, double tip_radius, double side_angle);

/// The keys of `machine.tools`, and that of a name; null for a name that is none.
std::vector<const configuration::Key*> tool_keys();
const configuration::Key* tool_key(std::string_view name);

// One reader for each format; mistakes are in the file.
/// Tools that name no unit count in one of so many mm.
std::vector<LibraryTool> read_fusion(const configuration::JsonValue& library, double millimeters, LibraryFile& file);
std::vector<LibraryTool> read_camotics(const configuration::JsonValue& table, LibraryFile& file);
/// A tool of FreeCAD, which has no number.
std::optional<LibraryTool> read_freecad_bit(const configuration::JsonValue& bit, LibraryFile& file);
std::vector<LibraryTool> read_linuxcnc(LibraryFile& file, double millimeters);
/// A table with named columns, in a unit of so many mm unless a row says another; the names that nothing here is called
/// by go to `ignored`.
std::vector<LibraryTool> read_columns(LibraryFile& file, double millimeters, std::vector<std::string>& ignored);

}  // namespace isocnc::tool_library
