#include "app/commands/picture_flags.h"

#include "app/commands/command.h"
#include "render/renderer/renderer.h"

#include <charconv>
#include <cstdint>
#include <map>
#include <string>

namespace ramus::app {

namespace {

// "1600x1200", within what can be drawn; else a message for the user.
std::string read_size(const std::string& text, glm::ivec2& size) {
    std::int64_t width = 0, height = 0;
    constexpr const char* kWanted = " is not a size such as 1600x1200";
    const char* const end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, width);
    if (x.ec != std::errc{} || x.ptr == end || *x.ptr != 'x') return text + kWanted;
    const auto y = std::from_chars(x.ptr + 1, end, height);
    if (y.ec != std::errc{} || y.ptr != end) return text + kWanted;
    if (const auto fits = render::check_size(width, height); !fits) return fits.error().message();
    size = {width, height};
    return {};
}

} // namespace

void add_size_flag(CLI::App& command, glm::ivec2& size) {
    const std::string usual = std::to_string(size.x) + "x" + std::to_string(size.y);
    command
        .add_option_function<std::string>(
            "--size",
            [&size](const std::string& text) {
                if (const std::string wrong = read_size(text, size); !wrong.empty())
                    throw CLI::ValidationError("--size", wrong);
            },
            "Pixels of the picture (default " + usual + ")")
        ->type_name("WxH");
}

CLI::Option* add_graphics_memory_flag(CLI::App& command, std::size_t& bytes) {
    return add_option(command, "--graphics-memory", "SIZE", bytes,
                      "Most graphics memory for surfaces, as 800M or 4G (default 0: three quarters of what there is)")
        ->transform(CLI::AsSizeValue(false));
}

CLI::Option* add_view_flag(CLI::App& command, render::View& view) {
    std::map<std::string, render::View> views;
    for (const render::View one : render::kViews) views.emplace(render::name_of(one), one);
    return add_option(command, "--view", "NAME", view,
                      "anterior (default), posterior, left, right, superior or inferior")
        ->transform(CLI::CheckedTransformer(views).description(""));
}

} // namespace ramus::app
