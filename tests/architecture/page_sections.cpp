#include "page_sections.h"

#include <optional>
#include <regex>
#include <set>
#include <sstream>

namespace isocnc::architecture {

/// Adds the marks of a line of prose.
static void add_marks(const std::string& text, std::size_t line, Marks& marks) {
  static const std::regex kMark(
      R"(--[a-z][a-z-]*|[\w-]+\.(?:svg|png)\b|\bI(?:\.\d+)+(?:\.[a-c]\b)?|\b[A-Z]{1,4}-?\d+(?:\.\d+)*\b|\bU\+[0-9A-F]+|\b\d+(?:\.\d+)+|\b\d{2,})");
  for (std::sregex_iterator it(text.begin(), text.end(), kMark); it != std::sregex_iterator(); ++it)
    marks.try_emplace(it->str(), line);
}

/// A line of prose without the targets of its links and the option, which are those of the language.
static std::string of_any_language(const std::string& line) {
  static const std::regex kOwn(R"((\])\([^)]*\.md[^)]*\)| ?`?--lang it\b)");
  return std::regex_replace(line, kOwn, "$1");
}

/// A line of a program without its comments and the blanks around them.
static std::string without_comments(const std::string& line) {
  static const std::regex kComment(R"(\([^)]*\)|\s*;.*)");
  std::string text = std::regex_replace(line, kComment, "");
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

static std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The code in a cell, such as `--jobs N` `-j N`.
static std::string code_of(const std::string& cell) {
  std::string all;
  bool is_code = false;
  std::string code;
  for (const char c : cell) {
    if (c == '`') {
      if (is_code) all += (all.empty() ? "" : ", ") + without_comments(code);
      is_code = !is_code;
      code.clear();
    } else if (is_code) {
      code += c;
    }
  }
  return all;
}

/// Whether a line is a row of a table with text.
static bool is_row(const std::string& line) {
  return line.starts_with('|') && line.find_first_not_of("|- ") != std::string::npos;
}

/// A `|` within code is part of the code.
static Row row_of(const std::string& line, std::size_t number) {
  std::vector<std::string> cells(1);
  bool is_code = false;
  for (const char c : line.substr(1)) {
    if (c == '`') is_code = !is_code;
    if (c == '|' && !is_code)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return {.line = number, .cells = cells.size() - 1, .code = code_of(trimmed(cells.front()))};
}

/// Collects the lines of an example, as far as all languages have them in common.
class CodeReader {
 public:
  CodeReader(const std::string& fence, std::size_t line)
      : language_(fence.substr(3)), block_{.line = line, .lines = {}} {}

  void add(const std::string& line) {
    if (line.starts_with("$ "))
      add_command(line);
    else if (answers_)
      return;
    else if (language_ == "sh")
      add_command(line.substr(0, line.find("  #")));
    else if (language_.starts_with("json"))
      add_json(line);
    else if (is_sentence(line))
      add_sentence(line);
    else
      block_.lines.push_back(without_comments(line));
  }

  const CodeBlock& block() const { return block_; }

 private:
  /// Answers of programs are those that the programs give: a test of the commands compares them.
  void add_command(const std::string& line) {
    static const std::regex kLanguage(" --lang it");
    block_.lines.push_back(trimmed(std::regex_replace(line, kLanguage, "")));
    answers_ = line.starts_with("$ ") && !line.starts_with("$ cat ");
  }

  void add_json(const std::string& line) {
    static const std::regex kMessage(R"re(("(?:message|text)":)"[^"]*")re");
    block_.lines.push_back(std::regex_replace(line.substr(0, line.find("  // ")), kMessage, "$1"));
  }

  /// Whether words of a language follow each other outside comments for the control.
  static bool is_sentence(const std::string& line) {
    static const std::regex kWords("[a-z]{3,} [a-z]+");
    return std::regex_search(without_comments(line), kWords);
  }

  void add_sentence(const std::string& line) {
    Marks marks;
    add_marks(line, 0, marks);
    std::string all;
    for (const auto& [mark, ignored] : marks) all += (all.empty() ? "" : " ") + mark;
    block_.lines.push_back(all);
  }

  const std::string language_;
  CodeBlock block_;
  bool answers_ = false;
};

/// Splits a page into its sections.
class PageReader {
 public:
  void add(const std::string& line) {
    ++number_;
    const std::string text = trimmed(line);
    if (text.starts_with("```"))
      toggle_code(text);
    else if (code_)
      code_->add(text);
    else if (line.starts_with("    ") && is_program_)
      add_program_line(line, text);
    else
      add_prose(line);
  }

  std::vector<Section> sections() { return std::move(sections_); }

 private:
  void toggle_code(const std::string& fence) {
    if (code_) {
      sections_.back().code.push_back(code_->block());
      code_.reset();
    } else {
      code_.emplace(fence, number_);
    }
  }

  /// The message below a mark, `= ...` and the lines that continue it, is that of the language.
  void add_program_line(const std::string& line, const std::string& text) {
    is_message_ = text.starts_with("= ") || (is_message_ && line.starts_with("      "));
    if (!is_message_) sections_.back().code.back().lines.push_back(text);
  }

  void add_prose(const std::string& line) {
    if (line.starts_with('#')) {
      const std::size_t level = line.find_first_not_of('#');
      sections_.push_back({.line = number_, .level = static_cast<int>(level), .heading = trimmed(line.substr(level))});
      return;
    }
    // The programs of the page of codes are lines that are indented.
    static const std::set<std::string> kBeforePrograms = {"Wrong:", "Right:", "Sbagliato:", "Giusto:"};
    if (kBeforePrograms.contains(line)) sections_.back().code.push_back({.line = number_, .lines = {}});
    is_program_ = kBeforePrograms.contains(line) || (is_program_ && line.empty());
    if (line.starts_with("> ")) return;  // The page of codes quotes the other language.
    const std::string text = of_any_language(line);
    add_marks(text, number_, sections_.back().marks);
    if (is_row(line)) sections_.back().rows.push_back(row_of(line, number_));
  }

  std::size_t number_ = 0;
  std::vector<Section> sections_;
  std::optional<CodeReader> code_;
  bool is_program_ = false;
  bool is_message_ = false;
};

std::vector<Section> sections_of(const std::string& page) {
  std::istringstream lines(page);
  PageReader reader;
  for (std::string line; std::getline(lines, line);) reader.add(line);
  return reader.sections();
}

}  // namespace isocnc::architecture
