#include <gtest/gtest.h>

#include <string>

#include "session.h"
#include "tests/support/random_program.h"

/// After any sequence of edits, requests and cancellations, the server's answers equal those for the final text opened
/// as a new document.
namespace isocnc::lsp {
namespace {

using support::Random;

constexpr const char* kEdited = "untitled:edited";
constexpr const char* kFresh = "untitled:fresh";

std::string utf8(const std::u16string& text) {
  std::string result;
  const auto add = [&](std::uint32_t byte) { result.push_back(static_cast<char>(byte)); };
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::uint32_t code = text[i];
    if (code >= 0xD800 && code < 0xDC00) code = 0x10000 + ((code - 0xD800) << 10) + (text[++i] - 0xDC00u);
    if (code < 0x80) {
      add(code);
    } else if (code < 0x800) {
      add(0xC0 | code >> 6);
      add(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
      add(0xE0 | code >> 12);
      add(0x80 | (code >> 6 & 0x3F));
      add(0x80 | (code & 0x3F));
    } else {
      add(0xF0 | code >> 18);
      add(0x80 | (code >> 12 & 0x3F));
      add(0x80 | (code >> 6 & 0x3F));
      add(0x80 | (code & 0x3F));
    }
  }
  return result;
}

/// A text as editors represent it: in UTF-16, with lines that end at CR, LF or both.
class EditorText {
 public:
  explicit EditorText(std::u16string text) : text_(std::move(text)) {}

  const std::u16string& text() const { return text_; }

  std::vector<std::size_t> line_starts() const {
    std::vector<std::size_t> starts = {0};
    for (std::size_t i = 0; i < text_.size(); ++i) {
      const bool is_pair = text_[i] == u'\r' && i + 1 < text_.size() && text_[i + 1] == u'\n';
      if ((text_[i] == u'\n' || text_[i] == u'\r') && !is_pair) starts.push_back(i + 1);
    }
    return starts;
  }
  std::size_t line_length(std::size_t line) const {
    std::size_t length = 0;
    for (std::size_t i = line_starts()[line]; i < text_.size() && text_[i] != u'\n' && text_[i] != u'\r'; ++i) ++length;
    return length;
  }
  /// A random position, never within a surrogate pair.
  std::pair<int, int> random_place(Random& random, std::size_t first_line, std::size_t lines) const {
    const std::vector<std::size_t> starts = line_starts();
    const std::size_t line = std::min(first_line + random.below(lines), starts.size() - 1);
    std::size_t column = random.below(line_length(line) + 1);
    const std::size_t offset = starts[line] + column;
    if (column > 0 && offset < text_.size() && text_[offset] >= 0xDC00 && text_[offset] < 0xE000) --column;
    return {static_cast<int>(line), static_cast<int>(column)};
  }
  Json replace(std::pair<int, int> begin, std::pair<int, int> end, const std::u16string& text) {
    const std::vector<std::size_t> starts = line_starts();
    const auto offset = [&](std::pair<int, int> place) {
      return starts[static_cast<std::size_t>(place.first)] + static_cast<std::size_t>(place.second);
    };
    text_.replace(offset(begin), offset(end) - offset(begin), text);
    return change(begin.first, begin.second, end.first, end.second, utf8(text));
  }

 private:
  std::u16string text_;
};

std::u16string ascii(const std::string& text) { return {text.begin(), text.end()}; }

std::u16string random_text(Random& random, support::RandomProgram& program) {
  static const std::u16string kEnds[] = {u"\n", u"\r\n", u"\r"};
  static const std::u16string kComments[] = {u"(perch\u00e9) ", u"(10 \u20ac) ", u"(\xD83D\xDE00) ", u"", u"", u""};
  switch (random.between(0, 4)) {
    case 0:
      return ascii(std::string(random.any_of({"", "1", "X", " ", "(", "G91", "\r", "\n"})));
    case 1:
      return kComments[random.below(3)];
    default:
      return kComments[random.below(6)] + ascii(program.line()) + kEnds[random.below(3)];
  }
}

/// Edits a document through the protocol, and sends and cancels requests meanwhile.
class Typist {
 public:
  Typist(std::uint64_t seed, int lines) : random_(seed), program_(random_), text_(first_text(lines)) {
    session_.start({{"textDocument", {{"diagnostic", Json::object()}}}});
    session_.open(kEdited, utf8(text_.text()), version_);
  }

  void type(int steps) {
    for (int i = 0; i < steps; ++i) {
      edit();
      if (random_.one_in(3)) ask();
      if (random_.one_in(6) && !asked_.empty()) cancel();
    }
  }

  /// The server's answers about the edited document.
  Json known() { return known_of(kEdited); }
  /// The answers about the same text, opened as a new document.
  Json known_afresh() {
    session_.open(kFresh, utf8(text_.text()));
    return known_of(kFresh);
  }
  /// Expects exactly one answer to each request.
  void expect_answers() {
    for (const std::int64_t id : asked_) {
      const Json response = session_.response_to(id);
      EXPECT_TRUE(response.contains("result") != response.contains("error"));
      if (!response.contains("error")) continue;
      const int code = response["error"]["code"];
      EXPECT_TRUE(code == -32800 || code == -32801) << response;
    }
    EXPECT_EQ(session_.request("shutdown"), nullptr);
    EXPECT_FALSE(session_.has_response());
  }

 private:
  std::u16string first_text(int lines) {
    std::u16string text;
    for (const std::string& line : program_.lines(lines)) text += ascii(line) + u"\n";
    return text;
  }
  void edit() {
    std::vector<Json> changes;
    for (int i = random_.between(1, 3); i > 0; --i) {
      auto begin = text_.random_place(random_, random_.below(text_.line_starts().size()), 1);
      auto end = text_.random_place(random_, static_cast<std::size_t>(begin.first), 3);
      if (end < begin) std::swap(begin, end);
      changes.push_back(text_.replace(begin, end, random_text(random_, program_)));
    }
    session_.edit(kEdited, ++version_, changes);
  }
  void ask() {
    const auto [line, column] = text_.random_place(random_, 0, text_.line_starts().size());
    const Json document = {{"uri", kEdited}};
    const Json position = {{"line", line + random_.between(0, 3)}, {"character", column + random_.between(0, 3)}};
    static constexpr const char* kOfDocument[] = {"textDocument/diagnostic", "textDocument/semanticTokens/full",
                                                  "textDocument/documentSymbol"};
    asked_.push_back(random_.one_in(2)
                         ? session_.ask(kOfDocument[random_.below(3)], {{"textDocument", document}})
                         : session_.ask("textDocument/hover", {{"textDocument", document}, {"position", position}}));
  }
  void cancel() { session_.notify("$/cancelRequest", {{"id", asked_[random_.below(asked_.size())]}}); }
  Json known_of(const char* uri) {
    const Json document = {{"textDocument", {{"uri", uri}}}};
    return {{"findings", session_.request("textDocument/diagnostic", document)["items"]},
            {"tokens", session_.request("textDocument/semanticTokens/full", document)["data"]},
            {"symbols", session_.request("textDocument/documentSymbol", document)}};
  }

  Random random_;
  support::RandomProgram program_;
  EditorText text_;
  Session session_;
  int version_ = 1;
  std::vector<std::int64_t> asked_;
};

/// The answers about a document, without its name.
std::string without_name(const Json& known) {
  std::string text = known.dump();
  for (const std::string name : {kEdited, kFresh})
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name)) text.erase(at, name.size());
  return text;
}

/// Divided into parts, so that several processes can run them.
class EditingProperty : public testing::TestWithParam<std::uint64_t> {};

constexpr std::uint64_t kShares = 8;
constexpr std::uint64_t kSequences = ISOCNC_RUNS_FAST ? 2000 : 120;

TEST_P(EditingProperty, EditedEqualsOpenedAfresh) {
  for (std::uint64_t seed = GetParam(); seed <= kSequences; seed += kShares) {
    Typist editor(seed, seed % 10 == 0 ? 600 : 25);
    editor.type(12);
    ASSERT_EQ(without_name(editor.known()), without_name(editor.known_afresh())) << "seed " << seed;
    editor.expect_answers();
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, EditingProperty, testing::Range<std::uint64_t>(1, kShares + 1));

}  // namespace
}  // namespace isocnc::lsp
