// ListsByThread: a list for each thread, for the results of parallel work without locks. sorted() merges the lists in
// an order that does not depend on the threads.
#pragma once

#include <algorithm>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <vector>

namespace ramus {

template <class T> class ListsByThread {
public:
    [[nodiscard]] std::vector<T>& local() { return lists_.local(); } // the list of the calling thread
    // The values of all lists, ascending. No thread may change its list meanwhile.
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
