#include "render/gl/headless_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/osmesa.h>
#include <array>
#include <dlfcn.h>
#include <string>

namespace ramus::render {

namespace {

// Finally any version: load_gl() then reports which version was found to be too old.
constexpr std::array kAskedFor{kWantedGl[0], kWantedGl[1], kWantedGl[2], GlVersion{}};

// Loads functions of a shared library by name; null if the library is missing.
class Library {
public:
    explicit Library(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
        if (handle_ == nullptr)
            if (const char* why = dlerror(); why != nullptr) why_ = why;
    }
    bool operator()(auto& function, const char* name) const {
        if (handle_ != nullptr)
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(handle_, name));
        return function != nullptr;
    }

    [[nodiscard]] const std::string& why() const { return why_; } // why it cannot be loaded

private:
    void* handle_;
    std::string why_;
};

Result<std::unique_ptr<GlContext>> made_current(std::unique_ptr<GlContext> context) {
    if (auto current = context->make_current(); !current) return tl::unexpected(current.error());
    return context;
}

// Loaded on first use: it contains a compiler of 100 MB, which the window and most commands do not need.
struct OsMesa {
    decltype(&OSMesaCreateContextAttribs) create_context = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaGetProcAddress) get_proc_address = nullptr;
    decltype(&OSMesaDestroyContext) destroy_context = nullptr;
    bool complete = false;
    std::string why; // it is not

    OsMesa() {
        const Library find(RAMUS_OSMESA);
        why = find.why();
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
        // OSMesa requires a colour buffer, which is unused.
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

struct Egl {
    decltype(&eglGetProcAddress) get_proc_address = nullptr;
    decltype(&eglQueryString) query_string = nullptr;
    decltype(&eglInitialize) initialize = nullptr;
    decltype(&eglBindAPI) bind_api = nullptr;
    decltype(&eglChooseConfig) choose_config = nullptr;
    decltype(&eglCreateContext) create_context = nullptr;
    decltype(&eglDestroyContext) destroy_context = nullptr;
    decltype(&eglMakeCurrent) make_current = nullptr;
    // Extension functions; null if not supported.
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;
    bool complete = false;
    std::string why; // it is not

    Egl() {
        const Library find(RAMUS_EGL);
        why = find.why();
        complete = find(get_proc_address, "eglGetProcAddress") && find(query_string, "eglQueryString") &&
                   find(initialize, "eglInitialize") && find(bind_api, "eglBindAPI") &&
                   find(choose_config, "eglChooseConfig") && find(create_context, "eglCreateContext") &&
                   find(destroy_context, "eglDestroyContext") && find(make_current, "eglMakeCurrent");
        if (!complete) return;
        const auto extend = [&](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(get_proc_address(name));
        };
        extend(get_platform_display, "eglGetPlatformDisplayEXT");
        extend(query_devices, "eglQueryDevicesEXT");
        extend(query_device_string, "eglQueryDeviceStringEXT");
    }

    // Extensions of a display, or without a display of EGL itself.
    [[nodiscard]] bool has(EGLDisplay display, std::string_view extension) const {
        const char* const all = query_string(display, EGL_EXTENSIONS);
        return all != nullptr && std::string_view(all).find(extension) != std::string_view::npos;
    }
};

const Egl& egl() {
    static const Egl library;
    return library;
}

std::vector<EGLDeviceEXT> device_handles() {
    constexpr EGLint kMost = 64;
    if (!egl().complete || egl().query_devices == nullptr) return {};
    std::vector<EGLDeviceEXT> devices(kMost);
    EGLint count = 0;
    if (egl().query_devices(kMost, devices.data(), &count) != EGL_TRUE) count = 0;
    devices.resize(static_cast<std::size_t>(count));
    return devices;
}

// Empty: not provided.
std::string_view text_of(EGLDeviceEXT device, EGLint what) {
    const char* text = egl().query_device_string != nullptr ? egl().query_device_string(device, what) : nullptr;
    return text != nullptr ? text : "";
}

bool is_software(EGLDeviceEXT device) {
    return text_of(device, EGL_EXTENSIONS).find("software") != std::string_view::npos;
}

class EglGlContext final : public GlContext {
public:
    EglGlContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    // The display is not terminated: EGL returns the same one again, and others may use it.
    ~EglGlContext() override {
        egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        egl().destroy_context(display_, context_);
    }

    Result<void> make_current() override {
        egl().bind_api(EGL_OPENGL_API);
        if (egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            return fail("EGL could not make its context current without a surface", {}, "use --backend osmesa");
        return load_gl([](const char* name) { return reinterpret_cast<GlFunction>(egl().get_proc_address(name)); },
                       context_, "update the graphics driver, or use --backend osmesa");
    }

private:
    EGLDisplay display_;
    EGLContext context_;
};

// Null: the display is unsuitable.
Result<std::unique_ptr<GlContext>> context_on(EGLDisplay display) {
    const auto no = [](const char* why) { return fail(std::string("EGL ") + why); };
    EGLint major = 0, minor = 0;
    if (display == EGL_NO_DISPLAY || egl().initialize(display, &major, &minor) != EGL_TRUE)
        return no("cannot be initialised");
    if (!egl().has(display, "EGL_KHR_surfaceless_context")) return no("has no contexts without a surface");
    if (egl().bind_api(EGL_OPENGL_API) != EGL_TRUE) return no("has no desktop OpenGL");
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!egl().has(display, "EGL_KHR_no_config_context")) {
        const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
        EGLint count = 0;
        if (egl().choose_config(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0)
            return no("has no configuration for OpenGL");
    }
    for (const GlVersion version : kAskedFor) {
        const bool any = version == GlVersion{};
        const EGLint first = any ? EGL_NONE : EGL_CONTEXT_OPENGL_PROFILE_MASK;
        const std::array attributes{first,         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_CONTEXT_MAJOR_VERSION,
                                    version.major, EGL_CONTEXT_MINOR_VERSION,           version.minor,
                                    EGL_NONE};
        const EGLContext handle = egl().create_context(display, config, EGL_NO_CONTEXT, attributes.data());
        if (handle != EGL_NO_CONTEXT) return made_current(std::make_unique<EglGlContext>(display, handle));
    }
    return no("gives no OpenGL context");
}

EGLDisplay display_of(EGLenum platform, void* native) {
    return egl().get_platform_display != nullptr ? egl().get_platform_display(platform, native, nullptr)
                                                 : EGL_NO_DISPLAY;
}

} // namespace

std::string_view name_of(Backend backend) { return backend == Backend::kEgl ? "egl" : "osmesa"; }

Result<std::unique_ptr<GlContext>> make_headless_context(Backend backend, std::optional<int> device) {
    return backend == Backend::kEgl ? make_egl_context(device) : make_osmesa_context();
}

Result<std::unique_ptr<GlContext>> make_osmesa_context() {
    const std::string remedy = "install Mesa's libosmesa6 22 or newer";
    if (!osmesa().complete)
        return fail("OSMesa cannot be loaded: " + osmesa().why, RAMUS_OSMESA, remedy + ", or use --backend egl");
    for (const GlVersion version : kAskedFor) {
        const bool any = version == GlVersion{};
        const int first = any ? 0 : OSMESA_PROFILE; // no depth and stencil unless requested
        const std::array attributes{first,
                                    OSMESA_CORE_PROFILE,
                                    OSMESA_CONTEXT_MAJOR_VERSION,
                                    version.major,
                                    OSMESA_CONTEXT_MINOR_VERSION,
                                    version.minor,
                                    0};
        OSMesaContext handle = osmesa().create_context(attributes.data(), nullptr);
        if (handle != nullptr) return made_current(std::make_unique<OsMesaGlContext>(handle));
    }
    return fail("OSMesa has no OpenGL " + kOldestGl.text(), {}, remedy);
}

std::vector<std::string> egl_devices() {
    std::vector<std::string> found;
    for (EGLDeviceEXT device : device_handles()) {
        const std::string_view name = text_of(device, EGL_DRM_DEVICE_FILE_EXT);
        found.emplace_back(!name.empty() ? name : is_software(device) ? "software" : "a device without a name");
    }
    return found;
}

Result<std::unique_ptr<GlContext>> make_egl_context(std::optional<int> device) {
    if (!egl().complete)
        return fail("EGL cannot be loaded: " + egl().why, RAMUS_EGL,
                    "install libegl1 and the graphics driver's EGL, or use --backend osmesa");
    const std::vector<EGLDeviceEXT> devices = device_handles();
    const auto on_device = [](EGLDeviceEXT handle) { return context_on(display_of(EGL_PLATFORM_DEVICE_EXT, handle)); };
    if (device) {
        if (*device < 0 || static_cast<std::size_t>(*device) >= devices.size())
            return fail("EGL has no device " + std::to_string(*device), {},
                        devices.empty() ? "it lists none: leave --device out"
                                        : "the last one is " + std::to_string(devices.size() - 1));
        return on_device(devices[static_cast<std::size_t>(*device)]);
    }
    for (EGLDeviceEXT handle : devices)
        if (!is_software(handle))
            if (auto context = on_device(handle)) return context;
    auto context = egl().has(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")
                       ? context_on(display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY))
                       : Result<std::unique_ptr<GlContext>>(fail("EGL needs a display"));
    for (EGLDeviceEXT handle : devices)
        if (!context && is_software(handle)) context = on_device(handle);
    if (!context && context.error().hint.empty())
        context.error().hint = "install the graphics driver's EGL (Mesa: libegl-mesa0), or use --backend osmesa";
    return context;
}

} // namespace ramus::render
