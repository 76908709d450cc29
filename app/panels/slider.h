// What a slider of the side panel remembers from frame to frame.
#pragma once

namespace ramus::app::widgets {

template <class T> struct Slider {
    T value{};
    bool held = false;
};

} // namespace ramus::app::widgets
