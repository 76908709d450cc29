// ListsByThread: what several threads find, each in a list of its own, put together in an order that does not depend on
// them.
#pragma once

#include <algorithm>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <vector>

namespace ramus {

template <class T> class ListsByThread {
public:
    [[nodiscard]] std::vector<T>& local() { return lists_.local(); } // of the thread that asks
    // All of them, ascending, once no thread adds to its own.
    [[nodiscard]] std::vector<T> sorted() const {
        std::vector<T> all;
        for (const std::vector<T>& list : lists_) all.insert(all.end(), list.begin(), list.end());
        std::sort(all.begin(), all.end());
        return all;
    }

private:
    tbb::enumerable_thread_specific<std::vector<T>> lists_;
};

} // namespace ramus
