// The slices of a session: what is drawn where. Used by the window, its mouse and pictures without a window.
#pragma once

#include "app/picture/compose.h"
#include "app/session/numbers.h"
#include "app/session/slices.h"
#include "core/slice/pixel_grid.h"
#include "render/scene/bounds.h"
#include "render/slice/slice_view.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ramus::app {

struct ScanFile; // app/assets/scans.h

// The place that slices go through: the crosshair, or the middle of the first scan, or of the tree.
[[nodiscard]] glm::dvec3 crosshair_of(const Session& session, const Assets& assets);
[[nodiscard]] slice::Plane plane_of(const Session& session, const Assets& assets, slice::Direction direction);

// The pixels of a slice in a part of the picture of `size`: at a zoom of 1, all of the first visible scan fits, or the
// tree without one.
[[nodiscard]] slice::PixelGrid grid_of(const Session& session, const Assets& assets, slice::Direction direction,
                                       glm::ivec2 size);

[[nodiscard]] slice::PixelGrid zoomed_grid(const Session& session, const Assets& assets, slice::Direction direction,
                                           glm::ivec2 size, const SliceZoom& zoom);

// The step from slice to slice: the smallest spacing of the first scan's voxels along the normal; 1 mm without a scan.
[[nodiscard]] double step_mm(const Session& session, const Assets& assets, slice::Direction direction);

// The first scan that is shown; null: there is none.
[[nodiscard]] std::shared_ptr<const volume::Volume> first_volume(const Session& session, const Assets& assets);

// The window that a scan is shown in.
[[nodiscard]] slice::Window window_of(const Scan& scan, const ScanFile& file);

// A window by name (core/slice/window.h), or WIDTH,LEVEL; none: it is neither.
[[nodiscard]] std::optional<slice::Window> window_in(const std::string& word);

// "512 x 512 x 800 voxels of 0.7 x 0.7 x 1 mm".
[[nodiscard]] std::string words_of_scan(const ScanFile& file, const Lengths& lengths);

// Unit and sides that slices may show: known only if known for the tree and for every scan.
[[nodiscard]] tree::Claims slice_claims(const Session& session, const Assets& assets);
// "R 12.3, A 4.5, S 100.2 mm".
[[nodiscard]] std::string place_words(const glm::dvec3& place, const tree::Claims& claims);
// The value of the first scan at a place, with its unit if the file states one, and the labels there; empty: none.
[[nodiscard]] std::string value_words(const glm::dvec3& place, const Session& session, const Assets& assets);
// "Axial, S 12.3 mm, maximum of 10 mm": where a slice is, in the words that the claims allow.
[[nodiscard]] std::string caption_of(slice::Direction direction, const slice::Plane& plane,
                                     const slice::Sampling& sampling, const tree::Claims& claims);

// A camera from which the planes of three slices are seen aslant.
[[nodiscard]] render::Camera camera_of_planes(std::span<const glm::vec3> points, glm::ivec2 size);

// The layers of scans and segmentations, for slices of any grid.
void add_scans(render::SliceView& view, const Session& session, const Assets& assets);

[[nodiscard]] render::SliceView compose_slice(const Session& session, const Assets& assets, slice::Direction direction,
                                              const Viewing& viewing);

} // namespace ramus::app
