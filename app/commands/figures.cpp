#include "app/commands/figures.h"

#include "app/commands/command.h"
#include "app/picture/colouring.h"
#include "render/image/text.h"
#include "render/overlay/overlay.h"

#include <algorithm>

namespace ramus::app {

void add_figure_flags(CLI::App& command, FigureFlags& flags) {
    add_option(command, "--supersample", "N", flags.supersample,
               "Draw N times as large and take the mean: smoother edges (default 1)")
        ->check(CLI::Range(1, 8).description(""));
    add_option(command, "--samples", "N", flags.samples,
               "Samples a pixel: 16 (default), or 4 in a quarter of the time; with --supersample 4 for each")
        ->check(CLI::IsMember({4, 16}).description(""));
    add_option(command, "--caption", "TEXT", flags.caption, "Words at the top left");
    CLI::Option* overlays = add_option(command, "--overlays", "LIST", flags.overlays,
                                       "What lies over the tree: none, or some of cube,scale,legend,letters (default "
                                       "cube,scale,legend)")
                                ->delimiter(',')
                                ->check(CLI::IsMember({"cube", "scale", "legend", "letters", "none"}).description(""));
    overlays->each([&flags](const std::string&) { flags.overlays_given = true; });
    CLI::Option* sheet =
        command.add_flag("--sheet", flags.sheet,
                         "Four views on one sheet: anterior, left, posterior, superior; with --compare "
                         "side-by-side a table of views and surfaces");
    add_option(command, "--turntable", "N", flags.turntable,
               "Once around the tree in N pictures: o.png becomes o_001.png and so on")
        ->check(CLI::Range(2, 9999).description(""))
        ->excludes(sheet);
}

namespace {

// What the flags say about what lies over the tree.
void dress(render::Frame& frame, const FigureFlags& flags) {
    const auto shows = [&](const char* name) {
        return std::ranges::find(flags.overlays, name) != flags.overlays.end();
    };
    frame.overlays.caption = latin1(flags.caption);
    if (!flags.overlays_given) return;
    frame.overlays.orientation_cube = shows("cube");
    frame.overlays.scale_bar = shows("scale");
    frame.overlays.orientation_letters = shows("letters");
    if (!shows("legend")) frame.overlays.legend = {};
}

} // namespace

void dress(render::Sheet& sheet, const FigureFlags& flags) {
    for (std::size_t i = 0; i < sheet.viewports.size(); ++i) {
        render::Overlays& overlays = sheet.viewports[i].frame.overlays;
        const render::Overlays shared = overlays; // what viewports beside each other have once, they have once
        dress(sheet.viewports[i].frame, flags);
        if (sheet.viewports.size() == 1 || sheet.blend) continue;
        overlays.orientation_cube &= i + 1 == sheet.viewports.size();
        overlays.scale_bar &= i == 0;
        if (i > 0) overlays.caption = shared.caption;
    }
}

namespace {

Result<void> check_enlarged(glm::ivec2 size, const FigureFlags& flags) {
    auto fits = render::check_size(size.x, size.y);
    if (!fits && flags.supersample > 1) fits.error().hint += "; or a smaller --supersample";
    return fits;
}

// Headings go below the caption of their own viewport by themselves; those beside them, and that of a blend, with them.
void make_room_for_caption(render::Sheet& sheet) {
    const render::Sheet::Viewport& first = sheet.viewports.front();
    const int bottom = render::OverlayPainter().caption_bottom(render::SpriteSource(first.frame));
    if (bottom == 0) return;
    if (sheet.blend) sheet.heading_top = std::max(sheet.heading_top, bottom);
    for (std::size_t i = 1; i < sheet.viewports.size() && !sheet.blend; ++i) {
        render::Overlays& overlays = sheet.viewports[i].frame.overlays;
        if (sheet.viewports[i].at.y == first.at.y && overlays.caption.empty() && !overlays.heading.empty())
            overlays.inset_top = std::max(overlays.inset_top, bottom);
    }
}

void enlarge(render::Frame& frame, const FigureFlags& flags) {
    frame.size *= flags.supersample;
    frame.pixel_ratio *= static_cast<float>(flags.supersample);
    for (int* inset : {&frame.overlays.inset_left, &frame.overlays.inset_top, &frame.overlays.inset_right,
                       &frame.overlays.inset_bottom})
        *inset *= flags.supersample;
}

} // namespace

Result<render::Image> draw_figure(render::SheetRenderer& renderer, render::Sheet sheet, const FigureFlags& flags) {
    sheet.size *= flags.supersample;
    sheet.heading_top *= flags.supersample;
    for (render::Sheet::Viewport& viewport : sheet.viewports) {
        viewport.at *= flags.supersample;
        enlarge(viewport.frame, flags);
    }
    make_room_for_caption(sheet);
    if (auto fits = check_enlarged(sheet.size, flags); !fits) return tl::unexpected(fits.error());
    if (const auto drawn = renderer.draw(sheet); !drawn) return tl::unexpected(drawn.error());
    if (flags.samples > 4 && flags.supersample == 1)
        if (const auto finer = renderer.refine(sheet); !finer) return tl::unexpected(finer.error());
    return render::reduced(renderer.read_image(), flags.supersample);
}

} // namespace ramus::app
