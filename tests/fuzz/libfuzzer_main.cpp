// What libFuzzer calls. The environment says which target: RAMUS_FUZZ_TARGET=swc.
#include "tests/fuzz/target.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <oneapi/tbb/global_control.h>
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>
#include <sanitizer/lsan_interface.h>

namespace {

using ramus::fuzz::Target;

const Target& chosen_target() {
    const char* name = std::getenv("RAMUS_FUZZ_TARGET");
    const auto& all = ramus::fuzz::targets();
    const auto found = std::ranges::find(all, std::string(name == nullptr ? "" : name), &Target::name);
    if (found != all.end()) return *found;
    for (const Target& target : all) std::puts(target.name.c_str());
    std::exit(name == nullptr ? EXIT_SUCCESS : EXIT_FAILURE);
}

// After every so many inputs, where libFuzzer does not do so after each. The report says where what leaks was
// allocated.
void look_for_leaks() {
    constexpr int kBetween = 1000;
    static int inputs = 0;
    if (++inputs % kBetween == 0 && __lsan_do_recoverable_leak_check() != 0) std::abort();
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Target& target = chosen_target();
    // What one input does must not depend on threads; and a process that is forked must find no lock of another thread.
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    target.run({reinterpret_cast<const char*>(data), size});
    look_for_leaks();
    return 0;
}

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerInitialize(int* /*count*/, char*** /*arguments*/) {
    (void)chosen_target();
    // What crashes in a process of its own is no finding: libFuzzer is not told.
    return pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });
}
