#include "analyzer/notepad_language.h"

#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpreter/configuration/configuration.h"
#include "interpreter/dialect/codes.h"
#include "interpreter/dialect/letters.h"

namespace isocnc::analyzer {

using Words = std::vector<std::string>;

namespace {

/// A class of words with a color of its own. Notepad++ numbers them from 1 to 8.
struct WordClass {
  Words words;
  bool is_prefix = false;  ///< Whether words only have to start like that: `T101001`.
  std::string_view color;
  bool is_bold = false;
};

}  // namespace

/// `G1` and `G01`.
static void append_spellings(const dialect::GCode& code, Words& words) {
  words.push_back(fmt::format("G{}", code.number));
  if (code.number < 10) words.push_back(fmt::format("G{:02}", code.number));
}

static std::array<WordClass, 8> word_classes() {
  WordClass motions = {.words = {}, .color = "0000C0", .is_bold = true};
  WordClass other_g = {.words = {}, .color = "0060A0"};
  for (const dialect::GCode& code : dialect::kGCodes)
    append_spellings(code, code.is_motion() ? motions.words : other_g.words);
  return {motions,
          other_g,
          {.words = {"M"}, .is_prefix = true, .color = "A000A0"},
          {.words = {"T"}, .is_prefix = true, .color = "A05000"},
          {.words = {"IF", "GOTO"}, .color = "C00000", .is_bold = true},
          {.words = {"F", "S"}, .is_prefix = true, .color = "707000"},
          {.words = {"V"}, .is_prefix = true, .color = "008080"},
          {.words = {"N"}, .is_prefix = true, .color = "808080"}};
}

/// The letters of words that only have a number: axes, centers, parameters.
static Words number_letters() {
  Words letters;
  for (const dialect::LetterDef& def : dialect::kLetters) {
    if (std::string_view("GMTFSVN").find(def.letter) != std::string_view::npos) continue;
    letters.emplace_back(1, def.letter);
    letters.emplace_back(1, static_cast<char>(def.letter - 'A' + 'a'));  // Numbers know no other way to ignore case.
  }
  return letters;
}

static std::string style(std::string_view name, std::string_view color, int font) {
  return fmt::format(
      "            <WordsStyle name=\"{}\" fgColor=\"{}\" bgColor=\"FFFFFF\" fontName=\"\" fontStyle=\"{}\" "
      "nesting=\"0\" />\n",
      name, color, font);
}

std::string notepad_language() {
  static constexpr std::string_view kCommentColor = "007000";
  static constexpr int kBold = 1;
  static constexpr int kItalic = 2;
  static constexpr int kDelimiters = 8;
  const std::array<WordClass, 8> classes = word_classes();
  Words extensions;
  for (const std::string& extension : configuration::kProgramExtensions) extensions.push_back(extension.substr(1));
  std::string prefixes;
  std::string keywords;
  std::string styles;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    prefixes += fmt::format(" Keywords{}=\"{}\"", i + 1, classes[i].is_prefix ? "yes" : "no");
    keywords += fmt::format("            <Keywords name=\"Keywords{}\">{}</Keywords>\n", i + 1,
                            fmt::join(classes[i].words, " "));
    styles += style(fmt::format("KEYWORDS{}", i + 1), classes[i].color, classes[i].is_bold ? kBold : 0);
  }
  std::string empty;
  for (const std::string_view name :
       {"Numbers, prefix2", "Numbers, extras1", "Numbers, extras2", "Numbers, suffix1", "Numbers, suffix2",
        "Numbers, range", "Operators2", "Folders in code1, open", "Folders in code1, middle", "Folders in code1, close",
        "Folders in code2, open", "Folders in code2, middle", "Folders in code2, close", "Folders in comment, open",
        "Folders in comment, middle", "Folders in comment, close"})
    empty += fmt::format("            <Keywords name=\"{}\"></Keywords>\n", name);
  std::string delimiters = "00( 01 02) 02((EOL))";  // A comment that is not closed ends with its line.
  for (int i = 3; i < 3 * kDelimiters; ++i) delimiters += fmt::format(" {:02}", i);
  std::string other_styles;
  for (const std::string_view name : {"FOLDER IN CODE1", "FOLDER IN CODE2", "FOLDER IN COMMENT"})
    other_styles += style(name, "000000", 0);
  other_styles += style("DELIMITERS1", kCommentColor, kItalic);
  for (int i = 2; i <= kDelimiters; ++i) other_styles += style(fmt::format("DELIMITERS{}", i), "000000", 0);
  return fmt::format(
      "<NotepadPlus>\n"
      "    <UserLang name=\"ISOCNC\" ext=\"{}\" udlVersion=\"2.1\">\n"
      "        <Settings>\n"
      "            <Global caseIgnored=\"yes\" allowFoldOfComments=\"no\" foldCompact=\"no\" forcePureLC=\"0\" "
      "decimalSeparator=\"0\" />\n"
      "            <Prefix{} />\n"
      "        </Settings>\n"
      "        <KeywordLists>\n"
      "            <Keywords name=\"Comments\">00; 01 02((EOL)) 03 04</Keywords>\n"
      "            <Keywords name=\"Numbers, prefix1\">{}</Keywords>\n"
      "            <Keywords name=\"Operators1\">= &lt; &gt;</Keywords>\n"
      "{}{}"
      "            <Keywords name=\"Delimiters\">{}</Keywords>\n"
      "        </KeywordLists>\n"
      "        <Styles>\n"
      "{}{}{}{}{}{}{}"
      "        </Styles>\n"
      "    </UserLang>\n"
      "</NotepadPlus>\n",
      fmt::join(extensions, " "), prefixes, fmt::join(number_letters(), " "), empty, keywords, delimiters,
      style("DEFAULT", "000000", 0), style("COMMENTS", kCommentColor, kItalic),
      style("LINE COMMENTS", kCommentColor, kItalic), style("NUMBERS", "202020", 0), styles,
      style("OPERATORS", "C00000", 0), other_styles);
}

}  // namespace isocnc::analyzer
