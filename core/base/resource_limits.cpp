#include "core/base/resource_limits.h"

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <pthread.h>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace ramus {

namespace {

constexpr std::size_t kUsualStack = std::size_t{8} << 20; // bytes, the default of Linux

struct Begun {
    const std::function<int()>* work;
    int status = EXIT_FAILURE;
};

void* run_begun(void* what) {
    auto& begun = *static_cast<Begun*>(what);
    begun.status = (*begun.work)();
    return nullptr;
}

const char* out_of_memory_message = ""; // composed in advance, while there is memory

extern "C" void report_out_of_memory(int /*number*/) {
    [[maybe_unused]] const ssize_t ignored =
        ::write(STDERR_FILENO, out_of_memory_message, std::strlen(out_of_memory_message));
    ::_exit(EXIT_FAILURE);
}

} // namespace

int run_with_usual_stacks(const std::function<int()>& work) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kUsualStack) return work();
    pthread_attr_t attributes;
    ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, kUsualStack);
    ::pthread_setattr_default_np(&attributes);
    Begun begun{&work};
    pthread_t thread{};
    const int code = ::pthread_create(&thread, &attributes, run_begun, &begun);
    ::pthread_attr_destroy(&attributes);
    if (code != 0) {
        std::fprintf(stderr, "ramus: no thread can be started: %s; raise the limits of stacks and memory (ulimit)\n",
                     std::strerror(code));
        return EXIT_FAILURE;
    }
    // The other threads handle signals.
    sigset_t all;
    sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
    ::pthread_join(thread, nullptr);
    return begun.status;
}

void explain_out_of_memory() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    static const std::string text =
        "ramus: most likely a library needed more memory than the " + std::to_string(limit.rlim_cur >> 20U) +
        " MiB that this process may have; nothing was written. Raise the limit (ulimit -v)\n";
    out_of_memory_message = text.c_str();
    for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGILL, SIGFPE}) std::signal(number, report_out_of_memory);
}

} // namespace ramus
