// What tells near from far in the picture.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

Result<void> depth_cue(ActionContext& context, Arguments arguments) {
    std::string names;
    for (const DepthCue cue : kDepthCues) names += (names.empty() ? "" : ", ") + std::string(name_of(cue));
    const auto found = std::ranges::find_if(
        kDepthCues, [&](DepthCue cue) { return !arguments.empty() && name_of(cue) == arguments[0]; });
    const bool plain = arguments.size() == 1;
    if (found == kDepthCues.end() ||
        !(plain || (arguments.size() == 2 && (arguments[1] == "on" || arguments[1] == "off"))))
        return fail("depth-cue takes a name, and on or off", {}, "the names are " + names);
    Marks next = context.document.marks();
    next.depth_cues.set(*found, plain ? !next.depth_cues.has(*found) : arguments[1] == "on");
    context.document.change(std::move(next));
    return {};
}

template <DepthCue cue> bool shows(const Document& document) { return document.marks().depth_cues.has(cue); }

template <DepthCue cue> Command cue_entry(const char* label, const char* help) {
    return Command("depth-cue", "NAME [on|off]", help, depth_cue)
        .in_menu("View", label)
        .giving({std::string(name_of(cue))})
        .when(has_tree)
        .checked_when(shows<cue>);
}

} // namespace

std::vector<Command> depth_commands() {
    return {
        Command("depth-cue", "NAME [on|off]",
                "Switches what tells near from far: occlusion, fog, halos, contours, shadows, chromadepth.", depth_cue),
        cue_entry<DepthCue::kOcclusion>("Shade in crevices", "Darkens what its surroundings hide from the sky."),
        cue_entry<DepthCue::kFog>("Fog", "Lets the far end of the tree sink into the background."),
        cue_entry<DepthCue::kHalos>("Halos", "Draws dark seams around vessels that pass before others."),
        cue_entry<DepthCue::kContours>("Contours", "Draws the outlines of vessels dark."),
        cue_entry<DepthCue::kShadows>("Shadows", "Lets vessels throw shadows on others close by."),
        cue_entry<DepthCue::kChromadepth>("Near red, far blue", "Colours by the distance from the viewer."),
    };
}

} // namespace ramus::app::actions
