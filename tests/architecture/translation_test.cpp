#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "page_sections.h"
#include "source_files.h"

/// That the pages for operators and programmers say the same in both languages: the same sections with the same
/// examples, tables, options and codes. Sentences are not compared. A failure names the page, the section and what is
/// missing, with its line in the English page.
namespace isocnc::architecture {
namespace {

namespace fs = std::filesystem;

struct Translation {
  std::string english;
  std::string italian;
};

void PrintTo(const Translation& pages, std::ostream* out) { *out << pages.italian; }

const std::vector<Translation> kPages = {{"docs/README.md", "docs/it/README.md"},
                                         {"docs/operator.md", "docs/it/operatore.md"},
                                         {"docs/cam.md", "docs/it/cam.md"},
                                         {"docs/isolint.md", "docs/it/isolint.md"},
                                         {"docs/isofmt.md", "docs/it/isofmt.md"},
                                         {"docs/isorun.md", "docs/it/isorun.md"},
                                         {"docs/isodiff.md", "docs/it/isodiff.md"},
                                         {"docs/posts.md", "docs/it/posts.md"},
                                         {"docs/machine.md", "docs/it/macchina.md"},
                                         {"docs/configuration.md", "docs/it/configurazione.md"},
                                         {"docs/tools.md", "docs/it/utensili.md"},
                                         {"docs/house-rules.md", "docs/it/regole.md"},
                                         {"docs/dialect.md", "docs/it/dialetto.md"},
                                         {"docs/rules.md", "docs/it/codici.md"},
                                         {"docs/other-controls.md", "docs/it/altri-controlli.md"},
                                         {"docs/vscode.md", "docs/it/vscode.md"},
                                         {"docs/editors.md", "docs/it/editor.md"},
                                         {"docs/packages.md", "docs/it/installare.md"},
                                         {"docs/platforms.md", "docs/it/piattaforme.md"},
                                         {"docs/verification.md", "docs/it/verifica.md"},
                                         {"vscode-extension/README.md", "docs/it/estensione.md"}};

/// The translations of headings and of words in code, from a file with a heading for each kind and `English = Italian`
/// on each line.
class Glossary {
 public:
  Glossary() {
    std::istringstream lines(read("tests/architecture/translations.txt"));
    std::vector<Translation>* current = nullptr;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t equals = line.find(" = ");
      if (line.starts_with("[")) current = line == "[headings]" ? &headings_ : &code_;
      if (current != nullptr && equals != std::string::npos)
        current->push_back({line.substr(0, equals), line.substr(equals + 3)});
    }
  }

  /// The Italian heading; headings of codes and keys are the same. `PAGE: English` counts for one page.
  std::string heading(const std::string& page, const std::string& english) const {
    for (const std::string& wanted : {page + ": " + english, english})
      for (const Translation& each : headings_)
        if (each.english == wanted) return each.italian;
    return english;
  }

  std::string code(std::string english) const {
    for (const Translation& each : code_)
      for (std::size_t at = 0; (at = english.find(each.english, at)) != std::string::npos; at += each.italian.size())
        english.replace(at, each.english.size(), each.italian);
    return english;
  }

  const std::vector<Translation>& headings() const { return headings_; }

 private:
  std::vector<Translation> headings_;
  std::vector<Translation> code_;
};

const Glossary& glossary() {
  static const Glossary kGlossary;
  return kGlossary;
}

/// Compares two pages and collects the differences, as sentences.
class Comparison {
 public:
  explicit Comparison(const Translation& pages)
      : pages_(pages), english_(sections_of(read(pages.english))), italian_(sections_of(read(pages.italian))) {}

  std::vector<std::string> differences() {
    compare_headings();
    if (!differences_.empty()) return std::move(differences_);
    for (std::size_t i = 0; i < english_.size(); ++i) compare(english_[i], italian_[i]);
    return std::move(differences_);
  }

 private:
  void compare_headings() {
    std::vector<std::string> wanted;
    for (const Section& section : english_)
      wanted.push_back(marked(section.level, glossary().heading(pages_.english, section.heading)));
    std::vector<std::string> found;
    for (const Section& section : italian_) found.push_back(marked(section.level, section.heading));
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (!contains(found, wanted[i])) report("lacks the section \"" + wanted[i] + "\"", english_[i].line);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!contains(wanted, found[i]))
        report("has the section \"" + found[i] + "\" (line " + std::to_string(italian_[i].line) + "), unlike " +
               pages_.english + "; headings are translated in tests/architecture/translations.txt");
    if (differences_.empty() && wanted != found) report("has its sections in another order, or twice");
  }
  static std::string marked(int level, const std::string& heading) {
    return std::string(static_cast<std::size_t>(level), '#') + " " + heading;
  }
  static bool contains(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  }

  void compare(const Section& english, const Section& italian) {
    section_ = italian.heading;
    compare_marks(english.marks, italian.marks);
    compare_rows(english, italian);
    compare_code(english, italian);
  }

  /// Options, codes, words of programs and numbers, which are the same in every language.
  void compare_marks(const Marks& english, const Marks& italian) {
    for (const auto& [mark, line] : english)
      if (!italian.contains(mark)) report("does not name " + mark, line);
    for (const auto& [mark, line] : italian)
      if (!english.contains(mark)) report("names " + mark + " (line " + std::to_string(line) + "), unlike the other");
  }

  void compare_rows(const Section& english, const Section& italian) {
    for (std::size_t i = 0; i < std::min(english.rows.size(), italian.rows.size()); ++i) {
      const Row& row = english.rows[i];
      if (glossary().code(row.code) == italian.rows[i].code && row.cells == italian.rows[i].cells) continue;
      return report("has a table row for \"" + italian.rows[i].code + "\" (line " +
                        std::to_string(italian.rows[i].line) + ") instead of \"" + glossary().code(row.code) + "\"",
                    row.line);
    }
    if (english.rows.size() > italian.rows.size()) {
      const Row& row = english.rows[italian.rows.size()];
      report("lacks the table row \"" + glossary().code(row.code) + "\"", row.line);
    } else if (english.rows.size() < italian.rows.size()) {
      report("has a table row more, on line " + std::to_string(italian.rows[english.rows.size()].line));
    }
  }

  void compare_code(const Section& english, const Section& italian) {
    for (std::size_t i = 0; i < english.code.size(); ++i) {
      if (i >= italian.code.size()) return report("lacks the example", english.code[i].line);
      compare(english.code[i], italian.code[i]);
    }
    if (english.code.size() < italian.code.size())
      report("has an example more, on line " + std::to_string(italian.code[english.code.size()].line));
  }

  /// Reports the first line of an example that differs.
  void compare(const CodeBlock& english, const CodeBlock& italian) {
    for (std::size_t i = 0; i < std::max(english.lines.size(), italian.lines.size()); ++i) {
      const std::string wanted = i < english.lines.size() ? glossary().code(english.lines[i]) : "the example's end";
      const std::string found = i < italian.lines.size() ? italian.lines[i] : "the example's end";
      if (wanted == found) continue;
      return report("has in the example of line " + std::to_string(italian.line) + " \"" + found + "\" instead of \"" +
                        wanted + "\"",
                    english.line);
    }
  }

  void report(const std::string& what, std::size_t english_line = 0) {
    differences_.push_back(pages_.italian + (section_.empty() ? ": " : ", \"" + section_ + "\": ") + what +
                           (english_line == 0 ? "" : " (" + pages_.english + ":" + std::to_string(english_line) + ")"));
  }

  const Translation& pages_;
  const std::vector<Section> english_;
  const std::vector<Section> italian_;
  std::string section_;
  std::vector<std::string> differences_;
};

class TranslatedPages : public testing::TestWithParam<Translation> {};
INSTANTIATE_TEST_SUITE_P(All, TranslatedPages, testing::ValuesIn(kPages), [](const auto& tested) {
  std::string name = fs::path(tested.param.italian).stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(TranslatedPages, SayTheSame) {
  for (const std::string& difference : Comparison(GetParam()).differences()) ADD_FAILURE() << difference;
}

TEST_P(TranslatedPages, LeadToEachOther) {
  const auto links_to = [](const std::string& from, const std::string& to) {
    const std::string target = fs::path(to).lexically_relative(fs::path(from).parent_path());
    return read(from).find("](" + target + ")") != std::string::npos;
  };
  EXPECT_TRUE(links_to(GetParam().italian, GetParam().english));
  if (!GetParam().english.starts_with("docs/")) return;  // The extension's page is shown in VS Code, too.
  EXPECT_TRUE(links_to(GetParam().english, GetParam().italian));
}

TEST(Translations, AreAllCompared) {
  std::set<std::string> compared;
  for (const Translation& pages : kPages) compared.insert(pages.italian);
  std::set<std::string> there;
  for (const auto& entry : fs::directory_iterator(kRoot / "docs/it"))
    there.insert(fs::relative(entry.path(), kRoot).string());
  EXPECT_EQ(there, compared);
}

/// A heading that no page has any more would hide the next one that is misspelt.
TEST(Translations, OfHeadingsAreUsed) {
  std::set<std::string> used;
  for (const Translation& pages : kPages)
    for (const Section& section : sections_of(read(pages.english)))
      used.insert({section.heading, pages.english + ": " + section.heading});
  for (const Translation& heading : glossary().headings())
    EXPECT_TRUE(used.contains(heading.english)) << heading.english;
}

}  // namespace
}  // namespace isocnc::architecture
