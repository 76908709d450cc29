#include "render/gl/headless_context.h"

#include <GL/osmesa.h>
#include <array>
#include <dlfcn.h>

namespace ramus::render {

namespace {

// Loaded when it is first needed: it brings a compiler of 100 MB, which the window and most commands do without.
struct OsMesa {
    decltype(&OSMesaCreateContextAttribs) create_context = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaGetProcAddress) get_proc_address = nullptr;
    decltype(&OSMesaDestroyContext) destroy_context = nullptr;
    bool complete = false;

    OsMesa() {
        void* const library = dlopen(RAMUS_OSMESA, RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr) return;
        const auto find = [&](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
            return function != nullptr;
        };
        complete = find(create_context, "OSMesaCreateContextAttribs") && find(make_current, "OSMesaMakeCurrent") &&
                   find(get_proc_address, "OSMesaGetProcAddress") && find(destroy_context, "OSMesaDestroyContext");
    }
};

const OsMesa& osmesa() {
    static const OsMesa library;
    return library;
}

class OsMesaGlContext final : public GlContext {
public:
    explicit OsMesaGlContext(OSMesaContext context) : context_(context) {}
    ~OsMesaGlContext() override { osmesa().destroy_context(context_); }

    Result<void> make_current() override {
        // OSMesa wants a colour buffer; nobody draws into it.
        if (osmesa().make_current(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide) == GL_FALSE)
            return fail("OSMesa could not make its context current", {}, "check the installation of libosmesa6");
        return load_gl([](const char* name) { return reinterpret_cast<GlFunction>(osmesa().get_proc_address(name)); },
                       context_, "install Mesa's libosmesa6 22 or newer, or use --backend egl");
    }

private:
    static constexpr int kSide = 4;
    OSMesaContext context_;
    std::array<unsigned char, 4 * kSide * kSide> buffer_{};
};

} // namespace

Result<std::unique_ptr<GlContext>> make_osmesa_context() {
    const std::string remedy = "install Mesa's libosmesa6 22 or newer";
    if (!osmesa().complete) return fail("OSMesa is not there", RAMUS_OSMESA, remedy + ", or use --backend egl");
    // Without a version asked for, what it has: load_gl() says that it is too old, and how old.
    for (const GlVersion version : {kWantedGl[0], kWantedGl[1], kWantedGl[2], GlVersion{}}) {
        const bool any = version == GlVersion{};
        const std::array<int, 13> attributes{OSMESA_FORMAT,
                                             OSMESA_RGBA,
                                             OSMESA_DEPTH_BITS,
                                             0,
                                             OSMESA_STENCIL_BITS,
                                             0,
                                             any ? 0 : OSMESA_PROFILE,
                                             OSMESA_CORE_PROFILE,
                                             OSMESA_CONTEXT_MAJOR_VERSION,
                                             version.major,
                                             OSMESA_CONTEXT_MINOR_VERSION,
                                             version.minor,
                                             0};
        OSMesaContext handle = osmesa().create_context(attributes.data(), nullptr);
        if (handle == nullptr) continue;
        std::unique_ptr<GlContext> context = std::make_unique<OsMesaGlContext>(handle);
        if (auto current = context->make_current(); !current) return tl::unexpected(current.error());
        return context;
    }
    return fail("OSMesa has no OpenGL " + kOldestGl.text(), {}, remedy);
}

} // namespace ramus::render
