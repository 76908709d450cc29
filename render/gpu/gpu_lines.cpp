#include "render/gpu/gpu_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace ramus::render {

namespace {

constexpr double kThinnedShare = 3e-4; // of the tree's extent: less than a pixel if it fills the window

} // namespace

void GpuLines::follow(const std::shared_ptr<const Centerlines>& lines) {
    if (lines == shown_) return;
    shown_ = lines && !lines->points.empty() ? lines : nullptr;
    bounds_ = shown_ ? bounds_of(*shown_) : Box{};
    thinned_ = {};
    list_ = {};
    levels_ = {};
    if (!shown_) return;
    balls_ = line_balls(*shown_);
    extent_mm_ = shown_->extent_mm();
    whole_.send(*shown_);
}

void GpuLines::bind_list(std::uint32_t list) {
    if (!shown_ || list >= shown_->lists.size()) return;
    if (list_.buffer == 0 || list_sent_ != list) {
        std::vector<Centerlines::Detail> numbers = shown_->details;
        for (std::size_t p = 0; p < numbers.size(); ++p) numbers[p].diameter_mm = shown_->lists[list][p];
        list_ = make_buffer_texture(GL_RG32UI, numbers);
        list_sent_ = list;
    }
    glBindTextureUnit(kUnitLineDetails, list_.texture);
}

const GpuLines::Copy& GpuLines::thinned() {
    if (shown_ && !thinned_.sent()) thinned_.send(shown_->thinned(kThinnedShare * extent_mm_));
    return thinned_;
}

// Merges adjacent runs; the shader discards the false segment between branches.
void GpuLines::Stretches::add(int level, const Centerlines::Run& run) {
    std::uint32_t first = run.first;
    segments_ += run.count - 1;
    for (std::uint32_t left = run.count - 1; left > 0;) {
        if (parts_.empty() || in_part_ >= kMostInPart || parts_.back().level != level) {
            parts_.push_back({level, counts_.size()});
            in_part_ = 0;
        }
        const std::uint32_t now = std::min(left, kMostInPart - in_part_);
        if (in_part_ > 0 && first == end_ + 1) {
            counts_.back() += static_cast<GLsizei>(6 * (now + 1));
        } else {
            firsts_.push_back(static_cast<GLint>(6 * first));
            counts_.push_back(static_cast<GLsizei>(6 * now));
        }
        first += now;
        left -= now;
        end_ = first;
        in_part_ += now;
    }
}

GpuLines::Stretches GpuLines::stretches(const Camera& camera, glm::ivec2 size, const std::vector<Layer>& layers,
                                        std::initializer_list<Layer> drawn) {
    Stretches found;
    if (!shown_) return found;
    std::vector<std::int8_t> levels = line_levels(balls_, extent_mm_, camera, size);
    for (std::size_t branch = 0; branch < levels.size(); ++branch)
        if (std::ranges::find(drawn, layer_of(layers, branch)) == drawn.end()) levels[branch] = kNotInPicture;
    for (int number = 0; number < kLineLevels; ++number) {
        if (std::ranges::find(levels, static_cast<std::int8_t>(number)) == levels.end()) continue;
        if (!level(number).sent())
            levels_.at(static_cast<std::size_t>(number))
                .send(shown_->thinned(level_mm(number, extent_mm_), std::numeric_limits<double>::infinity()));
        for (std::size_t branch = 0; branch < levels.size(); ++branch)
            if (levels[branch] == number) found.add(number, level(number).runs_[branch]);
    }
    return found;
}

void GpuLines::draw_part(const Stretches& stretches, std::size_t part) const {
    const auto [number, begin] = stretches.parts_[part];
    const std::size_t end = part + 1 < stretches.parts() ? stretches.parts_[part + 1].begin : stretches.counts_.size();
    level(number).bind();
    glMultiDrawArrays(GL_TRIANGLES, &stretches.firsts_[begin], &stretches.counts_[begin],
                      static_cast<GLsizei>(end - begin));
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
    // Merges adjacent runs; the shader discards the false segment between branches.
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
    for (GLsizei& count : counts) count -= 6; // the last point starts no segment
    if (!counts.empty())
        glMultiDrawArrays(GL_TRIANGLES, firsts.data(), counts.data(), static_cast<GLsizei>(counts.size()));
    return segments;
}

std::vector<SkeletonRing> skeleton_rings(const Centerlines& lines) {
    std::vector<SkeletonRing> rings;
    for (std::size_t branch = 0; branch < lines.runs.size(); ++branch) {
        const Centerlines::Run run = lines.runs[branch];
        if (run.count < 2) continue;
        const auto point = [&](std::uint32_t i) { return glm::vec3(lines.points[run.first + i]); };
        const auto radius = [&](std::uint32_t i) { return 0.5 * lines.details[run.first + i].diameter_mm; };
        std::vector<double> along(run.count, 0.0);
        double area = 0.0; // between the line and its radius
        for (std::uint32_t i = 1; i < run.count; ++i) {
            const double length = glm::distance(point(i - 1), point(i));
            along[i] = along[i - 1] + length;
            area += 0.5 * length * (radius(i - 1) + radius(i));
        }
        const double length = along.back(), mean = length > 0.0 ? area / length : 0.0;
        if (!(mean > 0.0) || length < mean) continue;
        const int count = std::max(1, static_cast<int>(length / (kRingSpacing * mean)));
        std::uint32_t segment = 1;
        for (int i = 0; i < count; ++i) {
            const double at = length * (i + 0.5) / count;
            while (segment + 1 < run.count && along[segment] < at) ++segment;
            const double step = along[segment] - along[segment - 1];
            const auto share = static_cast<float>(step > 0.0 ? (at - along[segment - 1]) / step : 0.0);
            // The direction over a radius to both sides, since segments of a voxel's length turn at every step.
            std::uint32_t from = segment - 1, to = segment;
            while (from > 0 && along[from] > at - mean) --from;
            while (to + 1 < run.count && along[to] < at + mean) ++to;
            glm::vec3 axis = point(to) - point(from);
            if (!(glm::length(axis) > 0.0F)) axis = point(segment) - point(segment - 1);
            if (!(glm::length(axis) > 0.0F)) continue;
            rings.push_back(
                {glm::mix(point(segment - 1), point(segment), share),
                 glm::mix(static_cast<float>(radius(segment - 1)), static_cast<float>(radius(segment)), share),
                 glm::normalize(axis), static_cast<std::int32_t>(branch)});
        }
    }
    return rings;
}

void GpuSkeleton::follow(const std::shared_ptr<const Centerlines>& lines) {
    if (lines.get() == shown()) return;
    lines_.follow(lines);
    all_.clear();
    if (shown() == nullptr) return;
    all_ = skeleton_rings(*shown());
    std::vector<glm::vec4> rings;
    for (const SkeletonRing& ring : all_) {
        rings.emplace_back(ring.centre, ring.radius_mm);
        rings.emplace_back(ring.axis, 0.0F);
    }
    if (!rings.empty()) rings_ = make_buffer_texture(GL_RGBA32F, rings);
}

GpuSkeleton::Seen GpuSkeleton::seen(const Camera& camera, glm::ivec2 size, const std::vector<Layer>& layers) const {
    Seen seen;
    if (shown() == nullptr) return seen;
    const Projector project(camera, size);
    const double in_focus = mm_per_pixel(camera, size);
    const double focus_mm = glm::distance(camera.position, camera.focal_point);
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const SkeletonRing& ring = all_[i];
        if (layer_of(layers, static_cast<std::size_t>(ring.branch)) == Layer::kNone) continue;
        const auto at = project(shown()->origin + glm::dvec3(ring.centre));
        if (!at) continue;
        const double mm_per_px = camera.orthographic ? in_focus : in_focus * at->z / focus_mm;
        const double pixels = ring.radius_mm / mm_per_px, reach = 1.5 * pixels + 4.0;
        if (pixels < kLeastRingPixels || at->x < -reach || at->y < -reach || at->x > size.x + reach ||
            at->y > size.y + reach)
            continue;
        (pixels < kLargeRingPixels ? seen.small : seen.large).push_back(static_cast<std::uint32_t>(i));
    }
    return seen;
}

} // namespace ramus::render
