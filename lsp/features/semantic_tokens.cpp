#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/text/characters.h"
#include "lsp/features/feature.h"
#include "lsp/queries/names.h"

/// Semantic tokens: the kind of each word, for the editor's colors. Tokens depend only on their line, so that chunks
/// which an edit has not touched keep their tokens.
namespace isocnc::features {

using syntax::LineTree;
using syntax::Span;
using syntax::Word;

namespace {

/// Kinds of tokens, in the order of kTypes.
enum class Type : std::uint8_t {
  Motion,
  Code,
  Function,
  Tool,
  Axis,
  Technology,
  Register,
  Label,
  Keyword,
  Operator,
  Number,
  Comment,
};

/// The protocol's name of each Type: a motion is a `function`, any other G a `macro`.
constexpr std::array kTypes = {"function", "macro",     "method",  "class",    "parameter", "property",
                               "variable", "decorator", "keyword", "operator", "number",    "comment"};
constexpr std::array kModifiers = {"definition", "readonly"};
constexpr unsigned kDefinition = 1;
constexpr unsigned kReadonly = 2;

struct Token {
  Span span;
  Type type = Type::Number;
  unsigned modifiers = 0;
};

/// The tokens of one line.
class LineTokens {
 public:
  /// The tokens of the line, valid until the next call.
  const std::vector<Token>& of(const LineTree& line) {
    tokens_.clear();
    line_ = &line;
    for (const Word& word : line.words) add_word(word);
    for (const Span comment : line.comments) tokens_.push_back({comment, Type::Comment});
    if (!line.comments.empty())
      std::sort(tokens_.begin(), tokens_.end(), [](const Token& a, const Token& b) { return a.span < b.span; });
    return tokens_;
  }

 private:
  void add_word(const Word& word) {
    switch (word.letter) {
      case 'G':
        return add(word.span(), is_motion(word) ? Type::Motion : Type::Code);
      case 'M':
        return add(word.span(), Type::Function);
      case 'T':
        return add(word.span(), Type::Tool);
      case 'N':
        return add(word.span(), Type::Label, is_target(word) ? 0 : kDefinition);
      case 'V':
        return add(word.span(), Type::Register, is_assigned(word) ? kDefinition : 0);
      case 'F':
      case 'S':
        return add_split(word, Type::Technology);
      case syntax::kVgpl:
        return add(word.span(), Type::Register, kReadonly);
      case syntax::kIf:
      case syntax::kGoto:
        return add(word.span(), Type::Keyword);
      case syntax::kOperator:
        return add(word.span(), Type::Operator);
      case syntax::kAssign:
        return add_split(word, Type::Operator);
      case syntax::kNumber:
        return add(word.span(), Type::Number);
      case syntax::kError:
        return;
      default:
        return add_split(word, Type::Axis);
    }
  }

  static bool is_motion(const Word& word) { return word.is_plain_integer() && dialect::is_motion_number(word.value); }
  bool is_target(const Word& word) const { return line_->jump && line_->jump->target_span == word.span(); }
  bool is_assigned(const Word& word) const { return !line_->jump || line_->jump->variable_span != word.span(); }

  /// Adds a letter or sign, and its number.
  void add_split(const Word& word, Type type) {
    tokens_.push_back({{word.begin, word.begin + 1}, type});
    add({word.begin + 1, word.end}, Type::Number);
  }

  /// Adds a token. Tokens must not overlap, so a comment within a word divides it.
  void add(Span span, Type type, unsigned modifiers = 0) {
    if (line_->comments.empty()) {
      while (!span.empty() && text::is_blank(line_->text[span.begin])) ++span.begin;
      if (!span.empty()) tokens_.push_back({span, type, modifiers});
      return;
    }
    for (const Span piece : queries::outside_comments(*line_, span)) tokens_.push_back({piece, type, modifiers});
  }

  const LineTree* line_ = nullptr;
  std::vector<Token> tokens_;
};

/// Writes tokens in the form of the protocol: five numbers each, with the position relative to the token before.
class Encoder {
 public:
  /// Positions are relative to the start of `previous_line`.
  explicit Encoder(const Snapshot& snapshot, std::size_t previous_line = 0)
      : snapshot_(snapshot), previous_line_(previous_line) {}

  /// Adds the tokens of a line, at most `maximum`.
  void add(std::size_t index, const LineTree& line, std::size_t maximum = static_cast<std::size_t>(-1)) {
    const std::vector<Token>& tokens = tokens_.of(line);
    std::uint32_t unit = index == 0 ? snapshot_.to_client({0, 0}).character : 0;
    std::uint32_t byte = 0;
    std::uint32_t previous_unit = 0;
    for (std::size_t i = 0; i < std::min(maximum, tokens.size()); ++i) {
      const Token& token = tokens[i];
      unit += units(line, byte, token.span.begin);
      const std::uint32_t length = units(line, token.span.begin, token.span.end);
      put(static_cast<std::uint32_t>(index - previous_line_));
      put(unit - previous_unit);
      put(length);
      put(static_cast<std::uint32_t>(token.type));
      put(token.modifiers);
      previous_line_ = index;
      previous_unit = unit;
      unit += length;
      byte = token.span.end;
      ++count_;
    }
  }

  void add_chunk(std::size_t chunk) {
    const std::size_t first = snapshot_.document().first_line_of_chunk(chunk);
    trees_.read(snapshot_.document(), chunk);
    for (std::size_t i = 0; i < trees_.size(); ++i) add(first + i, trees_[i]);
  }

  std::size_t count() const { return count_; }
  /// The numbers as a JSON array.
  std::string data() const { return fmt::format("[{}]", numbers_); }

 private:
  std::uint32_t units(const LineTree& line, std::uint32_t begin, std::uint32_t end) const {
    return protocol::units_before(line.text.substr(begin, end - begin), end - begin, snapshot_.client().encoding);
  }

  void put(std::uint32_t number) {
    if (!numbers_.empty()) numbers_ += ',';
    std::array<char, 10> digits;
    const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    numbers_.append(digits.data(), written.ptr);
  }

  const Snapshot& snapshot_;
  LineTokens tokens_;
  syntax::ChunkTrees trees_;
  std::size_t previous_line_;
  std::size_t count_ = 0;
  std::string numbers_;
};

/// The tokens last sent to the client, from which changes are computed.
struct SentTokens {
  struct TokenChunk {
    std::uint64_t version = 0;
    std::size_t tokens = 0;
  };

  std::string id;
  std::vector<TokenChunk> chunks;
  std::uint64_t times = 0;

  /// Sets a new id each time, even if a client never changes the version.
  void rename(std::int64_t version) { id = fmt::format("{}.{}", version, ++times); }
};

std::size_t sum_of_tokens(const std::vector<SentTokens::TokenChunk>& chunks, std::size_t first, std::size_t after) {
  std::size_t sum = 0;
  for (std::size_t i = first; i < after; ++i) sum += chunks[i].tokens;
  return sum;
}

protocol::RawJson all_tokens(const Snapshot& snapshot) {
  Encoder encoder(snapshot);
  std::vector<SentTokens::TokenChunk> chunks;
  for (std::size_t chunk = 0; chunk < snapshot.document().chunk_count(); ++chunk) {
    snapshot.throw_if_unwanted();
    const std::size_t before = encoder.count();
    encoder.add_chunk(chunk);
    chunks.push_back({snapshot.document().chunk_version(chunk), encoder.count() - before});
  }
  auto& sent = snapshot.memory<SentTokens>();
  sent.rename(snapshot.version());
  sent.chunks = std::move(chunks);
  return {fmt::format(R"({{"resultId":"{}","data":{}}})", sent.id, encoder.data())};
}

protocol::RawJson full(const Snapshot& snapshot, const protocol::DocumentParams&) { return all_tokens(snapshot); }

protocol::RawJson range(const Snapshot& snapshot, const protocol::RangeParams& params) {
  const std::size_t first = snapshot.from_client(params.range.start).line;
  const std::size_t last = snapshot.from_client(params.range.end).line;
  Encoder encoder(snapshot);
  for (std::size_t line = first; line <= last; ++line) {
    if (line % 1024 == 0) snapshot.throw_if_unwanted();
    const syntax::DocumentLine read = snapshot.document().line(line);
    encoder.add(line, *read);
  }
  return {fmt::format(R"({{"data":{}}})", encoder.data())};
}

// --- Changes since the last answer

struct DeltaParams : protocol::DocumentParams {
  std::string previous_result_id;
};

void from_json(const Json& json, DeltaParams& params) {
  from_json(json, static_cast<protocol::DocumentParams&>(params));
  params.previous_result_id = json.at("previousResultId");
}

/// The last line with tokens above a chunk: the position of the chunk's first token is relative to it.
std::size_t last_line_with_tokens_above(const Snapshot& snapshot, std::size_t chunk) {
  LineTokens tokens;
  for (std::size_t line = snapshot.document().first_line_of_chunk(chunk); line-- > 0;) {
    const syntax::DocumentLine read = snapshot.document().line(line);
    if (!tokens.of(*read).empty()) return line;
  }
  return 0;
}

/// Adds the first token of the chunks from `chunk` on: the token before it has changed, and with it the relative
/// position. Returns false if they have no token.
bool add_first_token(const Snapshot& snapshot, std::size_t chunk, Encoder& encoder) {
  const std::size_t before = encoder.count();
  for (; chunk < snapshot.document().chunk_count(); ++chunk) {
    const std::size_t first = snapshot.document().first_line_of_chunk(chunk);
    for (std::size_t line = first; line < first + snapshot.document().chunk_lines(chunk); ++line) {
      const syntax::DocumentLine read = snapshot.document().line(line);
      encoder.add(line, *read, 1);
      if (encoder.count() > before) return true;
    }
  }
  return false;
}

/// One edit that replaces the tokens of all chunks from the first to the last that has changed.
std::string edits_since(const Snapshot& snapshot, SentTokens& sent) {
  const syntax::Document& document = snapshot.document();
  const std::vector<SentTokens::TokenChunk>& old = sent.chunks;
  const std::size_t count = document.chunk_count();
  const std::size_t common = std::min(count, old.size());
  std::size_t head = 0;
  while (head < common && old[head].version == document.chunk_version(head)) ++head;
  if (head == count && head == old.size()) return "[]";
  std::size_t tail = 0;
  while (tail < common - head && old[old.size() - 1 - tail].version == document.chunk_version(count - 1 - tail)) ++tail;

  std::vector<SentTokens::TokenChunk> chunks(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(head));
  Encoder encoder(snapshot, head < count ? last_line_with_tokens_above(snapshot, head) : 0);
  for (std::size_t chunk = head; chunk < count - tail; ++chunk) {
    snapshot.throw_if_unwanted();
    const std::size_t before = encoder.count();
    encoder.add_chunk(chunk);
    chunks.push_back({document.chunk_version(chunk), encoder.count() - before});
  }
  chunks.insert(chunks.end(), old.end() - static_cast<std::ptrdiff_t>(tail), old.end());
  std::size_t deleted = sum_of_tokens(old, head, old.size() - tail);
  if (add_first_token(snapshot, count - tail, encoder)) ++deleted;
  const std::size_t start = sum_of_tokens(old, 0, head);
  sent.chunks = std::move(chunks);
  return fmt::format(R"([{{"start":{},"deleteCount":{},"data":{}}}])", 5 * start, 5 * deleted, encoder.data());
}

protocol::RawJson delta(const Snapshot& snapshot, const DeltaParams& params) {
  auto& sent = snapshot.memory<SentTokens>();
  if (sent.id.empty() || sent.id != params.previous_result_id) return all_tokens(snapshot);
  const std::string edits = edits_since(snapshot, sent);
  sent.rename(snapshot.version());
  return {fmt::format(R"({{"resultId":"{}","edits":{}}})", sent.id, edits)};
}

Json semantic_tokens_capabilities(const Client&) {
  return {{"semanticTokensProvider",
           {{"legend", {{"tokenTypes", kTypes}, {"tokenModifiers", kModifiers}}},
            {"range", true},
            {"full", {{"delta", true}}}}}};
}

}  // namespace

extern const Feature semantic_tokens = {
    .capabilities = semantic_tokens_capabilities,
    .methods = {on<&full>("textDocument/semanticTokens/full"), on<&delta>("textDocument/semanticTokens/full/delta"),
                on<&range>("textDocument/semanticTokens/range")}};

}  // namespace isocnc::features
