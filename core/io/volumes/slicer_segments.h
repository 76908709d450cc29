// Segmentations as 3D Slicer writes them to NRRD: what the fields Segment0_Name, Segment0_LabelValue, Segment0_Layer
// and Segment0_Color say of each segment, and layers, which segments that overlap are written to: a voxel has one
// number for each layer, and a segment is a number of one layer.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/header_text.h"
#include "core/volume/overlap_table.h"
#include "core/volume/volume.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ramus::io {

struct SlicerSegment {
    std::string name;
    std::int64_t layer = 0;
    std::int32_t value = 0; // that its voxels have in the layer; not 0
    std::optional<std::array<std::uint8_t, 3>> colour;
};

// In the order of the file; none: the header is not that of a segmentation. Values that are left out count from 1.
[[nodiscard]] std::vector<SlicerSegment> slicer_segments(const HeaderText& header);

// Of segments that share no layer with others, or all of them: their values are their labels. Ascending.
[[nodiscard]] std::vector<volume::LabelName> names_of(const std::vector<SlicerSegment>& segments);

// Turns the numbers of layers into one number for each voxel. Labels are the values that segments have in their layers
// if no two segments have the same value; else segments are numbered from 1 in the order of the file, and a note says
// so. Values that no segment has get labels behind those of the segments.
class SegmentLayers {
public:
    SegmentLayers(std::size_t count, const std::vector<SlicerSegment>& segments, std::vector<std::string>& notes);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::vector<volume::LabelName> names() const { return names_; }

    // The next numbers of the file, which need not end with a voxel: the values of the voxels that are complete.
    // `name`: of the file, for errors. Fails on negative numbers, on more than 1,024 values that no segment has, and
    // like volume::OverlapTable.
    [[nodiscard]] Result<std::vector<std::int32_t>> merged(const std::vector<std::int64_t>& numbers,
                                                           const std::string& name);
    // Once all voxels are there.
    void finish(volume::Volume& volume) &&;

private:
    [[nodiscard]] Result<std::int32_t> value_of(const std::int64_t* numbers);
    [[nodiscard]] Result<std::int32_t> label_of(std::size_t layer, std::int64_t value);

    std::size_t count_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::int32_t> labels_; // of a layer and a value
    std::vector<volume::LabelName> names_;
    std::int32_t next_ = 0, end_ = 0; // labels for values that no segment has
    volume::OverlapTable overlaps_;
    std::vector<std::int64_t> begun_; // of the voxel that is not complete
    std::vector<std::int64_t> last_;  // numbers of the voxel before, most often the same as the next one's
    std::int32_t last_value_ = 0;
};

} // namespace ramus::io
