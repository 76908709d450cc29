#include "render/gpu_lines.h"

#include <algorithm>
#include <array>
#include <map>

namespace ramus::render {

void make_buffer_texture(Buffer& buffer, Texture& texture, GLenum format, const void* data, std::size_t bytes) {
    buffer = make_buffer();
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(bytes), data, GL_DYNAMIC_STORAGE_BIT);
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
    texture = Texture(id);
    glTextureBuffer(id, format, buffer);
}

void GpuLines::follow(const std::shared_ptr<const Centerlines>& lines) {
    if (lines == shown_) return;
    shown_ = lines && !lines->points.empty() ? lines : nullptr;
    if (!shown_) return;
    const auto send = [](Buffer& buffer, Texture& texture, GLenum format, const auto& values) {
        make_buffer_texture(buffer, texture, format, values.data(), values.size() * sizeof values[0]);
    };
    send(points_, points_texture_, GL_RGBA32F, shown_->points);
    send(details_, details_texture_, GL_RG32UI, shown_->details);
    send(runs_, runs_texture_, GL_RG32UI, shown_->runs);

    // Branches that meet have an end at the very same place.
    std::map<std::array<float, 3>, std::vector<int>> ends;
    for (std::size_t branch = 0; branch < shown_->runs.size(); ++branch) {
        const Centerlines::Run run = shown_->runs[branch];
        if (run.count < 2) continue;
        for (const std::uint32_t end : {run.first, run.first + run.count - 1}) {
            const glm::vec4& p = shown_->points[end];
            ends[{p.x, p.y, p.z}].push_back(static_cast<int>(branch));
        }
    }
    nodes_.clear();
    for (auto& [place, branches] : ends)
        if (branches.size() > 1) nodes_.push_back(std::move(branches));
}

std::vector<std::vector<int>> GpuLines::meetings(const std::vector<Layer>& layers) const {
    std::vector<std::vector<int>> found(layers.size());
    const auto layer = [&](int branch) {
        return static_cast<std::size_t>(branch) < layers.size() ? layers[static_cast<std::size_t>(branch)]
                                                                : Layer::kNone;
    };
    if (!shown_) return found;
    for (const std::vector<int>& node : nodes_) {
        const auto any = [&](Layer wanted) {
            return std::ranges::any_of(node, [&](int branch) { return layer(branch) == wanted; });
        };
        if (!any(Layer::kOpaque) || !any(Layer::kGlass)) continue;
        for (const int branch : node) {
            if (layer(branch) == Layer::kNone) continue;
            auto& company = found[static_cast<std::size_t>(branch)];
            for (const int other : node)
                if (layer(other) != Layer::kNone && std::ranges::find(company, other) == company.end())
                    company.push_back(other);
        }
    }
    return found;
}

void GpuLines::draw(const std::vector<Layer>& layers) const {
    if (!shown_) return;
    // Neighbouring runs are drawn as one: the step from a branch to the next is no segment, which the shader sees.
    std::vector<GLint> firsts;
    std::vector<GLsizei> counts;
    std::uint32_t end = 0;
    for (std::size_t branch = 0; branch < std::min(layers.size(), shown_->runs.size()); ++branch) {
        const Centerlines::Run run = shown_->runs[branch];
        if (layers[branch] != Layer::kGlass || run.count < 2) continue;
        if (!counts.empty() && end == run.first)
            counts.back() += static_cast<GLsizei>(6 * run.count);
        else
            firsts.push_back(static_cast<GLint>(6 * run.first)), counts.push_back(static_cast<GLsizei>(6 * run.count));
        end = run.first + run.count;
    }
    for (GLsizei& count : counts) count -= 6; // the last point begins no segment
    if (!counts.empty())
        glMultiDrawArrays(GL_TRIANGLES, firsts.data(), counts.data(), static_cast<GLsizei>(counts.size()));
}

} // namespace ramus::render
