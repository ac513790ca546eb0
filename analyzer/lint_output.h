#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "analyzer/command_line.h"
#include "analyzer/formats/rendering.h"
#include "interpreter/system/output_file.h"

namespace isocnc::analyzer {

/// Prints an error message of isolint.
void complain(std::string_view what);

/// The output of findings and all other answers.
class LintOutput final : public formats::Output {
 public:
  explicit LintOutput(const LintCommandOptions& options);

  /// Writes the rest; returns false, after an error message, if output has been lost.
  bool finish();
  bool has_failed() const { return file_.error() != 0; }

 protected:
  void write(std::string_view text) override { file_.write(text); }

 private:
  const std::string path_;
  const dialect::Language language_;
  const int descriptor_;
  system::OutputFile file_;
};

}  // namespace isocnc::analyzer
