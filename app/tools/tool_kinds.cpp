#include "app/tools/tool_kinds.h"

#include "app/tools/edit_tools.h"
#include "app/tools/lasso_tool.h"
#include "app/tools/measure_tool.h"
#include "app/tools/place_tools.h"
#include "app/tools/three_places_tool.h"

#include <algorithm>
#include <cmath>

namespace ramus::app {

// Of pin_tool.cpp. NOLINTNEXTLINE(readability-redundant-declaration): where both are compiled as one file
std::unique_ptr<Tool> make_pin_tool();
// Of resection_tools.cpp. NOLINTBEGIN(readability-redundant-declaration)
std::unique_ptr<Tool> make_plane_tool();
std::unique_ptr<Tool> make_sheet_tool();
std::unique_ptr<Tool> make_handle_tool();
// Of region_tools.cpp
std::unique_ptr<Tool> make_region_tool();
std::unique_ptr<Tool> make_region_cut_tool();
// NOLINTEND(readability-redundant-declaration)

namespace {

template <typename T> std::unique_ptr<Tool> make() { return std::make_unique<T>(); }
template <Measurement::Kind kind> std::unique_ptr<Tool> measuring() { return std::make_unique<MeasureTool>(kind); }

// A circle in the unit square.
std::vector<glm::vec2> ring(glm::vec2 centre, float radius) {
    constexpr int kLoopCorners = 20;
    std::vector<glm::vec2> points;
    for (int i = 0; i <= kLoopCorners; ++i) {
        const float angle = 6.2831853F * static_cast<float>(i) / kLoopCorners;
        points.push_back(centre + radius * glm::vec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

} // namespace

// NOLINTNEXTLINE(readability-function-size): a table
const std::vector<ToolKind>& tool_kinds() {
    static const std::vector<ToolKind> kinds{
        {std::string(kNavigate),
         "Navigate",
         "The mouse turns the view and selects branches.",
         {"V"},
         {{{0.28F, 0.12F},
           {0.28F, 0.80F},
           {0.44F, 0.65F},
           {0.56F, 0.90F},
           {0.66F, 0.85F},
           {0.55F, 0.61F},
           {0.76F, 0.59F},
           {0.28F, 0.12F}}},
         nullptr},
        {"lasso",
         "Lasso",
         "Selects what lies inside a line drawn around it.",
         {"W"},
         {{{0.42F, 0.68F},
           {0.22F, 0.62F},
           {0.10F, 0.46F},
           {0.14F, 0.28F},
           {0.34F, 0.15F},
           {0.58F, 0.13F},
           {0.80F, 0.21F},
           {0.90F, 0.37F},
           {0.83F, 0.54F},
           {0.64F, 0.66F},
           {0.42F, 0.68F},
           {0.34F, 0.77F},
           {0.42F, 0.86F},
           {0.36F, 0.95F}}},
         make<LassoTool>},
        {"lasso-polygon",
         "Polygon lasso",
         "Selects what lies inside a polygon, clicked corner by corner.",
         {"Shift+W"},
         {{{0.14F, 0.80F}, {0.22F, 0.22F}, {0.62F, 0.40F}, {0.88F, 0.14F}, {0.84F, 0.82F}, {0.14F, 0.80F}}},
         make<PolygonLassoTool>},
        {"lesion",
         "Lesion",
         "Places a lesion, sizes it and moves it.",
         {"Shift+L"},
         {ring({0.5F, 0.5F}, 0.40F), ring({0.5F, 0.5F}, 0.10F)},
         make<LesionTool>},
        {"cut",
         "Cut",
         "Marks a cut through a vessel, and lists what depends on it; the tree stays whole.",
         {"Shift+C"},
         {{{0.06F, 0.62F}, {0.42F, 0.50F}}, {{0.58F, 0.45F}, {0.94F, 0.33F}}, {{0.40F, 0.20F}, {0.60F, 0.76F}}},
         make<CutTool>},
        {"resect-plane",
         "Resect by a plane",
         "Divides the organ by a plane behind a line drawn across the picture.",
         {},
         {{{0.10F, 0.60F}, {0.62F, 0.82F}, {0.90F, 0.40F}, {0.38F, 0.18F}, {0.10F, 0.60F}}},
         make_plane_tool},
        {"resect-points",
         "Resect by three points",
         "Divides the organ by the plane through three places on vessels.",
         {},
         {{{0.16F, 0.70F}, {0.50F, 0.22F}, {0.86F, 0.62F}, {0.16F, 0.70F}},
          ring({0.16F, 0.70F}, 0.08F),
          ring({0.50F, 0.22F}, 0.08F),
          ring({0.86F, 0.62F}, 0.08F)},
         make_points_tool},
        {"resect-sheet",
         "Resect by a sheet",
         "Divides the organ by a sheet behind a stroke drawn across the picture.",
         {},
         {{{0.08F, 0.66F}, {0.26F, 0.46F}, {0.46F, 0.52F}, {0.64F, 0.70F}, {0.92F, 0.50F}},
          {{0.08F, 0.40F}, {0.26F, 0.20F}, {0.46F, 0.26F}, {0.64F, 0.44F}, {0.92F, 0.24F}},
          {{0.08F, 0.66F}, {0.08F, 0.40F}},
          {{0.92F, 0.50F}, {0.92F, 0.24F}}},
         make_sheet_tool},
        {"resection",
         "Move resections",
         "Drags the points of planes and sheets.",
         {},
         {{{0.08F, 0.62F}, {0.34F, 0.40F}, {0.66F, 0.66F}, {0.92F, 0.42F}},
          ring({0.34F, 0.40F}, 0.09F),
          ring({0.66F, 0.66F}, 0.09F)},
         make_handle_tool},
        {"measure-distance",
         "Distance",
         "Measures straight between two places on vessels or lesions.",
         {"M"},
         {{{0.10F, 0.72F}, {0.90F, 0.28F}}, {{0.04F, 0.60F}, {0.16F, 0.84F}}, {{0.84F, 0.16F}, {0.96F, 0.40F}}},
         measuring<Measurement::Kind::kDistance>},
        {"measure-path",
         "Path",
         "Measures along the vessels from one place to another.",
         {"Shift+M"},
         {{{0.08F, 0.80F}, {0.30F, 0.36F}, {0.58F, 0.62F}, {0.92F, 0.18F}},
          ring({0.08F, 0.80F}, 0.06F),
          ring({0.92F, 0.18F}, 0.06F)},
         measuring<Measurement::Kind::kPath>},
        {"measure-diameter",
         "Diameter",
         "Measures a vessel across, at a place.",
         {},
         {ring({0.5F, 0.5F}, 0.34F), {{0.14F, 0.86F}, {0.86F, 0.14F}}},
         measuring<Measurement::Kind::kDiameter>},
        {"measure-angle",
         "Angle",
         "Measures the angle between three places on vessels.",
         {},
         {{{0.90F, 0.84F}, {0.12F, 0.84F}, {0.70F, 0.14F}}, {{0.56F, 0.84F}, {0.52F, 0.64F}, {0.40F, 0.50F}}},
         measuring<Measurement::Kind::kAngle>},
        {"pin",
         "Pin",
         "Pins a text to a place of a vessel.",
         {"Shift+I"},
         {ring({0.5F, 0.34F}, 0.22F), {{0.5F, 0.56F}, {0.5F, 0.94F}}},
         make_pin_tool},
        {"region",
         "Grow region",
         "Grows a region of similar values in the scan, from a click on a slice; no segmentation.",
         {},
         {ring({0.5F, 0.5F}, 0.08F),
          {{0.50F, 0.12F},
           {0.72F, 0.20F},
           {0.84F, 0.44F},
           {0.70F, 0.66F},
           {0.74F, 0.86F},
           {0.44F, 0.88F},
           {0.20F, 0.72F},
           {0.24F, 0.50F},
           {0.14F, 0.30F},
           {0.50F, 0.12F}}},
         make_region_tool},
        {"region-cut",
         "Cut region",
         "Cuts the region of the scan where it leaves the vessel: a drag by a disc, a click by a ball.",
         {},
         {{{0.14F, 0.60F}, {0.16F, 0.30F}, {0.50F, 0.14F}, {0.66F, 0.22F}},
          {{0.84F, 0.44F}, {0.74F, 0.84F}, {0.44F, 0.88F}, {0.34F, 0.80F}},
          {{0.24F, 0.84F}, {0.86F, 0.20F}}},
         make_region_cut_tool},
        {"slice-points",
         "Slice through three places",
         "Puts the oblique slice through three places on vessels or slices.",
         {},
         {{{0.14F, 0.58F}, {0.40F, 0.86F}, {0.86F, 0.42F}, {0.60F, 0.14F}, {0.14F, 0.58F}},
          ring({0.36F, 0.58F}, 0.06F),
          ring({0.46F, 0.70F}, 0.06F),
          ring({0.62F, 0.36F}, 0.06F)},
         make_slice_points_tool},
        {"join",
         "Join ends",
         "Joins a free end of a vessel with another vessel.",
         {},
         {{{0.06F, 0.70F}, {0.34F, 0.58F}},
          {{0.66F, 0.42F}, {0.94F, 0.30F}},
          ring({0.42F, 0.54F}, 0.07F),
          ring({0.58F, 0.46F}, 0.07F)},
         make<JoinTool>},
        {"disconnect",
         "Disconnect",
         "Takes a false connection out of the tree.",
         {},
         {{{0.06F, 0.70F}, {0.36F, 0.58F}},
          {{0.64F, 0.42F}, {0.94F, 0.30F}},
          {{0.40F, 0.34F}, {0.60F, 0.66F}},
          {{0.40F, 0.66F}, {0.60F, 0.34F}}},
         make<DisconnectTool>},
        {"delete-spur",
         "Delete spurs",
         "Deletes a branch that carries no others.",
         {},
         {{{0.08F, 0.70F}, {0.92F, 0.70F}},
          {{0.50F, 0.70F}, {0.50F, 0.46F}},
          {{0.38F, 0.16F}, {0.62F, 0.40F}},
          {{0.62F, 0.16F}, {0.38F, 0.40F}}},
         make<SpurTool>},
        {"move-root",
         "Move root",
         "Moves the root to a free end: all of the piece depends on it.",
         {},
         {{{0.50F, 0.92F}, {0.50F, 0.46F}},
          {{0.50F, 0.46F}, {0.22F, 0.12F}},
          {{0.50F, 0.46F}, {0.78F, 0.12F}},
          {{0.36F, 0.74F}, {0.50F, 0.60F}, {0.64F, 0.74F}}},
         make<RootTool>},
    };
    return kinds;
}

const ToolKind* find_tool(std::string_view name) {
    const auto found = std::ranges::find(tool_kinds(), name, &ToolKind::name);
    return found == tool_kinds().end() ? nullptr : &*found;
}

} // namespace ramus::app
