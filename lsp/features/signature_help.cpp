#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/dialect/codes.h"
#include "interpreter/dialect/letters.h"
#include "lsp/features/feature.h"

/// Signature help: the arguments of the instruction under the cursor, and the one that is being written.
namespace isocnc::features {

using dialect::Language;
using dialect::Text;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineTree;
using syntax::Word;

namespace {

struct Parameter {
  std::string label;  // A substring of the signature's label, after the command.
  std::string documentation;
};

struct Signature {
  std::string label;
  std::string documentation;
  std::vector<Parameter> parameters;
  std::size_t active = 0;  // The index of the active parameter; the number of parameters for none.
};

void to_json(Json& json, const Parameter& parameter) {
  json = {{"label", parameter.label}, {"documentation", parameter.documentation}};
}

void to_json(Json& json, const Signature& signature) {
  const Json one = {{"label", signature.label},
                    {"documentation", signature.documentation},
                    {"parameters", signature.parameters},
                    {"activeParameter", signature.active}};
  json = {{"signatures", Json::array({one})}, {"activeSignature", 0}, {"activeParameter", signature.active}};
}

Parameter parameter_of(char letter, Language language) {
  return {std::string(1, letter), std::string(dialect::meaning_of(letter).in(language))};
}

/// A signature of a command and each letter that may follow it.
Signature with_letters(std::string command, std::string documentation, dialect::LetterSet letters, Language language) {
  Signature signature{std::move(command), std::move(documentation), {}};
  for (const char letter : dialect::kArgumentOrder) {
    if (!dialect::contains(letters, letter)) continue;
    signature.label += fmt::format(" {}", letter);
    signature.parameters.push_back(parameter_of(letter, language));
  }
  return signature;
}

/// The argument of this instruction at the cursor or just before it.
const Word* argument_at(const LineTree& line, const Instruction& instruction, std::size_t column) {
  for (std::size_t i = instruction.begin; i < instruction.end; ++i) {
    const Word& word = line.words[i];
    const bool is_command = i == instruction.command && instruction.kind != InstructionKind::Continuation;
    if (word.owner == instruction.number && !is_command && word.begin < column && column <= word.end) return &word;
  }
  return nullptr;
}

/// The index of the parameter that is being written, or else of the first missing one.
std::size_t active_letter(const Signature& signature, const LineTree& line, const Instruction& instruction,
                          std::size_t column) {
  const Word* const at = argument_at(line, instruction, column);
  dialect::LetterSet given = 0;
  for (std::size_t i = instruction.begin; i < instruction.end; ++i) {
    const Word& word = line.words[i];
    const bool counts = word.owner == instruction.number && word.letter >= 'A' && word.letter <= 'Z';
    if (counts) given |= dialect::letter_bit(word.letter);
  }
  const auto is_active = [&](const Parameter& parameter) {
    const char letter = parameter.label.front();
    return at ? at->letter == letter : !dialect::contains(given, letter);
  };
  const auto active = std::find_if(signature.parameters.begin(), signature.parameters.end(), is_active);
  return static_cast<std::size_t>(active - signature.parameters.begin());
}

std::optional<Signature> of_g(const dialect::GCode* code, const LineTree& line, const Instruction& instruction,
                              std::size_t column, Language language) {
  if (!code || !code->takes_arguments()) return std::nullopt;
  Signature signature = with_letters(fmt::format("G{:02}", code->number), std::string(code->name.in(language)),
                                     code->arguments, language);
  signature.active = active_letter(signature, line, instruction, column);
  return signature;
}

std::optional<Signature> of_continuation(const Snapshot& snapshot, std::size_t number, const LineTree& line,
                                         const Instruction& instruction, std::size_t column) {
  const auto state = snapshot.state_before(number);
  return of_g(state ? state->motion() : nullptr, line, instruction, column, snapshot.language());
}

Signature of_tool_change(Language language) {
  return {"M06 T", std::string(Text{"tool change", "cambio utensile"}.in(language)), {parameter_of('T', language)}};
}

/// The signature of a user M function, under its configured name if it has one: P1 to P20.
std::optional<Signature> of_function(const Snapshot& snapshot, const LineTree& line, const Instruction& instruction,
                                     std::size_t column) {
  static constexpr Text kUser = {"function of the machine's user", "funzione dell'utente"};
  static constexpr Text kParameter = {"a number, handed to the function", "un numero, passato alla funzione"};
  const std::optional<int> number = line.command(instruction).whole();
  if (!number || !dialect::is_user_function(*number)) return std::nullopt;
  const Language language = snapshot.language();
  Signature signature{fmt::format("M{}", *number), std::string(kUser.in(language)), {}};
  const auto* const function = snapshot.configuration().machine.find_function(*number);
  if (function && !function->name.empty()) signature.documentation = function->name;
  std::size_t last = 0;
  for (std::size_t i = instruction.begin; i < instruction.end; ++i) {
    const Word& word = line.words[i];
    if (word.owner != instruction.number || word.letter != 'P' || word.begin >= column) continue;
    if (const int parameter = word.parameter_number(); parameter != 0) last = static_cast<std::size_t>(parameter);
  }
  for (int i = 1; i <= dialect::kMaxFunctionParameters; ++i) {
    signature.label += fmt::format(" P{}=", i);
    signature.parameters.push_back({fmt::format("P{}=", i), std::string(kParameter.in(language))});
  }
  signature.active = last == 0 ? 0 : last - 1;
  return signature;
}

/// The signature `IF left comparison value GOTO label`; the active parameter is the part at the cursor.
Signature of_jump(const LineTree& line, std::size_t column, Language language) {
  static constexpr Text kJump = {"jump forward to the label where the condition holds",
                                 "salta in avanti all'etichetta se la condizione è vera"};
  static constexpr Text kParts[] = {
      {"VGPL, or a register V1 to V30", "VGPL, oppure un registro da V1 a V30"},
      {"one of = < > <= >= <>", "uno tra = < > <= >= <>"},
      {"a number", "un numero"},
      {"the line number to go on from, below this line", "il numero della riga da cui proseguire, più in basso"}};
  Signature signature{"IF VGPL >= 1 GOTO N30", std::string(kJump.in(language)), {}};
  static constexpr std::string_view kLabels[] = {"VGPL", ">=", "1", "N30"};
  for (std::size_t i = 0; i < std::size(kLabels); ++i)
    signature.parameters.push_back({std::string(kLabels[i]), std::string(kParts[i].in(language))});
  for (const Word& word : line.words) {
    if (word.end >= column) break;
    if (word.letter == syntax::kVgpl || word.letter == 'V') signature.active = 1;
    if (word.letter == syntax::kOperator || word.letter == syntax::kAssign) signature.active = 2;
    if (word.letter == syntax::kGoto) signature.active = 3;
  }
  return signature;
}

Signature of_assignment(const LineTree& line, std::size_t column, Language language) {
  static constexpr Text kAssignment = {"gives a register its value", "assegna un valore al registro"};
  static constexpr Text kRegister = {"the register, 1 to 30", "il registro, da 1 a 30"};
  static constexpr Text kValue = {"its value, a number", "il suo valore, un numero"};
  const auto is_sign_before = [&](const Word& word) { return word.letter == syntax::kAssign && word.begin < column; };
  const bool has_sign = std::any_of(line.words.begin(), line.words.end(), is_sign_before);
  return {"V1 = 0",
          std::string(kAssignment.in(language)),
          {{"V1", std::string(kRegister.in(language))}, {"0", std::string(kValue.in(language))}},
          has_sign ? std::size_t{1} : std::size_t{0}};
}

std::optional<Signature> answer_signature_help(const Snapshot& snapshot, const protocol::PositionParams& params) {
  const syntax::Position place = snapshot.from_client(params.position);
  const syntax::DocumentLine read = snapshot.document().line(place.line);
  const syntax::LineTree& line = *read;
  const auto holds = [&](syntax::Span comment) {
    return comment.begin < place.column && (place.column < comment.end || line.text[comment.begin] == ';');
  };
  if (std::any_of(line.comments.begin(), line.comments.end(), holds)) return std::nullopt;
  const Instruction* at = nullptr;
  for (const Instruction& instruction : line.instructions)
    if (line.words[instruction.begin].begin < place.column &&
        (!at || line.words[at->begin].begin < line.words[instruction.begin].begin))
      at = &instruction;
  if (!at) return std::nullopt;
  const Language language = snapshot.language();
  switch (at->kind) {
    case InstructionKind::G:
      return of_g(at->g(), line, *at, place.column, language);
    case InstructionKind::Continuation:
      return of_continuation(snapshot, place.line, line, *at, place.column);
    case InstructionKind::ToolChange:
      return of_tool_change(language);
    case InstructionKind::Function:
      return of_function(snapshot, line, *at, place.column);
    case InstructionKind::Jump:
      return of_jump(line, place.column, language);
    case InstructionKind::Assignment:
      return of_assignment(line, place.column, language);
    case InstructionKind::StrayTool:
      break;
  }
  return std::nullopt;
}

Json signature_help_capabilities(const Client&) {
  return {{"signatureHelpProvider", {{"triggerCharacters", {" ", "="}}}}};
}

}  // namespace

extern const Feature signature_help = {.capabilities = signature_help_capabilities,
                                       .methods = {on<&answer_signature_help>("textDocument/signatureHelp")}};

}  // namespace isocnc::features
