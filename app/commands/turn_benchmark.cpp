#include "app/commands/turn_benchmark.h"

#include "app/session/numbers.h"
#include "core/base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

// How far the picture that moves is from the one that rests: the mean over the vessels' pixels of both, of 255.
Result<double> difference_at_rest(render::Renderer& renderer, render::Frame frame) {
    const auto drawn = [&](render::Quality quality) -> Result<render::Image> {
        frame.quality = quality;
        if (auto done = renderer.draw(frame); !done) return tl::unexpected(done.error());
        return renderer.read_image();
    };
    const auto moving = drawn(render::Quality::kInteractive);
    if (!moving) return tl::unexpected(moving.error());
    const render::BranchPicture there = renderer.read_branches();
    const auto resting = drawn(render::Quality::kFull);
    if (!resting) return tl::unexpected(resting.error());
    const render::BranchPicture here = renderer.read_branches();
    double sum = 0.0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < here.branches.size(); ++i) {
        if (here.branches[i] == render::kNoBranch && there.branches[i] == render::kNoBranch) continue;
        ++pixels;
        for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) sum += std::abs(moving->rgba[k] - resting->rgba[k]) / 3.0;
    }
    return sum / static_cast<double>(std::max<std::size_t>(pixels, 1));
}

} // namespace

Result<void> run_turn_benchmark(render::Renderer& renderer, render::Frame frame, int frames, bool hurry,
                                nlohmann::json& report) {
    const render::Camera start_camera = frame.camera;
    const auto turn_to = [&](double turn) { frame.camera = render::turned(start_camera, 360.0 * turn, 0.0); };
    frame.quality = hurry ? render::Quality::kInteractive : render::Quality::kFull;
    turn_to(-1.0 / frames); // what is made once is made
    if (auto ready = renderer.draw(frame); !ready) return tl::unexpected(ready.error());
    std::uint64_t triangles = 0, cones = 0;
    const Stopwatch watch;
    for (int i = 0; i < frames; ++i) {
        turn_to(static_cast<double>(i + 1) / frames);
        const auto done = renderer.draw(frame);
        if (!done) return tl::unexpected(done.error());
        triangles += done->triangles;
        cones += done->cones;
        (void)renderer.pick(0.0, 0.0); // waits until the frame is there
    }
    const double seconds = watch.seconds(), fps = frames / std::max(seconds, 1e-9);
    report["frames"] = frames;
    report["seconds"] = seconds;
    report["fps"] = fps;
    report["triangles"] = static_cast<double>(triangles) / frames;
    report["cones"] = static_cast<double>(cones) / frames;
    report["quality"] = hurry ? "interactive" : "full";
    double difference = 0.0;
    constexpr int kCompared = 4;
    for (int i = 0; i < kCompared && hurry; ++i) {
        turn_to((i + 0.3) / kCompared);
        const auto found = difference_at_rest(renderer, frame);
        if (!found) return tl::unexpected(found.error());
        difference += *found / kCompared;
    }
    report["difference"] = difference;
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
