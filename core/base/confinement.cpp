#include "core/base/confinement.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace ramus {

namespace {

// System calls that are harmless with any arguments, given the remaining descriptors.
constexpr std::array kComputing{
    // Memory.
    SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(mincore),
    // The answer, and what libraries ask of open files.
    SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(write), SCMP_SYS(writev), SCMP_SYS(close),
    SCMP_SYS(lseek), SCMP_SYS(fstat),
    // Locks and time.
    SCMP_SYS(futex), SCMP_SYS(sched_yield), SCMP_SYS(clock_gettime), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep),
    SCMP_SYS(gettimeofday), SCMP_SYS(time), SCMP_SYS(getrandom),
    // Its own signals and identity.
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack), SCMP_SYS(getpid),
    SCMP_SYS(gettid), SCMP_SYS(getppid), SCMP_SYS(sched_getaffinity), SCMP_SYS(sysinfo), SCMP_SYS(uname),
    // The end.
    SCMP_SYS(exit), SCMP_SYS(exit_group)};

// The undefined behaviour sanitizer tests whether memory is readable by writing it into a pipe.
#ifdef __SANITIZE_ADDRESS__
constexpr std::array kOfSanitizers{SCMP_SYS(pipe), SCMP_SYS(pipe2)};
#else
constexpr std::array<int, 0> kOfSanitizers{};
#endif

using Filter = std::unique_ptr<void, decltype(&seccomp_release)>;

bool allow_computing(scmp_filter_ctx filter, int descriptor) {
    const auto allow = [&](int call, auto... conditions) {
        return seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, sizeof...(conditions), conditions...) == 0;
    };
    bool good = true;
    for (const int call : kComputing) good = allow(call) && good;
    for (const int call : kOfSanitizers) good = allow(call) && good;
    for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)})
        good = allow(call, SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)) && good;
    // For abort() and raise(), but no signal to another process. Limits can only be read, and only its own.
    const auto own = static_cast<scmp_datum_t>(::getpid());
    good = allow(SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_EQ, own)) && good;
    good = allow(SCMP_SYS(prlimit64), SCMP_A0(SCMP_CMP_EQ, 0), SCMP_A2(SCMP_CMP_EQ, 0)) && good;
    // Only on the descriptor of the answer, and to no address.
    return allow(SCMP_SYS(sendto), SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(descriptor)),
                 SCMP_A4(SCMP_CMP_EQ, 0)) &&
           good;
}

void refuse_all_but_computing(int descriptor) {
    const Filter filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)), &seccomp_release);
    if (!filter || !allow_computing(filter.get(), descriptor)) std::_Exit(EXIT_FAILURE);
    // Fails on a kernel without seccomp, and in a process that is already confined and may not confine itself.
    (void)seccomp_load(filter.get());
}

void close_all_but(int descriptor) {
    constexpr auto kFirst = static_cast<unsigned>(STDERR_FILENO + 1);
    const auto kept = static_cast<unsigned>(descriptor);
    if (kept > kFirst) ::close_range(kFirst, kept - 1, 0);
    ::close_range(kept + 1, ~0U, 0);
}

} // namespace

void confine_this_process(int descriptor, pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) std::_Exit(EXIT_FAILURE); // the parent ended before the line above took effect
    close_all_but(descriptor);
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    refuse_all_but_computing(descriptor);
}

} // namespace ramus
