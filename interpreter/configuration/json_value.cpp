#include "interpreter/configuration/json_value.h"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "interpreter/text/counted_bytes.h"
#include "interpreter/text/unicode.h"

namespace isocnc::configuration {

using dialect::Text;

/// The offset after the comment that starts at `at`; `at` itself if there is none.
static std::size_t skip_comment(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  if (rest.starts_with("//")) return std::min(text.find_first_of("\r\n", at), text.size());
  const std::size_t end = rest.starts_with("/*") ? rest.find("*/", 2) : std::string_view::npos;
  return end == std::string_view::npos ? at : at + end + 2;
}

/// The start of the next token, after blanks, comments, colons and commas.
static std::size_t skip_separators(std::string_view text, std::size_t at) {
  static constexpr std::string_view kSeparators = " \t\r\n,:";
  while (at < text.size()) {
    const std::size_t after = skip_comment(text, at);
    if (after == at && kSeparators.find(text[at]) == std::string_view::npos) break;
    at = std::max(after, at + 1);
  }
  return at;
}

/// The token at a position, for messages.
static std::string_view token_at(std::size_t at, std::string_view text) {
  const std::string_view rest = text.substr(at);
  if (rest.empty() || std::string_view("{}[],:").find(rest.front()) != std::string_view::npos) return rest.substr(0, 1);
  const std::size_t end = rest.front() == '"' ? rest.find('"', 1) : rest.find_first_of(" \t\r\n{}[],:\"", 1) - 1;
  return rest.substr(0, std::min(end, rest.size() - 1) + 1);
}

/// A message of the parser and its replacement.
struct Reason {
  std::string_view parser_message;
  const Text& our_message;
};
static constexpr Reason kReasons[] = {
    {"unexpected end of input", mistakes::kEndsEarly}, {"expected end of input", mistakes::kTextAfterEnd},
    {"missing closing quote", mistakes::kStringOpen},  {"control character U+0009", mistakes::kStringTab},
    {"control character", mistakes::kStringOpen},      {"invalid string", mistakes::kStringEscape},
    {"missing closing '*/'", mistakes::kCommentOpen},  {"invalid comment", mistakes::kBadComment},
    {"invalid number", mistakes::kBadNumber},          {"number overflow", mistakes::kHugeNumber},
};

static const Text* reason_of(std::string_view parser_message) {
  for (const Reason& reason : kReasons)
    if (parser_message.find(reason.parser_message) != std::string_view::npos) return &reason.our_message;
  return nullptr;
}

/// Builds values from the tokens of the parser. The SAX interface reports no offsets, so the builder searches each
/// token after the end of the previous one.
class JsonBuilder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonBuilder(std::string_view text, const char* const& furthest) : text_(text), furthest_(furthest) {}

  JsonValue take() { return std::move(root_); }
  Mistake mistake() const { return *mistake_; }

  bool null() override { return leaf({.kind = JsonValue::Kind::Null}); }
  bool boolean(bool value) override { return leaf({.kind = JsonValue::Kind::Boolean, .boolean = value}); }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override { return leaf({.kind = JsonValue::Kind::String, .string = std::move(value)}); }
  bool binary(binary_t&) override { return false; }  // JSON has no binary values.

  bool key(string_t& value) override {
    const std::size_t at = token_start();
    JsonMember member;
    member.key = std::move(value);
    member.at = at;
    open_.back()->members.push_back(std::move(member));
    return true;
  }

  bool start_object(std::size_t) override { return open({.kind = JsonValue::Kind::Object}); }
  bool start_array(std::size_t) override { return open({.kind = JsonValue::Kind::List}); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
    const std::size_t at = std::min(skip_separators(text_, end_), std::max<std::size_t>(furthest(), 1) - 1);
    const Text* const reason = reason_of(error.what());
    if (reason == &mistakes::kEndsEarly) return fail(text_.size(), *reason);
    if (reason != nullptr) return fail(at, *reason);
    const std::string_view token = token_at(at, text_);
    const bool closes = token == "}" || token == "]";
    return fail(at, closes && follows_comma(at) ? mistakes::kExtraComma : mistakes::kOutOfPlace, token);
  }

 private:
  std::size_t furthest() const { return static_cast<std::size_t>(furthest_ - text_.data()); }

  /// The start of the token just read. After a number the parser has read one byte more.
  std::size_t token_start() {
    const std::size_t at = skip_separators(text_, end_);
    const bool is_number = text_[at] == '-' || (text_[at] >= '0' && text_[at] <= '9');
    end_ = is_number ? number_end(at) : furthest();
    return at;
  }

  /// In JSON no digits may follow a leading zero.
  std::size_t number_end(std::size_t at) const {
    const std::size_t digits = at + (text_[at] == '-' ? 1 : 0);
    const bool leads_zero = text_.substr(digits, 1) == "0" && digits + 1 < text_.size() &&
                            text_.find_first_of("0123456789", digits + 1) == digits + 1;
    return leads_zero ? digits + 1 : std::min(text_.find_first_not_of("+-.0123456789eE", at), text_.size());
  }

  /// Whether a comma outside comments lies between the last token and `at`.
  bool follows_comma(std::size_t at) const {
    for (std::size_t i = end_; i < at; i = std::max(i + 1, skip_comment(text_, i)))
      if (text_[i] == ',') return true;
    return false;
  }

  JsonValue& add(JsonValue value) {
    if (open_.empty()) return root_ = std::move(value);
    JsonValue& parent = *open_.back();
    if (parent.kind == JsonValue::Kind::List) return parent.elements.emplace_back(std::move(value));
    return parent.members.back().value = std::move(value);
  }

  bool leaf(JsonValue value) {
    value.at = token_start();
    value.end = end_;
    add(std::move(value));
    return true;
  }

  bool number(double value) { return leaf({.kind = JsonValue::Kind::Number, .number = value}); }

  bool open(JsonValue value) {
    value.at = token_start();
    if (open_.size() == kDeepestJson) return fail(value.at, mistakes::kTooDeep);
    open_.push_back(&add(std::move(value)));
    return true;
  }

  bool close() {
    token_start();
    open_.back()->end = end_;
    open_.pop_back();
    return true;
  }

  bool fail(std::size_t at, const Text& text, std::string_view token = {}) {
    mistake_ = Mistake{.at = at, .key = {}, .text = text, .names = {}, .meant = {}};
    if (!token.empty()) mistake_->names.emplace_back(shortened(token));
    return false;
  }

  const std::string_view text_;
  const char* const& furthest_;
  std::size_t end_ = 0;  // End of the last token.
  JsonValue root_;
  std::vector<JsonValue*> open_;  // Open lists and objects, the innermost last.
  std::optional<Mistake> mistake_;
};

/// The first invalid byte that the parser would miss: it takes a NUL for the end and does not check comments.
static std::optional<Mistake> foreign_byte(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = text::sequence_length(text.substr(at));
    const auto byte = static_cast<unsigned char>(text[at]);
    const bool is_control = byte < 0x20 && byte != '\t' && byte != '\r' && byte != '\n';
    if (length == 0 || is_control)
      return Mistake{
          .at = at, .key = {}, .text = is_control ? mistakes::kControl : mistakes::kNoUtf8, .names = {}, .meant = {}};
    at += length;
  }
  return std::nullopt;
}

std::variant<JsonValue, Mistake> parse_json(std::string_view text) {
  if (const std::optional<Mistake> mistake = foreign_byte(text)) return *mistake;
  const char* furthest = text.data();
  const char* const end = text.data() + text.size();
  JsonBuilder builder(text, furthest);
  using text::CountedBytes;
  if (nlohmann::json::sax_parse(CountedBytes(text.data(), furthest), CountedBytes(end, furthest), &builder,
                                nlohmann::json::input_format_t::json, true, true))
    return builder.take();
  return builder.mistake();
}

}  // namespace isocnc::configuration
