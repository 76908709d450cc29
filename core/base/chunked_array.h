// ChunkedArray: an array in chunks, for plain values of which only a part is in use at a time. No value ever moves. The
// chunks of released values are reused for the next ones, while they are still in the processor's caches.
//
//     array.resize(count);       // no memory yet
//     array.provide(0, 1000);    // memory for these, unset
//     array.release(0, 512);     // these will not be used again
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
    // Sets the number of values, without memory for them.
    void resize(std::size_t count) {
        count_ = count;
        chunks_.resize((count + kChunk - 1) / kChunk);
    }
    // Allocates memory for the values in [first, end) that have none, and leaves them unset. Not thread-safe.
    void provide(std::size_t first, std::size_t end) {
        assert(end <= count_);
        for (std::size_t c = first / kChunk; c * kChunk < end; ++c) {
            if (chunks_[c].values != nullptr) continue;
            if (spare_.empty()) add_spare();
            chunks_[c].values = spare_.back();
            spare_.pop_back();
        }
    }
    // Ends the use of the values in [first, end). Each value may be released once. A chunk is reused when all of its
    // values are released. Not thread-safe.
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
