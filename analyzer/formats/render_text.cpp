#include <algorithm>

#include <fmt/format.h>

#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/formats/related.h"
#include "analyzer/formats/renderers.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/text/unicode.h"

namespace isocnc::formats {

using dialect::Text;

/// The maximum width of a shown line; longer lines are shown from kContext bytes before the mark.
static constexpr std::size_t kWidth = 110;
static constexpr std::size_t kContext = 40;

static constexpr std::string_view kReset = "\x1b[0m";
static constexpr std::string_view kBold = "\x1b[1m";
static constexpr std::string_view kDim = "\x1b[2m";
static constexpr std::string_view kBlue = "\x1b[1;34m";
static constexpr std::string_view kSeverityColors[] = {"\x1b[1;31m", "\x1b[1;33m", "\x1b[1;36m"};

static constexpr Text kHelp = {"help", "aiuto"};
/// The maximum length of a fixed line shown next to its help.
static constexpr std::size_t kShortLine = 60;

static constexpr Text kOtherPlace = {"the other place", "l'altro punto"};

/// The maximum number of findings with help in one file; --diff shows all fixes.
static constexpr std::size_t kMaxHelpedFindings = 1'000;

static void append(std::string& out, std::initializer_list<std::string_view> pieces) {
  for (const std::string_view piece : pieces) out += piece;
}

/// A part of a line that fits on the screen, and its start.
struct Excerpt {
  std::string_view text;
  std::size_t begin = 0;
  bool cut_left = false;
  bool cut_right = false;
};

static Excerpt excerpt_around(std::string_view line, std::size_t byte) {
  const auto is_inside = [&](std::size_t at) { return at < line.size() && text::is_inside_character(line[at]); };
  Excerpt excerpt;
  if (line.size() > kWidth && byte > kContext + kContext / 2) excerpt.begin = byte - kContext;
  while (excerpt.begin > 0 && is_inside(excerpt.begin)) --excerpt.begin;
  std::size_t end = std::min(line.size(), excerpt.begin + kWidth);
  while (end < line.size() && is_inside(end)) --end;
  excerpt.cut_left = excerpt.begin > 0;
  excerpt.cut_right = end < line.size();
  excerpt.text = line.substr(excerpt.begin, end - excerpt.begin);
  return excerpt;
}

/// The default format: message, place, the line with the mark below it, reason, and path.
class TextRenderer final : public Renderer {
 public:
  explicit TextRenderer(const ReportStyle& style) : style_(style) {}

  void file(const CheckedProgram& program, Output& output) override {
    const std::string name = printable(program.name);
    syntax::LineFinder lines(program.text);
    const StepTexts steps(program.text, program.report, style_.language);
    RelatedPlaces places(program.text);
    fixing::FindingFixes fixes(program.text, program.report, program.setup);
    std::size_t helps = 0;
    for (const check::LocatedFinding& located : program.report.findings) {
      one(name, lines, places, located, program.report, steps, output.buffer());
      if (helps < kMaxHelpedFindings)
        if (const std::optional<fixes::Fix> fix = fixes.offered(located)) {
          help(located, *fix, fixes, output.buffer());
          ++helps;
        }
      output.buffer() += '\n';
      output.drain();
    }
  }

 private:
  std::string_view paint(std::string_view color) const { return style_.color ? color : std::string_view(); }

  void one(std::string_view name, syntax::LineFinder& lines, RelatedPlaces& places,
           const check::LocatedFinding& located, const check::Report& report, const StepTexts& steps,
           std::string& out) const {
    const ShownFinding shown = show(located, report, lines, style_);
    const std::string_view line = shown.line_text;
    const syntax::Finding& finding = located.finding;
    const std::string_view color = paint(kSeverityColors[static_cast<std::size_t>(shown.severity)]);
    const std::string number = std::to_string(shown.line);
    const std::string margin(number.size(), ' ');
    const std::string_view reset = paint(kReset);
    const std::string_view blue = paint(kBlue);
    append(out, {color, dialect::severity_name(shown.severity, style_.language), "[", shown.def.code, "]", reset,
                 paint(kBold), ": ", printable(shown.message), reset, "\n"});
    append(out, {margin, blue, "-->", reset, " ", name, ":", number, ":", std::to_string(shown.column), "\n"});
    const Excerpt excerpt = excerpt_around(line, finding.span.begin);
    append(out, {margin, " ", blue, "|", reset, "\n"});
    if (const std::optional<RelatedPlace> place = places.of(located, line)) above(*place, located.line, margin, out);
    append(out, {blue, number, " |", reset, " ", excerpt.cut_left ? "..." : "", printable(excerpt.text),
                 excerpt.cut_right ? "..." : "", "\n"});
    append(out, {margin, " ", blue, "|", reset, " ", underline(excerpt, finding, color), "\n"});
    append(out, {margin, " ", blue, "=", reset, " ", dialect::first_sentence(shown.def.explanation.in(style_.language)),
                 "\n"});
    for (const RunPlace& place : run_places(located, style_.language)) beside(place, name, margin, out);
    if (located.path >= 0) path(steps, report.paths[static_cast<std::size_t>(located.path)], margin, out);
  }

  /// Prints the fix, the option that applies it, and the fixed line.
  void help(const check::LocatedFinding& located, const fixes::Fix& fix, fixing::FindingFixes& fixes,
            std::string& out) const {
    const std::string margin(fmt::format("{}", located.line + 1).size(), ' ');
    const bool needs_more = fix.safety == fixes::Safety::Unsafe && !style_.unsafe_fixes;
    fmt::format_to(std::back_inserter(out), "{} {}={} {}: {} ({})", margin, paint(kBlue), paint(kReset),
                   kHelp.in(style_.language), printable(fix.title_in(style_.language)),
                   needs_more ? "--fix --unsafe-fixes" : "--fix");
    const std::optional<std::string> line = fixes.changed_line(located, fix);
    if (line && !line->empty() && line->size() <= kShortLine)
      fmt::format_to(std::back_inserter(out), ": {}", printable(*line));
    out += '\n';
  }

  /// Prints the earlier line that explains the finding.
  void above(const RelatedPlace& place, std::size_t line, std::string_view margin, std::string& out) const {
    const auto to = std::back_inserter(out);
    const Excerpt excerpt = excerpt_around(place.text, place.span.begin);
    const std::size_t begin = column_of(excerpt.text, place.span.begin - excerpt.begin);
    const std::size_t end =
        column_of(excerpt.text, std::min<std::size_t>(place.span.end - excerpt.begin, excerpt.text.size()));
    fmt::format_to(to, "{}{:>{}} |{} {}{}{}\n", paint(kBlue), place.line + 1, margin.size(), paint(kReset),
                   excerpt.cut_left ? "..." : "", printable(excerpt.text), excerpt.cut_right ? "..." : "");
    fmt::format_to(to, "{} {}|{} {:{}}{}{:-<{}} {}{}\n", margin, paint(kBlue), paint(kReset), "",
                   begin - 1 + (excerpt.cut_left ? 3 : 0), paint(kBlue), "", end - begin,
                   place.note.in(style_.language), paint(kReset));
    if (place.line + 1 < line) fmt::format_to(to, "{}...{}\n", paint(kBlue), paint(kReset));
  }

  /// Prints another place of the finding.
  void beside(const RunPlace& place, std::string_view name, std::string_view margin, std::string& out) const {
    const std::string file = place.file.empty() ? std::string(name) : printable(place.file);
    fmt::format_to(std::back_inserter(out), "{} {}={} {}:{}:{}: {}\n", margin, paint(kBlue), paint(kReset), file,
                   place.line, place.column, printable(place.note));
  }

  /// `^^^^` under the finding, `----` under the other place on the same line.
  std::string underline(const Excerpt& excerpt, const syntax::Finding& finding, std::string_view color) const {
    struct UnderlineMark {
      std::size_t begin, end;
      char sign;
    };
    const auto mark = [&](syntax::Span span, char sign) {
      const auto clip = [&](std::size_t byte) {
        return std::min(std::max(byte, excerpt.begin), excerpt.begin + excerpt.text.size()) - excerpt.begin;
      };
      const std::size_t begin = column_of(excerpt.text, clip(span.begin)) - 1;
      return UnderlineMark{begin, std::max(begin + 1, column_of(excerpt.text, clip(span.end)) - 1), sign};
    };
    std::vector<UnderlineMark> marks = {mark(finding.span, '^')};
    const bool related_shown = !finding.related.empty() && finding.related.begin >= excerpt.begin &&
                               finding.related.end <= excerpt.begin + excerpt.text.size();
    if (related_shown) marks.push_back(mark(finding.related, '-'));
    std::sort(marks.begin(), marks.end(),
              [](const UnderlineMark& a, const UnderlineMark& b) { return a.begin < b.begin; });
    std::string result(excerpt.cut_left ? 3 : 0, ' ');
    std::size_t at = 0;
    for (const UnderlineMark& each : marks) {
      if (each.begin < at) continue;
      result.append(each.begin - at, ' ');
      result += each.sign == '^' ? color : paint(kBlue);
      result.append(each.end - each.begin, each.sign);
      result += paint(kReset);
      at = each.end;
    }
    if (related_shown)
      fmt::format_to(std::back_inserter(result), "  {}(--- {}){}", paint(kDim), kOtherPlace.in(style_.language),
                     paint(kReset));
    return result;
  }

  void path(const StepTexts& texts, const std::vector<check::PathStep>& steps, std::string_view margin,
            std::string& out) const {
    fmt::format_to(std::back_inserter(out), "{} {}={} {}\n", margin, paint(kBlue), paint(kReset),
                   kReachedThrough.in(style_.language));
    for (const check::PathStep& step : steps)
      fmt::format_to(std::back_inserter(out), "{}     {}: {}\n", margin, step.line + 1, texts.of(step));
  }

  ReportStyle style_;
};

std::unique_ptr<Renderer> make_text_renderer(const ReportStyle& style) { return std::make_unique<TextRenderer>(style); }

}  // namespace isocnc::formats
