#include "debugger/session/console.h"

#include <filesystem>
#include <utility>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::session {

using dialect::Text;
using syntax::InstructionKind;

/// Maximum length of the blocks that wait, in bytes.
static constexpr std::size_t kMaxLength = 65536;

static constexpr Text kWaits{"waits for G909", "in attesa di G909"};
static constexpr Text kComparing{"comparing with {}", "confronto con {}"};
static constexpr Text kTooLong{"this is too long to be run by hand", "troppo lungo per essere eseguito a mano"};

/// Throws RequestError where the text is not an expression.
static expressions::Expression::Formatted compile_or_throw(const Session& session, std::string_view text,
                                                           const expressions::ValueFormat& format) {
  auto compiled = expressions::compile_formatted(text, format, session.language());
  if (const auto* const problem = std::get_if<expressions::ExpressionProblem>(&compiled))
    throw dap::RequestError(problem->message);
  return std::get<expressions::Expression::Formatted>(std::move(compiled));
}

std::string evaluate(const Session& session, std::string_view text, const expressions::ValueFormat& format) {
  const expressions::Expression::Formatted formatted = compile_or_throw(session, text, format);
  return expressions::show_value(formatted.expression.at(session.moment()), formatted.format);
}

double number_of(const Session& session, std::string_view text) {
  return compile_or_throw(session, text, {}).expression.at(session.moment());
}

namespace {

/// What the lines of a text hold, read as blocks.
struct Blocks {
  bool are_any = false;       ///< At least one line does something.
  bool are_sound = true;      ///< No line has a mistake of its own.
  bool look_like_it = false;  ///< The text begins with a word, a letter and its number.
  bool need_g909 = false;
  bool have_g909 = false;
};

bool needs_g909(const syntax::Instruction& instruction) {
  return instruction.kind != InstructionKind::Function && instruction.kind != InstructionKind::ToolChange &&
         !instruction.is_motion();
}

void add_line(std::string_view line, Blocks& blocks) {
  const syntax::ParsedLine parsed(line);
  const syntax::LineTree tree = parsed.tree();
  blocks.are_any |= !tree.is_empty();
  blocks.are_sound &= tree.findings.empty();
  blocks.look_like_it |= !tree.words.empty() && tree.words.front().letter >= 'A' && tree.words.front().letter <= 'Z' &&
                         tree.words.front().digits > 0;
  blocks.need_g909 |= tree.spindle >= 0;
  for (const syntax::Instruction& each : tree.instructions) {
    const bool is_g909 = each.is(dialect::GRole::ApplyMdi);
    blocks.have_g909 |= is_g909;
    blocks.need_g909 |= !is_g909 && needs_g909(each);
  }
}

Blocks read_blocks(std::string_view text) {
  Blocks blocks;
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p != end;) {
    const char* const line_end = text::find_line_end(p, end);
    add_line({p, static_cast<std::size_t>(line_end - p)}, blocks);
    p = text::skip_line_end(line_end, end);
  }
  return blocks;
}

bool is_expression(const Session& session, std::string_view text) {
  return std::holds_alternative<expressions::Expression::Formatted>(
      expressions::compile_formatted(text, {}, session.language()));
}

}  // namespace

/// The file that the console's one command, `difference FILE`, names; empty for any other text.
static std::string_view file_of_command(std::string_view text) {
  constexpr std::string_view kCommand = "difference";
  if (!text.starts_with(kCommand)) return {};
  const std::string_view rest = text::trimmed(text.substr(kCommand.size()));
  return rest.empty() || !text::is_blank(text[kCommand.size()]) ? std::string_view() : rest;
}

std::string enter(Session& session, std::string_view text) {
  if (const std::string_view file = file_of_command(text); !file.empty()) {
    session.run_to_difference(std::filesystem::path(file));
    return session.in_language(kComparing, file);
  }
  if (text.starts_with('=')) return evaluate(session, text.substr(1), session.launch_options().format);
  const Blocks blocks = read_blocks(text);
  const bool is_block = blocks.are_any && (blocks.are_sound || (blocks.look_like_it && !is_expression(session, text)));
  if (!is_block) return evaluate(session, text, session.launch_options().format);
  session.stopped_debuggee();
  std::string all = std::exchange(session.waiting_blocks(), {}) + std::string(text) + "\n";
  if (all.size() > kMaxLength) throw dap::RequestError(std::string(session.in_language(kTooLong)));
  const bool are_first = all.size() == text.size() + 1;
  if (blocks.have_g909 || (are_first && !blocks.need_g909)) return session.run_by_hand(all);
  session.waiting_blocks() = std::move(all);
  return std::string(session.in_language(kWaits));
}

}  // namespace isocnc::session
