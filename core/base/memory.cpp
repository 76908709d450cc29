#include "core/base/memory.h"

#include "core/base/pages.h"

#include <algorithm>
#include <fstream>
#include <unistd.h>

namespace ramus {

double memory_limit(double asked) {
    if (asked > 0.0) return asked;
    return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

double process_memory() {
    std::ifstream statm("/proc/self/statm");
    double total = 0.0;
    double resident = 0.0;
    if (!(statm >> total >> resident)) return 0.0;
    return std::max(0.0,
                    resident * static_cast<double>(sysconf(_SC_PAGE_SIZE)) - static_cast<double>(kept_page_bytes()));
}

} // namespace ramus
