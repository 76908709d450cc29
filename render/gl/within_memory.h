// What is made for a picture may take more memory than there is, on the graphics card or beside it: then what there was
// of it is let go, and an error says so.
#pragma once

#include "core/base/error.h"
#include "render/gl/gl_objects.h"

#include <new>
#include <string>

namespace ramus::render {

// The Result of `work()`; where that throws for want of memory, an error with this hint, after `let_go()`.
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
