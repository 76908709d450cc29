#include "render/gpu/gpu_lines.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render {

namespace {

constexpr double kThinnedShare = 3e-4; // of the tree's extent: less than a pixel where it fills the window

} // namespace

void GpuLines::follow(const std::shared_ptr<const Centerlines>& lines) {
    if (lines == shown_) return;
    shown_ = lines && !lines->points.empty() ? lines : nullptr;
    bounds_ = shown_ ? bounds_of(*shown_) : Box{};
    if (!shown_) return;
    whole_.send(*shown_);
    thinned_there_ = false;
}

const GpuLines::Copy& GpuLines::thinned() {
    if (shown_ && !thinned_there_) {
        thinned_.send(shown_->thinned(kThinnedShare * shown_->extent_mm()));
        thinned_there_ = true;
    }
    return thinned_;
}

void GpuLines::Copy::send(const Centerlines& lines) {
    runs_ = lines.runs;
    points_ = make_buffer_texture(GL_RGBA32F, lines.points);
    details_ = make_buffer_texture(GL_RG32UI, lines.details);
    run_table_ = make_buffer_texture(GL_RG32UI, lines.runs);
}

void GpuLines::Copy::bind() const {
    glBindTextureUnit(kUnitLinePoints, points_.texture);
    glBindTextureUnit(kUnitLineDetails, details_.texture);
    glBindTextureUnit(kUnitLineRuns, run_table_.texture);
}

std::uint64_t GpuLines::Copy::draw(const std::vector<Layer>& layers, std::initializer_list<Layer> drawn) const {
    bind();
    // Neighbouring runs are drawn as one: the step from a branch to the next is no segment, which the shader sees.
    std::vector<GLint> firsts;
    std::vector<GLsizei> counts;
    std::uint32_t end = 0;
    std::uint64_t segments = 0;
    for (std::size_t branch = 0; branch < runs_.size(); ++branch) {
        const Centerlines::Run run = runs_[branch];
        if (run.count < 2 || std::ranges::find(drawn, layer_of(layers, branch)) == drawn.end()) continue;
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
