#include "interpreter/diff_operand.h"

#include "interpreter/configuration/configuration.h"
#include "interpreter/dialect/format.h"
#include "interpreter/git/revision.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/paths.h"

namespace isocnc::interpreter {

using dialect::Language;
using dialect::Text;
using system::SourceFile;

static constexpr Text kIsConflict{"both sides of the merge: isodiff ':2:{0}' ':3:{0}'",
                                  "le due parti della fusione: isodiff ':2:{0}' ':3:{0}'"};
static constexpr Text kIsNoFile{"is not a regular file", "non è un file regolare"};
static constexpr Text kIsNoProgram{"is no program, by its name", "non è un programma, dal suo nome"};

/// What does nothing.
static constexpr std::string_view kIdleProgram = "M02\n";

std::variant<DiffOperand, std::string> diff_operand(const std::string& word, Language language) {
  if (word == "-" || word == "/dev/stdin") return DiffOperand{.name = "<stdin>", .place = {}, .file = {}, .bytes = {}};
  const std::optional<git::RevisionFile> revision = git::revision_file(word);
  if (!revision) return DiffOperand{.name = system::generic_name(word), .place = word, .file = word, .bytes = {}};
  auto read = git::read(*revision, language);
  if (auto* const problem = std::get_if<std::string>(&read)) return std::move(*problem);
  auto& file = std::get<git::FileAtRevision>(read);
  return DiffOperand{
      .name = system::generic_name(word), .place = std::move(file.place), .file = {}, .bytes = std::move(file.bytes)};
}

static DiffOperand diff_operand(const git::DiffedVersion& version) {
  DiffOperand operand{.name = version.path, .place = version.path, .file = {}, .bytes = {}};
  if (version.is_there()) {
    operand.file = version.file;
  } else {
    operand.bytes = kIdleProgram;
  }
  return operand;
}

std::variant<DiffOperands, std::string> diff_operands(const git::ExternalDiff& diff,
                                                      std::span<const std::string> extensions, Language language) {
  const git::DiffedVersion& named = diff.new_version;
  if (git::is_for_all_files() && !configuration::is_program_name(named.path, extensions))
    return std::string(kIsNoProgram.in(language));
  if (diff.is_unmerged) return dialect::format(kIsConflict, language, named.path);
  if (!diff.old_version.is_file() || !diff.new_version.is_file()) return std::string(kIsNoFile.in(language));
  return DiffOperands{diff_operand(diff.old_version), diff_operand(diff.new_version)};
}

std::variant<SourceFile, SourceFile::Problem> open(const DiffOperand& operand, Language language) {
  if (operand.bytes) return SourceFile::of_bytes(*operand.bytes, language);
  return operand.is_standard_input() ? SourceFile::read_stream(system::kStandardInput, language)
                                     : SourceFile::open(operand.file, language);
}

}  // namespace isocnc::interpreter
