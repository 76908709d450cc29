// The panel that asks for the unit and the axes that a file does not state.
#pragma once

#include "app/session/document.h"
#include "core/io/orientation.h"
#include "core/io/trees/imported_tree.h"
#include "render/scene/camera.h"

#include <array>
#include <optional>
#include <string>

namespace ramus::app {

// The panel that asks for what a file does not say.
struct UnitsPanel {
    std::string unit = "open"; // a name, "voxels", or "open": nobody says it
    std::array<char, 64> voxel{};
    std::array<std::optional<io::Side>, 3> sides{};                   // that x, y, z lead to; never two on one line
    void show(const io::ReadOptions& options);                        // said_of() the document
    [[nodiscard]] std::optional<io::Orientation> orientation() const; // none: not all three are chosen
    // What the picture of a tree that is read so calls its axes while the choice is tried; none: as ever.
    [[nodiscard]] std::optional<render::AxisNames> axes(const tree::Claims& claims,
                                                        const io::ReadOptions& options) const;
};

// What a person has said of the document's file: its reading; without a tree, the unit that all context has been given.
[[nodiscard]] io::ReadOptions said_of(const Document& document);

} // namespace ramus::app
