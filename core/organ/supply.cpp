#include "core/organ/supply.h"

#include "core/base/bounds.h"
#include "core/base/words.h"
#include "core/measure/amount.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <oneapi/tbb/parallel_invoke.h>
#include <utility>

namespace ramus::organ {

namespace {

constexpr std::array<std::pair<Rule, std::string_view>, 3> kRules{
    {{Rule::kTips, "tips"}, {Rule::kAxis, "axis"}, {Rule::kWall, "wall"}}};

// A segment or a tip of a branch. Its value at a point p is the least of |p - q| - r(q) over its points q.
struct Site {
    glm::dvec3 from, along;          // start, and the way to the end (0: a tip), mm
    double radius = 0.0, more = 0.0; // r at the start, and what it gains to the end; both 0 for an axis
    double steeper = 0.0;            // of a wall: distance along the axis by which q moves for each mm off the axis
    double length_squared = 0.0;
    std::int32_t branch = 0;
    float at = 0.0F, share = 0.0F; // place of its start on the branch, and its share of the branch's length
};

Site site_of(const glm::dvec3& from, const glm::dvec3& to) {
    Site site{from, to - from};
    site.length_squared = glm::dot(site.along, site.along);
    return site;
}

// The parameter of q: where the distance to the segment, or to its wall, is least.
double share_on(const Site& site, const glm::dvec3& from_start) {
    if (site.length_squared <= 0.0) return 0.0;
    const double along = glm::dot(from_start, site.along);
    double shift = 0.0;
    if (site.steeper != 0.0) {
        const double off = std::max(0.0, glm::dot(from_start, from_start) - along * along / site.length_squared);
        shift = site.steeper * std::sqrt(off);
    }
    return std::clamp((along + shift) / site.length_squared, 0.0, 1.0);
}

double value_at(const Site& site, const glm::dvec3& p) {
    const glm::dvec3 from_start = p - site.from;
    const double t = share_on(site, from_start);
    return glm::length(from_start - t * site.along) - (site.radius + t * site.more);
}

// Gives a segment these values of r at its ends: its wall is the cone that touches both balls. Where one ball contains
// the other, only that counts.
void add_wall(Site& site, double first, double last) {
    const double gain = last - first, length = std::sqrt(site.length_squared);
    if (std::abs(gain) >= length) {
        if (gain > 0.0) site.from += site.along, site.at += site.share;
        site.along = glm::dvec3(0.0);
        site.length_squared = site.share = 0.0;
        site.radius = std::max(first, last);
        return;
    }
    site.radius = first;
    site.more = gain;
    // q moves towards the thicker end by tan(angle of the cone) for each mm off the axis; here times the length.
    const double sine = gain / length;
    site.steeper = sine / std::sqrt(1.0 - sine * sine) * length;
}

std::vector<Site> sites_of(const Organ& organ, const tree::VesselTree& tree, const SupplyOptions& options,
                           std::span<const std::uint8_t> excluded) {
    const std::vector<std::uint8_t> inside = points_in(organ, tree);
    const std::vector<char> ends = measure::free_ends(tree);
    std::vector<Site> sites;
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        if (!excluded.empty() && excluded[id] != 0) continue;
        const tree::Branch& branch = tree.branches[id];
        const double length = tree::length_mm(tree, branch);
        double behind = 0.0;
        for (std::size_t n = 1; n < branch.points.size(); ++n) {
            const std::uint32_t a = branch.points[n - 1], b = branch.points[n];
            const tree::Point &from = tree.points[a], &to = tree.points[b];
            Site site = site_of(from.position, to.position);
            const double own = std::sqrt(site.length_squared);
            site.branch = static_cast<std::int32_t>(id);
            site.at = static_cast<float>(length > 0.0 ? behind / length : 0.0);
            site.share = static_cast<float>(length > 0.0 ? own / length : 0.0);
            behind += own;
            if (inside[a] == 0 && inside[b] == 0) continue;
            if (options.rule == Rule::kWall) add_wall(site, from.radius, to.radius);
            if (options.rule == Rule::kTips)
                add_wall(site, -options.axis_back * from.radius, -options.axis_back * to.radius);
            sites.push_back(site);
        }
        const std::uint32_t last = branch.points.back();
        if (options.rule != Rule::kTips || ends[id] == 0 || inside[last] == 0) continue;
        Site tip = site_of(tree.points[last].position, tree.points[last].position);
        tip.radius = options.tip_reach * tree.points[last].radius;
        tip.branch = static_cast<std::int32_t>(id);
        tip.at = 1.0F;
        sites.push_back(tip);
    }
    return sites;
}

// Halves blocks of voxels, and labels the voxels of small ones.
class Labelling {
public:
    Labelling(const Organ& organ, const std::vector<Site>& sites, Supply& supply, const JobRange& job)
        : organ_(organ), sites_(sites), supply_(supply), job_(job) {}

    void label(const glm::ivec3& from, const glm::ivec3& to, const std::vector<std::uint32_t>& candidates) {
        if (job_.cancelled()) return;
        Bounds<glm::ivec3> held; // of the organ's voxels in the block
        std::size_t count = 0;
        organ_.for_voxels(from, to, [&](const glm::ivec3& voxel, std::size_t) {
            held.hold(voxel);
            ++count;
        });
        if (count == 0) return;
        const glm::dvec3 least(held.least), most(held.most);
        const glm::dvec3 middle = glm::dvec3(organ_.to_patient() * glm::dvec4(0.5 * (least + most), 1.0));
        const std::vector<std::uint32_t> left = near(candidates, middle, half_diagonal(most - least));
        constexpr std::size_t kFew = 96; // voxels; tuned on a liver of 1.5 litres
        if (count <= kFew || left.size() == 1) {
            compare(held.least, held.most + 1, left);
            report(count);
            return;
        }
        // Halves the longest side.
        const glm::dvec3 sides = glm::dvec3(held.most + 1 - held.least) * volume::spacing_mm(organ_.to_patient());
        int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
        glm::ivec3 end = held.most + 1, begin = held.least;
        end[axis] = begin[axis] = (held.least[axis] + held.most[axis] + 1) / 2;
        const auto first = [&, end] { label(held.least, end, left); };
        const auto second = [&, begin] { label(begin, held.most + 1, left); };
        constexpr std::size_t kWorthAThread = 4096; // voxels
        if (count < kWorthAThread) {
            first();
            second();
        } else {
            tbb::parallel_invoke(first, second);
        }
    }

private:
    // The largest distance of voxel centres from the middle of a block with these index ranges.
    [[nodiscard]] double half_diagonal(const glm::dvec3& range) const {
        double largest = 0.0;
        for (const glm::dvec3 corner : {glm::dvec3(1, 1, 1), {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}})
            largest = std::max(largest, glm::length(glm::dmat3(organ_.to_patient()) * (0.5 * corner * range)));
        return largest;
    }

    // The candidates that may have the least value at a distance of up to `reach` from `middle`.
    [[nodiscard]] std::vector<std::uint32_t> near(const std::vector<std::uint32_t>& candidates,
                                                  const glm::dvec3& middle, double reach) const {
        std::vector<double> values(candidates.size());
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t n = 0; n < candidates.size(); ++n) {
            values[n] = value_at(sites_[candidates[n]], middle);
            least = std::min(least, values[n]);
        }
        constexpr double kRounding = 1e-9; // of the distances, for values computed twice
        const double most = least + 2.0 * reach + kRounding * (1.0 + std::abs(least) + reach);
        std::vector<std::uint32_t> left;
        for (std::size_t n = 0; n < candidates.size(); ++n)
            if (values[n] <= most) left.push_back(candidates[n]);
        return left;
    }

    // Compares the organ's voxels of a small block with all candidates.
    void compare(const glm::ivec3& from, const glm::ivec3& to, const std::vector<std::uint32_t>& candidates) {
        organ_.for_voxels(from, to, [&](const glm::ivec3& voxel, std::size_t number) {
            const glm::dvec3 p = organ_.centre_mm(voxel);
            double least = std::numeric_limits<double>::infinity();
            const Site* nearest = nullptr;
            for (const std::uint32_t n : candidates) { // ascending by branch: the first of equals stays
                const double value = value_at(sites_[n], p);
                if (value < least) least = value, nearest = &sites_[n];
            }
            supply_.branch[number] = nearest->branch;
            supply_.at[number] =
                nearest->at + nearest->share * static_cast<float>(share_on(*nearest, p - nearest->from));
        });
    }

    void report(std::size_t voxels) {
        const std::size_t done = done_.fetch_add(voxels, std::memory_order_relaxed) + voxels;
        job_.report(static_cast<float>(done) / static_cast<float>(organ_.count()));
    }

    const Organ& organ_;
    const std::vector<Site>& sites_;
    Supply& supply_;
    const JobRange& job_;
    std::atomic<std::size_t> done_{0};
};

} // namespace

std::string_view name_of(Rule rule) {
    return std::ranges::find(kRules, rule, &std::pair<Rule, std::string_view>::first)->second;
}

std::optional<Rule> rule_named(std::string_view name) { return paired_with(kRules, name); }

Result<Supply> supply_of(const Organ& organ, const tree::VesselTree& tree, const SupplyOptions& options,
                         std::span<const std::uint8_t> excluded, const JobRange& job) {
    const std::vector<Site> sites = sites_of(organ, tree, options, excluded);
    if (sites.empty())
        return fail("no vessel of the tree lies in the organ", {},
                    "check that both are of one patient, and the unit and the sides of the tree");
    Supply supply;
    supply.branch.resize(organ.count());
    supply.at.resize(organ.count());
    std::vector<std::uint32_t> all(sites.size());
    std::iota(all.begin(), all.end(), 0U);
    Labelling(organ, sites, supply, job).label(glm::ivec3(0), organ.size(), all);
    if (job.cancelled()) return fail("cancelled");
    return supply;
}

} // namespace ramus::organ
