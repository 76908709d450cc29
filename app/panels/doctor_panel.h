// The import doctor's panel.
#pragma once

#include "app/panels/slider_row.h"
#include "app/panels/widgets.h"

#include <array>

namespace ramus::app {

// What the import doctor's panel remembers.
struct Doctor {
    bool mark = true;    // in the picture
    int current = -1;    // the note that was gone to; -1: none
    bool voxels = false; // the field for a size of voxels is there
    std::array<char, 64> voxel{};
    std::array<char, 32> radius{}; // of what has none; also where a file cannot be opened without
    bool of_mask = false;          // the tree was made of one
    bool place = false;            // the field for the root's place is there
    std::array<char, 64> root{};
    widgets::Slider<float> bulge_size, islands;
};

} // namespace ramus::app
