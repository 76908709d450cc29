// sort_unique(): ascending, each thing once.
#pragma once

#include <algorithm>
#include <vector>

namespace ramus {

template <class T> void sort_unique(std::vector<T>& things) {
    std::sort(things.begin(), things.end());
    things.erase(std::unique(things.begin(), things.end()), things.end());
}

} // namespace ramus
