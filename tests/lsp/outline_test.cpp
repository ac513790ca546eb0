#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "client_text.h"
#include "marked_program.h"
#include "session.h"
#include "tests/support/random.h"
#include "tests/support/random_program.h"

/// The structure of a program: symbols, folds, and selection ranges. Lines are counted from 1, as machinists do.
namespace isocnc::lsp {
namespace {

using protocol::Encoding;

constexpr const char* kOtherUri = "file:///nowhere/other.iso";

const Json kHierarchical = {{"textDocument", {{"documentSymbol", {{"hierarchicalDocumentSymbolSupport", true}}}}}};

std::string lines_of(const Json& range) {
  return fmt::format("{}-{}", range["start"]["line"].get<int>() + 1, range["end"]["line"].get<int>() + 1);
}

/// Draws one line for each symbol, indented by its depth.
void draw(const Json& symbols, std::string& drawing, const std::string& indent = "") {
  for (const Json& symbol : symbols) {
    const std::string detail = symbol["detail"];
    drawing += fmt::format("{}{} {}{}\n", indent, lines_of(symbol["range"]), symbol["name"].get<std::string>(),
                           detail.empty() ? "" : ": " + detail);
    draw(symbol["children"], drawing, indent + "  ");
  }
}

std::string drawing_of(const std::string& text) {
  Session session;
  session.start(kHierarchical);
  session.open(kUri, text);
  std::string drawing;
  draw(session.request("textDocument/documentSymbol", document_params()), drawing);
  return drawing;
}

struct Drawn {
  const char* program;
  const char* drawing;
};

const Drawn kDrawn[] = {
    {"", ""},
    {"G00 X1\nM02\n", ""},
    {"G92 X1 Y2 (pezzo)\n"
     "(--- SGROSSATURA ---)\n"
     "; fresa D12\n"
     "M06 T101005\n"
     "N10 G29 X10 B90\n"
     "G00 X1\n"
     "G27\n"
     "; contorno\n"
     "G24 X1 I1 Q1\n"
     "IF VGPL = 1 GOTO N20\n"
     "(----)\n"
     "N20 G00 X1\n"
     "M06 T 1 01 007\n"
     "G00 X1\n"
     "M02\n"
     "; note\n",
     "1-1 G92 X1 Y2\n"
     "2-12 T101005: SGROSSATURA\n"
     "  5-7 G29 X10 B90\n"
     "  8-12 G24 X1 I1 Q1: contorno\n"
     "    12-12 N20\n"
     "13-15 T101007\n"
     "16-16 note\n"},
    {"M06\nG28 I1 Q1\nG28 J1 P1\nG00 X1\n", "1-5 M06\n  2-2 G28 I1 Q1\n  3-5 G28 J1 P1\n"},
    {"(prima)\n(seconda)\n\n(terza)\nG00 X1\nM02\n", "1-2 prima\n4-4 terza\n"},
    // A label continues after the first M02: the tool's section ends at the last one.
    {"M06 T101001\nIF VGPL = 1 GOTO N5\nM02\nN5 G00 X1\nM02\n\n", "1-5 T101001\n  4-4 N5\n"},
    {"M02\nM06 T101001\nG00 X1", "2-3 T101001\n"},
};

TEST(DocumentSymbols, AreToolsFramesLabelsAndHeadings) {
  for (const auto& [program, drawing] : kDrawn) EXPECT_EQ(drawing_of(program), drawing) << program;
}

TEST(DocumentSymbols, PointAtWhatMakesThem) {
  for (const Encoding encoding : kEncodings) {
    const MarkedProgram program("(😀) [M06] T101001 (é)\n", encoding);
    Session session;
    Json capabilities = capabilities_with(encoding);
    capabilities.update(kHierarchical);
    session.start(capabilities);
    session.open(kUri, program.text);
    const Json symbols = session.request("textDocument/documentSymbol", document_params());
    EXPECT_EQ(symbols[0]["selectionRange"], program.marked_ranges[0]);
  }
}

TEST(DocumentSymbols, AreARowForClientsThatKnowNoTree) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nG29 B90\nM02\n");
  const Json symbols = session.request("textDocument/documentSymbol", document_params());
  ASSERT_EQ(symbols.size(), 2u);
  EXPECT_EQ(symbols[1]["name"], "G29 B90");
  EXPECT_EQ(symbols[1]["containerName"], "T101001");
  EXPECT_EQ(symbols[1]["location"]["uri"], kUri);
}

TEST(WorkspaceSymbols, AreThoseOfAllOpenPrograms) {
  Session session;
  session.start();
  session.open(kUri, "(SGROSSATURA)\nM06 T101001\nM02\n");
  session.open(kOtherUri, "; finitura\nG00 X1\nM06 T101002\nM02\n");
  const auto names = [&](const char* query) {
    std::vector<std::string> found;
    for (const Json& symbol : session.request("workspace/symbol", {{"query", query}})) found.push_back(symbol["name"]);
    return found;
  };
  EXPECT_THAT(names(""), testing::UnorderedElementsAre("T101001 SGROSSATURA", "finitura", "T101002"));
  EXPECT_THAT(names("t1002"), testing::ElementsAre("T101002"));
  EXPECT_THAT(names("GROSS"), testing::ElementsAre("T101001 SGROSSATURA"));
  EXPECT_THAT(names("fresa"), testing::IsEmpty());
}

/// Expects each symbol to lie within its parent and to contain its name.
void expect_nested(const Json& symbols, const Json& outer, const std::string& program) {
  const auto place = [](const Json& json) { return std::pair(json["line"].get<int>(), json["character"].get<int>()); };
  const auto holds = [&](const Json& a, const Json& b) {
    return place(a["start"]) <= place(b["start"]) && place(b["end"]) <= place(a["end"]);
  };
  for (const Json& symbol : symbols) {
    EXPECT_NE(symbol["name"], "");
    EXPECT_TRUE(outer.is_null() || holds(outer, symbol["range"])) << symbol << "\n" << program;
    EXPECT_TRUE(holds(symbol["range"], symbol["selectionRange"])) << symbol << "\n" << program;
    expect_nested(symbol["children"], symbol["range"], program);
  }
}

/// A program in which many sections start and end.
std::string sections_program(support::Random& random) {
  support::RandomProgram lines(random);
  std::string text;
  for (int i = random.between(0, 40); i > 0; --i) {
    text += random.one_in(3)
                ? message_text(lines.line())
                : std::string(random.any_of({"M06 T101001", "G29 B90", "G27", "G92 X1", "M02", "(a 😀)", "; --", "",
                                             "N5 (b)", "N5 M06 T1", "IF V1 = 2 GOTO N5", "G29 B90 M06 T101002"}));
    text += "\n";
  }
  return text;
}

TEST(DocumentSymbols, AreNestedInAnyProgram) {
  Session session;
  session.start(kHierarchical);
  for (const std::uint64_t seed : support::seeds(200)) {
    support::Random random(seed);
    const std::string text = sections_program(random);
    session.open(kUri, text);
    expect_nested(session.request("textDocument/documentSymbol", document_params()), nullptr, text);
  }
}

TEST(Outline, IsTheSameAfterEditsAsAfresh) {
  for (const std::uint64_t seed : support::seeds(40)) {
    support::Random random(seed);
    Session session;
    session.start(kHierarchical);
    std::string text = sections_program(random);
    session.open(kUri, text);
    for (int version = 2; version < 8; ++version) {
      const int line = random.between(0, static_cast<int>(std::count(text.begin(), text.end(), '\n')));
      const int lines = random.between(0, 4);
      const std::string inserted = sections_program(random);
      const Json step = change(line, 0, line + lines, 0, inserted);
      std::size_t begin = 0;
      for (int i = 0; i < line; ++i) begin = text.find('\n', begin) + 1;
      std::size_t end = begin;
      for (int i = 0; i < lines && end < text.size(); ++i) end = text.find('\n', end) + 1;
      text.replace(begin, end - begin, inserted);
      session.edit(kUri, version, {step});
      session.request("textDocument/documentSymbol", document_params());
    }
    session.open(kOtherUri, text);
    for (const char* const method : {"textDocument/documentSymbol", "textDocument/foldingRange"})
      EXPECT_EQ(session.request(method, document_params()), session.request(method, document_params(kOtherUri)))
          << seed << "\n"
          << text;
  }
}

std::string folds_of(const std::string& text, const Json& capabilities = Json::object()) {
  Session session;
  session.start(capabilities);
  session.open(kUri, text);
  std::string drawing;
  for (const Json& fold : session.request("textDocument/foldingRange", document_params()))
    drawing += fmt::format("{}-{} {}\n", fold["startLine"].get<int>() + 1, fold["endLine"].get<int>() + 1,
                           fold.value("kind", "jump"));
  return drawing;
}

TEST(Folding, HidesSectionsJumpsCommentsAndTheTail) {
  const Drawn kCases[] = {
      {"G00 X1\nM02\n", ""},
      {"; uno\n; due\n\n(tre)\nM02\n", "1-2 comment\n"},
      {"M06 T101001\nG29 B90\nG00 X1\nG27\nM02\n", "1-5 region\n2-4 region\n"},
      {"IF VGPL = 1 GOTO N5\nG00 X1\nG00 X2\nN5 M02\n", "1-3 jump\n"},
      {"IF VGPL = 1 GOTO N5\nN5 M02\n", ""},
      {"IF VGPL = 1 GOTO N7\nN5 M02\n", ""},
      {"G00 X1\nM02\n; note\nG00 X2\n\n", "2-4 region\n"},
      {"IF VGPL = 1 GOTO N5\nM02\nN5 G00 X1\nM02\nuseless\n", "1-2 jump\n4-5 region\n"},
  };
  for (const auto& [program, folds] : kCases) EXPECT_EQ(folds_of(program), folds) << program;
}

TEST(Folding, GivesNoMoreThanTheClientTakes) {
  const Json capabilities = {{"textDocument", {{"foldingRange", {{"rangeLimit", 1}}}}}};
  EXPECT_EQ(folds_of("; uno\n; due\n\nM06 T101001\nM02\n", capabilities), "4-5 region\n");
}

TEST(Folding, ShowsToolAndTimeInPlaceOfTheLines) {
  const Json capabilities = {{"textDocument", {{"foldingRange", {{"foldingRange", {{"collapsedText", true}}}}}}}};
  Session session;
  session.start(capabilities);
  session.open(kUri,
               "; sgrossatura\nM06 T101001\nG29 B90\nG04 P100\nG27\n; nota\n; seconda\nM06 T101002\nG04 P20\nM02\n");
  std::string drawing;
  for (const Json& fold : session.request("textDocument/foldingRange", document_params()))
    drawing += fmt::format("{} {}\n", fold["startLine"].get<int>() + 1, fold.value("collapsedText", "-"));
  // A tool change takes 8 s.
  EXPECT_EQ(drawing, "1 T101001 sgrossatura, 0:01:48\n3 G29 B90\n6 -\n6 T101002 nota, 0:00:28\n");
  session.edit(kUri, 2, {change(3, 0, 3, 8, "X1.2.3")});
  const Json after = session.request("textDocument/foldingRange", document_params());
  EXPECT_EQ(after[0]["collapsedText"], "T101001 sgrossatura") << "the run does not come to its end";
}

/// The operations of a program: a line for each, with times in seconds, and the room in mm.
std::string operations_of(Session& session) {
  std::string drawing;
  const Json answer = session.request("isocnc/operations", document_params());
  for (const Json& each : answer["operations"]) {
    drawing +=
        fmt::format("{} {}-{} {} ({})", each["line"].get<int>() + 1, each["firstLine"].get<int>() + 1,
                    each["lastLine"].get<int>() + 1, each["tool"].get<std::string>(), each["name"].get<std::string>());
    if (each["seconds"].is_null()) {
      drawing += " not run\n";
      continue;
    }
    drawing += fmt::format(" from {:.0f} s, {:.0f} s, {:.0f} mm", each["start"].get<double>(),
                           each["seconds"].get<double>(), each["length"].get<double>());
    for (const auto& [axis, range] : each["extents"].items())
      drawing += fmt::format(" {}{:.0f}..{:.0f}", axis, range[0].get<double>(), range[1].get<double>());
    drawing += "\n";
  }
  return drawing;
}

TEST(Operations, HaveTheirTimePathAndRoom) {
  Session session;
  session.start();
  session.open(
      kUri,
      "G92 X100 Y50 Z0\n; tasca\nM06 T101001\nG00 X10 Y5 Z20\nG01 Z-3 F60\nX40\nG00 Z20\n; sosta\nM06 T101002\n"
      "G04 P30\nM06 T101001\nG00 X0\nG02 X20 Y5 R10 F600\nM02\n");
  const std::string drawing = operations_of(session);
  EXPECT_THAT(drawing, testing::MatchesRegex(
                           "3 2-7 T101001 \\(tasca\\) from 0 s, 6[0-9] s, [0-9]+ mm X10..40 Y5..5 Z-3..20\n"
                           "9 8-10 T101002 \\(sosta\\) from 6[0-9] s, 38 s, 0 mm\n"
                           "11 11-14 T101001 \\(\\) from 10[0-9] s, 1[0-9] s, [0-9]+ mm X0..20 Y5..15 Z20..20\n"))
      << drawing;
  session.edit(kUri, 2, {change(9, 0, 9, 7, "G04 P1.2.3")});
  EXPECT_THAT(operations_of(session),
              testing::EndsWith("9 8-10 T101002 (sosta) not run\n11 11-14 T101001 () not run\n"));
  session.open(kOtherUri, "G00 X1\nM02\n");
  EXPECT_EQ(session.request("isocnc/operations", document_params(kOtherUri))["operations"], Json::array());
}

struct Grown {
  const char* program;
  std::vector<std::string> steps;
};

TEST(Selection, GrowsFromNumberToProgram) {
  const Grown kCases[] = {
      {"(😀) G01 X1|2.5 Y3 F100\nM02",
       {"12.5", "X12.5", "G01 X12.5 Y3", "(😀) G01 X12.5 Y3 F100", "(😀) G01 X12.5 Y3 F100\nM02"}},
      {"  G01 X12|  \nM02", {"12", "X12", "G01 X12", "  G01 X12  ", "  G01 X12  \nM02"}},
      {"M06 T101001\nG29 B90\nG27 (é x|y)\nM02",
       {"é xy", "(é xy)", "G27 (é xy)", "G29 B90\nG27 (é xy)", "M06 T101001\nG29 B90\nG27 (é xy)\nM02"}},
      {"M02\n|", {"", "M02\n"}},
  };
  for (const auto& [marked, steps] : kCases)
    for (const Encoding encoding : kEncodings) {
      const MarkedProgram program(marked, encoding);
      Session session;
      session.start(capabilities_with(encoding));
      session.open(kUri, program.text);
      Json params = document_params();
      params["positions"] = Json::array({program.cursor});
      std::vector<std::string> grown;
      for (Json at = session.request("textDocument/selectionRange", params)[0]; !at.is_null();
           at = at.value("parent", Json()))
        grown.push_back(ClientText(program.text, encoding).in(at["range"]));
      EXPECT_EQ(grown, steps) << marked;
    }
}

}  // namespace
}  // namespace isocnc::lsp
