#include "app/session/saved_views.h"

#include "core/base/closest_word.h"
#include "core/base/words.h"

#include <algorithm>

namespace ramus::app {

namespace {

auto place_of(std::span<const SavedView> views, const std::string& name) {
    return std::ranges::find(views, name, &SavedView::name);
}

} // namespace

Result<void> check_view_name(const std::string& name) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
    if (name.find_first_not_of(' ') == std::string::npos) return fail("a saved view needs a name");
    if (std::ranges::any_of(name, is_control)) return fail("the name of a saved view is one line of text");
    if (render::view_named(name))
        return fail("\"" + name + "\" is the name of an anatomical view", {}, "give the saved view another name");
    return {};
}

Result<std::size_t> find_view(std::span<const SavedView> views, const std::string& name) {
    const auto found = place_of(views, name);
    if (found != views.end()) return static_cast<std::size_t>(found - views.begin());
    if (views.empty()) return fail("there are no saved views", {}, "view-save NAME saves the view as it is");
    std::vector<std::string> names;
    for (const SavedView& view : views) names.push_back(view.name);
    const std::string closest = closest_word(name, names);
    constexpr std::size_t kMostNamed = 8;
    const std::size_t named = std::min(names.size(), kMostNamed);
    names.resize(named);
    return fail("there is no saved view \"" + shortened(name) + "\"", {},
                closest.empty() ? "saved are " + joined(names) + (views.size() > named ? ", ..." : "")
                                : "did you mean \"" + closest + "\"?");
}

bool has_view(std::span<const SavedView> views, const std::string& name) {
    return place_of(views, name) != views.end();
}

std::string free_view_name(std::span<const SavedView> views) {
    std::size_t number = views.size() + 1;
    const auto named = [&] { return "View " + std::to_string(number); };
    while (has_view(views, named())) ++number;
    return named();
}

void save_view(std::vector<SavedView>& views, const std::string& name, const render::Camera& camera) {
    const auto found = std::ranges::find(views, name, &SavedView::name);
    if (found == views.end())
        views.push_back({name, camera});
    else
        found->camera = camera;
}

} // namespace ramus::app
