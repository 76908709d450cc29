#include "render/gpu/gpu_lines.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render {

namespace {

constexpr double kThinnedShare = 3e-4; // of the tree's extent: less than a pixel where it fills the window

} // namespace

void GpuLines::Copy::send(const Centerlines& lines) {
    const auto send = [](Buffer& buffer, Texture& texture, GLenum format, const auto& values) {
        make_buffer_texture(buffer, texture, format, values.data(), values.size() * sizeof values[0]);
    };
    runs = lines.runs;
    send(point_buffer, point_texture, GL_RGBA32F, lines.points);
    send(detail_buffer, detail_texture, GL_RG32UI, lines.details);
    send(run_buffer, run_texture, GL_RG32UI, lines.runs);
}

void GpuLines::follow(const std::shared_ptr<const Centerlines>& lines) {
    if (lines == shown_) return;
    shown_ = lines && !lines->points.empty() ? lines : nullptr;
    bounds_ = shown_ ? bounds_of(*shown_) : Box{};
    if (!shown_) return;
    whole_.send(*shown_);
    thinned_there_ = false;
}

void GpuLines::thin() {
    if (!shown_ || thinned_there_) return;
    thinned_.send(shown_->thinned(kThinnedShare * shown_->extent_mm()));
    thinned_there_ = true;
}

std::uint64_t GpuLines::draw(const std::vector<Layer>& layers, Layer layer) const {
    return shown_ ? whole_.draw(layers, layer) : 0;
}

std::uint64_t GpuLines::draw_thinned(const std::vector<Layer>& layers, Layer layer) const {
    return shown_ ? thinned_.draw(layers, layer) : 0;
}

std::uint64_t GpuLines::Copy::draw(const std::vector<Layer>& layers, Layer layer) const {
    return draw_runs(runs, [&](std::size_t branch) { return layer_of(layers, branch) == layer; });
}

std::uint64_t draw_runs(const std::vector<Centerlines::Run>& runs, const std::function<bool(std::size_t)>& drawn) {
    // Neighbouring runs are drawn as one: the step from a branch to the next is no segment, which the shader sees.
    std::vector<GLint> firsts;
    std::vector<GLsizei> counts;
    std::uint32_t end = 0;
    std::uint64_t segments = 0;
    for (std::size_t branch = 0; branch < runs.size(); ++branch) {
        const Centerlines::Run run = runs[branch];
        if (run.count < 2 || !drawn(branch)) continue;
        if (!counts.empty() && end == run.first)
            counts.back() += static_cast<GLsizei>(6 * run.count);
        else
            firsts.push_back(static_cast<GLint>(6 * run.first)), counts.push_back(static_cast<GLsizei>(6 * run.count));
        end = run.first + run.count;
        segments += run.count - 1;
    }
    for (GLsizei& count : counts) count -= 6; // the last point begins no segment
    if (!counts.empty())
        glMultiDrawArrays(GL_TRIANGLES, firsts.data(), counts.data(), static_cast<GLsizei>(counts.size()));
    return segments;
}

} // namespace ramus::render
