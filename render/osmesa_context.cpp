#include "render/osmesa_context.h"

#include <GL/osmesa.h>
#include <array>

namespace ramus::render {

namespace {

class OsMesaGlContext final : public GlContext {
public:
    explicit OsMesaGlContext(OSMesaContext context) : context_(context) {}
    ~OsMesaGlContext() override { OSMesaDestroyContext(context_); }

    Result<void> make_current() override {
        // OSMesa wants a colour buffer; nobody draws into it.
        if (OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide) == GL_FALSE)
            return fail("OSMesa could not make its context current", {}, "check the installation of libosmesa6");
        return load_gl([](const char* name) { return reinterpret_cast<GlFunction>(OSMesaGetProcAddress(name)); });
    }

private:
    static constexpr int kSide = 4;
    OSMesaContext context_;
    std::array<unsigned char, 4 * kSide * kSide> buffer_{};
};

} // namespace

Result<std::unique_ptr<GlContext>> make_osmesa_context() {
    const std::array<int, 15> attributes{OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_DEPTH_BITS,
                                         0,
                                         OSMESA_STENCIL_BITS,
                                         0,
                                         OSMESA_PROFILE,
                                         OSMESA_CORE_PROFILE,
                                         OSMESA_CONTEXT_MAJOR_VERSION,
                                         4,
                                         OSMESA_CONTEXT_MINOR_VERSION,
                                         5,
                                         0,
                                         0,
                                         0};
    OSMesaContext handle = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (handle == nullptr) return fail("OSMesa has no OpenGL 4.5 context", {}, "install Mesa's libosmesa6 22 or newer");
    std::unique_ptr<GlContext> context = std::make_unique<OsMesaGlContext>(handle);
    if (auto current = context->make_current(); !current) return tl::unexpected(current.error());
    return context;
}

} // namespace ramus::render
