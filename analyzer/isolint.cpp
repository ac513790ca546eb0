#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <sstream>
#include <thread>
#include <variant>

#include <unistd.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "analyzer/check_text.h"
#include "analyzer/explain.h"
#include "analyzer/files.h"
#include "analyzer/renderers.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/running/output_file.h"
#include "interpreter/running/source_file.h"
#include "interpreter/running/system_texts.h"

namespace isocnc::analyzer {
namespace {

using dialect::Language;
using dialect::Text;
using running::SourceFile;

enum ExitStatus { kClean = 0, kFindings = 1, kTrouble = 2 };

struct Options {
  std::vector<std::string> paths;
  std::string format = "text";
  std::string language;
  std::string color = "auto";
  std::string explain;
  std::string stdin_name = "<stdin>";
  int jobs = 0;
  bool list_rules = false;
  bool rules_page = false;
  bool no_config = false;

  Language reader_language() const {
    if (language == "it") return Language::Italian;
    if (language == "en") return Language::English;
    return dialect::language_of_environment();
  }
  bool wants_color() const {
    if (color != "auto") return color == "always";
    return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
  }
};

void complain(std::string_view what) { std::cerr << "isolint: " << printable(what) << '\n'; }

/// Where findings and all other answers go.
class StandardOutput final : public Output {
 public:
  /// Flushes; false, after a complaint, when anything written has been lost.
  bool finish(Language language) {
    flush();
    if (file_.flush() == 0) return true;
    complain(fmt::format("<stdout>: {}", running::cannot_write(file_.error(), language)));
    return false;
  }
  bool has_failed() const { return file_.error() != 0; }

 protected:
  void write(std::string_view text) override { file_.write(text); }

 private:
  running::OutputFile file_{STDOUT_FILENO};
};

/// Prints an answer that is no finding.
ExitStatus say(std::string_view text, Language language) {
  StandardOutput output;
  output.buffer() += text;
  return output.finish(language) ? kClean : kTrouble;
}

struct Counts {
  std::size_t errors = 0, warnings = 0, infos = 0, files = 0;

  void add(const Report& report) {
    ++files;
    for (const LocatedFinding& located : report.findings) {
      switch (dialect::definition(located.finding.id).severity) {
        case dialect::Severity::Error:
          ++errors;
          break;
        case dialect::Severity::Warning:
          ++warnings;
          break;
        case dialect::Severity::Info:
          ++infos;
          break;
      }
    }
  }
};

/// Checks files side by side and shows what was found in their order.
class Run {
 public:
  Run(const Options& options, std::vector<std::filesystem::path> files)
      : options_(options),
        language_(options.reader_language()),
        files_(std::move(files)),
        renderer_(make_renderer(options.format, {language_, options.wants_color()})),
        jobs_(options.jobs > 0 ? options.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {}

  int run(bool trouble) {
    trouble_ = trouble;
    renderer_->begin(output_.buffer());
    const auto workers = std::min<std::size_t>(static_cast<std::size_t>(jobs_), files_.size());
    std::vector<std::thread> helpers;
    for (std::size_t i = 1; i < workers; ++i) helpers.emplace_back([this] { work(); });
    work();
    for (std::thread& helper : helpers) helper.join();
    renderer_->end(output_.buffer());
    if (!output_.finish(language_)) return kTrouble;
    if (options_.format == "text") summarize();
    if (trouble_) return kTrouble;
    return counts_.errors > 0 ? kFindings : kClean;
  }

 private:
  void work() {
    for (std::size_t index = next_++; index < files_.size(); index = next_++) {
      const std::filesystem::path& path = files_[index];
      const bool from_stdin = path == "-";
      auto opened = from_stdin ? SourceFile::read_stream(STDIN_FILENO, language_) : SourceFile::open(path, language_);
      const std::string name = from_stdin ? options_.stdin_name : path.string();
      Report report;
      std::string_view text;
      if (const SourceFile* source = std::get_if<SourceFile>(&opened)) {
        text = source->text();
        const bool is_large = text.size() > kLargeFile;
        report = check_text(text, {}, files_.size() == 1 || is_large ? jobs_ : 1);
      }
      std::unique_lock lock(mutex_);
      turn_changed_.wait(lock, [&] { return turn_ == index; });
      if (const auto* problem = std::get_if<SourceFile::Problem>(&opened)) {
        complain(fmt::format("{}: {}", name, problem->message));
        trouble_ = true;
      } else {
        counts_.add(report);
        if (!output_.has_failed()) renderer_->file(name, text, report, output_);
      }
      ++turn_;
      turn_changed_.notify_all();
    }
  }

  void summarize() const {
    const bool italian = language_ == Language::Italian;
    const auto plural = [](std::size_t n, std::string_view one, std::string_view many) {
      return fmt::format("{} {}", n, n == 1 ? one : many);
    };
    std::string line =
        italian ? plural(counts_.errors, "errore", "errori") + ", " + plural(counts_.warnings, "avviso", "avvisi")
                : plural(counts_.errors, "error", "errors") + ", " + plural(counts_.warnings, "warning", "warnings");
    if (counts_.infos > 0) line += ", " + plural(counts_.infos, italian ? "nota" : "note", italian ? "note" : "notes");
    line += italian ? " in " + plural(counts_.files, "file", "file") : " in " + plural(counts_.files, "file", "files");
    std::cerr << line << '\n';
  }

  static constexpr std::size_t kLargeFile = 8 * 1024 * 1024;

  const Options& options_;
  const Language language_;
  const std::vector<std::filesystem::path> files_;
  std::unique_ptr<Renderer> renderer_;
  const int jobs_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::condition_variable turn_changed_;
  std::size_t turn_ = 0;  // With all below: guarded by mutex_.
  StandardOutput output_;
  Counts counts_;
  bool trouble_ = false;
};

int check(const Options& options) {
  const Language language = options.reader_language();
  const std::vector<std::string> here = {"."};
  FileSelection selection = select_programs(options.paths.empty() ? here : options.paths, language);
  for (const std::string& problem : selection.problems) complain(problem);
  const bool trouble = !selection.problems.empty();
  std::vector<std::filesystem::path> files = std::move(selection.files);
  if (selection.is_refused) return kTrouble;
  // Readers of JSON compare arrays, whatever order the files were named in.
  if (options.format == "json")
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.native() < b.native(); });
  return Run(options, std::move(files)).run(trouble);
}

int explain_code(const Options& options) {
  const auto id = dialect::find_diagnostic(options.explain);
  if (!id) {
    complain(fmt::format(
        "{} {} (--list-rules)",
        options.reader_language() == Language::Italian ? "codice sconosciuto:" : "unknown code:", options.explain));
    return kTrouble;
  }
  return say(explain(*id, options.reader_language()), options.reader_language());
}

int run_main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // A closed pipe is a write that fails, and is told as one.
  Options options;
  CLI::App app{"Checks ISOCNC programs and reports what the control would stop at."};
  app.name("isolint");
  app.set_version_flag("--version", "isolint " ISOCNC_VERSION);
  app.add_option("PATH", options.paths,
                 "Programs, directories (searched for .iso .nc .cnc .tap .ngc), or - for standard input; else the "
                 "current directory");
  app.add_option("--format", options.format, "How findings are shown: text, concise, json")
      ->check(CLI::IsMember({"text", "concise", "json"}));
  app.add_option("--lang", options.language, "Language of messages: en, it (else from the locale)")
      ->check(CLI::IsMember({"en", "it"}));
  app.add_option("--color", options.color, "auto, always, never")->check(CLI::IsMember({"auto", "always", "never"}));
  app.add_option("--jobs,-j", options.jobs, "Threads (else one per core)")->check(CLI::Range(1, 1024));
  app.add_option("--stdin-filename", options.stdin_name, "Name to show for standard input");
  app.add_option("--explain", options.explain, "Tell all about a code, such as ISO031");
  app.add_flag("--list-rules", options.list_rules, "List all codes");
  app.add_flag("--no-config", options.no_config, "Read no isocnc.json");
  app.add_flag("--rules-page", options.rules_page, "Print docs/rules.md")->group("");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    std::ostringstream said;
    app.exit(success, said, said);
    return say(said.str(), options.reader_language());
  } catch (const CLI::ParseError& error) {
    complain(error.what());
    std::cerr << "isolint --help\n";
    return kTrouble;
  }
  if (options.rules_page) return say(rules_page(), options.reader_language());
  if (options.list_rules) return say(list_rules(options.reader_language()), options.reader_language());
  if (!options.explain.empty()) return explain_code(options);
  return check(options);
}

}  // namespace
}  // namespace isocnc::analyzer

int main(int argc, char** argv) {
  try {
    return isocnc::analyzer::run_main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "isolint: internal error: " << error.what() << '\n';
    return 2;
  }
}
