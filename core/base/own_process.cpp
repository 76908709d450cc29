#include "core/base/own_process.h"

#include "core/base/confinement.h"
#include "core/base/descriptor.h"
#include "core/base/fork_server.h"
#include "core/base/process_answer.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <string_view>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ramus {

namespace {

constexpr char kComplete = '.'; // the last byte of a complete answer

std::uint64_t own_address_space() {
    std::ifstream statm("/proc/self/statm");
    std::uint64_t pages = 0;
    statm >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limit(decltype(RLIMIT_AS) what, std::uint64_t most) {
    const rlimit both{most, most};
    ::setrlimit(what, &both);
}

} // namespace

void work_and_end(OwnWork work, std::string_view input, const ProcessLimits& limits, int answer, pid_t parent) {
    // Crashes are expected, so they must be silent: without the signal handlers of this program.
    for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGPIPE})
        std::signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (nowhere < 0 || ::dup2(nowhere, standard) < 0) std::_Exit(EXIT_FAILURE);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.seconds);
    if (const std::uint64_t now = own_address_space(); now > 0) limit(RLIMIT_AS, now + limits.memory);
    confine_this_process(answer, parent);
    bool done = false;
    try {
        done = send_all(answer, work(input) + kComplete);
    } catch (...) { // most likely out of memory
        done = false;
    }
    std::_Exit(done ? EXIT_SUCCESS : EXIT_FAILURE); // flushes no buffer that is a copy of the parent's
}

Result<std::string> read_answer(int descriptor, const ProcessLimits& limits) {
    std::string answer;
    std::array<char, 1 << 16> part{};
    while (true) {
        const ssize_t count = ::read(descriptor, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        answer.append(part.data(), static_cast<std::size_t>(count));
        if (answer.size() > limits.answer + 1) // with kComplete
            return fail("the answer of a helper process is too long");
    }
    if (!answer.ends_with(kComplete)) return fail("a helper process ended early");
    answer.pop_back();
    return answer;
}

Result<std::string> run_in_own_process(OwnWork work, std::string_view input, const ProcessLimits& limits) {
    if (auto answer = run_at_fork_server(work, input, limits)) return std::move(*answer);
    std::array<int, 2> ends{};
    const auto cannot = [] {
        return fail(std::string("a helper process cannot be started: ") + std::strerror(errno), {}, "free some memory");
    };
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return cannot();
    const Descriptor own(ends[0]);
    Descriptor other(ends[1]);
    const pid_t self = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) return cannot();
    if (child == 0) work_and_end(work, input, limits, other.number(), self);
    other.close();
    auto answer = read_answer(own.number(), limits);
    if (!answer) ::kill(child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return answer;
}

} // namespace ramus
