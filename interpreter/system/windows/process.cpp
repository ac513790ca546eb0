#include "interpreter/system/process.h"

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <shellapi.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <string_view>

#include "interpreter/system/descriptor.h"

namespace isocnc::system {

namespace fs = std::filesystem;

void prepare_process() {
  for (const int stream : {kStandardInput, kStandardOutput, kStandardError}) ::_setmode(stream, _O_BINARY);
  ::SetConsoleOutputCP(CP_UTF8);
  ::SetErrorMode(SEM_FAILCRITICALERRORS);  // No window where a drive has no disk.
}

/// Half characters become U+FFFD.
static std::string utf8(std::wstring_view text) {
  const auto size = static_cast<int>(text.size());
  const int bytes = ::WideCharToMultiByte(CP_UTF8, 0, text.data(), size, nullptr, 0, nullptr, nullptr);
  std::string result(static_cast<std::size_t>(bytes), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, text.data(), size, result.data(), bytes, nullptr, nullptr);
  return result;
}

/// The arguments of main() are in the code page of the system, which lacks most letters.
ProgramArguments::ProgramArguments(int, char**) {
  int count = 0;
  wchar_t** const wide = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  for (int i = 0; i < count; ++i) texts_.push_back(utf8(wide[i]));
  ::LocalFree(wide);
  for (std::string& text : texts_) pointers_.push_back(text.data());
  pointers_.push_back(nullptr);
}

static void (*clean_up_before_end)() = nullptr;

/// Runs on a thread of its own.
static BOOL WINAPI on_console_event(DWORD) {
  clean_up_before_end();
  return FALSE;  // The next handler ends the process.
}

void before_forced_end(void (*clean_up)()) {
  clean_up_before_end = clean_up;
  ::SetConsoleCtrlHandler(on_console_event, TRUE);
}

static std::atomic<bool> end_is_requested = false;
static HANDLE end_request = nullptr;

/// Handlers are asked the last one first; the one before this one ends the process. A console that closes does not
/// wait.
static BOOL WINAPI on_end_request(DWORD event) {
  if ((event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) || end_is_requested.exchange(true)) return FALSE;
  ::SetEvent(end_request);
  return TRUE;
}

bool take_end_request() {
  end_request = ::CreateEventW(nullptr, TRUE, FALSE, nullptr);
  return end_request != nullptr && ::SetConsoleCtrlHandler(on_end_request, TRUE) != 0;
}

bool is_end_requested() { return end_is_requested; }

bool sleep_until_end_request(std::chrono::milliseconds longest) {
  ::WaitForSingleObject(end_request, static_cast<DWORD>(longest.count()));
  return is_end_requested();
}

void share_one_heap() {}

bool has_threads() { return true; }

int processor_count() {
  DWORD_PTR usable = 0;
  DWORD_PTR all = 0;
  if (::GetProcessAffinityMask(::GetCurrentProcess(), &usable, &all) == 0) return 1;
  return std::max(1, std::popcount(usable));
}

bool is_running(std::int64_t process) {
  HANDLE const opened = ::OpenProcess(SYNCHRONIZE, FALSE, static_cast<DWORD>(process));
  if (opened == nullptr) return ::GetLastError() != ERROR_INVALID_PARAMETER;
  const bool has_ended = ::WaitForSingleObject(opened, 0) == WAIT_OBJECT_0;
  ::CloseHandle(opened);
  return !has_ended;
}

fs::path program_file() {
  static constexpr DWORD kLongest = 32 * 1024;
  std::wstring name(kLongest, L'\0');
  name.resize(::GetModuleFileNameW(nullptr, name.data(), kLongest));
  return name;
}

std::string user_locale() {
  wchar_t name[LOCALE_NAME_MAX_LENGTH] = {};
  if (::LCIDToLocaleName(MAKELCID(::GetUserDefaultUILanguage(), SORT_DEFAULT), name, LOCALE_NAME_MAX_LENGTH, 0) == 0)
    return {};
  return utf8(name);
}

}  // namespace isocnc::system
