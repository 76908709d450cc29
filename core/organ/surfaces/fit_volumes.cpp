#include "core/organ/surfaces/fit_volumes.h"

#include "core/base/grouped.h"
#include "core/organ/surfaces/relax_net.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace ramus::organ::surfaces {

namespace {

constexpr double kGoodError = 0.001; // no further rounds below that
constexpr int kRounds = 6;

// A symmetric matrix by label: the first-order change of a volume by a pressure.
class Pressures {
public:
    explicit Pressures(std::size_t labels) : diagonal_(labels, 0.0) {}
    void add(std::uint32_t a, std::uint32_t b, double value) {
        if (a == b) {
            diagonal_[a] += value;
            return;
        }
        const auto pair = std::minmax(a, b);
        if (others_.empty() || others_.back().a != pair.first || others_.back().b != pair.second)
            others_.push_back({pair.first, pair.second, 0.0});
        others_.back().value += value;
    }
    // The pressures that give the changes, by conjugate gradients. Label 0 keeps pressure 0.
    [[nodiscard]] std::vector<double> solve(std::vector<double> wanted) {
        merge();
        const std::size_t count = diagonal_.size();
        std::vector<double> pressures(count, 0.0), direction(count), scaled(count), image(count);
        wanted[0] = 0.0;
        double before = 0.0;
        const double enough = 1e-8 * dot(wanted, wanted);
        for (std::size_t step = 0; step < 4 * count + 20 && dot(wanted, wanted) > enough; ++step) {
            for (std::size_t n = 1; n < count; ++n) scaled[n] = diagonal_[n] > 0.0 ? wanted[n] / diagonal_[n] : 0.0;
            const double now = dot(wanted, scaled);
            for (std::size_t n = 0; n < count; ++n)
                direction[n] = scaled[n] + (step == 0 ? 0.0 : now / before * direction[n]);
            before = now;
            multiply(direction, image);
            const double curve = dot(direction, image);
            if (!(curve > 0.0)) break;
            for (std::size_t n = 1; n < count; ++n) {
                pressures[n] += now / curve * direction[n];
                wanted[n] -= now / curve * image[n];
            }
        }
        return pressures;
    }

private:
    struct Entry {
        std::uint32_t a, b;
        double value;
    };

    static double dot(const std::vector<double>& a, const std::vector<double>& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    }
    void merge() {
        std::ranges::stable_sort(others_, {}, [](const Entry& entry) { return std::pair(entry.a, entry.b); });
        std::vector<Entry> merged;
        for (const Entry& entry : others_) {
            if (merged.empty() || merged.back().a != entry.a || merged.back().b != entry.b)
                merged.push_back({entry.a, entry.b, 0.0});
            merged.back().value += entry.value;
        }
        others_.swap(merged);
    }
    void multiply(const std::vector<double>& by, std::vector<double>& image) const {
        constexpr double kFirm = 1.0 + 1e-9; // the matrix is singular where a label does not reach the outside
        for (std::size_t n = 0; n < by.size(); ++n) image[n] = kFirm * diagonal_[n] * by[n];
        for (const Entry& entry : others_) {
            image[entry.a] += entry.value * by[entry.b];
            image[entry.b] += entry.value * by[entry.a];
        }
        image[0] = 0.0;
    }

    std::vector<double> diagonal_;
    std::vector<Entry> others_; // off the diagonal
};

// The gradients of the volumes of the labels at a vertex.
struct Gradients {
    std::vector<std::pair<std::uint32_t, glm::dvec3>> of_labels;
    double area = 0.0;
    glm::dvec3& of(std::uint32_t label) {
        for (auto& [which, gradient] : of_labels)
            if (which == label) return gradient;
        return of_labels.emplace_back(label, glm::dvec3(0.0)).second;
    }
};

class VolumeFit {
public:
    VolumeFit(const Bounded& surfaces, std::span<const glm::vec3> corners, LargeArray<glm::vec3>& places)
        : surfaces_(surfaces), corners_(corners), places_(places), around_(places.size(), [&](const auto& put) {
              for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
                  for (int corner = 0; corner < 3; ++corner) put(surfaces.triangles[t][corner], t);
          }) {}

    // By label: what is missing, in voxels. `worst` receives the largest error as a fraction.
    [[nodiscard]] std::vector<double> missing(double& worst) const {
        const std::size_t count = surfaces_.volumes.size();
        std::vector<double> volumes(count, 0.0);
        std::vector<glm::dvec3> origins(count, glm::dvec3(0.0)); // near the label: less is lost to rounding
        std::vector<std::uint8_t> known(count, 0);
        for (std::size_t t = 0; t < surfaces_.triangles.size(); ++t) {
            const glm::uvec3& triangle = surfaces_.triangles[t];
            for (std::size_t side = 0; side < 2; ++side) {
                const std::uint32_t label = surfaces_.labels[t][side];
                if (known[label] == 0) origins[label] = glm::dvec3(corners_[triangle.x]), known[label] = 1;
                const glm::dvec3 a = glm::dvec3(places_[triangle.x]) - origins[label];
                const glm::dvec3 b = glm::dvec3(places_[triangle.y]) - origins[label];
                const glm::dvec3 c = glm::dvec3(places_[triangle.z]) - origins[label];
                volumes[label] +=
                    (side == 0 ? 1.0 : -1.0) * surfaces_.orientation * glm::dot(a, glm::cross(b, c)) / 6.0;
            }
        }
        worst = 0.0;
        for (std::size_t label = 1; label < count; ++label) {
            volumes[label] = surfaces_.volumes[label] - volumes[label];
            if (surfaces_.volumes[label] > 0.0)
                worst = std::max(worst, std::abs(volumes[label]) / surfaces_.volumes[label]);
        }
        return volumes;
    }

    void move(const std::vector<double>& missing) {
        Pressures matrix(surfaces_.volumes.size());
        Gradients at;
        for (std::uint32_t v = 0; v < places_.size(); ++v) {
            find_gradients(v, at);
            if (at.area <= 0.0) continue;
            for (std::size_t a = 0; a < at.of_labels.size(); ++a)
                for (std::size_t b = a; b < at.of_labels.size(); ++b)
                    matrix.add(at.of_labels[a].first, at.of_labels[b].first,
                               glm::dot(at.of_labels[a].second, at.of_labels[b].second) / at.area);
        }
        const std::vector<double> pressures = matrix.solve(missing);
        LargeArray<glm::vec3> moved = places_;
        for (std::uint32_t v = 0; v < places_.size(); ++v) {
            find_gradients(v, at);
            if (at.area <= 0.0) continue;
            glm::dvec3 by(0.0);
            for (const auto& [label, gradient] : at.of_labels) by += pressures[label] / at.area * gradient;
            moved[v] = glm::clamp(places_[v] + glm::vec3(by), corners_[v] - kMostMove, corners_[v] + kMostMove);
        }
        places_.swap(moved);
    }

    // Moves all vertices of labels that are off toward their corners: half of the way, and the whole in the fourth
    // round.
    void give_up(const std::vector<double>& missing) {
        if (rounds_.empty()) rounds_.assign(places_.size(), 0);
        std::vector<std::uint8_t> touched(places_.size(), 0);
        for (std::size_t t = 0; t < surfaces_.triangles.size(); ++t) {
            bool off = false;
            for (const std::uint32_t label : surfaces_.labels[t])
                off |= label != 0 && std::abs(missing[label]) > kMostVolumeError * surfaces_.volumes[label];
            for (int corner = 0; off && corner < 3; ++corner) touched[surfaces_.triangles[t][corner]] = 1;
        }
        for (std::size_t v = 0; v < places_.size(); ++v)
            if (touched[v] != 0)
                places_[v] = rounds_[v] < 3 ? 0.5F * (places_[v] + corners_[v]) : corners_[v], ++rounds_[v];
    }

private:
    void find_gradients(std::uint32_t v, Gradients& at) const {
        at.of_labels.clear();
        at.area = 0.0;
        for (const std::uint32_t t : around_.of(v)) {
            const glm::uvec3& triangle = surfaces_.triangles[t];
            const glm::dvec3 a(places_[triangle.x]), b(places_[triangle.y]), c(places_[triangle.z]);
            const glm::dvec3 gradient = surfaces_.orientation / 6.0 * glm::cross(b - a, c - a);
            at.area += glm::length(gradient);
            at.of(surfaces_.labels[t][0]) += gradient;
            at.of(surfaces_.labels[t][1]) -= gradient;
        }
    }

    const Bounded& surfaces_;
    std::span<const glm::vec3> corners_;
    LargeArray<glm::vec3>& places_;
    Grouped<std::uint32_t> around_;     // by vertex: its triangles
    std::vector<std::uint32_t> rounds_; // by vertex, of give_up()
};

} // namespace

void fit_volumes(const Bounded& surfaces, std::span<const glm::vec3> corners, LargeArray<glm::vec3>& places,
                 const JobRange& job) {
    VolumeFit fit(surfaces, corners, places);
    double worst = 0.0;
    std::vector<double> missing = fit.missing(worst);
    for (int round = 0; round < kRounds && worst > kGoodError && !job.cancelled(); ++round) {
        fit.move(missing);
        missing = fit.missing(worst);
        job.report(static_cast<float>(round + 1) / static_cast<float>(kRounds));
    }
    // Ends: a label that stays off is at its corners after four rounds, and its volume is exact there.
    while (worst > kMostVolumeError && !job.cancelled()) {
        fit.give_up(missing);
        missing = fit.missing(worst);
    }
}

} // namespace ramus::organ::surfaces
