// Whole pages from the system, for arrays of plain values. Long stretches have pages of 2 MB: the first touch of a page
// costs as much as filling it, and one of these spares 511 of 512. What is given back is kept for what is asked for
// next, so that a surface made anew is written where the one before it was; the system may take kept pages whenever it
// is short. Keeping adds nothing to the peak: fresh pages come only after as many kept ones have gone.
#pragma once

#include <cstddef>

namespace ramus {

// At least so many bytes of any content; throws std::bad_alloc. Untouched, they take no memory.
[[nodiscard]] void* take_pages(std::size_t bytes);
void give_pages_back(void* memory, std::size_t bytes);
// Pages from take_pages() as part of a longer stretch, elsewhere maybe; throws std::bad_alloc.
[[nodiscard]] void* stretch_pages(void* memory, std::size_t bytes, std::size_t more_bytes);
// Whole pages among these bytes go back to the system; what was in them is lost. They may be written again.
void empty_pages(void* memory, std::size_t bytes);

// Pages of zeros, none of them large; throws std::bad_alloc.
[[nodiscard]] void* take_zero_pages(std::size_t bytes);
void give_zero_pages_back(void* memory, std::size_t bytes);

// What is kept for what is asked for next: how many bytes of memory it takes now; all of it back to the system.
[[nodiscard]] std::size_t kept_page_bytes();
void let_kept_pages_go();

} // namespace ramus
