#include "core/base/own_process.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace ramus;

namespace {

int touched = 0;

std::string turned_round(std::string_view input) { return {input.rbegin(), input.rend()}; }
std::string touch(std::string_view input) {
    ++touched;
    return std::string(input);
}
std::string aborts(std::string_view) { std::abort(); }
std::string throws(std::string_view) { throw std::runtime_error("no"); }
std::string ends(std::string_view) { std::_Exit(0); } // without an answer
std::string dies(std::string_view) {
    ::raise(SIGKILL);
    return {};
}
std::string runs_for_ever(std::string_view) {
    volatile bool forever = true;
    while (forever) {
    }
    return {};
}
std::string doubled(std::string_view input) { return std::string(input).append(input); }
std::string takes_much(std::string_view) {
    const std::vector<char> much(std::size_t{1} << 30, 'x');
    return std::string(1, much.back());
}
std::string parent(std::string_view) { return std::to_string(::getppid()); }

// What of the things that a reader of files has no use for is not refused; `input`: a descriptor of the other process.
std::string breaks_out(std::string_view input) {
    std::string allowed;
    const auto attempt = [&](const char* what, long result) {
        if (result >= 0) allowed.append(what) += ' ';
    };
    attempt("reads a file", ::open("/etc/passwd", O_RDONLY));
    attempt("makes a file", ::open("/tmp/ramus-broke-out", O_WRONLY | O_CREAT, 0600));
    attempt("removes a file", ::unlink("/tmp/ramus-broke-out"));
    attempt("has a socket", ::socket(AF_INET, SOCK_STREAM, 0));
    attempt("has a local socket", ::socket(AF_UNIX, SOCK_STREAM, 0));
    attempt("forks", ::fork());
    pthread_t thread{};
    attempt("starts a thread", -::pthread_create(
                                   &thread, nullptr, [](void* nothing) { return nothing; }, nullptr));
    attempt("signals its parent", ::kill(::getppid(), 0));
    attempt("signals its parent's thread", ::syscall(SYS_tgkill, ::getppid(), ::getppid(), 0));
    attempt("follows its parent", ::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr));
    const rlimit no_files{0, 0};
    attempt("limits its parent", ::prlimit(::getppid(), RLIMIT_NOFILE, &no_files, nullptr));
    attempt("writes to its parent's file", ::write(std::stoi(std::string(input)), "x", 1));
    void* code = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    attempt("runs what it writes", code == MAP_FAILED ? -1 : 0);
    std::array<char*, 1> words{};
    attempt("becomes a program", ::execve("/bin/true", words.data(), words.data())); // returns only where it is refused
    return allowed;
}

void check_confined() {
    if (::prctl(PR_GET_SECCOMP) < 0) {
        MESSAGE("SKIPPED: this kernel has no seccomp");
        return;
    }
    std::array<int, 2> pipe{};
    REQUIRE(::pipe(pipe.data()) == 0);
    const auto allowed = run_in_own_process(breaks_out, std::to_string(pipe[1]), {});
    REQUIRE(allowed);
    CHECK(*allowed == "");
    for (const int end : pipe) ::close(end);
}

void check_own_processes() {
    std::string large(3'000'000, 'x');
    large[17] = '\0';
    const auto answer = run_in_own_process(turned_round, large, {});
    REQUIRE(answer);
    CHECK(*answer == std::string(large.rbegin(), large.rend()));
    const auto nothing = run_in_own_process(turned_round, {}, {});
    REQUIRE(nothing);
    CHECK(nothing->empty());

    REQUIRE(run_in_own_process(touch, "done", {}));
    CHECK(touched == 0);
    for (const OwnWork work : {aborts, throws, ends, dies}) CHECK_FALSE(run_in_own_process(work, large, {}));

    const ProcessLimits limits{.memory = 64U << 20, .seconds = 1, .answer = 1000};
    CHECK_FALSE(run_in_own_process(runs_for_ever, {}, limits));
    CHECK_FALSE(run_in_own_process(doubled, std::string(501, 'x'), limits));
    CHECK(run_in_own_process(doubled, std::string(500, 'x'), limits));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they end the process in their own way
    CHECK_FALSE(run_in_own_process(takes_much, {}, limits));
#endif
    std::vector<std::string> answers(8);
    {
        std::vector<std::jthread> threads;
        for (std::size_t n = 0; n < answers.size(); ++n)
            threads.emplace_back([&answers, &large, n] {
                const auto one = run_in_own_process(turned_round, std::to_string(n) + large, {});
                if (one) answers[n] = one->back();
            });
    }
    for (std::size_t n = 0; n < answers.size(); ++n) CHECK(answers[n] == std::to_string(n));
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool kForksItself = false; // the test program has a small process from the beginning (doctest_main.cpp)
#else
constexpr bool kForksItself = true;
#endif

pid_t parent_of_own_process() { return std::stoi(run_in_own_process(parent, {}, {}).value_or("0")); }

} // namespace

TEST_CASE("what happens in a process of its own stays there, and limits hold" * doctest::test_suite("slow")) {
    if (kForksItself) REQUIRE(parent_of_own_process() == ::getpid());
    check_own_processes();
    check_confined();
}

TEST_CASE("a small process forks in place of a large one, and where it is gone the large one does" *
          doctest::test_suite("slow")) {
    start_fork_server();
    const pid_t server = parent_of_own_process();
    REQUIRE(server > 0);
    REQUIRE(server != ::getpid());
    check_own_processes();
    check_confined();
    CHECK(parent_of_own_process() == server); // after all those crashes
    ::kill(server, SIGKILL);
    REQUIRE(::waitpid(server, nullptr, 0) == server);
    CHECK(parent_of_own_process() == ::getpid());
}

TEST_CASE("a process that forks for another ends with it, and keeps none of its files open") {
    std::array<int, 2> pipe{};
    REQUIRE(::pipe(pipe.data()) == 0);
    const pid_t large = ::fork();
    if (large == 0) {
        start_fork_server();
        const pid_t server = parent_of_own_process();
        std::_Exit(::write(pipe[1], &server, sizeof(server)) == sizeof(server) ? 0 : 1);
    }
    ::close(pipe[1]);
    pid_t server = 0;
    REQUIRE(::read(pipe[0], &server, sizeof(server)) == sizeof(server));
    const int watched =
        static_cast<int>(::syscall(SYS_pidfd_open, server, 0)); // none: it has ended already, and somebody has seen it
    char more = 0;
    CHECK(::read(pipe[0], &more, 1) == 0); // nobody writes to it any more
    ::waitpid(large, nullptr, 0);
    pollfd end{watched, POLLIN, 0};
    if (watched >= 0) CHECK(::poll(&end, 1, 10'000) == 1);
    ::close(pipe[0]);
    ::close(watched);
}

TEST_CASE("a process of its own ends with the one that waits for it, however that one ends" *
          doctest::skip(!kForksItself)) {
    const pid_t large = ::fork();
    if (large == 0) {
        if (const auto never = run_in_own_process(runs_for_ever, {}, {}); !never) std::_Exit(1);
        std::_Exit(0);
    }
    pid_t reader = 0;
    const std::string list = "/proc/" + std::to_string(large) + "/task/" + std::to_string(large) + "/children";
    for (int attempt = 0; attempt < 1000 && reader == 0; ++attempt) {
        std::ifstream(list) >> reader;
        if (reader == 0) ::poll(nullptr, 0, 10);
    }
    const int watched = reader > 0 ? static_cast<int>(::syscall(SYS_pidfd_open, reader, 0)) : -1;
    ::kill(large, SIGKILL);
    ::waitpid(large, nullptr, 0);
    REQUIRE(watched >= 0);
    pollfd end{watched, POLLIN, 0};
    CHECK(::poll(&end, 1, 10'000) == 1);
    ::close(watched);
}
