// Sorts the images of a DICOM series along their normal into a volume, and computes its position.
#pragma once

#include "core/io/volumes/dicom/dicom_image.h"

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

namespace ramus::io {

// A frame of one of the images.
struct DicomSlice {
    std::size_t image = 0, frame = 0;
};

struct DicomStack {
    std::vector<DicomSlice> slices;
    glm::dmat4 to_patient{1.0}; // voxel indices to mm, RAS; accepted by check_affine()
    std::vector<std::string> notes;
};

// Takes the largest group of images with equal direction and spacing, without localizers. The notes say which images
// were left out, and whether the positions are uneven. The third axis is the mean step between slices, so it is also
// correct for a tilted gantry. Fails on images without a position, on two at one position, and on missing slices.
[[nodiscard]] Result<DicomStack> stack_images(const std::vector<DicomImage>& images, const std::string& name);

// The affine to mm, RAS with the pixel axes and origin of `frame`, and `step` as its third axis.
[[nodiscard]] glm::dmat4 frame_affine(const DicomFrame& frame, const glm::dvec3& step);
[[nodiscard]] glm::dvec3 frame_normal(const DicomFrame& frame);
// Whether two frames have the same directions and spacing.
[[nodiscard]] bool lie_alike(const DicomFrame& a, const DicomFrame& b);
// Fails if position, directions or spacing are missing or invalid.
[[nodiscard]] Result<void> check_frame(const DicomFrame& frame, const std::string& name);

} // namespace ramus::io
