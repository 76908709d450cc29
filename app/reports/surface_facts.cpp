#include "app/reports/surface_facts.h"

#include "app/session/numbers.h"

#include <string>

namespace ramus::app {

Facts surface_facts(const mesh::SurfaceOptions& options) {
    const field::KernelRow& kernel = field::row_of(options.kernel);
    Facts facts{{"Surface", std::string(mesh::row_of(options.method).noun)},
                {"Smoothing passes", std::to_string(options.smooth_passes)},
                {"Pruning ratio", options.prune_ratio > 0.0 ? digits(options.prune_ratio) : "off"},
                {"Kernel", std::string(kernel.label)},
                {"Blends", std::string(mesh::row_of(options.blend).help)},
                {"Centerlines", options.centerline == tree::Centerline::kSmooth ? "with round corners" : "lines"},
                options.cell_mm > 0.0
                    ? std::pair<std::string, std::string>{"Cell size", digits(options.cell_mm) + " mm"}
                    : std::pair<std::string, std::string>{"Triangles around a vessel", std::to_string(options.detail)}};
    if (kernel.most_width > 0.0) facts.insert(facts.begin() + 4, {"Kernel width", digits(options.width)});
    return facts;
}

} // namespace ramus::app
