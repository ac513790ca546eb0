#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "debugger/adapter.h"
#include "interpreter/command_line/program_app.h"
#include "interpreter/command_line/program_main.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/system/user_language.h"
#include "lsp/rpc/serve.h"

namespace isocnc::debugger {
namespace {

struct DebugCommandOptions {
  std::optional<std::uint16_t> port;
  std::string language;
};

void complain(std::string_view what) { command_line::complain("isodap", what); }

system::ExitStatus run(const DebugCommandOptions& options) {
  const std::optional<dialect::Language> language = dialect::language_named(options.language);
  const auto make = [&](rpc::Loop& loop, rpc::Send send) {
    return std::make_unique<Adapter>(loop, std::move(send), language);
  };
  rpc::serve(options.port, language.value_or(system::user_language()), make, complain);
  return system::ExitStatus::Failure;  // The port is not available.
}

system::ExitStatus run_main(int argc, char** argv) {
  DebugCommandOptions options;
  command_line::ProgramApp program(
      argc, argv,
      {"The debug adapter for ISOCNC programs: an editor starts it and speaks with it.",
       "Il debug adapter per i programmi ISOCNC: un editor lo avvia e parla con lui."},
      {.program = "isodap",
       .version = ISOCNC_VERSION,
       .purpose = {"debug adapter for ISOCNC programs", "debug adapter per i programmi ISOCNC"},
       .operands = "",
       .paragraphs =
           {{"isodap speaks the debug adapter protocol. An editor starts it, and steps a program by it, "
             "forwards and backwards, on the simulated machine of isorun.",
             "isodap parla il debug adapter protocol. Un editor lo avvia e con esso esegue un programma passo "
             "passo, avanti e indietro, sulla macchina simulata di isorun."},
            {"The isocnc.json beside the program or above describes the machine, as for isorun.",
             "La macchina è descritta dall'isocnc.json nella cartella del programma o in una sopra, come per "
             "isorun."}},
       .exit = {{"0", {"The editor has disconnected.", "L'editor si è scollegato."}},
                {"1",
                 {"The editor has disconnected without ending the session.",
                  "L'editor si è scollegato senza chiudere la sessione."}},
                {"2",
                 {"A mistake in the command, or the port is not available.",
                  "Un errore nel comando, oppure la porta non è disponibile."}}},
       .see_also = {"isorun", "isols", "isolint"}});
  program.add_option("--server", options.port, {"PORT", "PORTA"},
                     {"Wait for one editor on this port of the loopback\ninterface; 0: any. Else "
                      "speak by standard input and\noutput",
                      "Aspetta un editor su questa porta dell'interfaccia\nloopback; 0: una qualsiasi. "
                      "Altrimenti parla via\nstandard input e output"});
  program.add_language(options.language, {"en or it; else as the configuration, the editor\nor the locale says",
                                          "en o it; altrimenti secondo la configurazione,\nl'editor o il locale"});
  if (const auto status = program.answer(argc, argv)) return *status;
  return run(options);
}

}  // namespace
}  // namespace isocnc::debugger

int main(int argc, char** argv) {
  return isocnc::command_line::program_main("isodap", isocnc::debugger::run_main, argc, argv);
}
