// A GLFW window with an OpenGL core context, its events handed to a Viewer in framebuffer pixels. One at a time.
#pragma once

#include "app/window/drawing_thread.h"
#include "app/window/first_window.h"
#include "app/window/viewer.h"
#include "core/base/error.h"
#include "render/gl/gl_context.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

struct GLFWwindow;
struct GLFWcursor;

namespace ramus::app {

class GlfwWindow final : public render::GlContext {
public:
    // Fails without a display (what == kNoDisplay) or without OpenGL 3.3. The context is current afterwards. 0 for
    // `size_points` or `scale`: as the monitor suggests (app/window/first_window.h).
    static constexpr const char* kNoDisplay = "there is no display to open a window on";
    [[nodiscard]] static Result<std::unique_ptr<GlfwWindow>> create(glm::ivec2 size_points, float scale);
    ~GlfwWindow() override;

    Result<void> make_current() override;

    // Has another thread draw: with a context of its own that shares textures and buffers with the window's, which
    // stays current here. Where the driver gives none, or two threads cannot use what it has, it is none, and who asks
    // draws. The window outlives it.
    [[nodiscard]] std::unique_ptr<DrawingThread> make_drawing_thread();

    void attach(Viewer* viewer); // null: events go nowhere
    void show();
    void set_title(const std::string& title);
    void set_cursor(Cursor cursor); // over the window's content
    [[nodiscard]] glm::ivec2 framebuffer_size() const { return told_.framebuffer; }
    [[nodiscard]] float scale() const; // pixels per point
    [[nodiscard]] bool close_wanted() const;
    void refuse_close();                                         // and not wanted any more
    void set_scale(float pixels_per_point);                      // 0: the display's
    [[nodiscard]] std::optional<glm::ivec2> size_points() const; // none while it fills the screen
    void hide();
    void swap();
    void wait(double seconds); // for events; infinite is allowed, 0 only looks

private:
    GlfwWindow(GLFWwindow* window, float scale, const MonitorFacts& monitor)
        : window_(window), fixed_scale_(scale), first_monitor_(monitor) {}
    void connect();
    void resized();
    [[nodiscard]] glm::dvec2 pixels(double x, double y) const;
    void key(int number, int scancode, int action, int modifiers);

    // As the display last told. To ask it is to wait until it has done all that it was given before.
    struct Told {
        glm::ivec2 framebuffer{1}, window{1}; // pixels, the system's units
        bool maximized = false;
    };

    GLFWwindow* window_;
    Told told_;
    GLFWwindow* beside_ = nullptr; // never seen: GLFW has a context with a window alone
    float fixed_scale_;            // 0: the display's
    MonitorFacts first_monitor_;   // that the window was opened on
    Viewer* viewer_ = nullptr;
    std::string title_;
    Cursor cursor_ = Cursor::kArrow;
    std::map<Cursor, GLFWcursor*> cursors_; // made when first wanted
    float cursor_scale_ = 0.0F;             // that they were made for
    glm::dvec2 pointer_{0.0};               // where it was last, in pixels
};

// May be called from any thread: wait() returns. Does nothing while there is no window.
void wake_window();

} // namespace ramus::app
