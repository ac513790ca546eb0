// Edits a program, one key after the other, and has it checked after each as the language server does:
//   isocnc_edits [--kind KIND] [--slowest N] COUNT FILE
// Prints how many lines were checked after an edit and what was found, on average, and the processor time that it took
// to all findings, and to those that the server reports first, after the first 2,048 lines; with --slowest, also the
// edits that took longest. The kinds of edits:
//   digit   another last digit on any line; this is the default
//   mode    a line with a mode or a function, as G18, typed key by key anywhere, then deleted again
//   if      a line with an IF, typed whole anywhere with the label of a line further down, then deleted again
//   if-keys the same, typed key by key
//   label   another last digit of a label that an IF names, then the old one again

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <deque>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/check/analysis.h"
#include "interpreter/system/source_file.h"

namespace isocnc {
namespace {

/// As many as the language server sends.
constexpr std::size_t kMostFindings = 1001;

using syntax::Document;
using syntax::Position;

struct Edit {
  Position begin;
  Position end;
  std::string text;
};

/// Makes the edits of one kind.
class Editor {
 public:
  Editor(std::string_view kind, const Document& document) : kind_(kind), document_(document) {
    for (std::size_t line = 0; kind == "label" && line < document.line_count(); ++line)
      if (const auto jump = document.line(line)->jump; jump && jump->has_target) targets_.push_back(jump->target);
  }

  static bool knows(std::string_view kind) {
    return std::find(std::begin(kKinds), std::end(kKinds), kind) != std::end(kKinds);
  }

  Edit next() {
    while (planned_.empty()) plan();
    Edit edit = std::move(planned_.front());
    planned_.pop_front();
    return edit;
  }

 private:
  static constexpr std::string_view kKinds[] = {"digit", "mode", "if", "if-keys", "label"};

  void plan() {
    const std::size_t line = random_() % document_.line_count();
    if (kind_ == "digit") return change_digit(line, document_.text_of_line(line).find_last_of("0123456789"));
    if (kind_ == "label") return change_label();
    if (kind_ == "mode") {
      static constexpr std::string_view kModes[] = {"G18", "G19", "G41", "G42", "G91", "G93", "G49", "G70",  "G48",
                                                    "G38", "M05", "M04", "G0",  "G3",  "G92", "G27", "F500", "S5000"};
      return type_line(line, std::string(kModes[random_() % std::size(kModes)]), true);
    }
    type_line(line, "IF VGPL=1 GOTO N" + std::to_string(label_below(line)), kind_ == "if-keys");
  }

  void change_digit(std::size_t line, std::size_t column) {
    if (column == std::string_view::npos) {
      planned_.push_back({{line, 0}, {line, 0}, ""});
      return;
    }
    const char digit = document_.text_of_line(line)[column];
    const char next = digit == '9' ? '0' : static_cast<char>(digit + 1);
    planned_.push_back({{line, column}, {line, column + 1}, std::string(1, next)});
  }

  void change_label() {
    if (targets_.empty()) return planned_.push_back({});
    const std::string label = "N" + std::to_string(targets_[random_() % targets_.size()]) + " ";
    std::size_t line = 0;
    while (line < document_.line_count() && !document_.text_of_line(line).starts_with(label)) ++line;
    if (line == document_.line_count()) return;
    const std::size_t last = label.size() - 2;
    change_digit(line, last);
    planned_.push_back({{line, last}, {line, last + 1}, label.substr(last, 1)});
  }

  /// The first line number below a line; 1 if there is none near.
  std::uint64_t label_below(std::size_t line) const {
    for (std::size_t i = line + 1; i < std::min(line + 500, document_.line_count()); ++i)
      if (const auto tree = document_.line(i); tree->has_label()) return tree->label;
    return 1;
  }

  void type_line(std::size_t line, const std::string& text, bool is_by_key) {
    if (is_by_key) {
      planned_.push_back({{line, 0}, {line, 0}, "\n"});
      for (std::size_t i = 0; i < text.size(); ++i) planned_.push_back({{line, i}, {line, i}, text.substr(i, 1)});
    } else {
      planned_.push_back({{line, 0}, {line, 0}, text + "\n"});
    }
    planned_.push_back({{line, 0}, {line + 1, 0}, ""});
  }

  const std::string_view kind_;
  const Document& document_;
  std::mt19937_64 random_;  // The same numbers everywhere.
  std::vector<std::uint64_t> targets_;
  std::deque<Edit> planned_;
};

/// What an edit took.
struct Cost {
  double milliseconds = 0;
  double first = 0;  ///< Milliseconds to what is reported first.
  std::uint64_t lines = 0;
  int number = 0;
  std::size_t line = 0;
  std::string before;
  std::string after;
};

/// Sorts the edits by what they took.
void print_sorted(const char* what, std::vector<Cost>& costs, double Cost::*milliseconds) {
  std::sort(costs.begin(), costs.end(),
            [&](const Cost& a, const Cost& b) { return a.*milliseconds < b.*milliseconds; });
  std::printf("ms %s: median %.2f, 99th percentile %.2f, worst %.2f\n", what, costs[costs.size() / 2].*milliseconds,
              costs[costs.size() * 99 / 100].*milliseconds, costs.back().*milliseconds);
}

int run(std::string_view kind, std::size_t slowest, int count, const char* file) {
  const auto opened = system::SourceFile::open(file, dialect::Language::English);
  if (const auto* const problem = std::get_if<system::SourceFile::Problem>(&opened)) {
    std::fprintf(stderr, "%s: %s\n", file, problem->message.c_str());
    return 2;
  }
  const rules::CheckSetup setup;
  Document document(std::get<system::SourceFile>(opened).text());
  check::Analysis analysis(document, setup);
  Editor editor(kind, document);
  std::uint64_t lines = 0;
  std::size_t findings = 0;
  std::vector<Cost> costs;
  for (int i = 0; i < count; ++i) {
    const Edit edit = editor.next();
    std::string before;
    if (slowest > 0) before = document.text_of_line(edit.begin.line);
    const std::clock_t begin = std::clock();
    const auto taken = [&] { return 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; };
    std::size_t found = 0;
    const auto report = [&] { found = analysis.excerpt({.max = kMostFindings, .folds = true}).report.findings.size(); };
    document.replace(edit.begin, edit.end, edit.text);
    const bool is_all =
        analysis.update([chunks = 0]() mutable { return ++chunks == check::Analysis::kChunksInAMoment; });
    const bool has_first = !is_all && analysis.has_known_findings();
    std::uint64_t checked = analysis.lines_checked();
    if (has_first) report();
    const double first = taken();
    if (!is_all) {
      analysis.update();
      checked += analysis.lines_checked();
    }
    report();
    const double all = taken();
    findings += found;
    lines += checked;
    costs.push_back({all, has_first ? first : all, checked, i, edit.begin.line, std::move(before), {}});
    if (slowest > 0) costs.back().after = document.text_of_line(edit.begin.line);
  }
  const double of_first_edit = costs.front().milliseconds;
  std::printf("after an edit: %.0f lines checked, %.0f findings\n", static_cast<double>(lines) / count,
              static_cast<double>(findings) / count);
  print_sorted("to the first findings", costs, &Cost::first);
  print_sorted("to all findings", costs, &Cost::milliseconds);
  std::printf("ms of the first edit: %.2f\n", of_first_edit);
  for (std::size_t i = 0; i < std::min(slowest, costs.size()); ++i) {
    const Cost& cost = costs[costs.size() - 1 - i];
    std::printf("%.2f ms, %llu lines checked: edit %d, line %zu: `%s` -> `%s`\n", cost.milliseconds,
                static_cast<unsigned long long>(cost.lines), cost.number, cost.line + 1, cost.before.c_str(),
                cost.after.c_str());
  }
  return 0;
}

int run(int argc, char** argv) {
  std::string_view kind = "digit";
  int slowest = 0;
  int next = 1;
  for (; next + 1 < argc && argv[next][0] == '-'; next += 2) {
    if (std::strcmp(argv[next], "--kind") == 0) kind = argv[next + 1];
    if (std::strcmp(argv[next], "--slowest") == 0) slowest = std::atoi(argv[next + 1]);
  }
  const int count = argc == next + 2 ? std::atoi(argv[next]) : 0;
  if (count <= 0 || slowest < 0 || !Editor::knows(kind)) {
    std::fputs("usage: isocnc_edits [--kind digit|mode|if|if-keys|label] [--slowest N] COUNT FILE\n", stderr);
    return 2;
  }
  return run(kind, static_cast<std::size_t>(slowest), count, argv[next + 1]);
}

}  // namespace
}  // namespace isocnc

int main(int argc, char** argv) { return isocnc::run(argc, argv); }
