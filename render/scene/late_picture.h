// LatePicture: an image that is painted when somebody first asks for it, on the thread that asks: a window composes
// frames faster than they are drawn, and most are replaced before. Thread-safe.
#pragma once

#include "render/image/image.h"

#include <functional>
#include <mutex>
#include <utility>

namespace ramus::render {

class LatePicture {
public:
    explicit LatePicture(std::function<Image()> paint) : paint_(std::move(paint)) {}
    explicit LatePicture(Image image) : LatePicture([image = std::move(image)] { return image; }) {}

    // If painting throws, the next call paints again.
    [[nodiscard]] const Image& image() const {
        std::call_once(painted_, [this] { image_ = paint_(); });
        return image_;
    }

private:
    std::function<Image()> paint_;
    mutable std::once_flag painted_;
    mutable Image image_;
};

} // namespace ramus::render
