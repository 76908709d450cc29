#include "app/window/glfw_window.h"

#include "app/window/cursor_image.h"

// GL comes through glad, in render.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <imgui.h>
#include <mutex>
#include <utility>

namespace ramus::app {

namespace {

Modifiers modifiers_of(int bits) {
    return {.ctrl = (bits & GLFW_MOD_CONTROL) != 0,
            .shift = (bits & GLFW_MOD_SHIFT) != 0,
            .alt = (bits & GLFW_MOD_ALT) != 0};
}

// The name that the command table gives a key; empty: none. Letters and digits follow the keyboard's layout.
std::string name_of_key(int number, int scancode) {
    if (number >= GLFW_KEY_F1 && number <= GLFW_KEY_F12)
        return std::string("F").append(std::to_string(number - GLFW_KEY_F1 + 1));
    if (number >= GLFW_KEY_KP_0 && number <= GLFW_KEY_KP_9) return std::to_string(number - GLFW_KEY_KP_0);
    if (number >= GLFW_KEY_0 && number <= GLFW_KEY_9) return std::to_string(number - GLFW_KEY_0);
    switch (number) {
    case GLFW_KEY_ESCAPE:
        return "Escape";
    case GLFW_KEY_TAB:
        return "Tab";
    case GLFW_KEY_DELETE:
        return "Delete";
    case GLFW_KEY_LEFT:
        return "Left";
    case GLFW_KEY_RIGHT:
        return "Right";
    case GLFW_KEY_UP:
        return "Up";
    case GLFW_KEY_DOWN:
        return "Down";
    case GLFW_KEY_PAGE_UP:
        return "PageUp";
    case GLFW_KEY_PAGE_DOWN:
        return "PageDown";
    case GLFW_KEY_LEFT_BRACKET: // by their places: on many layouts the characters need a third key
        return "[";
    case GLFW_KEY_RIGHT_BRACKET:
        return "]";
    default:
        break;
    }
    const char* name = glfwGetKeyName(number, scancode);
    if (name == nullptr || name[0] == '\0' || name[1] != '\0') {
        // A layout without Latin letters: the key's place on a US keyboard.
        return number >= GLFW_KEY_A && number <= GLFW_KEY_Z
                   ? std::string(1, static_cast<char>('A' + number - GLFW_KEY_A))
                   : "";
    }
    const auto letter = static_cast<unsigned char>(name[0]);
    return std::isalnum(letter) != 0 ? std::string(1, static_cast<char>(std::toupper(letter))) : "";
}

std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "" : text;
}

// Workers may outlive the window, and start before it exists.
std::mutex wake_mutex;
bool can_wake = false;

void let_wake(bool can) {
    const std::lock_guard lock(wake_mutex);
    can_wake = can;
}

MonitorFacts primary_monitor() {
    MonitorFacts facts;
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) return facts;
    int x = 0, y = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &facts.work_area.x, &facts.work_area.y);
    float across = 1.0F, down = 1.0F;
    glfwGetMonitorContentScale(monitor, &across, &down);
    if (across > 0.0F) facts.content_scale = across;
    int wide_mm = 0, high_mm = 0;
    glfwGetMonitorPhysicalSize(monitor, &wide_mm, &high_mm);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    if (mode != nullptr && wide_mm > 0)
        facts.pixels_per_mm = static_cast<float>(mode->width) / static_cast<float>(wide_mm);
    return facts;
}

} // namespace

Result<std::unique_ptr<GlfwWindow>> GlfwWindow::create(glm::ivec2 size_points, float scale) {
    const std::string remedy = "draw a picture without one: ramus render FILE -o PNG";
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr && *value != '\0';
    };
    if (!set("DISPLAY") && !set("WAYLAND_DISPLAY")) return fail(kNoDisplay, {}, remedy);
    if (glfwInit() != GLFW_TRUE) return fail(kNoDisplay, {}, remedy);
    glfwWindowHint(GLFW_DEPTH_BITS, 0); // the renderer has its own framebuffers
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    // GLFW converts its units to pixels by the desktop's scale.
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "ramus");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "ramus");
    const MonitorFacts monitor = primary_monitor();
    const glm::vec2 wanted(window_pixels(monitor, scale == 0.0F ? suggested_scale(monitor) : scale, size_points));
    const glm::ivec2 size(glm::round(wanted / monitor.content_scale));
    GLFWwindow* handle = nullptr;
    std::string why;
    for (const render::GlVersion version : render::kWantedGl) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, version.major);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, version.minor);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        handle = glfwCreateWindow(size.x, size.y, "ramus", nullptr, nullptr);
        if (handle != nullptr) break;
        why = last_error();
    }
    if (handle == nullptr) { // any version: load_gl() reports that it is too old
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 1);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_ANY_PROFILE);
        handle = glfwCreateWindow(size.x, size.y, "ramus", nullptr, nullptr);
    }
    if (handle == nullptr) {
        glfwTerminate();
        return fail("the display gives no window with OpenGL " + render::kOldestGl.text() +
                        (why.empty() ? "" : " (" + why + ")"),
                    {}, "update the graphics driver, or " + remedy);
    }
    std::unique_ptr<GlfwWindow> window(new GlfwWindow(handle, scale, monitor));
    if (auto current = window->make_current(); !current) return tl::unexpected(current.error());
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(handle, 480, 360, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSetWindowUserPointer(handle, window.get());
    let_wake(true);
    window->connect();
    return window;
}

GlfwWindow::~GlfwWindow() {
    let_wake(false);
    for (const auto& [kind, shape] : cursors_)
        if (shape != nullptr) glfwDestroyCursor(shape);
    if (beside_ != nullptr) glfwDestroyWindow(beside_);
    glfwDestroyWindow(window_);
    glfwTerminate();
}

Result<void> GlfwWindow::make_current() {
    glfwMakeContextCurrent(window_);
    return render::load_gl(
        [](const char* name) { return glfwGetProcAddress(name); }, window_,
        "update the graphics driver, set LIBGL_ALWAYS_SOFTWARE=1, or draw without a window: ramus render "
        "FILE -o PNG");
}

// GL's functions belong to the process and are loaded already: the thread only makes the context current.
// RAMUS_ONE_THREAD is for tests, and for drivers that wrongly claim to support threads.
std::unique_ptr<DrawingThread> GlfwWindow::make_drawing_thread() {
    auto none = std::make_unique<DrawingThread>();
    const char* one_thread = std::getenv("RAMUS_ONE_THREAD");
    const render::GlVersion version = render::gl_version();
    if (!render::gl_takes_threads() || (one_thread != nullptr && *one_thread != '\0')) return none;
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    beside_ = glfwCreateWindow(1, 1, "", nullptr, window_);
    if (beside_ == nullptr) return none;
    glfwMakeContextCurrent(beside_);
    const auto loaded = render::load_gl([](const char* name) { return glfwGetProcAddress(name); }, beside_);
    const bool same = loaded && render::gl_version() == version;
    if (auto back = make_current(); !back || !same) return none;
    const auto enter = [beside = beside_] {
        glfwMakeContextCurrent(beside);
        return glfwGetCurrentContext() == beside;
    };
    return std::make_unique<DrawingThread>(
        enter, [] { glfwMakeContextCurrent(nullptr); }, wake_window);
}

namespace {

GlfwWindow* self(GLFWwindow* window) { return static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window)); }

} // namespace

void GlfwWindow::attach(Viewer* viewer) { viewer_ = viewer; }

glm::dvec2 GlfwWindow::pixels(double x, double y) const {
    return glm::dvec2(x, y) * glm::dvec2(told_.framebuffer) / glm::dvec2(glm::max(told_.window, 1));
}

void GlfwWindow::key(int number, int scancode, int action, int modifiers) {
    if (viewer_ == nullptr) return;
    const Modifiers held = modifiers_of(modifiers);
    std::optional<KeyPress> press;
    const bool repeats = number >= GLFW_KEY_RIGHT && number <= GLFW_KEY_PAGE_DOWN; // arrows and pages, while held
    const bool pressed = action == GLFW_PRESS || (action == GLFW_REPEAT && repeats);
    const std::string name = pressed ? name_of_key(number, scancode) : "";
    if (!name.empty()) press = KeyPress{name, held.ctrl, held.shift, held.alt};
    viewer_->input().key(number, action != GLFW_RELEASE, press, held, glfwGetTime());
}

void GlfwWindow::resized() {
    if (std::exchange(cursor_scale_, scale()) != cursor_scale_) { // pointer images depend on the scale
        set_cursor(Cursor::kArrow);
        for (const auto& [kind, shape] : cursors_)
            if (shape != nullptr) glfwDestroyCursor(shape);
        cursors_.clear();
    }
    const glm::ivec2 size = framebuffer_size();
    if (viewer_ != nullptr && size.x > 0 && size.y > 0) viewer_->resize(size, scale()); // 0: minimised
}

void GlfwWindow::connect() {
    glfwGetFramebufferSize(window_, &told_.framebuffer.x, &told_.framebuffer.y);
    glfwGetWindowSize(window_, &told_.window.x, &told_.window.y);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        Viewer* viewer = self(window)->viewer_;
        if (viewer == nullptr) return;
        self(window)->pointer_ = self(window)->pixels(x, y);
        viewer->input().mouse_moved(self(window)->pointer_);
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int entered) {
        Viewer* viewer = self(window)->viewer_;
        if (viewer == nullptr) return;
        if (entered == GLFW_FALSE) return viewer->input().mouse_left();
        // A window manager that inspects a press first takes the pointer away and returns it, which GLFW does not
        // report as a move. The pointer may have moved on already.
        viewer->input().mouse_moved(self(window)->pointer_);
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
        Viewer* viewer = self(window)->viewer_;
        if (viewer == nullptr || button > GLFW_MOUSE_BUTTON_MIDDLE) return;
        // The pointer may already be far from where the button was pressed; earlier moves have reported that position.
        constexpr std::array kButtons{MouseButton::kLeft, MouseButton::kRight, MouseButton::kMiddle};
        viewer->input().mouse_button(kButtons[static_cast<std::size_t>(button)], action == GLFW_PRESS,
                                     modifiers_of(modifiers), glfwGetTime());
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double dx, double dy) {
        if (Viewer* viewer = self(window)->viewer_) viewer->input().mouse_wheel({dx, dy});
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int number, int scancode, int action, int modifiers) {
        self(window)->key(number, scancode, action, modifiers);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned codepoint) {
        if (Viewer* viewer = self(window)->viewer_) viewer->input().character(codepoint, glfwGetTime());
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        Viewer* viewer = self(window)->viewer_;
        if (viewer != nullptr && count > 0) viewer->files().dropped(paths[0]);
    });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int width, int height) {
        self(window)->told_.framebuffer = {width, height};
        self(window)->resized();
    });
    glfwSetWindowSizeCallback(window_, [](GLFWwindow* window, int width, int height) {
        self(window)->told_.window = {width, height};
    });
    glfwSetWindowMaximizeCallback(
        window_, [](GLFWwindow* window, int maximized) { self(window)->told_.maximized = maximized == GLFW_TRUE; });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* window, float, float) { self(window)->resized(); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) {
        if (Viewer* viewer = self(window)->viewer_) viewer->present_again();
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int) {
        if (Viewer* viewer = self(window)->viewer_) viewer->redraw();
    });
    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = window_;
    io.GetClipboardTextFn = [](void* window) { return glfwGetClipboardString(static_cast<GLFWwindow*>(window)); };
    io.SetClipboardTextFn = [](void* window, const char* text) {
        glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
    };
}

void GlfwWindow::show() { glfwShowWindow(window_); }

void GlfwWindow::set_title(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_, title.c_str());
}

void GlfwWindow::set_cursor(Cursor cursor) {
    if (cursor == cursor_) return;
    cursor_ = cursor;
    GLFWcursor*& shape = cursors_[cursor];
    if (auto drawn = shape == nullptr ? cursor_image(cursor, scale()) : std::nullopt) {
        const GLFWimage image{drawn->image.width, drawn->image.height, drawn->image.rgba.data()};
        shape = glfwCreateCursor(&image, drawn->hot_spot.x, drawn->hot_spot.y);
    }
    if (shape == nullptr && cursor != Cursor::kArrow)
        shape = glfwCreateStandardCursor(cursor == Cursor::kHand       ? GLFW_HAND_CURSOR
                                         : cursor == Cursor::kSideways ? GLFW_HRESIZE_CURSOR
                                                                       : GLFW_CROSSHAIR_CURSOR);
    glfwSetCursor(window_, shape); // null: the arrow
}

float GlfwWindow::scale() const {
    if (fixed_scale_ > 0.0F) return fixed_scale_;
    float x = 1.0F, y = 1.0F;
    glfwGetWindowContentScale(window_, &x, &y);
    return scale_after_move(x, suggested_scale(first_monitor_), first_monitor_.content_scale);
}

bool GlfwWindow::close_wanted() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
void GlfwWindow::refuse_close() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }

void GlfwWindow::set_scale(float pixels_per_point) {
    if (fixed_scale_ == pixels_per_point) return;
    fixed_scale_ = pixels_per_point;
    resized();
}

std::optional<glm::ivec2> GlfwWindow::size_points() const {
    if (told_.maximized) return {};
    const glm::ivec2 pixels = framebuffer_size();
    const auto points = [&](int length) { return static_cast<int>(std::lround(static_cast<float>(length) / scale())); };
    const glm::ivec2 size(points(pixels.x), points(pixels.y));
    return size.x >= 480 && size.y >= 360 ? std::optional(size) : std::nullopt;
}

void GlfwWindow::hide() { glfwHideWindow(window_); }

void GlfwWindow::swap() { glfwSwapBuffers(window_); }

void GlfwWindow::wait(double seconds) {
    if (seconds <= 0.0)
        glfwPollEvents();
    else if (std::isinf(seconds))
        glfwWaitEvents();
    else
        glfwWaitEventsTimeout(seconds);
}

void wake_window() {
    const std::lock_guard lock(wake_mutex);
    if (can_wake) glfwPostEmptyEvent();
}

} // namespace ramus::app
