#include "app/actions/organ_strokes.h"

#include "app/actions/arguments.h"
#include "app/assets/assets.h"
#include "app/assets/operation.h"
#include "core/organ/resect/resection.h"
#include "core/slice/pixel_grid.h"
#include "render/slice/slice_view.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::app::actions {

namespace {

std::optional<std::vector<glm::dvec2>> pixels_in(Arguments words) {
    constexpr double kMostPixels = 1e6;
    std::vector<glm::dvec2> pixels;
    for (const std::string& word : words) {
        const auto numbers = numbers_in(word, 2, kMostPixels);
        if (!numbers) return {};
        pixels.emplace_back((*numbers)[0], (*numbers)[1]);
    }
    return pixels;
}

// Lines of sight through the organ.
class Sight {
public:
    Sight(const render::Camera& camera, glm::ivec2 size, const organ::Organ& organ)
        : camera_(camera), size_(size), organ_(organ), to_voxels_(glm::inverse(organ.to_patient())) {
        const glm::dvec3 middle = organ.centre_mm(organ.size() / 2);
        const double reach = glm::distance(middle, organ.centre_mm(glm::ivec3(0)));
        const double depth = glm::dot(middle - camera.position, render::axes_of(camera).forward);
        constexpr double kNearest = 1e-3; // mm; in front of the eye
        near_ = camera.orthographic ? depth - reach : std::max(depth - reach, kNearest);
        far_ = std::max(depth + reach, near_ + kNearest);
    }

    [[nodiscard]] glm::dvec3 near_end(const glm::dvec2& pixel) const { return at(pixel, near_); }
    [[nodiscard]] glm::dvec3 far_end(const glm::dvec2& pixel) const { return at(pixel, far_); }

    // Appends the places where a line of sight enters and leaves the organ, to half a voxel.
    void add_ends(const glm::dvec2& pixel, std::vector<glm::dvec3>& places) const {
        const glm::dvec3 from = near_end(pixel), to = far_end(pixel);
        const glm::dmat3 axes(organ_.to_patient());
        const double step = 0.25 * std::min({glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])});
        const int steps = std::max(2, static_cast<int>(std::min(glm::distance(from, to) / step, 1e5)));
        int first = -1, last = -1;
        for (int n = 0; n <= steps; ++n)
            if (inside(glm::mix(from, to, static_cast<double>(n) / steps))) {
                if (first < 0) first = n;
                last = n;
            }
        if (first < 0) return;
        places.push_back(glm::mix(from, to, static_cast<double>(first) / steps));
        if (last > first) places.push_back(glm::mix(from, to, static_cast<double>(last) / steps));
    }

private:
    [[nodiscard]] glm::dvec3 at(const glm::dvec2& pixel, double depth) const {
        return render::unproject(camera_, size_, pixel, depth);
    }
    [[nodiscard]] bool inside(const glm::dvec3& place) const {
        const glm::ivec3 voxel(glm::floor(glm::dvec3(to_voxels_ * glm::dvec4(place, 1.0)) + 0.5));
        return organ_.mask().test(voxel);
    }

    render::Camera camera_;
    glm::ivec2 size_;
    const organ::Organ& organ_;
    glm::dmat4 to_voxels_;
    double near_ = 0.0, far_ = 0.0;
};

Result<Resection> plane_along(const Sight& sight, const std::vector<glm::dvec2>& pixels) {
    const glm::dvec3 a = sight.near_end(pixels[0]), b = sight.near_end(pixels[1]), behind = sight.far_end(pixels[0]);
    const glm::dvec3 normal = glm::cross(behind - a, b - a);
    if (pixels[0] == pixels[1] || glm::length(normal) == 0.0) return fail("a line is from one pixel to another");
    return Resection{.kind = Resection::Kind::kPlane, .point = 0.5 * (a + behind), .normal = glm::normalize(normal)};
}

// Also between the pixels: a straight stroke across the organ has its corners outside.
Result<Resection> sheet_along(const Sight& sight, const std::vector<glm::dvec2>& pixels) {
    constexpr double kSteps = 64.0; // along the stroke
    double length = 0.0;
    for (std::size_t n = 1; n < pixels.size(); ++n) length += glm::distance(pixels[n - 1], pixels[n]);
    std::vector<glm::dvec3> contour;
    sight.add_ends(pixels.front(), contour);
    for (std::size_t n = 1; n < pixels.size() && length > 0.0; ++n) {
        const double steps = std::ceil(kSteps * glm::distance(pixels[n - 1], pixels[n]) / length);
        for (double k = 1.0; k <= steps; k += 1.0)
            sight.add_ends(glm::mix(pixels[n - 1], pixels[n], k / steps), contour);
    }
    if (contour.size() < 4) return fail("the line does not cross the organ", {}, "draw it across the organ");
    RAMUS_TRY(sheet, organ::sheet_through(contour));
    return Resection{.kind = Resection::Kind::kSheet, .sheet = std::move(sheet)};
}

// Whether the side that a resection removes now is to stay instead.
bool is_wrong_side(const Resection& resection, const organ::Organ& organ, const std::vector<PlannedLesion>& lesions) {
    const organ::Resection function = resection.kind == Resection::Kind::kPlane
                                          ? organ::Resection(organ::HalfSpace{resection.point, resection.normal})
                                          : organ::Resection(resection.sheet);
    const auto is_removed = [&](const glm::dvec3& place) { return organ::value_at(function, place) <= 0.0; };
    std::size_t removed = 0;
    for (const PlannedLesion& lesion : lesions) {
        glm::dvec3 middle(lesion.sphere[0], lesion.sphere[1], lesion.sphere[2]);
        if (lesion.mesh) middle = 0.5 * (lesion.mesh->distance->bounds().least + lesion.mesh->distance->bounds().most);
        removed += is_removed(middle) ? 1 : 0;
    }
    if (!lesions.empty() && (removed == 0 || removed == lesions.size())) return removed == 0;
    std::atomic<std::size_t> voxels = 0;
    tbb::parallel_for(0, organ.size().z, [&](int k) {
        std::size_t here = 0;
        organ.for_voxels({0, 0, k}, {organ.size().x, organ.size().y, k + 1}, [&](const glm::ivec3& voxel, std::size_t) {
            here += is_removed(organ.centre_mm(voxel)) ? 1 : 0;
        });
        voxels += here;
    });
    return 2 * voxels > organ.count();
}

} // namespace

Result<const organ::Organ*> organ_read(const ActionContext& context) {
    const OrganAssets& assets = context.assets.organ;
    if (assets.source != context.document.marks().organ.source || !assets.mask.value || !*assets.mask.value)
        return fail("the organ is not read yet", {}, "wait for it, and give the command again");
    return &(*assets.mask.value)->organ;
}

Result<void> choose_side(const ActionContext& context, Resection& resection) {
    RAMUS_TRY(organ, organ_read(context));
    if (!is_wrong_side(resection, *organ, planned_lesions(context.assets, context.document.marks()))) return {};
    if (resection.kind == Resection::Kind::kPlane)
        resection.normal = -resection.normal;
    else
        resection.sheet.removes_below = !resection.sheet.removes_below;
    return {};
}

Result<Resection> resection_drawn(const ActionContext& context, bool straight, Arguments words) {
    const auto pixels = pixels_in(words);
    if (!pixels || (straight ? pixels->size() != 2 : pixels->size() < 2))
        return fail(straight ? "a line is two pixels X,Y" : "a stroke is two or more pixels X,Y", {},
                    "from the top left of the picture");
    RAMUS_TRY(organ, organ_read(context));
    const Sight sight(context.document.session().camera, context.picture.picture_size(), *organ);
    RAMUS_TRY(resection, straight ? plane_along(sight, *pixels) : sheet_along(sight, *pixels));
    if (auto chosen = choose_side(context, resection); !chosen) return tl::unexpected(chosen.error());
    return resection;
}

Result<Resection> resection_drawn_on_slice(const ActionContext& context, const glm::dvec3& normal,
                                           const std::vector<glm::dvec3>& places) {
    RAMUS_TRY(organ, organ_read(context));
    // A pixel for each mm; any size and middle serve.
    constexpr int kSide = 1000;
    const slice::PixelGrid grid =
        slice::grid_around(slice::axes_across(normal), places.front(), 1.0, glm::ivec2(kSide));
    const Sight sight(render::camera_of(grid), grid.size, *organ);
    std::vector<glm::dvec2> pixels;
    for (const glm::dvec3& place : places) pixels.push_back(grid.pixel(place) + 0.5);
    RAMUS_TRY(resection, sheet_along(sight, pixels));
    if (auto chosen = choose_side(context, resection); !chosen) return tl::unexpected(chosen.error());
    return resection;
}

} // namespace ramus::app::actions
