#include "core/base/child_program.h"

#include "core/base/descriptor.h"
#include "core/base/printable.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace ramus {

namespace {

namespace fs = std::filesystem;

constexpr int kCannotStart = 127; // status, as shells have it

tl::unexpected<Error> cannot_start(const std::string& program, int reason) {
    return fail(program + " cannot be started: " + std::strerror(reason), {}, "check that it is installed");
}

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> all;
    for (std::string& word : words) all.push_back(word.data());
    all.push_back(nullptr);
    return all;
}

std::vector<std::string> environment_with(const std::vector<std::string>& more) {
    std::vector<std::string> all;
    for (char** each = environ; each != nullptr && *each != nullptr; ++each) {
        const std::string_view own = *each;
        const auto same_name = [&](const std::string& one) {
            return own.starts_with(std::string_view(one).substr(0, one.find('=') + 1));
        };
        if (std::ranges::none_of(more, same_name)) all.emplace_back(own);
    }
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

// The arguments of execve() and what the new process needs before it.
struct Start {
    const char* program;
    char* const* words;
    char* const* environment;
    int input = -1, says = -1;   // descriptors of standard input and error; -1: /dev/null
    bool ends_with_this = false; // gets SIGTERM when the thread that starts it ends
};

// The entry point of the new process. It shares its parent's memory, so nothing here may allocate or lock. Returns only
// if execve() fails.
int become(void* what) {
    const Start& start = *static_cast<const Start*>(what);
    if (start.ends_with_this) ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    ::dup2(start.input >= 0 ? start.input : nowhere, STDIN_FILENO);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(start.says >= 0 ? start.says : nowhere, STDERR_FILENO);
    ::execve(start.program, start.words, start.environment);
    return kCannotStart;
}

using Stack = std::vector<std::byte>;
constexpr std::size_t kStackBytes = std::size_t{1} << 16; // a multiple of the alignment of stacks

// Starts a process that shares this one's memory; the calling thread waits until the process calls execve() or ends.
// fork(2) would copy the page tables, and block every thread that needs a page meanwhile: 0.15 s with a large surface.
pid_t clone_in(Stack& stack, int (*run)(void*), void* what) {
    return ::clone(run, stack.data() + stack.size(), CLONE_VM | CLONE_VFORK | SIGCHLD, what);
}

// Blocks signals until execve(): a handler in the child would run in the memory of both processes.
pid_t start_process(int (*run)(void*), void* what) {
    Stack stack(kStackBytes);
    sigset_t all, before;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t process = clone_in(stack, run, what);
    const int reason = errno;
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    errno = reason;
    return process;
}

// A program whose parent has ended, so that nobody has to wait for it.
struct Orphan {
    Start start;
    Stack stack;
};

int leave(void* what) {
    auto& orphan = *static_cast<Orphan*>(what);
    ::setsid();
    return clone_in(orphan.stack, become, &orphan.start) > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

fs::path path_of(const std::string& program) {
    return program.find('/') == std::string::npos ? find_program(program) : fs::path(program);
}

} // namespace

fs::path find_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::string_view rest = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
    while (!rest.empty()) {
        const std::size_t end = rest.find(':');
        fs::path one = fs::path(rest.substr(0, end)) / name;
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        std::error_code ignored;
        if (one.is_absolute() && fs::is_regular_file(one, ignored) && ::access(one.c_str(), X_OK) == 0) return one;
    }
    return {};
}

Result<ChildProgram> ChildProgram::start(const std::vector<std::string>& words,
                                         const std::vector<std::string>& environment) {
    const fs::path program = path_of(words.front());
    if (program.empty()) return cannot_start(words.front(), ENOENT);
    std::array<int, 2> input{}, says{};
    // A socket, because writing to a program that has ended must be an error, and no signal.
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input.data()) != 0)
        return cannot_start(program.string(), errno);
    if (::pipe2(says.data(), O_CLOEXEC) != 0) {
        const int reason = errno;
        for (const int end : input) ::close(end);
        return cannot_start(program.string(), reason);
    }
    std::vector<std::string> own_words = words, own_environment = environment_with(environment);
    const auto word_pointers = pointers(own_words), environment_pointers = pointers(own_environment);
    Start start{program.c_str(), word_pointers.data(), environment_pointers.data(), input[1], says[1], true};
    const pid_t process = start_process(become, &start);
    const int reason = errno;
    ::close(input[1]);
    ::close(says[1]);
    if (process > 0) return ChildProgram(process, input[0], says[0]);
    ::close(input[0]);
    ::close(says[0]);
    return cannot_start(program.string(), reason);
}

ChildProgram::ChildProgram(ChildProgram&& other) noexcept
    : process_(std::exchange(other.process_, -1)), input_(std::exchange(other.input_, -1)),
      words_(std::exchange(other.words_, -1)) {}

ChildProgram::~ChildProgram() {
    close_input();
    if (words_ >= 0) ::close(words_);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    (void)reap();
}

void ChildProgram::close_input() {
    if (input_ >= 0) ::close(std::exchange(input_, -1));
}

int ChildProgram::reap() const {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

Result<void> ChildProgram::write(std::string_view bytes) const {
    if (!send_all(input_, bytes)) return fail("the program has closed its input");
    return {};
}

Result<void> ChildProgram::wait(Job& job, const Hear& hear) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::seconds kPolite{3}; // between SIGTERM and SIGKILL
    constexpr std::size_t kLongestLine = 4096;
    close_input();
    std::string line, complaint;
    const auto heard = [&] {
        if (!line.empty() && !(hear && hear(line))) complaint = line;
        line.clear();
    };
    Clock::time_point asked{};
    std::array<char, 4096> part{};
    while (true) {
        if (job.cancelled() && asked == Clock::time_point{}) {
            asked = Clock::now();
            ::kill(process_, SIGTERM);
        }
        if (asked != Clock::time_point{} && Clock::now() > asked + kPolite) ::kill(process_, SIGKILL);
        pollfd ready{words_, POLLIN, 0};
        if (::poll(&ready, 1, 50) <= 0) continue;
        const ssize_t count = ::read(words_, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        for (const char c : std::string_view(part.data(), static_cast<std::size_t>(count)))
            if (c == '\n' || line.size() >= kLongestLine)
                heard();
            else
                line += c;
    }
    heard();
    const int status = reap();
    process_ = -1;
    if (job.cancelled()) return fail("cancelled");
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    if (!complaint.empty()) return fail(printable(complaint));
    return fail(WIFEXITED(status) ? "the program ended with status " + std::to_string(WEXITSTATUS(status))
                                  : "the program was ended by signal " + std::to_string(WTERMSIG(status)));
}

Result<void> start_and_leave(const std::vector<std::string>& words) {
    const fs::path program = path_of(words.front());
    if (program.empty()) return cannot_start(words.front(), ENOENT);
    std::vector<std::string> own_words = words;
    const auto word_pointers = pointers(own_words);
    Orphan orphan{{program.c_str(), word_pointers.data(), environ}, Stack(kStackBytes)};
    const pid_t between = start_process(leave, &orphan); // leaves nothing to wait for
    if (between < 0) return cannot_start(program.string(), errno);
    int status = 0;
    while (::waitpid(between, &status, 0) < 0 && errno == EINTR) {
    }
    return {};
}

} // namespace ramus
