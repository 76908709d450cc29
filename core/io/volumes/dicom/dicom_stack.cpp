#include "core/io/volumes/dicom/dicom_stack.h"

#include "core/io/volumes/voxel_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace ramus::io {

namespace {

// Slices nearer than these count as the same position; as a fraction of the slice distance, and in mm.
constexpr double kSamePlace = 0.01, kSamePlaceLeast = 1e-3;
// Allowed deviation of slices from even steps, as a fraction of a step: without a note (rounded positions), and with a
// note. Not tuned on data: beyond a quarter, a slice is most likely missing.
constexpr double kEven = 0.01, kUneven = 0.25;

std::string length_text(double mm) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g mm", mm);
    return text.data();
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-4 * std::max(std::abs(a), std::abs(b)); }
bool near(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) <= 1e-3; }

class Stacker {
public:
    Stacker(const std::vector<DicomImage>& images, std::string name) : images_(images), name_(std::move(name)) {}

    Result<DicomStack> run() {
        if (auto picked = pick(); !picked) return tl::unexpected(picked.error());
        sort();
        const glm::dvec3 step = slices().size() > 1 ? between() : of_one();
        if (auto even = check_steps(step); !even) return tl::unexpected(even.error());
        stack_.to_patient = frame_affine(frame(0), step);
        const DicomImage& image = images_[slices()[0].image];
        const glm::ivec3 size(image.columns, image.rows, static_cast<int>(slices().size()));
        auto sound = check_affine(stack_.to_patient, size, "geometry (positions and orientation of its images)",
                                  "export it again", name_);
        if (!sound) return tl::unexpected(sound.error());
        return std::move(stack_);
    }

private:
    [[nodiscard]] std::vector<DicomSlice>& slices() { return stack_.slices; }
    [[nodiscard]] const DicomFrame& frame_of(const DicomSlice& slice) const {
        return images_[slice.image].frames[slice.frame];
    }
    [[nodiscard]] const DicomFrame& frame(std::size_t n) { return frame_of(slices()[n]); }
    [[nodiscard]] const std::string& file_of(std::size_t n) { return images_[slices()[n].image].file.name; }
    [[nodiscard]] double along_normal(const DicomSlice& slice) const {
        return glm::dot(*frame_of(slice).position, normal_);
    }
    void note(const std::string& text) { stack_.notes.push_back(text); }

    [[nodiscard]] bool alike(const DicomSlice& a, const DicomSlice& b) const {
        const DicomImage& image_a = images_[a.image];
        const DicomImage& image_b = images_[b.image];
        return image_a.rows == image_b.rows && image_a.columns == image_b.columns &&
               image_a.bits_allocated == image_b.bits_allocated && lie_alike(frame_of(a), frame_of(b));
    }

    // The largest group of slices with the same direction and spacing.
    Result<void> pick() {
        const bool only_localizers = std::ranges::all_of(images_, &DicomImage::localizer);
        std::vector<std::vector<DicomSlice>> groups;
        std::size_t left_out = 0, all = 0;
        std::string why;
        for (std::size_t n = 0; n < images_.size(); ++n) {
            for (std::size_t k = 0; k < images_[n].frames.size(); ++k, ++all) {
                const DicomSlice slice{n, k};
                if (images_[n].localizer && !only_localizers) {
                    ++left_out;
                    continue;
                }
                if (auto sound = check_frame(frame_of(slice), images_[n].file.name); !sound) return sound;
                const auto known =
                    std::ranges::find_if(groups, [&](const auto& group) { return alike(group.front(), slice); });
                if (known != groups.end())
                    known->push_back(slice);
                else
                    groups.push_back({slice});
            }
        }
        const auto largest = std::ranges::max_element(groups, {}, &std::vector<DicomSlice>::size);
        slices() = std::move(*largest);
        left_out = all - slices().size();
        if (left_out > 0)
            note("left out: " + std::to_string(left_out) + " of its " + std::to_string(all) +
                 " images, localizers or of another orientation or size");
        return {};
    }

    void sort() {
        normal_ = frame_normal(frame(0));
        std::ranges::stable_sort(slices(), {}, [&](const DicomSlice& slice) { return along_normal(slice); });
    }

    glm::dvec3 between() {
        return (*frame(slices().size() - 1).position - *frame(0).position) / static_cast<double>(slices().size() - 1);
    }
    // The step of a single slice.
    glm::dvec3 of_one() {
        const DicomFrame& only = frame(0);
        const double said = only.between_slices > 0.0 ? only.between_slices : only.thickness;
        const double mm = said > 0.0 && std::isfinite(said) ? said : 1.0;
        note("there is one slice alone: taken as " + length_text(mm) + " thick" +
             (said > 0.0 ? "" : ", for the file does not say"));
        return mm * normal_;
    }

    Result<void> check_steps(const glm::dvec3& step) {
        if (slices().size() < 2) return {};
        std::vector<double> gaps;
        for (std::size_t n = 1; n < slices().size(); ++n)
            gaps.push_back(along_normal(slices()[n]) - along_normal(slices()[n - 1]));
        std::vector<double> sorted = gaps;
        std::ranges::sort(sorted);
        const double usual = sorted[sorted.size() / 2];
        for (std::size_t n = 0; n < gaps.size(); ++n)
            if (gaps[n] < std::max(kSamePlace * usual, kSamePlaceLeast))
                return fail("two of its images lie at one place: " + file_of(n) + " and " + file_of(n + 1), name_,
                            "copy the images of one phase or echo, once each, to a folder of their own");
        const double along = glm::dot(step, normal_);
        double worst = 0.0;
        for (std::size_t n = 0; n < slices().size(); ++n)
            worst = std::max(worst, glm::length(*frame(n).position - *frame(0).position - double(n) * step));
        if (worst > kUneven * along) return refuse_steps(gaps, usual, sorted.front(), sorted.back());
        if (worst > kEven * along + kSamePlaceLeast)
            note("its slices are not evenly spaced: " + length_text(sorted.front()) + " to " +
                 length_text(sorted.back()) + "; put " + length_text(along) + " apart, they are up to " +
                 length_text(worst) + " from where they were");
        constexpr double kUpright = 0.1; // degrees; smaller angles come from rounded positions
        const double tilt = glm::degrees(std::acos(std::clamp(along / glm::length(step), -1.0, 1.0)));
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.3g", tilt);
        if (tilt > kUpright)
            note(std::string("the gantry was tilted by ") + text.data() +
                 " degrees: slices are shifted against each other, and the volume with them");
        return {};
    }

    Result<void> refuse_steps(const std::vector<double>& gaps, double usual, double least, double most) {
        constexpr double kMissing = 1.5; // in usual gaps
        const auto widest = static_cast<std::size_t>(std::ranges::max_element(gaps) - gaps.begin());
        if (most > kMissing * usual)
            return fail("slices are missing: from " + file_of(widest) + " to " + file_of(widest + 1) + " it is " +
                            length_text(most) + ", where " + length_text(usual) + " are the rule",
                        name_, "export the whole series");
        return fail("its slices do not lie one behind the other in even steps: " + length_text(least) + " to " +
                        length_text(most),
                    name_, "export one stack of the series");
    }

    const std::vector<DicomImage>& images_;
    std::string name_;
    DicomStack stack_;
    glm::dvec3 normal_{0.0};
};

} // namespace

Result<DicomStack> stack_images(const std::vector<DicomImage>& images, const std::string& name) {
    return Stacker(images, name).run();
}

glm::dmat4 frame_affine(const DicomFrame& frame, const glm::dvec3& step) {
    const auto& [row, column] = *frame.direction;
    glm::dmat4 affine(1.0);
    affine[0] = glm::dvec4(row * frame.spacing->x, 0.0);
    affine[1] = glm::dvec4(column * frame.spacing->y, 0.0);
    affine[2] = glm::dvec4(step, 0.0);
    affine[3] = glm::dvec4(*frame.position, 1.0);
    return lps_to_ras(affine);
}

glm::dvec3 frame_normal(const DicomFrame& frame) { return slice_axis((*frame.direction)[0], (*frame.direction)[1]); }

bool lie_alike(const DicomFrame& a, const DicomFrame& b) {
    return near((*a.direction)[0], (*b.direction)[0]) && near((*a.direction)[1], (*b.direction)[1]) &&
           near(a.spacing->x, b.spacing->x) && near(a.spacing->y, b.spacing->y);
}

Result<void> check_frame(const DicomFrame& frame, const std::string& name) {
    if (!frame.position || !frame.direction)
        return fail("its images do not say where they lie (ImagePositionPatient, ImageOrientationPatient)", name,
                    "export the original series");
    if (!frame.spacing)
        return fail("its images do not say how far pixels are apart (PixelSpacing)", name,
                    "export the original series");
    if (!std::isfinite(glm::dot(*frame.position, *frame.position)))
        return fail("its position (ImagePositionPatient) is no number", name, "export it again");
    const auto& [row, column] = *frame.direction;
    constexpr double kRounding = 1e-2; // generous tolerance for directions with few digits
    if (!(std::abs(glm::length(row) - 1.0) < kRounding && std::abs(glm::length(column) - 1.0) < kRounding &&
          std::abs(glm::dot(row, column)) < kRounding))
        return fail("its orientation (ImageOrientationPatient) is no pair of directions", name, "export it again");
    if (!(frame.spacing->x > 0.0 && frame.spacing->y > 0.0))
        return fail("its PixelSpacing is not a length", name, "export it again");
    return {};
}

} // namespace ramus::io
