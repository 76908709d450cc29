// What the side panel's controls hold while they are changed.
#pragma once

#include "app/panels/slider_row.h"
#include "app/panels/widgets.h"
#include "app/picture/flat_map.h"
#include "app/session/objects.h"
#include "app/session/systems.h"
#include "core/organ/couinaud.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// What the side panel's sliders and fields hold while they are being changed: the session hears of it when they are let
// go, so that it is one step of undo.
struct Editing {
    std::map<std::string_view, widgets::Slider<float>> options; // by the key of a SurfaceOption
    std::set<std::string_view> shown_options; // that are seen only when set; once seen they stay, for what is below
    widgets::Slider<float> glass_opacity, glass_grey, blend, wipe, territories;
    // Of one object of the scene, its colour while the picker is open, or its opacity while the slider is held.
    struct Object {
        std::string_view kind; // empty: of none
        std::size_t index = 0;
        std::optional<Rgb> colour;
        std::optional<double> opacity;
    } object;
    // Of one system, from 0, its colour while the picker is open.
    struct System {
        int of = -1;
        std::array<std::uint8_t, 3> colour{};
    } system;
    // One field for numbers has the keyboard at a time.
    struct Numbers {
        std::string field; // its id; empty: none
        std::array<char, 64> typed{};
    } numbers;
    // Branches suggested for segments of the liver, of this tree, until each is taken or left.
    struct Segments {
        std::weak_ptr<const tree::VesselTree> tree;
        std::vector<organ::SegmentSuggestion> list;
        std::string trouble; // why there are none
    } segments;
    // The flat maps of the current plan's resections.
    struct FlatMaps {
        std::set<int> open;                                 // by id of the resection
        std::shared_ptr<const Operation> of;                // of those that are made
        Systems systems;                                    // their colours
        std::map<std::size_t, std::optional<FlatMap>> made; // by index
    } maps;
    std::set<std::string> closed; // sections of the side panel, by title
    std::string thin;             // diameter below which vessels are thin, as it was typed; empty: the usual one
    std::string colours_before;   // what colours said before they said distances to lesions; empty: the usual
};

} // namespace ramus::app
