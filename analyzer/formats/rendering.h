#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "analyzer/check/report.h"
#include "analyzer/rules/check_setup.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/text/unicode.h"

namespace isocnc::formats {

using text::column_of;
using text::printable;

/// The style in which findings are shown.
struct ReportStyle {
  dialect::Language language = dialect::Language::English;
  bool color = false;
  bool unsafe_fixes = false;  ///< Whether --fix would include unsafe fixes.
  std::string shard;          ///< `2/8` if only this part of the files is checked, else empty.
};

/// A finding as the formats show it: lines and columns from 1, columns in code points, the end exclusive.
struct ShownFinding {
  const dialect::DiagnosticDef& def;
  dialect::Severity severity;
  std::string_view line_text;
  std::size_t line = 0;
  std::size_t column = 0;
  std::size_t end_column = 0;
  std::string message;  ///< The message; may hold any byte that the program holds.
};
ShownFinding show(const check::LocatedFinding& located, const check::Report& report, syntax::LineFinder& lines,
                  const ReportStyle& style);

/// The message of a finding of this line, with the number of lines below that repeat it (D66).
std::string message_of(const check::LocatedFinding& located, const check::Report& report, std::string_view line,
                       dialect::Language language);

/// The texts of the IFs on a report's paths, each made once, however many findings share it.
class StepTexts {
 public:
  StepTexts(std::string_view text, const check::Report& report, dialect::Language language);
  const std::string& of(const check::PathStep& step) const { return texts_.at({step.line, step.taken}); }
  /// The path of a finding, for the lines below its message; each line follows a line end. Empty if every path leads to
  /// it.
  std::string note(const check::LocatedFinding& located, const check::Report& report) const;

 private:
  dialect::Language language_;
  std::map<std::pair<std::size_t, bool>, std::string> texts_;
};

/// A program and the findings to show.
struct CheckedProgram {
  std::string_view name;
  std::string_view text;
  const check::Report& report;
  const rules::CheckSetup& setup;  ///< The setup of the check and of the fixes.
  std::string_view certificate;    ///< What a run has proven, in words; empty for no run.
};

/// Writes the findings of one file after another in one of the output formats.
class Renderer {
 public:
  virtual ~Renderer() = default;
  /// Appends the text before the first file to `output`.
  virtual void begin(std::string&) {}
  /// Appends the file's findings to `output`; calls its drain() between findings.
  virtual void file(const CheckedProgram& program, class Output& output) = 0;
  virtual void end(std::string&) {}
};

/// The destination of rendered text: collects it and passes it on in large pieces.
class Output {
 public:
  virtual ~Output() = default;
  std::string& buffer() { return buffer_; }
  /// Call it between findings.
  void drain() {
    if (buffer_.size() >= kLarge) flush();
  }
  void flush() {
    write(buffer_);
    buffer_.clear();
  }

 protected:
  virtual void write(std::string_view text) = 0;

 private:
  static constexpr std::size_t kLarge = 64 * 1024;
  std::string buffer_;
};

/// The title of the steps of a path.
inline constexpr dialect::Text kReachedThrough = {"only on this path:", "solo su questo percorso:"};

/// A file's normalized name, as other tools print it: `./a/../part.iso` becomes `part.iso`.
std::string plain_path(std::string_view name);
/// A text as a part of a URI, with escapes such as %20; slashes stay.
std::string in_uri(std::string_view text);
/// The plain path as a URI: relative, unless the path is absolute.
std::string uri_of(std::string_view name);

/// The URL of a rule's page.
std::string rule_url(dialect::DiagnosticId id);
/// `line 12: IF VGPL = 1 GOTO N30 jumps` in the reader's language.
std::string describe_step(const check::PathStep& step, std::string_view line_text, dialect::Language language);

}  // namespace isocnc::formats
