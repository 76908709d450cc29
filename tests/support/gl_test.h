// OpenGL in tests: contexts that watch for errors, and pictures that are compared to the byte.
#pragma once

#include "render/gl/gl_context.h"
#include "render/gl/gl_objects.h"
#include "render/gl/headless_context.h"
#include "render/image/image.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <memory>
#include <utility>

namespace ramus::test {

// An OSMesa context that is current. What OpenGL complains of while it lives fails the test: debug messages of errors
// and of high severity, or glGetError() where there are none.
class WatchedContext {
public:
    // `newest`: the context counts as no newer.
    explicit WatchedContext(render::GlVersion newest = {99, 0}) : WatchedContext(newest, render::make_osmesa_context) {}
    template <class Make>
    WatchedContext(render::GlVersion newest, const Make& make) : newest_(newest), errors_(render::gl_error_count()) {
        render::limit_gl_version(newest);
        auto made = make();
        render::limit_gl_version({99, 0});
        REQUIRE_MESSAGE(made.has_value(), (made ? "" : made.error().message()));
        context_ = std::move(*made);
    }
    ~WatchedContext() {
        const int errors = render::gl_error_count() - errors_;
        CHECK_MESSAGE(errors == 0, render::gl_last_error());
    }
    WatchedContext(const WatchedContext&) = delete;
    WatchedContext& operator=(const WatchedContext&) = delete;
    [[nodiscard]] Result<void> make_current() {
        render::limit_gl_version(newest_);
        auto current = context_->make_current();
        render::limit_gl_version({99, 0});
        return current;
    }
    WatchedContext* operator->() { return this; }

private:
    render::GlVersion newest_;
    int errors_;
    std::unique_ptr<render::GlContext> context_;
};

// Of two pictures of one size, of 255; 256: of different sizes.
inline int largest_difference(const render::Image& a, const render::Image& b) {
    if (a.width != b.width || a.height != b.height) return 256;
    int largest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
    return largest;
}

} // namespace ramus::test
