#include "core/volume/voxel_runs.h"

namespace ramus::volume {

template <class T> void RunsOf<T>::add(Value value, std::size_t count) {
    while (count > 0) {
        const std::size_t within = size_ % kBlock;
        if (within == 0) firsts_.push_back(runs_.size());
        if (within == 0 || runs_.back().value != value) runs_.push_back({static_cast<std::uint16_t>(within), value});
        const std::size_t part = std::min(count, kBlock - within);
        size_ += part;
        count -= part;
    }
}

template <class T> std::size_t RunsOf<T>::run_at(std::size_t n) const {
    const std::size_t block = n / kBlock;
    const auto begin = runs_.begin() + static_cast<std::ptrdiff_t>(firsts_[block]);
    const auto end =
        block + 1 < firsts_.size() ? runs_.begin() + static_cast<std::ptrdiff_t>(firsts_[block + 1]) : runs_.end();
    const auto behind =
        std::upper_bound(begin, end, n % kBlock, [](std::size_t within, const Run& run) { return within < run.begin; });
    return static_cast<std::size_t>(behind - runs_.begin()) - 1;
}

template class RunsOf<std::uint16_t>;
template class RunsOf<float>;

} // namespace ramus::volume
