// GlfwWindow: a GLFW window with an OpenGL core context; passes its events to a Viewer in framebuffer pixels. At most
// one exists at a time.
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
    // Fails without a display (what == kNoDisplay) or without OpenGL 3.3. The context is current on return.
    // `size_points` or `scale` 0: as suggested for the monitor (app/window/first_window.h).
    static constexpr const char* kNoDisplay = "there is no display to open a window on";
    [[nodiscard]] static Result<std::unique_ptr<GlfwWindow>> create(glm::ivec2 size_points, float scale);
    ~GlfwWindow() override;

    Result<void> make_current() override;

    // Creates a drawing thread with a context that shares textures and buffers with the window's context, which stays
    // current on the calling thread. If the driver provides no second context, or two threads cannot use it, the result
    // has no thread. The window must outlive the result.
    [[nodiscard]] std::unique_ptr<DrawingThread> make_drawing_thread();

    void attach(Viewer* viewer); // null: events are ignored
    void show();
    void set_title(const std::string& title);
    void set_cursor(Cursor cursor); // over the content
    [[nodiscard]] glm::ivec2 framebuffer_size() const { return told_.framebuffer; }
    [[nodiscard]] float scale() const; // pixels per point
    [[nodiscard]] bool close_wanted() const;
    void refuse_close();                                         // resets close_wanted()
    void set_scale(float pixels_per_point);                      // 0: the display's
    [[nodiscard]] std::optional<glm::ivec2> size_points() const; // none while the window is maximized
    void hide();
    void swap();
    void wait(double seconds); // for events; may be infinite; 0: only polls

private:
    GlfwWindow(GLFWwindow* window, float scale, const MonitorFacts& monitor)
        : window_(window), fixed_scale_(scale), first_monitor_(monitor) {}
    void connect();
    void resized();
    [[nodiscard]] glm::dvec2 pixels(double x, double y) const;
    void key(int number, int scancode, int action, int modifiers);

    // State last reported by the display. Querying the display would wait for all its pending work.
    struct Told {
        glm::ivec2 framebuffer{1}, window{1}; // pixels; units of the window system
        bool maximized = false;
    };

    GLFWwindow* window_;
    Told told_;
    GLFWwindow* beside_ = nullptr; // invisible: GLFW creates a context only with a window
    float fixed_scale_;            // 0: the display's
    MonitorFacts first_monitor_;   // on which the window was opened
    Viewer* viewer_ = nullptr;
    std::string title_;
    Cursor cursor_ = Cursor::kArrow;
    std::map<Cursor, GLFWcursor*> cursors_; // created on first use
    float cursor_scale_ = 0.0F;             // scale of `cursors_`
    glm::dvec2 pointer_{0.0};               // last position, pixels
};

// Makes wait() return. Thread-safe; does nothing without a window.
void wake_window();

} // namespace ramus::app
