// A library to preload: the N-th call of one kind that the program makes fails, as DERMIS_FAULT=KIND:N says.
// Kinds: memory, open, read, write, sync, rename, thread. The file DERMIS_FAULT_HIT appears when the call was
// reached. Calls before main() and after it do not count.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

enum Kind { memory, open_file, read_file, write_file, sync_file, rename_file, thread, none };
constexpr const char* kNames[] = {"memory", "open", "read", "write", "sync", "rename", "thread"};

std::atomic<bool> g_counting = false;
Kind g_kind = none;
std::atomic<long> g_left = 0;

bool fails(Kind kind) {
    if (kind != g_kind || !g_counting || g_left.fetch_sub(1) != 1) return false;
    if (const char* path = std::getenv("DERMIS_FAULT_HIT"))
        ::syscall(SYS_close, ::syscall(SYS_openat, AT_FDCWD, path, O_CREAT | O_WRONLY, 0600));
    return true;
}

void read_settings() {
    const char* text = std::getenv("DERMIS_FAULT");
    const char* colon = text ? std::strchr(text, ':') : nullptr;
    if (!colon) return;
    for (int kind = 0; kind < none; ++kind)
        if (std::strlen(kNames[kind]) == size_t(colon - text) &&
            std::strncmp(kNames[kind], text, size_t(colon - text)) == 0)
            g_kind = Kind(kind);
    g_left = std::atol(colon + 1);
}

template <class Function>
Function* next(Function*, const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int (*g_main)(int, char**, char**) = nullptr;

int counted_main(int argc, char** argv, char** environment) {
    read_settings();
    ::unsetenv("LD_PRELOAD");  // the programs that this one starts do not fail
    g_counting = true;
    const int exit_code = g_main(argc, argv, environment);
    g_counting = false;
    return exit_code;
}

int open_mode(int flags, va_list arguments) {
    return (flags & O_CREAT) ? va_arg(arguments, int) : 0;
}

}  // namespace

extern "C" {

int __libc_start_main(int (*program)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*finish)(), void (*loader_finish)(), void* stack_end) {
    g_main = program;
    return next(&__libc_start_main, "__libc_start_main")(counted_main, argc, argv, init, finish,
                                                         loader_finish, stack_end);
}

void* malloc(size_t bytes) {
    if (!fails(memory)) return __libc_malloc(bytes);
    errno = ENOMEM;
    return nullptr;
}

void* calloc(size_t count, size_t bytes) {
    if (!fails(memory)) return __libc_calloc(count, bytes);
    errno = ENOMEM;
    return nullptr;
}

void* realloc(void* old, size_t bytes) {
    if (!fails(memory)) return __libc_realloc(old, bytes);
    errno = ENOMEM;
    return nullptr;
}

void* aligned_alloc(size_t alignment, size_t bytes) {
    if (!fails(memory)) return __libc_memalign(alignment, bytes);
    errno = ENOMEM;
    return nullptr;
}

int open(const char* path, int flags, ...) {
    va_list arguments;
    va_start(arguments, flags);
    const int mode = open_mode(flags, arguments);
    va_end(arguments);
    if (!fails(open_file)) return int(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
    errno = EMFILE;
    return -1;
}

ssize_t read(int fd, void* into, size_t bytes) {
    if (!fails(read_file)) return ::syscall(SYS_read, fd, into, bytes);
    errno = EIO;
    return -1;
}

ssize_t write(int fd, const void* from, size_t bytes) {
    if (!fails(write_file)) return ::syscall(SYS_write, fd, from, bytes);
    errno = ENOSPC;
    return -1;
}

int fsync(int fd) {
    if (!fails(sync_file)) return int(::syscall(SYS_fsync, fd));
    errno = EIO;
    return -1;
}

int rename(const char* from, const char* to) {
    if (!fails(rename_file)) return next(&rename, "rename")(from, to);
    errno = EACCES;
    return -1;
}

int pthread_create(pthread_t* created, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) {
    if (!fails(thread)) return next(&pthread_create, "pthread_create")(created, attributes, run, argument);
    return EAGAIN;
}

}  // extern "C"
