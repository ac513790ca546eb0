#include <gtest/gtest.h>

#include "client_text.h"
#include "session.h"

/// Formatting of a program, in the minimum number of edits.
namespace isocnc::lsp {
namespace {

const Json kOptions = {{"tabSize", 2}, {"insertSpaces", true}};

class Formatting : public testing::Test {
 protected:
  Formatting() { session_.start(); }

  Json edits_of(const std::string& method, const std::string& text, Json more) {
    session_.open(kUri, text);
    more["textDocument"] = {{"uri", kUri}};
    more["options"] = kOptions;
    return session_.request(method, more);
  }

  Session session_;
};

TEST_F(Formatting, WritesCapitalsAndOneBlankBetweenWords) {
  const std::string before = "m06t101001\ng01 x10(piè 😀)f2000\nG00 Z50\n\tx5   y6 ; già 😀 così\nM02";
  const Json edits = edits_of("textDocument/formatting", before, {});
  EXPECT_EQ(ClientText(before).with(edits), "M06 T101001\nG01 X10 (piè 😀) F2000\nG00 Z50\nX5 Y6 ; già 😀 così\nM02");
  for (const Json& edit : edits) {
    EXPECT_NE(edit["range"]["start"]["line"], 2) << "a line that stays as it is";
    EXPECT_EQ(edit["range"]["start"]["line"], edit["range"]["end"]["line"]);
  }
  EXPECT_EQ(edits.size(), 3u);
}

TEST_F(Formatting, WhatIsRightOrWrongStaysAsItIs) {
  EXPECT_EQ(edits_of("textDocument/formatting", "G01 X10\r\nM02\r\n", {}), Json::array());
  EXPECT_EQ(edits_of("textDocument/formatting", "g01 x1.2.3\n", {}), Json::array());
  EXPECT_EQ(edits_of("textDocument/formatting", "", {}), Json::array());
}

TEST_F(Formatting, ARangeIsItsLines) {
  const std::string before = "g0x1\ng0x2\ng0x3\ng0x4\n";
  const auto format = [&](const Json& range) {
    return ClientText(before).with(edits_of("textDocument/rangeFormatting", before, {{"range", range}}));
  };
  const auto range = [](std::uint32_t line, std::uint32_t column, std::uint32_t end_line, std::uint32_t end_column) {
    return Json{{"start", {{"line", line}, {"character", column}}},
                {"end", {{"line", end_line}, {"character", end_column}}}};
  };
  EXPECT_EQ(format(range(1, 2, 2, 1)), "g0x1\nG0 X2\nG0 X3\ng0x4\n");
  EXPECT_EQ(format(range(1, 0, 2, 0)), "g0x1\nG0 X2\ng0x3\ng0x4\n");
  EXPECT_EQ(format(range(3, 0, 4294967295u, 4294967295u)), "g0x1\ng0x2\ng0x3\nG0 X4\n");
}

struct Typed {
  const char* text;  // The program, with the cursor after the typed text.
  const char* character;
  const char* after;
};

TEST_F(Formatting, TypedLettersBecomeCapitals) {
  const Typed kTyped[] = {
      {"g[!!]\n", "g", "G\n"},
      {"G01 x[!!]\n", "x", "G01 X\n"},
      {"(è 😀) g01 x[!!]\n", "x", "(è 😀) G01 X\n"},
      {"G01 (tasca è x[!!])\n", "x", "G01 (tasca è x)\n"},
      {"G01 X1 ; tasca x[!!]\n", "x", "G01 X1 ; tasca x\n"},
      {"if v1=2 goto n3[!!]\n", "n", "IF V1=2 GOTO N3\n"},
      {"g0x1\ng01x10\n[!!]\nx1", "\n", "g0x1\nG01 X10\n\nx1"},
  };
  for (const Typed& typed : kTyped) {
    const SelectedProgram program(typed.text);
    const ClientText text(program.text);
    const Json edits = edits_of("textDocument/onTypeFormatting", program.text,
                                {{"position", text.place(program.begin)}, {"ch", typed.character}});
    EXPECT_EQ(text.with(edits), typed.after) << typed.text;
  }
}

}  // namespace
}  // namespace isocnc::lsp
