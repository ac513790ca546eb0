#include "interpreter/system/mapped_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <functional>
#include <utility>

#include "interpreter/system/exit_status.h"
#include "interpreter/system/handler_table.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/temporary_file.h"
#include "interpreter/text/unicode.h"

namespace isocnc::system {

using dialect::Language;
using dialect::Text;

static constexpr Text kWasCutShort{"has been cut short by another program while it was being read",
                                   "è stato accorciato da un altro programma durante la lettura"};

/// The mapped files. Lost bytes of a file that finds no free slot end the program by SIGBUS, without a message.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a handler sees nothing else.
static HandlerTable<MappedFile> mapped_files;

MappedFile::MappedFile(const std::filesystem::path& path, int descriptor, std::size_t size, Language language)
    : size_(size) {
  void* const bytes = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  if (bytes == MAP_FAILED) {
    error_ = errno;
    return;
  }
  begin_ = static_cast<const char*>(bytes);
  complaint_ = text::printable(generic_name(path)) + ": " + std::string(kWasCutShort.in(language)) + "\n";
  mapped_files.add(this);
}

MappedFile::~MappedFile() {
  if (begin_ == nullptr) return;
  mapped_files.remove(this);
  ::munmap(const_cast<char*>(begin_), size_);  // NOLINT(cppcoreguidelines-pro-type-const-cast): changes no byte.
}

void MappedFile::will_be_read_in_order() const {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): changes no byte.
  ::madvise(const_cast<char*>(begin_), size_, MADV_SEQUENTIAL);
}

const std::string* MappedFile::complaint_of(const void* address) const {
  const auto* const place = static_cast<const char*>(address);
  const std::less<> is_below;
  return !is_below(place, begin_) && is_below(place, begin_ + size_) ? &complaint_ : nullptr;
}

/// Prefix of the handler's message: `isolint: `.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): likewise.
static std::string complaint_prefix;

/// Handles SIGBUS; calls only functions allowed in a signal handler.
static void on_lost_bytes(int signal, siginfo_t* info, void*) {
  mapped_files.for_each([info](const MappedFile& file) {
    const std::string* const complaint = file.complaint_of(info->si_addr);
    if (complaint == nullptr) return;
    for (const std::string* const part : {&std::as_const(complaint_prefix), complaint})
      if (::write(STDERR_FILENO, part->data(), part->size()) < 0) break;
    remove_temporary_files();
    ::_exit(static_cast<int>(ExitStatus::Failure));
  });
  std::signal(signal, SIG_DFL);  // Not in a mapped file: the access is repeated and ends the program.
}

void report_lost_bytes(std::string_view program) {
  complaint_prefix = std::string(program) + ": ";
  struct sigaction action {};
  action.sa_sigaction = on_lost_bytes;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

}  // namespace isocnc::system
