// Reads segmentations that 3D Slicer wrote to NRRD. The fields Segment0_Name, Segment0_LabelValue, Segment0_Layer and
// Segment0_Color describe each segment. Overlapping segments are in different layers: a voxel has one number for each
// layer, and a segment is a value in one layer.
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
    std::int32_t value = 0; // of its voxels in the layer; not 0
    std::optional<std::array<std::uint8_t, 3>> colour;
};

// The segments in the order of the file. Empty: the file is no segmentation. A missing value is the number of the
// segment, from 1.
[[nodiscard]] std::vector<SlicerSegment> slicer_segments(const HeaderText& header);

// The names of segments that are all in one layer: their values are the labels. Ascending.
[[nodiscard]] std::vector<volume::LabelName> names_of(const std::vector<SlicerSegment>& segments);

// Converts the numbers of layers into one number for each voxel. If all segments have different values, the values are
// the labels; otherwise segments are numbered from 1 in the order of the file, with a note. Values without a segment
// get labels above those of the segments. Call merged() for all numbers of the file in order, then finish().
class SegmentLayers {
public:
    SegmentLayers(std::size_t count, const std::vector<SlicerSegment>& segments, std::vector<std::string>& notes);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::vector<volume::LabelName> names() const { return names_; }

    // Takes the next numbers of the file, which need not end with a complete voxel, and returns the values of the
    // complete voxels. `name`: of the file, for errors. Fails on negative numbers, on more than 1,024 values without a
    // segment, and like volume::OverlapTable.
    [[nodiscard]] Result<std::vector<std::int32_t>> merged(const std::vector<std::int64_t>& numbers,
                                                           const std::string& name);
    // Adds the sets of overlapping labels to `volume`, when all voxels are there.
    void finish(volume::Volume& volume) &&;

private:
    [[nodiscard]] Result<std::int32_t> value_of(const std::int64_t* numbers);
    [[nodiscard]] Result<std::int32_t> label_of(std::size_t layer, std::int64_t value);

    std::size_t count_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::int32_t> labels_; // by layer and value
    std::vector<volume::LabelName> names_;
    std::int32_t next_ = 0, end_ = 0; // labels for values without a segment
    volume::OverlapTable overlaps_;
    std::vector<std::int64_t> begun_; // numbers of the incomplete voxel
    std::vector<std::int64_t> last_;  // cache: numbers of the previous voxel, which are usually repeated
    std::int32_t last_value_ = 0;
};

} // namespace ramus::io
