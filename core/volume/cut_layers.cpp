#include "core/volume/cut_layers.h"

namespace ramus::volume {

namespace {

// Allocates all rows of a slice and the two outside rows. The caller must write every word.
void make_room(Cuts& cuts, const BitMask& mask) {
    const std::size_t words = mask.row_words() * (static_cast<std::size_t>(mask.size().y) + 2);
    cuts.words.resize(words);
    cuts.before.resize(words);
}

void put(Cuts& cuts, std::size_t at, std::uint64_t word, std::uint64_t& count) {
    cuts.words[at] = word;
    cuts.before[at] = static_cast<std::uint32_t>(count); // with more than 32 bits of cut edges there is no mesh
    if (word != 0) count += count_bits(word);
}

} // namespace

void SliceCuts::find(const PaddedRows& rows, int k) {
    const BitMask& mask = rows.mask();
    make_room(x, mask);
    make_room(y, mask);
    count = 0;
    const std::size_t words = mask.row_words();
    for (int j = -1; j <= mask.size().y; ++j) {
        const std::uint64_t* here = rows.row(j, k);
        const std::uint64_t* next = rows.row(j + 1, k);
        const std::size_t first = static_cast<std::size_t>(j + 1) * words;
        for (std::size_t w = 0; w < words; ++w) put(x, first + w, here[w] ^ right_of(here, w, words), count);
        for (std::size_t w = 0; w < words; ++w) put(y, first + w, here[w] ^ next[w], count);
    }
}

void LayerCuts::find(const PaddedRows& rows, int k) {
    const BitMask& mask = rows.mask();
    make_room(z, mask);
    count = 0;
    const std::size_t words = mask.row_words();
    for (int j = -1; j <= mask.size().y; ++j) {
        const std::uint64_t* lower = rows.row(j, k);
        const std::uint64_t* upper = rows.row(j, k + 1);
        const std::size_t first = static_cast<std::size_t>(j + 1) * words;
        for (std::size_t w = 0; w < words; ++w) put(z, first + w, lower[w] ^ upper[w], count);
    }
}

} // namespace ramus::volume
