#include "app/session/depth_cues.h"

#include <algorithm>

namespace ramus::app {

using render::Appearance;

std::span<const DepthCue> depth_cues() {
    static constexpr DepthCue kCues[] = {
        {"occlusion", "Shade in crevices", "Darkens places that lie deep between other vessels.",
         &Appearance::occlusion},
        {"fog", "Fog", "Lets the far end of the tree sink into the background.", &Appearance::depth_cue},
        {"halos", "Halos", "Draws dark seams around vessels that pass before others.", &Appearance::halos},
        {"contours", "Contours", "Draws the outlines of vessels dark.", &Appearance::contours},
        {"shadows", "Shadows", "Lets vessels throw shadows on others close by.", &Appearance::shadows},
        {"chromadepth", "Near red, far blue", "Colours by the distance from the viewer.", &Appearance::chromadepth},
    };
    return kCues;
}

const DepthCue* depth_cue_named(std::string_view name) {
    const auto found = std::ranges::find(depth_cues(), name, &DepthCue::name);
    return found == depth_cues().end() ? nullptr : &*found;
}

} // namespace ramus::app
