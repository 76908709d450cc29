// Images of a DICOM series put in order: which of them make a volume, sorted along their normal, and where it lies.
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
    glm::dmat4 to_patient{1.0}; // checked
    std::vector<std::string> notes;
};

// The images of one series, of which those that lie as most do are taken, without localizers; the notes say what was
// left out and what of the positions is uneven. Fails on images without a place, on two at one place, on missing
// slices. The third axis is the mean step from slice to slice: true to them also where a tilted gantry shifts them.
[[nodiscard]] Result<DicomStack> stack_images(const std::vector<DicomImage>& images, const std::string& name);

// x and y of pixels, and the origin of `frame`; the third column is `step`. In RAS.
[[nodiscard]] glm::dmat4 frame_affine(const DicomFrame& frame, const glm::dvec3& step);
[[nodiscard]] glm::dvec3 frame_normal(const DicomFrame& frame);
// Whether two frames have the same directions and spacing.
[[nodiscard]] bool lie_alike(const DicomFrame& a, const DicomFrame& b);
// Whether position, directions and spacing are there and make sense.
[[nodiscard]] Result<void> check_frame(const DicomFrame& frame, const std::string& name);

} // namespace ramus::io
