// ChunkedArray: plain values in chunks, for long arrays of which only a part is in use at a time. Growing moves no
// value, and the chunks of values that are done with serve those that come next, while they are still in the caches.
#pragma once

#include "core/base/large_array.h"

#include <cassert>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace ramus {

template <class T> class ChunkedArray {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    // How many there may be; they have no memory yet.
    void resize(std::size_t count) {
        count_ = count;
        chunks_.resize((count + kChunk - 1) / kChunk);
    }
    // Memory for the values from `first` up to `end`, unset where they have none. For one thread.
    void provide(std::size_t first, std::size_t end) {
        assert(end <= count_);
        for (std::size_t c = first / kChunk; c * kChunk < end; ++c) {
            if (chunks_[c].values != nullptr) continue;
            if (spare_.empty()) add_spare();
            chunks_[c].values = spare_.back();
            spare_.pop_back();
        }
    }
    // These are done with, each for the first time. For one thread.
    void release(std::size_t first, std::size_t end) {
        assert(end <= count_);
        while (first < end) {
            Chunk& chunk = chunks_[first / kChunk];
            const std::size_t next = first - first % kChunk + kChunk < end ? first - first % kChunk + kChunk : end;
            chunk.released += next - first;
            if (chunk.released == kChunk) spare_.push_back(chunk.values);
            first = next;
        }
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] T& operator[](std::size_t n) { return chunks_[n / kChunk].values[n % kChunk]; }
    [[nodiscard]] const T& operator[](std::size_t n) const { return chunks_[n / kChunk].values[n % kChunk]; }

private:
    static constexpr std::size_t kChunk = 512;
    static constexpr std::size_t kBlock = std::size_t{4} << 20; // bytes
    static constexpr std::size_t kChunksPerBlock = kBlock / (kChunk * sizeof(T));
    static_assert(kChunksPerBlock > 0);
    struct Chunk {
        T* values = nullptr;
        std::size_t released = 0;
    };

    void add_spare() {
        memory_.emplace_back(kBlock);
        T* const values = reinterpret_cast<T*>(memory_.back().data());
        for (std::size_t c = kChunksPerBlock; c-- > 0;) spare_.push_back(values + c * kChunk);
    }

    std::vector<LargeArray<std::byte>> memory_;
    std::vector<Chunk> chunks_;
    std::vector<T*> spare_;
    std::size_t count_ = 0;
};

} // namespace ramus
