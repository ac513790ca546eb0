// Runs the command of an entry in the Explorer's menu for a file, as the Explorer does: run_verb CLASS VERB FILE. The
// command gets no input, so a console that would stay open closes.
#include <windows.h>

#include <cstdio>
#include <string>

int wmain(int argc, wchar_t** argv) {
  if (argc != 4) return 2;
  const std::wstring key = std::wstring(L"Software\\Classes\\") + argv[1] + L"\\shell\\" + argv[2] + L"\\command";
  wchar_t command[4096] = {};
  DWORD bytes = sizeof command;
  if (::RegGetValueW(HKEY_CURRENT_USER, key.c_str(), nullptr, RRF_RT_REG_SZ, nullptr, command, &bytes) != ERROR_SUCCESS)
    return 3;
  std::wstring line = command;
  const std::size_t place = line.find(L"%1");
  if (place == std::wstring::npos) return 4;
  line.replace(place, 2, argv[3]);
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  SECURITY_ATTRIBUTES inherited = {sizeof inherited, nullptr, TRUE};
  startup.hStdInput = ::CreateFileW(L"NUL", GENERIC_READ, 0, &inherited, OPEN_EXISTING, 0, nullptr);
  startup.hStdOutput = ::GetStdHandle(STD_OUTPUT_HANDLE);
  startup.hStdError = ::GetStdHandle(STD_ERROR_HANDLE);
  PROCESS_INFORMATION process{};
  if (::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &startup, &process) == 0) {
    std::printf("%ls: error %lu", line.c_str(), ::GetLastError());
    return 5;
  }
  ::WaitForSingleObject(process.hProcess, INFINITE);
  return 0;
}
