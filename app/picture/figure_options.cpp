#include "app/picture/figure_options.h"

#include "app/session/numbers.h"
#include "core/base/words.h"
#include "render/renderer/drawn.h"

#include <algorithm>

namespace ramus::app {

namespace {

tl::unexpected<Error> no_such(const std::string& word) {
    return fail("\"" + word + "\" is nothing that a picture can be told", {}, kFigureUsage);
}

Result<int> count_in(const std::string& word, const std::string& value, int least, int most) {
    const auto number = parsed<int>(value);
    if (number && *number >= least && *number <= most) return *number;
    return fail(word + " takes a whole number from " + std::to_string(least) + " to " + std::to_string(most));
}

Result<void> read_overlays(const std::string& list, FigureOptions& options) {
    options.overlays.clear();
    options.overlays_given = true;
    for (const std::string_view part : parts_of(list)) {
        if (part == "none") continue;
        if (std::ranges::find(kFigureOverlays, part, &OverlayRow::key) == kFigureOverlays.end())
            return fail("--overlays takes some of cube,scale,legend,letters, or none");
        options.overlays.emplace_back(part);
    }
    return {};
}

Result<void> read_one(const std::string& word, const std::string& value, FigureRequest& request) {
    FigureOptions& options = request.options;
    const auto set = [](Result<int> number, int& target) -> Result<void> {
        if (!number) return tl::unexpected(number.error());
        target = *number;
        return {};
    };
    if (word == "--size") {
        RAMUS_TRY(size, size_in(value));
        request.size = size;
        return {};
    }
    if (word == "--background") {
        const auto* const row = std::ranges::find(kGrounds, value, &GroundRow::key);
        if (row == kGrounds.end()) return fail("--background takes dark, grey, white or transparent");
        options.ground = row->ground;
        return {};
    }
    if (word == "--caption") {
        options.caption = value;
        return {};
    }
    if (word == "--overlays") return read_overlays(value, options);
    if (word == "--text-size") {
        const auto number = parsed<double>(value);
        if (!number || !(*number >= kLeastTextSize && *number <= kMostTextSize))
            return fail("--text-size takes pixels a point, from 0.25 to 16");
        options.text_size = *number;
        return {};
    }
    if (word == "--supersample") return set(count_in(word, value, 1, kMostSupersampling), options.supersample);
    if (word == "--pictures") return set(count_in(word, value, 2, kMostTurntable), options.turntable);
    if (word == "--rate") return set(count_in(word, value, 1, 120), options.frames_a_second);
    return no_such(word);
}

} // namespace

Result<glm::ivec2> size_in(const std::string& text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const auto width = parsed<std::int64_t>(text.substr(0, cross));
    const auto height = parsed<std::int64_t>(text.substr(std::min(cross + 1, text.size())));
    if (!width || !height) return fail(text + " is not a size such as 1600x1200");
    const std::int64_t across = width.value_or(0), down = height.value_or(0);
    if (auto fits = render::check_size(across, down); !fits) return tl::unexpected(fits.error());
    return glm::ivec2(across, down);
}

Result<void> read_figure_words(std::span<const std::string> words, FigureRequest& request) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--as-near") {
            request.options.whole = false;
            continue;
        }
        if (i + 1 == words.size()) return no_such(words[i]);
        if (auto taken = read_one(words[i], words[i + 1], request); !taken) return taken;
        ++i;
    }
    return {};
}

std::vector<std::string> figure_words(const FigureRequest& request) {
    const FigureOptions usual, &options = request.options;
    std::vector<std::string> words;
    const auto say = [&](const char* word, std::string value) { words.insert(words.end(), {word, std::move(value)}); };
    if (request.size) say("--size", std::to_string(request.size->x) + "x" + std::to_string(request.size->y));
    if (options.ground) say("--background", std::string(kGrounds[static_cast<std::size_t>(*options.ground)].key));
    if (!options.caption.empty()) say("--caption", options.caption);
    if (options.overlays_given) say("--overlays", options.overlays.empty() ? "none" : joined(options.overlays, ","));
    if (options.text_size != usual.text_size) say("--text-size", exact_text(options.text_size));
    if (options.supersample != usual.supersample) say("--supersample", std::to_string(options.supersample));
    if (options.turntable != usual.turntable) say("--pictures", std::to_string(options.turntable));
    if (options.frames_a_second != usual.frames_a_second) say("--rate", std::to_string(options.frames_a_second));
    if (!options.whole) words.emplace_back("--as-near");
    return words;
}

} // namespace ramus::app
