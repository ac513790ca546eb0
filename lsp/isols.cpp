#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "interpreter/command_line/program_app.h"
#include "interpreter/command_line/program_main.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/system/user_language.h"
#include "lsp/rpc/serve.h"
#include "lsp/server.h"

namespace isocnc::lsp {
namespace {

struct ServerOptions {
  bool stdio = false;
  std::optional<std::uint16_t> port;
  std::string language;
};

void complain(std::string_view what) { command_line::complain("isols", what); }

system::ExitStatus run(const ServerOptions& options) {
  const std::optional<dialect::Language> language = dialect::language_named(options.language);
  const auto make = [&](rpc::Loop& loop, rpc::Send send) {
    return std::make_unique<Server>(loop, std::move(send), language);
  };
  rpc::serve(options.port, language.value_or(system::user_language()), make, complain);
  return system::ExitStatus::Failure;  // The port cannot be opened.
}

system::ExitStatus run_main(int argc, char** argv) {
  ServerOptions options;
  command_line::ProgramApp program(
      argc, argv,
      {"The language server for ISOCNC programs: an editor starts it and speaks with it.",
       "Il language server per i programmi ISOCNC: un editor lo avvia e parla con lui."},
      {.program = "isols",
       .version = ISOCNC_VERSION,
       .purpose = {"language server for ISOCNC programs", "language server per i programmi ISOCNC"},
       .operands = "",
       .paragraphs = {{"isols speaks the language server protocol, version 3.18. An editor starts it, and shows "
                       "what isolint would find while the program is being written.",
                       "isols parla il language server protocol, versione 3.18. Un editor lo avvia e, mentre si scrive "
                       "il programma, mostra ciò che troverebbe isolint."},
                      {"Programs are checked as the isocnc.json beside them or above says, as by isolint.",
                       "I programmi vengono verificati come dice l'isocnc.json nella loro cartella o in una sopra, "
                       "come con isolint."}},
       .exit = {{"0", {"The editor has shut the server down.", "L'editor ha chiuso il server."}},
                {"1",
                 {"The editor has disconnected, or ended the server without shutting it down.",
                  "L'editor si è scollegato, o ha terminato il server senza chiuderlo."}},
                {"2",
                 {"A mistake in the command, or the port is not available.",
                  "Un errore nel comando, oppure la porta non è disponibile."}}},
       .see_also = {"isolint", "isofmt", "isorun"}});
  const command_line::ProgramOption stdio = program.add_flag(
      "--stdio", options.stdio,
      {"Use standard input and output, as by default", "Usa standard input e output, come in assenza"});
  program
      .add_option("--tcp", options.port, {"PORT", "PORTA"},
                  {"Wait for one editor on this port of the loopback\ninterface; 0: any",
                   "Aspetta un editor su questa porta dell'interfaccia\nloopback; 0: una qualsiasi"})
      .excludes(stdio);
  stdio.without_exclusions();
  program.add_language(options.language, {"en or it; else as the editor, the configuration\nor the locale says",
                                          "en o it; altrimenti secondo l'editor, la\nconfigurazione o il locale"});
  // An option that some clients add by themselves.
  int client_process = 0;
  program.add_option("--clientProcessId", client_process, {}, {}).hidden();
  if (const auto status = program.answer(argc, argv)) return *status;
  return run(options);
}

}  // namespace
}  // namespace isocnc::lsp

int main(int argc, char** argv) {
  return isocnc::command_line::program_main("isols", isocnc::lsp::run_main, argc, argv);
}
