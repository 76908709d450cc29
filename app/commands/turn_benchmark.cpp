#include "app/commands/turn_benchmark.h"

#include "app/session/numbers.h"
#include "core/base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

void look_from(render::Sheet& sheet, const render::Camera& camera, render::Quality quality) {
    for (render::Sheet::Viewport& viewport : sheet.viewports) {
        viewport.frame.camera = camera;
        viewport.frame.quality = quality;
    }
}

// The difference between the interactive and the full picture, over the pixels of vessels in either.
struct Difference {
    double mean = 0.0;  // of 255
    double apart = 0.0; // share of the pixels that differ by more than kEdgeMoved
};
constexpr double kEdgeMoved = 60.0; // of 255

Result<Difference> difference_at_rest(render::SheetRenderer& renderer, render::Sheet sheet,
                                      const render::Camera& camera) {
    const auto drawn = [&](render::Quality quality) -> Result<render::Image> {
        look_from(sheet, camera, quality);
        if (auto done = renderer.draw(sheet); !done) return tl::unexpected(done.error());
        return renderer.read_image();
    };
    RAMUS_TRY(moving, drawn(render::Quality::kInteractive));
    const std::vector<bool> there = renderer.read_covered();
    RAMUS_TRY(resting, drawn(render::Quality::kFull));
    const std::vector<bool> here = renderer.read_covered();
    double sum = 0.0;
    std::size_t pixels = 0, apart = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        if (!here[i] && !there[i]) continue;
        double difference = 0.0;
        for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) difference += std::abs(moving.rgba[k] - resting.rgba[k]) / 3.0;
        ++pixels;
        apart += difference > kEdgeMoved ? 1 : 0;
        sum += difference;
    }
    const auto all = static_cast<double>(std::max<std::size_t>(pixels, 1));
    return Difference{sum / all, static_cast<double>(apart) / all};
}

} // namespace

Result<void> run_turn_benchmark(render::SheetRenderer& renderer, render::Sheet sheet, int frames, bool hurry,
                                nlohmann::json& report) {
    const render::Camera start_camera = sheet.viewports.front().frame.camera;
    const auto camera_at = [&](double turn) { return render::turned(start_camera, 360.0 * turn, 0.0); };
    const render::Quality quality = hurry ? render::Quality::kInteractive : render::Quality::kFull;
    look_from(sheet, camera_at(-1.0 / frames), quality); // warms up the caches
    if (auto ready = renderer.draw(sheet); !ready) return tl::unexpected(ready.error());
    render::SheetRenderer::finish();
    std::uint64_t triangles = 0, cones = 0;
    const Stopwatch watch;
    const std::clock_t processor = std::clock();
    for (int i = 0; i < frames; ++i) {
        look_from(sheet, camera_at(static_cast<double>(i + 1) / frames), quality);
        RAMUS_TRY(done, renderer.draw(sheet));
        triangles += done.triangles;
        cones += done.cones;
        render::SheetRenderer::finish();
    }
    const double seconds = watch.seconds(), fps = frames / std::max(seconds, 1e-9);
    report["processor_seconds"] = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
    report["frames"] = frames;
    report["seconds"] = seconds;
    report["fps"] = fps;
    report["triangles"] = static_cast<double>(triangles) / frames;
    report["cones"] = static_cast<double>(cones) / frames;
    report["panes"] = sheet.viewports.size();
    report["quality"] = hurry ? "interactive" : "full";
    Difference difference;
    constexpr int kAtRest = 4;
    for (int i = 0; i < kAtRest && hurry; ++i) {
        RAMUS_TRY(found, difference_at_rest(renderer, sheet, camera_at((i + 0.3) / kAtRest)));
        difference.mean += found.mean / kAtRest;
        difference.apart += found.apart / kAtRest;
    }
    report["difference"] = difference.mean;
    report["apart"] = difference.apart;
    return {};
}

std::string benchmark_sentence(const nlohmann::json& report) {
    const auto amount = [&](const char* key) { return grouped(static_cast<std::uint64_t>(report[key].get<double>())); };
    std::string text = std::to_string(report["frames"].get<int>()) + " frames in " +
                       digits(report["seconds"].get<double>()) + " s: " + digits(report["fps"].get<double>()) +
                       " a second, " + amount("triangles") + " triangles and " + amount("cones") + " cones a frame";
    if (report["quality"].get<std::string>() == "interactive")
        text += ", on average " + digits(report["difference"].get<double>()) + " of 255 from the picture at rest";
    return text;
}

} // namespace ramus::app
