#include <windows.h>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/base/system/command_line.h"

namespace dermis::inline base {
namespace {

HANDLE open_inherited(const wchar_t* path, DWORD access, DWORD creation) {
    SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
    return ::CreateFileW(path, access, FILE_SHARE_READ | FILE_SHARE_WRITE, &inherited, creation,
                         FILE_ATTRIBUTE_NORMAL, nullptr);
}

}  // namespace

int run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
    const HANDLE nothing = open_inherited(L"NUL", GENERIC_READ, OPEN_EXISTING);
    const HANDLE output = open_inherited(log.c_str(), GENERIC_WRITE, CREATE_ALWAYS);
    DWORD status = DWORD(-1);
    if (nothing != INVALID_HANDLE_VALUE && output != INVALID_HANDLE_VALUE) {
        STARTUPINFOW startup{};
        startup.cb = sizeof startup;
        startup.dwFlags = STARTF_USESTDHANDLES;
        startup.hStdInput = nothing;
        startup.hStdOutput = startup.hStdError = output;
        PROCESS_INFORMATION child{};
        std::wstring line = utf8_path(command_line(arguments)).wstring();  // CreateProcessW() writes to it
        if (::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, CREATE_NO_WINDOW, nullptr, nullptr,
                             &startup, &child)) {
            ::WaitForSingleObject(child.hProcess, INFINITE);
            ::GetExitCodeProcess(child.hProcess, &status);
            ::CloseHandle(child.hThread);
            ::CloseHandle(child.hProcess);
        }
    }
    for (const HANDLE handle : {nothing, output})
        if (handle != INVALID_HANDLE_VALUE) ::CloseHandle(handle);
    // Above: the system's code of what killed it.
    constexpr DWORD kMostOfAProgram = 0x7fffffff;
    return status > kMostOfAProgram ? -1 : int(status);
}

}  // namespace dermis::inline base
