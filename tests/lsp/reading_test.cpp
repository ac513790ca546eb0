#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "client_text.h"
#include "lsp/documents/analyzed_document.h"
#include "lsp/documents/settings_store.h"
#include "lsp/documents/snapshot.h"
#include "lsp/features/feature.h"
#include "marked_program.h"
#include "session.h"
#include "tests/support/random.h"
#include "tests/support/random_program.h"

/// Semantic tokens and inlay hints.
namespace isocnc::lsp {
namespace {

using protocol::Encoding;

/// A session with one program open.
class Reading {
 public:
  explicit Reading(std::string text, Encoding encoding = Encoding::Utf16, const Json& more = Json::object())
      : text_(std::move(text), encoding) {
    legend_ = session.start(capabilities_with(encoding), more)["capabilities"]["semanticTokensProvider"]["legend"];
    session.open(kUri, text_.text());
  }

  /// The tokens, such as `function:G01 parameter:X`, one line for each line of the program.
  std::string drawing_of(const std::vector<int>& data) const {
    std::string drawing;
    int line = 0;
    int unit = 0;
    for (std::size_t i = 0; i + 4 < data.size(); i += 5) {
      drawing += data[i] > 0 ? std::string(static_cast<std::size_t>(data[i]), '\n') : drawing.empty() ? "" : " ";
      line += data[i];
      unit = data[i] > 0 ? data[i + 1] : unit + data[i + 1];
      const Json range = {{"start", {{"line", line}, {"character", unit}}},
                          {"end", {{"line", line}, {"character", unit + data[i + 2]}}}};
      drawing += fmt::format("{}{}:{}", legend_["tokenTypes"][static_cast<std::size_t>(data[i + 3])].get<std::string>(),
                             data[i + 4] == 1   ? "!"
                             : data[i + 4] == 2 ? "="
                                                : "",
                             text_.in(range));
    }
    return drawing;
  }

  /// The text with its hints inserted in braces.
  std::string with_hints() {
    Json params = document_params();
    params["range"] = lines(0, 1000);
    Json edits = Json::array();
    for (const Json& hint : session.request("textDocument/inlayHint", params))
      edits.push_back({{"range", {{"start", hint["position"]}, {"end", hint["position"]}}},
                       {"newText", fmt::format("{{{}}}", hint["label"].get<std::string>())}});
    return text_.with(edits);
  }

  Session session;

 private:
  const ClientText text_;
  Json legend_;
};

const std::pair<const char*, const char*> kDrawnRanges[] = {
    {"N10 G01 X-1.5 F 200 (😀) Y2",
     "decorator!:N10 function:G01 parameter:X number:-1.5 property:F number:200 "
     "comment:(😀) parameter:Y number:2"},
    {"g90 M03 S1000\nM06 T101001 ; é",
     "macro:g90 method:M03 property:S number:1000\nmethod:M06 class:T101001 comment:; é"},
    {"IF V1 <= 2.5 GOTO N30", "keyword:IF variable:V1 operator:<= number:2.5 keyword:GOTO decorator:N30"},
    {"IF VGPL=1 GOTO N30", "keyword:IF variable=:VGPL operator:= number:1 keyword:GOTO decorator:N30"},
    {"V1=2 V2 = -3", "variable!:V1 operator:= number:2 variable!:V2 operator:= number:-3"},
    {"M100 P1=5", "method:M100 parameter:P number:1 operator:= number:5"},
    {"X1(a)0", "parameter:X number:1 comment:(a) number:0"},
    {"%% G1", "function:G1"},
    {"", ""},
};

TEST(SemanticTokens, DescribeEachWord) {
  for (const auto& [program, drawing] : kDrawnRanges)
    for (const Encoding encoding : kEncodings) {
      Reading reading(program, encoding);
      const Json full = reading.session.request("textDocument/semanticTokens/full", document_params());
      EXPECT_EQ(reading.drawing_of(full["data"]), drawing);
    }
}

TEST(SemanticTokens, OfARangeAreThoseOfItsLines) {
  Reading reading("G00 X1\nG01 Y2\n\nM02\n");
  Json params = document_params();
  params["range"] = lines(1, 2);
  EXPECT_EQ(reading.drawing_of(reading.session.request("textDocument/semanticTokens/range", params)["data"]),
            "\nfunction:G01 parameter:Y number:2");
  params["range"] = lines(7, 9);
  EXPECT_EQ(reading.session.request("textDocument/semanticTokens/range", params)["data"], Json::array());
}

/// Keeps tokens as an editor does: requests changes and applies them.
class TokenClient {
 public:
  explicit TokenClient(Session& session) : session_(session) {
    take(session_.request("textDocument/semanticTokens/full", document_params()));
  }

  void update() {
    Json params = document_params();
    params["previousResultId"] = id_;
    take(session_.request("textDocument/semanticTokens/full/delta", params));
  }

  std::vector<int> data;
  std::size_t received = 0;  ///< The number of numbers in the last answer.

 private:
  void take(const Json& answer) {
    id_ = answer["resultId"];
    if (answer.contains("data")) {
      data = answer["data"].get<std::vector<int>>();
      received = data.size();
      return;
    }
    received = 0;
    for (const Json& edit : answer["edits"]) {
      const std::vector<int> put = edit["data"];
      const auto begin = data.begin() + edit["start"].get<std::ptrdiff_t>();
      data.insert(data.erase(begin, begin + edit["deleteCount"].get<std::ptrdiff_t>()), put.begin(), put.end());
      received += put.size();
    }
  }

  Session& session_;
  std::string id_;
};

TEST(SemanticTokens, ComeAsChangesThatGiveTheSameAsAfresh) {
  for (const std::uint64_t seed : support::seeds(30)) {
    support::Random random(seed);
    support::RandomProgram program(random);
    const auto text = [&](int maximum) {
      std::string all;
      for (const std::string& line : program.lines(random.between(0, maximum))) all += message_text(line) + "\n";
      return all;
    };
    Session session;
    session.start();
    session.open(kUri, text(600));
    std::optional<TokenClient> client(session);
    for (int version = 2; version < 12; ++version) {
      const int line = random.between(0, 500);
      const Json step = random.one_in(10) ? Json{{"text", text(600)}}
                                          : change(line, random.between(0, 9), line + random.between(0, 3),
                                                   random.between(0, 9), random.one_in(2) ? "(è 😀)" : text(3));
      session.edit(kUri, version, {step});
      client->update();
      if (random.one_in(2)) continue;  // No comparison now, so that the next changes build on these.
      const Json full = session.request("textDocument/semanticTokens/full", document_params());
      EXPECT_EQ(client->data, full["data"].get<std::vector<int>>()) << seed << " " << version;
      client.emplace(session);
    }
  }
}

TEST(SemanticTokens, OfOneChangedLineAreFew) {
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "G01 X1 Y2 F100\n";
  Session session;
  session.start();
  session.open(kUri, text);
  TokenClient client(session);
  client.update();
  EXPECT_EQ(client.received, 0u);
  session.edit(kUri, 2, {change(10'000, 0, 10'000, 0, "M03 ")});
  client.update();
  EXPECT_GT(client.received, 0u);
  EXPECT_LT(client.received, 30'000u);
}

TEST(InlayHints, ShowWhereIncrementalMotionsEndAndWhatIsInForce) {
  const std::pair<const char*, const char*> kCases[] = {
      {"M06 T101001\nG90 G00 X10 Y20\nG91 G01 X5 F100\n(😀) X5.25 Y-1\nG90\nX1\nM02\n",
       "M06 T101001{0:00:00}\nG90 G00 X10 Y20\nG91 G01 X5{→ X15} F100\n(😀) {G01}X5.25 Y-1{→ X20.25 "
       "Y19}\nG90\n{G01}X1\nM02\n"},
      // Inches stay inches; a center is not a target position.
      {"M06 T101001\nG70 G91 G00 X1\nG02 I1 J0 X2 F10\nM02\n",
       "M06 T101001{0:00:00}\nG70 G91 G00 X1{→ X1}\nG02 I1 J0 X2{→ X3} F10\nM02\n"},
      // Rotary axes have hints as well.
      {"M06 T101001\nG91 G49\nG01 B10 C-5 F100\nB2.5\nM02\n",
       "M06 T101001\nG91 G49\nG01 B10 C-5{→ B10 C-5} F100\n{G01}B2.5{→ B12.5}\nM02\n"},
      // Two paths with different Gs and positions lead to N5, so there are no hints.
      {"M06 T101001\nG91 G00 X1\nIF VGPL = 1 GOTO N5\nG01 X1 F100\nN5 X1\nY1\nM02\n",
       "M06 T101001{0:00:00}\nG91 G00 X1{→ X1}\nIF VGPL = 1 GOTO N5\nG01 X1{→ X2} F100\nN5 X1\nY1\nM02\n"},
      {"M02\nG91 G00 X1\nX1\n", "M02\nG91 G00 X1\nX1\n"},
  };
  for (const auto& [program, hinted] : kCases)
    for (const Encoding encoding : kEncodings) EXPECT_EQ(Reading(program, encoding).with_hints(), hinted);
}

TEST(InlayHints, CanBeSwitchedOffEachByItself) {
  const char* const kProgram = "M06 T101001\nG91 G00 X1\nX1\nM02\n";
  const auto with = [&](const Json& hints) {
    return Reading(kProgram, Encoding::Utf16, {{"initializationOptions", {{"inlayHints", hints}}}}).with_hints();
  };
  EXPECT_EQ(with({{"endPosition", false}, {"sectionTime", false}}), "M06 T101001\nG91 G00 X1\n{G00}X1\nM02\n");
  EXPECT_EQ(with({{"motionInForce", false}}), "M06 T101001{0:00:00}\nG91 G00 X1{→ X1}\nX1{→ X2}\nM02\n");
  EXPECT_EQ(with({{"endPosition", false}, {"motionInForce", false}, {"sectionTime", false}}), kProgram);
}

}  // namespace
}  // namespace isocnc::lsp
