#include "interpreter/system/system_texts.h"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <system_error>

namespace isocnc::system {

using dialect::Language;
using dialect::Text;

static constexpr Text kCannotRead{"cannot read: ", "non si può leggere: "};
static constexpr Text kCannotWrite{"cannot write: ", "non si può scrivere: "};

/// The system reports errors in the locale's language, not the chosen one, so the most common messages are translated
/// here.
struct SystemText {
  int error;
  Text text;
};
static constexpr SystemText kSystemTexts[] = {
    {ENOENT, {"No such file or directory", "file o directory non esistente"}},
    {EACCES, {"Permission denied", "permesso negato"}},
    {EPERM, {"Operation not permitted", "operazione non permessa"}},
    {EISDIR, {"Is a directory", "è una directory"}},
    {ENOTDIR, {"Not a directory", "non è una directory"}},
    {ELOOP, {"Too many levels of symbolic links", "troppi livelli di collegamenti simbolici"}},
    {ENAMETOOLONG, {"File name too long", "nome del file troppo lungo"}},
    {ENOMEM, {"Cannot allocate memory", "memoria insufficiente"}},
    {EMFILE, {"Too many open files", "troppi file aperti"}},
    {EIO, {"Input/output error", "errore di input/output"}},
    {ENXIO, {"No such device or address", "dispositivo o indirizzo non esistente"}},
    {ENOSPC, {"No space left on device", "spazio su disco esaurito"}},
#ifdef EDQUOT  // Windows has none.
    {EDQUOT, {"Disk quota exceeded", "quota di spazio su disco superata"}},
#endif
    {EBUSY, {"In use by another program", "in uso da un altro programma"}},
    {EFBIG, {"File too large", "file troppo grande"}},
    {EROFS, {"Read-only file system", "file system in sola lettura"}},
    {EPIPE, {"Broken pipe", "nessuno legge più dalla pipe"}},
    {EADDRINUSE, {"Address already in use", "indirizzo già in uso"}},
    {EADDRNOTAVAIL, {"Cannot assign requested address", "indirizzo non disponibile"}},
    {EBADF, {"Bad file descriptor", "il file non è aperto"}},
};

std::string reason_of(int error, Language language) {
  const auto* const row =
      std::find_if(std::begin(kSystemTexts), std::end(kSystemTexts), [&](const auto& r) { return r.error == error; });
  if (row == std::end(kSystemTexts)) return std::generic_category().message(error);
  return std::string(row->text.in(language));
}

std::string cannot_read(int error, Language language) {
  return std::string(kCannotRead.in(language)) + reason_of(error, language);
}

std::string cannot_read(const std::error_code& error, Language language) {
  return cannot_read(error.default_error_condition().value(), language);
}

std::string cannot_write(int error, Language language) {
  return std::string(kCannotWrite.in(language)) + reason_of(error, language);
}

}  // namespace isocnc::system
