#include "core/base/give_way.h"

#include <sys/resource.h>
#include <unistd.h>

namespace ramus {

namespace {

constexpr int kBehind = 10; // niceness: a tenth of the time of a thread beside it that wants all

} // namespace

#ifdef __linux__
void give_way() {
    if (!gives_way()) (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kBehind);
}

bool gives_way() { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())) >= kBehind; }
#else
void give_way() {}
bool gives_way() { return false; }
#endif

} // namespace ramus
