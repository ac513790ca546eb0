#include <gtest/gtest.h>

#include "client_text.h"
#include "session.h"

/// Signature help for the instruction that is being written.
namespace isocnc::lsp {
namespace {

struct Signed {
  const char* program;
  const char* signature;  // The label of the signature; null for none.
  const char* active;     // The active parameter; empty for none.
};

constexpr Signed kSigned[] = {
    {"G01[!!]\n", "G01 X Y Z B C", "X"},
    {"G01 [!!]\n", "G01 X Y Z B C", "X"},
    {"G01 X10 [!!]\n", "G01 X Y Z B C", "Y"},
    {"G01 X10 Y[!!]\n", "G01 X Y Z B C", "Y"},
    {"G01 X1[!!]0 Y5\n", "G01 X Y Z B C", "X"},
    {"G01 X1 Y1 Z1 B1 C1 [!!]\n", "G01 X Y Z B C", ""},
    {"(è 😀) G90 G02 X10 Y10 R[!!]\n", "G02 X Y Z B C I J K R", "R"},
    {"G90 [!!]G02 X10 Y10\n", nullptr, ""},
    {"G00 X1\nY[!!]\n", "G00 X Y Z B C", "Y"},
    {"Y[!!]\n", nullptr, ""},
    {"G04 [!!]\n", "G04 P", "P"},
    {"M06 [!!]\n", "M06 T", "T"},
    {"M100 P1=2 P2=[!!]\n",
     "M100 P1= P2= P3= P4= P5= P6= P7= P8= P9= P10= P11= P12= P13= P14= P15= P16= P17= P18= P19= P20=", "P2="},
    {"M02 [!!]\n", nullptr, ""},
    {"IF [!!]\n", "IF VGPL >= 1 GOTO N30", "VGPL"},
    {"IF V1 [!!]\n", "IF VGPL >= 1 GOTO N30", ">="},
    {"IF V1 >= [!!]\n", "IF VGPL >= 1 GOTO N30", "1"},
    {"IF V1 >= 2 GOTO [!!]\n", "IF VGPL >= 1 GOTO N30", "N30"},
    {"V1 = [!!]\n", "V1 = 0", "0"},
    {"G01 X1 ; X[!!]\n", nullptr, ""},
    {"G01 X1 (X[!!])\n", nullptr, ""},
    {"[!!]\n", nullptr, ""},
    {"G17 [!!]\n", nullptr, ""},
    {"T101001[!!]\n", nullptr, ""},
};

TEST(SignatureHelp, ShowsTheArgumentsAndTheOneAtTheCursor) {
  Session session;
  session.start();
  for (const Signed& each : kSigned) {
    const SelectedProgram program(each.program);
    session.open(kUri, program.text);
    const Json help = session.request(
        "textDocument/signatureHelp",
        {{"textDocument", {{"uri", kUri}}}, {"position", ClientText(program.text).place(program.begin)}});
    if (!each.signature) {
      EXPECT_EQ(help, nullptr) << each.program;
      continue;
    }
    ASSERT_TRUE(help.is_object()) << each.program;
    const Json& signature = help["signatures"][0];
    EXPECT_EQ(signature["label"], each.signature) << each.program;
    const std::size_t active = help["activeParameter"];
    const Json& parameters = signature["parameters"];
    EXPECT_EQ(active < parameters.size() ? parameters[active]["label"] : Json(""), each.active) << each.program;
  }
}

TEST(SignatureHelp, SpeaksItalian) {
  Session session;
  session.start(Json::object(), {{"locale", "it"}});
  session.open(kUri, "G04 ");
  const Json help = session.request("textDocument/signatureHelp",
                                    {{"textDocument", {{"uri", kUri}}}, {"position", {{"line", 0}, {"character", 4}}}});
  EXPECT_EQ(help["signatures"][0]["documentation"], "attesa");
}

}  // namespace
}  // namespace isocnc::lsp
