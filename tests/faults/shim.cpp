// A library for LD_PRELOAD that makes system calls fail: those on files below a folder, and on stdout and stderr.
//
//   FAULT_UNDER  the folder, as the program is given it
//   FAULT        CALL:N:HOW, the N-th call of a kind; CALL:N+:HOW, all from the N-th on; every:EINTR, each call but
//                truncate once before it is done; every:short, each write and read of more than a byte does half
//   FAULT_COUNT  a file for the numbers of calls, a line "CALL N" each, when the program ends by itself
//   FAULT_RANK   only in the process that Open MPI gave this rank
//
// CALL: write, read, fsync, rename, open, close, mkdir, truncate; data and words are writes to stdout and stderr. HOW:
// a name of an error number, `short` (half of the bytes), or `kill` (SIGKILL instead of the call). A failing close
// closes, as Linux's does. Programs that the process starts are left alone.

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

namespace {

enum Call : std::size_t { write_, read_, fsync_, rename_, open_, close_, mkdir_, truncate_, data_, words_, calls };
constexpr std::array<std::string_view, calls> names{"write", "read",  "fsync",    "rename", "open",
                                                    "close", "mkdir", "truncate", "data",   "words"};

/// Numbers that a fault may have besides an error number.
constexpr int none = 0, half = -1, death = -2;

int number_of(std::string_view how) {
  constexpr std::array<std::pair<std::string_view, int>, 10> all{{{"short", half},
                                                                  {"kill", death},
                                                                  {"EINTR", EINTR},
                                                                  {"EIO", EIO},
                                                                  {"ENOSPC", ENOSPC},
                                                                  {"EDQUOT", EDQUOT},
                                                                  {"EMFILE", EMFILE},
                                                                  {"EACCES", EACCES},
                                                                  {"EPIPE", EPIPE},
                                                                  {"EROFS", EROFS}}};
  for (const auto& [name, number] : all)
    if (name == how) return number;
  std::fprintf(stderr, "FAULT: unknown %s\n", std::string(how).c_str());
  std::abort();
}

std::string text_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr ? value : "";
}

struct Plan {
  bool active = false;
  std::string under, count_file;
  std::size_t call = calls;  ///< `calls`: none
  unsigned long first = 0, last = 0;
  int how = none;
  int every = none;
  std::array<std::atomic<unsigned long>, calls> counts{};
  std::array<std::atomic<bool>, 65536> ours{};  ///< by descriptor: of a file below the folder

  Plan() {
    const std::string rank = text_of("FAULT_RANK");
    under = text_of("FAULT_UNDER");
    count_file = text_of("FAULT_COUNT");
    ::unsetenv("LD_PRELOAD");
    active = !under.empty() && (rank.empty() || rank == text_of("OMPI_COMM_WORLD_RANK"));
    const std::string fault = text_of("FAULT");
    if (fault.empty()) return;
    const std::string name = fault.substr(0, fault.find(':'));
    const std::string rest = fault.substr(name.size() + 1);
    if (name == "every") {
      every = number_of(rest);
      return;
    }
    const std::size_t colon = rest.find(':');
    how = number_of(rest.substr(colon + 1));
    first = std::strtoul(rest.c_str(), nullptr, 10);
    last = rest[colon - 1] == '+' ? ~0UL : first;
    for (call = 0; names.at(call) != name;) ++call;
  }

  ~Plan() {
    if (!active || count_file.empty()) return;
    active = false;
    if (std::FILE* file = std::fopen(count_file.c_str(), "w")) {
      for (std::size_t k = 0; k < calls; ++k) std::fprintf(file, "%s %lu\n", names[k].data(), counts[k].load());
      std::fclose(file);
    }
  }
};

Plan& plan() {
  static Plan instance;
  return instance;
}

/// Before main, so that no thread is there yet.
[[maybe_unused]] const bool made = plan().active || true;

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool is_below(const char* path) {
  const std::string& under = plan().under;
  return plan().active && std::strncmp(path, under.c_str(), under.size()) == 0 &&
         (path[under.size()] == '/' || path[under.size()] == '\0');
}

bool is_ours(int descriptor) {
  return plan().active && descriptor >= 0 && descriptor < 65536 && plan().ours[static_cast<std::size_t>(descriptor)];
}

void set_ours(int descriptor, bool ours) {
  if (descriptor >= 0 && descriptor < 65536) plan().ours[static_cast<std::size_t>(descriptor)] = ours;
}

/// What becomes of this call: none, half, or an error number; does not return if it is death.
int fate(Call call, bool counts) {
  Plan& p = plan();
  if (!p.active || !counts) return none;
  const unsigned long number = ++p.counts[call];
  if (p.every == EINTR) {
    if (call == truncate_) return none;  // HDF5 does not repeat it
    thread_local std::array<bool, calls> interrupted{};
    return (interrupted[call] = !interrupted[call]) ? EINTR : none;
  }
  if (p.every != none) return p.every;
  if (p.call != call || number < p.first || number > p.last) return none;
  if (p.how == death) ::kill(::getpid(), SIGKILL);
  return p.how;
}

Call kind_of_write(int descriptor) {
  return descriptor == STDOUT_FILENO ? data_ : descriptor == STDERR_FILENO ? words_ : write_;
}

bool is_seen(int descriptor) {
  return is_ours(descriptor) || descriptor == STDOUT_FILENO || descriptor == STDERR_FILENO;
}

/// Bytes for the real call, or -1 with errno set.
ssize_t allowed(Call call, bool counts, std::size_t bytes) {
  const int what = fate(call, counts);
  if (what == half && bytes > 1) return static_cast<ssize_t>(bytes / 2);
  if (what <= none) return static_cast<ssize_t>(bytes);
  errno = what;
  return -1;
}

/// @returns true if the call is not to be made
bool fails(Call call, bool counts) {
  const int what = fate(call, counts);
  if (what <= none) return false;
  errno = what;
  return true;
}

template <class Open>
int opened(const char* path, const Open& open) {
  const bool below = is_below(path);
  if (fails(open_, below)) return -1;
  const int descriptor = open();
  if (descriptor >= 0) set_ours(descriptor, below);
  return descriptor;
}

mode_t mode_of(int flags, va_list arguments) {
  return (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

// The C library's names: what the program and its libraries call. Parameters are the standard's.
extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return opened(path, [&] { return real<int(const char*, int, ...)>("open")(path, flags, mode); });
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return opened(path, [&] { return real<int(const char*, int, ...)>("open64")(path, flags, mode); });
}

int close(int descriptor) {
  const bool counts = is_ours(descriptor);
  set_ours(descriptor, false);
  const int what = fate(close_, counts);
  const int result = real<int(int)>("close")(descriptor);
  if (what <= none) return result;
  errno = what;
  return -1;
}

ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  const ssize_t some = allowed(kind_of_write(descriptor), is_seen(descriptor), count);
  return some < 0
             ? -1
             : real<ssize_t(int, const void*, std::size_t)>("write")(descriptor, bytes, static_cast<std::size_t>(some));
}

ssize_t pwrite(int descriptor, const void* bytes, std::size_t count, off_t at) {
  const ssize_t some = allowed(write_, is_ours(descriptor), count);
  return some < 0 ? -1
                  : real<ssize_t(int, const void*, std::size_t, off_t)>("pwrite")(descriptor, bytes,
                                                                                  static_cast<std::size_t>(some), at);
}

ssize_t pwrite64(int descriptor, const void* bytes, std::size_t count, off64_t at) {
  return pwrite(descriptor, bytes, count, at);
}

ssize_t read(int descriptor, void* bytes, std::size_t count) {
  const ssize_t some = allowed(read_, is_ours(descriptor), count);
  return some < 0 ? -1
                  : real<ssize_t(int, void*, std::size_t)>("read")(descriptor, bytes, static_cast<std::size_t>(some));
}

ssize_t pread(int descriptor, void* bytes, std::size_t count, off_t at) {
  const ssize_t some = allowed(read_, is_ours(descriptor), count);
  return some < 0 ? -1
                  : real<ssize_t(int, void*, std::size_t, off_t)>("pread")(descriptor, bytes,
                                                                           static_cast<std::size_t>(some), at);
}

ssize_t pread64(int descriptor, void* bytes, std::size_t count, off64_t at) {
  return pread(descriptor, bytes, count, at);
}

int fsync(int descriptor) { return fails(fsync_, is_ours(descriptor)) ? -1 : real<int(int)>("fsync")(descriptor); }

int ftruncate(int descriptor, off_t size) noexcept {
  return fails(truncate_, is_ours(descriptor)) ? -1 : real<int(int, off_t)>("ftruncate")(descriptor, size);
}

int ftruncate64(int descriptor, off64_t size) noexcept { return ftruncate(descriptor, size); }

int rename(const char* from, const char* to) noexcept {
  return fails(rename_, is_below(to)) ? -1 : real<int(const char*, const char*)>("rename")(from, to);
}

int mkdir(const char* path, mode_t mode) noexcept {
  return fails(mkdir_, is_below(path)) ? -1 : real<int(const char*, mode_t)>("mkdir")(path, mode);
}

}  // extern "C"
