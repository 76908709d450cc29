// Turns running out of memory, on the graphics card or on the processor, into an Error.
#pragma once

#include "core/base/error.h"
#include "render/gl/gl_objects.h"

#include <new>
#include <string>

namespace ramus::render {

// Returns the Result of `work()`. If it throws for lack of memory, calls `release()` and returns an Error with this
// hint.
template <class Release, class Work>
auto within_memory(const std::string& hint, const Release& release, const Work& work) -> decltype(work()) {
    try {
        return work();
    } catch (const OutOfGraphicsMemory& error) {
        release();
        return fail(error.what(), {}, hint);
    } catch (const std::bad_alloc&) {
        release();
        return fail("not enough memory for this picture", {}, hint);
    }
}

} // namespace ramus::render
