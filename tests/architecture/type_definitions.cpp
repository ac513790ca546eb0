#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <string_view>
#include <utility>

#include "source_files.h"

namespace isocnc::architecture {
namespace {

/// Where a comment, a directive or a quoted text that starts at `begin` ends; `begin` if none does.
std::size_t end_of_prose(const std::string& text, std::size_t begin) {
  const auto after = [&](const std::string& end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    return found == std::string::npos ? text.size() : found + end.size();
  };
  const std::string_view rest = std::string_view(text).substr(begin);
  if (rest.starts_with("//") || rest.starts_with("#")) return after("\n", begin);
  if (rest.starts_with("/*")) return after("*/", begin);
  if (rest.starts_with("R\"")) {
    const std::size_t open = text.find('(', begin);
    return after(")" + text.substr(begin + 2, open - begin - 2) + "\"", open);
  }
  const bool separates_digits = begin > 0 && std::isxdigit(static_cast<unsigned char>(text[begin - 1])) != 0;
  if (rest[0] != '"' && (rest[0] != '\'' || separates_digits)) return begin;
  std::size_t end = begin + 1;
  while (end < text.size() && text[end] != rest[0]) end += text[end] == '\\' ? 2 : 1;
  return end + 1;
}

/// The text without comments, directives and what stands between quotes, where a brace or a semicolon means nothing.
std::string code_in(const std::string& text) {
  std::string code;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = end_of_prose(text, at);
    code += end > at ? ' ' : text[at];
    at = std::max(end, at + 1);
  }
  return code;
}

/// Words and signs; `::` is a sign of its own.
std::vector<std::string> tokens_of(const std::string& code) {
  static const std::regex kToken(R"(\w+|::|\[\[|\]\]|[^\s\w])");
  std::vector<std::string> tokens;
  for (std::sregex_iterator it(code.begin(), code.end(), kToken); it != std::sregex_iterator(); ++it)
    tokens.push_back(it->str());
  return tokens;
}

bool is_name(const std::string& token) { return std::isalpha(static_cast<unsigned char>(token[0])) || token[0] == '_'; }

/// Reads the start of a declaration: the tokens up to its `{` or `;`.
class Declaration {
 public:
  explicit Declaration(std::vector<std::string> tokens) : tokens_(std::move(tokens)) {
    while (at(0) == "public" || at(0) == "private" || at(0) == "protected") next_ += 2;
    while (take("template")) pass_brackets("<", ">");
    take("inline");
  }

  bool is_namespace() const { return at(0) == "namespace"; }
  /// The name of the class or enumeration that the declaration defines; none for other declarations, an empty one for
  /// those without a name and for specializations.
  std::optional<std::string> class_name() {
    const bool is_enum = take("enum");
    if (!(take("struct") || take("class") || take("union")) && !is_enum) return std::nullopt;
    if (at(0) == "[[") pass_brackets("[[", "]]");
    if (take("alignas")) pass_brackets("(", ")");
    std::string name;
    for (; is_name(at(0)) && at(0) != "final"; next_ += at(1) == "::" ? 2 : 1) name = at(0);
    if (at(0) == "(" || at(0) == "*" || at(0) == "&") return std::nullopt;  // A function that returns one.
    return at(0) == "<" ? "" : name;
  }
  std::optional<TypeDefinition> alias() {
    if (at(0) != "using" || at(2) != "=") return std::nullopt;
    TypeDefinition alias{at(1), ""};
    for (next_ += 3; next_ < tokens_.size(); ++next_) alias.alias += at(0);
    return alias;
  }

 private:
  const std::string& at(std::size_t ahead) const {
    static const std::string kEnd = ";";
    return next_ + ahead < tokens_.size() ? tokens_[next_ + ahead] : kEnd;
  }
  bool take(const std::string& token) {
    if (at(0) != token) return false;
    ++next_;
    return true;
  }
  void pass_brackets(const std::string& open, const std::string& close) {
    int depth = 0;
    do {
      depth += at(0) == open ? 1 : at(0) == close ? -1 : 0;
      ++next_;
    } while (depth > 0 && next_ < tokens_.size());
  }

  std::vector<std::string> tokens_;
  std::size_t next_ = 0;
};

/// Follows the braces of a file, so that types within functions are not counted.
class TypeReader {
 public:
  void read(const std::string& token) {
    if (token == "{") {
      open();
    } else if (token == "}") {
      if (!holds_types_.empty()) holds_types_.pop_back();
    } else if (token == ";") {
      if (const std::optional<TypeDefinition> alias = Declaration(start_).alias()) add(*alias);
    } else {
      start_.push_back(token);
      return;
    }
    start_.clear();
  }
  const std::vector<TypeDefinition>& types() const { return types_; }

 private:
  void open() {
    Declaration declaration(start_);
    const std::optional<std::string> name = declaration.class_name();
    if (name && !name->empty()) add({*name, ""});
    holds_types_.push_back(name || declaration.is_namespace());
  }
  void add(TypeDefinition type) {
    for (const bool holds_types : holds_types_)
      if (!holds_types) return;
    types_.push_back(std::move(type));
  }

  std::vector<std::string> start_;
  std::vector<bool> holds_types_;
  std::vector<TypeDefinition> types_;
};

}  // namespace

std::vector<TypeDefinition> types_defined_in(const std::string& file) {
  TypeReader reader;
  for (const std::string& token : tokens_of(code_in(read(file)))) reader.read(token);
  return reader.types();
}

}  // namespace isocnc::architecture
