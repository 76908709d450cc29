// sort_unique(): sorts a vector and removes duplicates.
#pragma once

#include <algorithm>
#include <vector>

namespace ramus {

template <class T, class Allocator> void sort_unique(std::vector<T, Allocator>& things) {
    std::sort(things.begin(), things.end());
    things.erase(std::unique(things.begin(), things.end()), things.end());
}

} // namespace ramus
