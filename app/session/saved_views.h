// Saved views: cameras with names, to which a person comes back in the window, in scripts and on the page for browsers.
// They are marks: saving, renaming and deleting a view are steps of undo. Looking from a saved view is not.
//
// Names are unique in a session, are one line of text, and are not those of the anatomical views, so that a name means
// one view wherever it is typed. Letters count as they are typed.
#pragma once

#include "core/base/error.h"
#include "render/scene/camera.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace ramus::app {

struct SavedView {
    std::string name;
    render::Camera camera; // mm, RAS
    bool operator==(const SavedView&) const = default;
};

// Fails for an empty name, a name of several lines or with other control characters, and the name of an anatomical
// view.
[[nodiscard]] Result<void> check_view_name(const std::string& name);
// The index of the view of this name. The error names the closest one.
[[nodiscard]] Result<std::size_t> find_view(std::span<const SavedView> views, const std::string& name);
[[nodiscard]] bool has_view(std::span<const SavedView> views, const std::string& name);
// "View 3": the first such name that is free.
[[nodiscard]] std::string free_view_name(std::span<const SavedView> views);

// Adds a view behind the others, or replaces the camera of the one of this name. `name` must be a legal one.
void save_view(std::vector<SavedView>& views, const std::string& name, const render::Camera& camera);

} // namespace ramus::app
