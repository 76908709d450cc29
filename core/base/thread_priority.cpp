#include "core/base/thread_priority.h"

#include <sys/resource.h>
#include <unistd.h>

namespace ramus {

namespace {

constexpr int kBehind = 10; // niceness; about a tenth of the time of a busy thread with niceness 0

} // namespace

#ifdef __linux__
void lower_thread_priority() {
    if (!has_low_priority()) (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kBehind);
}

bool has_low_priority() { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())) >= kBehind; }
#else
void lower_thread_priority() {}
bool has_low_priority() { return false; }
#endif

} // namespace ramus
