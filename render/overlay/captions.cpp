#include "render/overlay/captions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace ramus::render {

Image haloed(const Coverage& ink, int halo) {
    constexpr double kDark = 0.85, kEdge = 0.4; // next to the letters; at the halo's edge, relative to that
    const int side = 2 * halo + 1;
    std::vector<double> weights(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int i = 0; i < side * side; ++i) {
        const double away = std::hypot(i % side - halo, i / side - halo) / halo;
        weights[static_cast<std::size_t>(i)] = away > 1.0 ? 0.0 : std::min(1.0, 1.0 + kEdge - away);
    }
    Image image(ink.width, ink.height);
    for (int y = 0; y < ink.height; ++y)
        for (int x = 0; x < ink.width; ++x) {
            double around = 0.0;
            for (int i = 0; i < side * side; ++i)
                around = std::max(around, weights[static_cast<std::size_t>(i)] *
                                              ink.at(x + i % side - halo, y + i / side - halo));
            const double light = ink.at(x, y) / 255.0, dark = kDark * around / 255.0;
            const double alpha = light + dark * (1.0 - light);
            if (alpha <= 0.0) continue;
            std::uint8_t* out = image.pixel(x, y);
            for (int k = 0; k < 3; ++k)
                out[k] = static_cast<std::uint8_t>(std::lround((light * 235.0 + (1.0 - light) * dark * 10.0) / alpha));
            out[3] = static_cast<std::uint8_t>(std::lround(255.0 * alpha));
        }
    return image;
}

Image with_dark_ink(Image haloed) {
    for (std::size_t i = 0; i < haloed.rgba.size(); ++i)
        if (i % 4 != 3) haloed.rgba[i] = static_cast<std::uint8_t>(255 - haloed.rgba[i]);
    return haloed;
}

std::string orientation_letters(const glm::dvec3& direction, const AxisNames& axes) {
    std::array<int, 3> order{0, 1, 2};
    std::ranges::sort(order, [&](int a, int b) { return std::abs(direction[a]) > std::abs(direction[b]); });
    std::string letters;
    for (const int axis : order)
        if (std::abs(direction[axis]) > 0.34)
            letters += axes.at(static_cast<std::size_t>(2 * axis + (direction[axis] < 0.0 ? 1 : 0)));
    return letters;
}

Image paint_caption(const std::string& text, double pixel_ratio, int width) {
    const double capital = 10.0 * pixel_ratio;
    const int halo = std::max(2, static_cast<int>(std::lround(2.0 * pixel_ratio)));
    std::vector<Coverage> lines;
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;) {
        std::string longer = line;
        longer.append(line.empty() ? 0 : 1, ' ').append(word);
        if (!line.empty() && draw_text(longer, capital).width > width) {
            lines.push_back(draw_text(line, capital));
            line = word;
        } else {
            line = longer;
        }
    }
    if (!line.empty()) lines.push_back(draw_text(line, capital));
    int width_of_all = 0, height_of_all = 2 * halo;
    for (const Coverage& one : lines) {
        width_of_all = std::max(width_of_all, one.width + 2 * halo);
        height_of_all += one.height;
    }
    Coverage sheet(width_of_all, height_of_all);
    int top = halo;
    for (const Coverage& one : lines) {
        sheet.put(halo, top, one);
        top += one.height;
    }
    return haloed(sheet, halo);
}

} // namespace ramus::render
