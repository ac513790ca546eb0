#include <windows.h>

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <thread>

#include "interpreter/system/descriptor.h"
#include "interpreter/system/process.h"
#include "interpreter/system/windows/errors.h"
#include "interpreter/system/windows/handle.h"

namespace isocnc::system {

namespace {

std::error_code last_error() { return {errno_of(::GetLastError()), std::generic_category()}; }

/// A pipe of which the other program has one end.
struct Pipe {
  Descriptor ours;
  Descriptor theirs;

  enum class Ours { Read, Write };
  bool open(Ours end) {
    HANDLE read = nullptr;
    HANDLE write = nullptr;
    if (::CreatePipe(&read, &write, nullptr, 0) == 0) return false;
    const auto take = [](HANDLE handle) {
      const int number = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY | _O_NOINHERIT);
      if (number < 0) ::CloseHandle(handle);
      return Descriptor(number);
    };
    Descriptor reader = take(read);
    Descriptor writer = take(write);
    ours = std::move(end == Ours::Read ? reader : writer);
    theirs = std::move(end == Ours::Read ? writer : reader);
    return ours.is_open() && theirs.is_open() &&
           ::SetHandleInformation(handle_of(theirs.number()), HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT) != 0;
  }
};

/// An argument as CommandLineToArgvW() reads it.
std::wstring quoted(const std::wstring& argument) {
  if (!argument.empty() && argument.find_first_of(L" \t\n\v\"") == std::wstring::npos) return argument;
  std::wstring text = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t c : argument) {
    if (c == L'"') text.append(backslashes + 1, L'\\');
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    text += c;
  }
  return text.append(backslashes, L'\\') + L'"';
}

/// The file of a program in the PATH, and never in the current folder, which may be of an unknown source; empty if
/// there is none.
std::wstring file_in_path(const std::wstring& name) {
  constexpr DWORD kLongest = 32 * 1024;
  std::wstring path(kLongest, L'\0');
  path.resize(std::min(::GetEnvironmentVariableW(L"PATH", path.data(), kLongest), kLongest));
  std::wstring file(kLongest, L'\0');
  file.resize(path.empty() ? 0 : ::SearchPathW(path.c_str(), name.c_str(), L".exe", kLongest, file.data(), nullptr));
  return file;
}

std::string all_of(const Descriptor& from) {
  std::string text;
  std::array<char, 64 * 1024> bytes{};
  for (;;) {
    const std::ptrdiff_t count = read_some(from.number(), bytes.data(), bytes.size());
    if (count <= 0) return text;
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

std::variant<ProgramEnd, std::error_code> run_program(const std::vector<std::string>& command, std::string_view input) {
  std::wstring line;
  for (const std::string& argument : command)
    line += (line.empty() ? L"" : L" ") + quoted(std::filesystem::path(argument).wstring());
  const std::wstring file = file_in_path(std::filesystem::path(command[0]).wstring());
  if (file.empty()) return std::make_error_code(std::errc::no_such_file_or_directory);
  Pipe in;
  Pipe out;
  Pipe errors;
  if (!in.open(Pipe::Ours::Write) || !out.open(Pipe::Ours::Read) || !errors.open(Pipe::Ours::Read)) return last_error();
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = handle_of(in.theirs.number());
  startup.hStdOutput = handle_of(out.theirs.number());
  startup.hStdError = handle_of(errors.theirs.number());
  PROCESS_INFORMATION process{};
  if (::CreateProcessW(file.c_str(), line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &startup, &process) == 0)
    return last_error();
  ::CloseHandle(process.hThread);
  for (Pipe* const pipe : {&in, &out, &errors}) pipe->theirs = Descriptor();
  ProgramEnd end;
  // Windows lets nobody wait for several pipes at once.
  std::thread writer([&] {
    for (std::string_view rest = input; !rest.empty();) {
      const std::ptrdiff_t count = write_some(in.ours.number(), rest);
      if (count < 0) break;
      rest.remove_prefix(static_cast<std::size_t>(count));
    }
    in.ours = Descriptor();
  });
  std::thread listener([&] { end.errors = all_of(errors.ours); });
  end.output = all_of(out.ours);
  writer.join();
  listener.join();
  ::WaitForSingleObject(process.hProcess, INFINITE);
  DWORD status = 0;
  ::GetExitCodeProcess(process.hProcess, &status);
  ::CloseHandle(process.hProcess);
  end.status = static_cast<int>(status);
  return end;
}

}  // namespace isocnc::system
