// Whole pages mapped from the system, for arrays of plain values that grow without being copied, or of which much is
// never written or given up early. Untouched, they take no memory; what is mapped is zero.
#pragma once

#include <cstddef>

namespace ramus {

// kSparse: small pages only, for one value in a large page would fill all of it.
enum class PageUse { kDense, kSparse };

// At least so many bytes; throws std::bad_alloc.
[[nodiscard]] void* map_pages(std::size_t bytes, PageUse use);
// The same as part of more, elsewhere maybe; throws std::bad_alloc.
[[nodiscard]] void* remap_pages(void* memory, std::size_t bytes, std::size_t more_bytes);
void unmap_pages(void* memory, std::size_t bytes);
// Whole pages among these bytes, of whatever memory, go back to the system; what was in them is lost. They may be
// written again.
void empty_pages(void* memory, std::size_t bytes);

} // namespace ramus
