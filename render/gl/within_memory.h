// Turns running out of memory, on the graphics card or on the processor, into an Error.
#pragma once

#include "core/base/error.h"
#include "render/gl/gl_objects.h"

#include <new>
#include <string>

namespace ramus::render {

// Returns the Result of `work()`. If it throws for lack of memory, calls `let_go()` and returns an Error with this
// hint.
template <class LetGo, class Work>
auto within_memory(const std::string& hint, const LetGo& let_go, const Work& work) -> decltype(work()) {
    try {
        return work();
    } catch (const OutOfGraphicsMemory& error) {
        let_go();
        return fail(error.what(), {}, hint);
    } catch (const std::bad_alloc&) {
        let_go();
        return fail("not enough memory for this picture", {}, hint);
    }
}

} // namespace ramus::render
