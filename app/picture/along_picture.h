// The picture along the vessel that slices follow: what is drawn where. Used by the window, its mouse and pictures
// without a window.
#pragma once

#include "app/assets/vessel_sections.h"
#include "app/picture/compose.h"
#include "app/session/numbers.h"
#include "core/slice/cross_section.h"
#include "render/slice/slice_view.h"

#include <memory>
#include <optional>
#include <string>

namespace ramus::app {

// The usual width of a picture along a path: four of the vessel's largest diameters.
[[nodiscard]] double usual_width_mm(const slice::VesselPath& path);

// The slice views at a place of the path: the crosshair is there, and the oblique slice lies across the vessel.
[[nodiscard]] SliceViews views_at(SliceViews views, const slice::VesselPath& path, double at_mm);

// `mesh`: the shown surface. `inset_top`: pixels at the top that are occupied. Without a path, the picture has a
// sentence that says what to do.
[[nodiscard]] render::SliceView compose_along(const Session& session, const Assets& assets,
                                              const std::shared_ptr<const render::PagedMesh>& mesh,
                                              const Viewing& viewing, int inset_top);

// A ring around the vessel at the current place, in the picture of the tree.
void mark_followed(render::Frame& frame, const Session& session, const Assets& assets);

// "branch 12", "root to branch 12", "3@0.2 to 12@0.5".
[[nodiscard]] std::string way_words(const Way& way);
// "34.2 of 120 mm, branch 12".
[[nodiscard]] std::string arc_words(const slice::VesselPath& path, double at_mm, const Lengths& lengths);

// "Least diameter 42 % less (3.1 of 5.3 mm) at 34.2 mm, ...": each measure with the numbers that it comes from.
[[nodiscard]] std::string stenosis_words(const NarrowPlaces& places, const VesselSections& sections,
                                         const Lengths& lengths);

} // namespace ramus::app
