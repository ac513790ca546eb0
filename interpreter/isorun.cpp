#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "interpreter/dialect/locale.h"
#include "interpreter/running/runner.h"

namespace isocnc::running {
namespace {

using dialect::Language;

enum ExitStatus { kRan = 0, kStopped = 1, kTrouble = 2 };

struct Options {
  std::string file;
  std::string trace;
  std::string language;
  std::vector<std::string> settings;
  double vgpl = 0;
  std::uint64_t until = 0;

  Language reader_language() const {
    if (language.empty()) return dialect::language_of_environment();
    return language == "it" ? Language::Italian : Language::English;
  }
};

void complain(std::string_view what) { std::cerr << "isorun: " << what << '\n'; }

/// V3=1.5
bool read_register(const std::string& setting, RunOptions& run) {
  int reg = 0;
  int length = 0;
  double value = 0;
  if (std::sscanf(setting.c_str(), "V%d=%lf%n", &reg, &value, &length) != 2 ||
      static_cast<std::size_t>(length) != setting.size() || reg < 1 || reg > dialect::kRegisterCount)
    return false;
  run.registers[static_cast<std::size_t>(reg)] = value;
  return true;
}

/// What a run adds up to.
struct Totals {
  std::size_t rapids = 0, feeds = 0, arcs = 0;
  double rapid_mm = 0, feed_mm = 0;

  void add(const Event& event) {
    const auto* const move = std::get_if<MoveEvent>(&event.what);
    if (!move) return;
    switch (move->kind) {
      case execution::MoveKind::Rapid: ++rapids; break;
      case execution::MoveKind::Feed: ++feeds; break;
      case execution::MoveKind::Arc: ++arcs; break;
    }
    (move->kind == execution::MoveKind::Rapid ? rapid_mm : feed_mm) += move->length;
  }
};

void print_error(const std::string& file, const RunResult& result, Language language) {
  const syntax::Span span = result.error.span;
  const std::string_view marked = result.line_text.substr(span.begin, span.end - span.begin);
  std::cerr << fmt::format("{}:{}: {}: {} [{}]\n", file, result.line + 1,
                           dialect::severity_name(dialect::definition(result.error.id).severity, language),
                           dialect::message(result.error.id, language, marked, result.error.values),
                           dialect::definition(result.error.id).code);
}

void summarize(std::ostream& out, const RunResult& result, const Totals& totals, Language language) {
  const bool italian = language == Language::Italian;
  const char* const endings[][2] = {{"ran to M02", "eseguito fino a M02"},
                                    {"stopped by an error", "fermato da un errore"},
                                    {"stopped where asked", "fermato dove richiesto"}};
  const geometry::Vec3 tip = result.state.to_machine(result.state.position.tip);
  out << fmt::format("{}: {}, {} {}\n", italian ? "esito" : "result",
                     endings[static_cast<std::size_t>(result.ending)][italian ? 1 : 0], italian ? "riga" : "line", result.line + 1);
  out << fmt::format("{}: {}\n", italian ? "blocchi" : "blocks", result.blocks);
  out << fmt::format("{}: {} ({:.3f} mm)\n", italian ? "rapidi" : "rapids", totals.rapids, totals.rapid_mm);
  out << fmt::format("{}: {}, {}: {} ({:.3f} mm)\n", italian ? "lineari" : "feed moves", totals.feeds,
                     italian ? "archi" : "arcs", totals.arcs, totals.feed_mm);
  out << fmt::format("{}: X{:.3f} Y{:.3f} Z{:.3f} B{:.3f} C{:.3f}\n", italian ? "posizione finale (macchina)" : "final position (machine)",
                     tip.x(), tip.y(), tip.z(), result.state.position.b, result.state.position.c);
}

int run_file(const Options& options) {
  const Language language = options.reader_language();
  RunOptions run_options;
  run_options.vgpl = options.vgpl;
  if (options.until > 0) run_options.until = options.until - 1;
  for (const std::string& setting : options.settings)
    if (!read_register(setting, run_options)) return complain("--set wants V1=VALUE to V30=VALUE, not " + setting), kTrouble;
  std::ifstream input;
  if (options.file != "-") input.open(options.file, std::ios::binary);
  errno = 0;
  std::istream& source = options.file == "-" ? std::cin : input;
  std::string text{std::istreambuf_iterator<char>(source), {}};
  if (!input.is_open() && options.file != "-") return complain(options.file + ": " + std::strerror(ENOENT)), kTrouble;
  if (source.bad()) return complain(options.file + ": " + std::strerror(errno ? errno : EIO)), kTrouble;
  std::string_view program = text;
  if (program.starts_with("\xEF\xBB\xBF")) program.remove_prefix(3);

  std::ofstream trace_file;
  if (!options.trace.empty() && options.trace != "-") {
    trace_file.open(options.trace, std::ios::binary);
    if (!trace_file) return complain(options.trace + ": " + std::strerror(errno)), kTrouble;
  }
  std::ostream* const trace = options.trace.empty() ? nullptr : options.trace == "-" ? &std::cout : &trace_file;
  Totals totals;
  const RunResult result = run(program, run_options, [&](const Event& event) {
    totals.add(event);
    if (trace) *trace << to_json(event) << '\n';
  });
  if (trace && !trace->flush()) return complain("cannot write the trace"), kTrouble;
  if (trace != &std::cout) summarize(std::cout, result, totals, language);
  if (result.ending != Ending::Error) return kRan;
  print_error(options.file, result, language);
  return kStopped;
}

int run_main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  Options options;
  CLI::App app{"Runs an ISOCNC program and tells what it does."};
  app.name("isorun");
  app.set_version_flag("--version", "isorun " ISOCNC_VERSION);
  app.add_option("FILE", options.file, "The program, or - for standard input")->required();
  app.add_option("--trace", options.trace, "Write what happens as JSON lines to this file, or - for standard output");
  app.add_option("--vgpl", options.vgpl, "Value of VGPL (else 0)");
  app.add_option("--set", options.settings, "Value of a register at the start: V3=1.5");
  app.add_option("--until", options.until, "Stop before this line")->check(CLI::PositiveNumber);
  app.add_option("--lang", options.language, "en, it (else from the locale)")->check(CLI::IsMember({"en", "it"}));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    complain(error.what());
    return kTrouble;
  }
  return run_file(options);
}

}  // namespace
}  // namespace isocnc::running

int main(int argc, char** argv) {
  try {
    return isocnc::running::run_main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "isorun: internal error: " << error.what() << '\n';
    return 2;
  }
}
