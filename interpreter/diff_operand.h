#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/git/external_diff.h"
#include "interpreter/system/source_file.h"

namespace isocnc::interpreter {

/// A program that isodiff compares.
struct DiffOperand {
  std::string name;                  ///< As messages call it: `part.iso`, `HEAD:part.iso`, `<stdin>`.
  std::filesystem::path place;       ///< Whose folder and those above it hold the configuration; empty for none.
  std::string file;                  ///< To read; empty where `bytes` are there, or for standard input.
  std::optional<std::string> bytes;  ///< What git has given.

  bool is_standard_input() const { return file.empty() && !bytes; }
};
using DiffOperands = std::array<DiffOperand, 2>;  ///< The old one and the new one.

/// What a word of the command means: a file, a file of a revision, or `-`. Reads from git; why that has not worked, as
/// text for a user.
std::variant<DiffOperand, std::string> diff_operand(const std::string& word, dialect::Language language);

/// The programs that git wants to be compared; one that does not exist does nothing. None where there are no programs,
/// with the reason for a user: among all files of a repository these have one of the `extensions`, with their dot.
std::variant<DiffOperands, std::string> diff_operands(const git::ExternalDiff& diff,
                                                      std::span<const std::string> extensions,
                                                      dialect::Language language);

/// Reads the text.
std::variant<system::SourceFile, system::SourceFile::Problem> open(const DiffOperand& operand,
                                                                   dialect::Language language);

}  // namespace isocnc::interpreter
