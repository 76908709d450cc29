#include "core/base/infinity.h"
#include "core/validate/questions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

namespace ramus::validate {

namespace {

// Tuned on trees of patients with correct surfaces, and on surfaces with one fault each. Means along the vessel are
// compared, so that the rounding of a jump of the radius is no change of width, and the rounding of a corner no offset.
constexpr double kWindow = 1.5;          // radii to either side
constexpr double kWindowVoxels = 3.0;    // voxels to either side, for a tree of voxels
constexpr double kShortestStretch = 2.0; // least length of a stretch, in radii
constexpr double kJoined = 2.0;          // stretches with a smaller gap are joined, in radii
constexpr double kLong = 12.0;           // radii: longer than the part of a stenosis that is filled
constexpr std::size_t kFewest = 4;       // least number of places of a mean

constexpr double kAllowedWidth = 0.1;
constexpr double kAllowedOffset = 1.0 / 3.0; // in radii

// Means along the vessel around a place.
struct Mean {
    double expected_mm = 0.0, radius_mm = 0.0, scale_mm = 0.0;
    glm::dvec3 offset{0.0};
};

class Means {
public:
    Means(const Reference& reference, std::span<const Section> sections, std::size_t branch)
        : places_(reference.places_of(branch)), sections_(sections.subspan(reference.first_of(branch), places_.size())),
          grain_mm_(reference.grain_mm()) {}

    [[nodiscard]] std::span<const Place> places() const { return places_; }
    [[nodiscard]] bool measured(std::size_t i) const { return is_alone(places_[i]) && sections_[i].found; }
    // The values at the place itself, without a mean.
    [[nodiscard]] Mean only(std::size_t i) const {
        return {places_[i].radius, sections_[i].vessel.radius, places_[i].scale, offset_of(sections_[i], places_[i])};
    }
    // The means around a place; none if too little of the vessel there is away from joints, ends and other vessels.
    [[nodiscard]] std::optional<Mean> at(std::size_t i) const {
        if (!measured(i)) return std::nullopt;
        const double reach = std::max(kWindow * places_[i].scale, kWindowVoxels * grain_mm_);
        Mean mean;
        double length = 0.0;
        std::size_t count = 0;
        const auto take = [&](std::size_t j) {
            if (!measured(j)) return;
            const double step = places_[j].step;
            length += step, ++count;
            mean.expected_mm += step * places_[j].radius;
            mean.scale_mm += step * places_[j].scale;
            mean.radius_mm += step * sections_[j].vessel.radius;
            mean.offset += step * offset_of(sections_[j], places_[j]);
        };
        for (std::size_t j = i; j < places_.size() && places_[j].along <= places_[i].along + reach; ++j) take(j);
        for (std::size_t j = i; j-- > 0 && places_[j].along >= places_[i].along - reach;) take(j);
        if (count < kFewest || length < 0.5 * reach) return std::nullopt;
        mean.expected_mm /= length, mean.radius_mm /= length, mean.scale_mm /= length, mean.offset /= length;
        return mean;
    }

private:
    std::span<const Place> places_;
    std::span<const Section> sections_;
    double grain_mm_;
};

// A stretch of a branch: the indices of its first and last place.
struct Stretch {
    std::size_t first = 0, last = 0;
};

// The stretches in which off(mean) holds, with small gaps and places that cannot be measured bridged.
template <class Off> std::vector<Stretch> stretches_where(const Means& means, const Off& off) {
    const std::span<const Place> places = means.places();
    std::vector<Stretch> all;
    bool goes_on = false; // whether off() held at the last measured place
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::optional<Mean> mean = means.at(i);
        if (!mean) continue;
        const bool goes_on_here = std::exchange(goes_on, off(*mean));
        if (!goes_on) continue;
        const bool is_near =
            !all.empty() && places[i].along - places[all.back().last].along <= kJoined * places[i].scale;
        if (goes_on_here || is_near)
            all.back().last = i;
        else
            all.push_back({i, i});
    }
    std::erase_if(all, [&](const Stretch& one) {
        const Place &first = places[one.first], &last = places[one.last];
        return last.along + last.step - first.along < kShortestStretch * places[(one.first + one.last) / 2].scale;
    });
    return all;
}

// The place of a stretch with the largest size(mean).
template <class Size> std::size_t worst_of(const Means& means, const Stretch& stretch, const Size& size) {
    std::size_t worst = stretch.first;
    double most = -kInfinity;
    for (std::size_t i = stretch.first; i <= stretch.last; ++i)
        if (const std::optional<Mean> mean = means.at(i); mean && size(*mean) > most) worst = i, most = size(*mean);
    return worst;
}

double length_of(const Means& means, const Stretch& stretch) {
    const Place &first = means.places()[stretch.first], &last = means.places()[stretch.last];
    return last.along + last.step - first.along;
}

double change_of(const Mean& mean) { return (mean.radius_mm - mean.expected_mm) / mean.scale_mm; }

bool is_off(const Mean& mean, double side) { return side * change_of(mean) > kAllowedWidth; }

std::size_t place_of(const Means& means, const glm::dvec3& at) {
    return static_cast<std::size_t>(std::ranges::find(means.places(), at, &Place::at) - means.places().begin());
}

// Whether the vessel is off on both sides of a narrow place, at the widest measured places there. Then the narrow place
// is part of a stretch with a different width.
bool is_of_stretch(const Means& means, std::size_t narrow, double side) {
    constexpr double kLooked = 12.0; // radii: half of a stenosis of five diameters, and more
    const std::span<const Place> places = means.places();
    std::optional<std::size_t> before, behind; // the widest measured, the farthest of these
    const auto take = [&](std::optional<std::size_t>& widest, std::size_t i) {
        const double most = widest ? places[*widest].radius : places[narrow].radius;
        if (std::abs(places[i].along - places[narrow].along) > kLooked * std::max(most, places[i].radius)) return false;
        if (means.measured(i) && places[i].radius >= (1.0 - 1e-6) * most) widest = i;
        return true;
    };
    for (std::size_t i = narrow; i-- > 0 && take(before, i);) {
    }
    for (std::size_t i = narrow + 1; i < places.size() && take(behind, i); ++i) {
    }
    std::size_t asked = 0, off = 0;
    for (const std::optional<std::size_t>& widest : {before, behind})
        if (widest) ++asked, off += is_off(means.only(*widest), side) ? 1 : 0; // a mean would include the narrow place
    return asked > 0 && off == asked;
}

// Whether the vessel has left its place: the side opposite to the offset is outside. Otherwise it is still there, and
// something sticks out of it on the other side.
bool has_left(const Means& means, const Probe& probe, const Stretch& stretch) {
    constexpr double kWithin = 0.85; // radii; a vessel that is off by a third of the radius ends at two thirds
    std::size_t asked = 0, outside = 0;
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
        const std::optional<Mean> mean = means.at(i);
        if (!mean || !(glm::length(mean->offset) > 0.0)) continue;
        const Place& place = means.places()[i];
        ++asked;
        outside += probe.inside(place.at - kWithin * place.radius * glm::normalize(mean->offset)) ? 0 : 1;
    }
    return 2 * outside > asked;
}

bool overlaps(const Means& means, const Stretch& stretch, std::size_t place) {
    const std::span<const Place> places = means.places();
    const double around = kWindow * places[place].scale;
    return places[place].along >= places[stretch.first].along - around &&
           places[place].along <= places[stretch.last].along + around;
}

} // namespace

bool is_moved(std::span<const MovedStretch> moved, const Place& place) {
    const double around = kWindow * place.scale;
    return std::ranges::any_of(moved, [&](const MovedStretch& one) {
        return one.offset.branch == place.branch && place.along >= one.from - around && place.along <= one.to + around;
    });
}

std::vector<MovedStretch> moved_stretches(const Reference& reference, const Probe& probe,
                                          std::span<const Section> sections) {
    std::vector<MovedStretch> found;
    const auto in_radii = [](const Mean& mean) { return glm::length(mean.offset) / mean.expected_mm; };
    for (std::size_t branch = 0; branch < reference.branches(); ++branch) {
        const Means means(reference, sections, branch);
        for (const Stretch& stretch :
             stretches_where(means, [&](const Mean& mean) { return in_radii(mean) > kAllowedOffset; })) {
            if (!has_left(means, probe, stretch)) continue;
            const std::size_t worst = worst_of(means, stretch, in_radii);
            const double from = means.places()[stretch.first].along, length = length_of(means, stretch);
            found.push_back(
                {{static_cast<int>(branch), means.places()[worst].at, length, glm::length(means.at(worst)->offset)},
                 from,
                 from + length});
        }
    }
    return found;
}

std::vector<Width> changed_widths(const Reference& reference, std::span<const Section> sections,
                                  std::span<const MovedStretch> moved, std::vector<Constriction>& constrictions) {
    std::vector<Width> found;
    for (std::size_t branch = 0; branch < reference.branches(); ++branch) {
        const Means means(reference, sections, branch);
        const int id = static_cast<int>(branch);
        for (const double side : {1.0, -1.0})
            for (const Stretch& stretch :
                 stretches_where(means, [&](const Mean& mean) { return is_off(mean, side); })) {
                const std::size_t worst =
                    worst_of(means, stretch, [&](const Mean& mean) { return side * change_of(mean); });
                if (is_moved(moved, means.places()[worst])) continue;
                // A stretch longer than the range that a stenosis of five diameters changes is not caused by narrow
                // places.
                const double beside = std::max(means.places()[stretch.first].scale, means.places()[stretch.last].scale);
                const bool is_long = length_of(means, stretch) > kLong * beside;
                const auto narrow_here = [&](const Constriction& one) {
                    return one.branch == id && overlaps(means, stretch, place_of(means, one.at));
                };
                std::erase_if(constrictions, [&](const Constriction& one) {
                    return narrow_here(one) && (is_long || is_of_stretch(means, place_of(means, one.at), side));
                });
                if (std::ranges::any_of(constrictions, narrow_here)) continue;
                const Mean mean = *means.at(worst);
                found.push_back(
                    {id, means.places()[worst].at, length_of(means, stretch), mean.expected_mm, mean.radius_mm});
            }
    }
    return found;
}

} // namespace ramus::validate
