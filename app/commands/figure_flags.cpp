#include "app/commands/figure_flags.h"

#include "app/commands/command.h"

#include <algorithm>
#include <string>
#include <vector>

namespace ramus::app {

void add_figure_flags(CLI::App& command, FigureOptions& flags) {
    add_option(command, "--supersample", "N", flags.supersample,
               "Draw N times as large and take the mean: smoother edges (default 1)")
        ->check(CLI::Range(1, kMostSupersampling).description(""));
    add_option(command, "--samples", "N", flags.samples,
               "Samples a pixel: 16 (default), or 4 in a quarter of the time; with --supersample 4 for each")
        ->check(CLI::IsMember({4, 16}).description(""));
    command.add_flag("--moving", flags.moving,
                     "Draw the quick picture that the window shows while the view moves, without a graphics card");
    add_option(command, "--caption", "TEXT", flags.caption, "Text at the top left");
    CLI::Option* overlays = add_option(command, "--overlays", "LIST", flags.overlays,
                                       "Overlays: none, or some of cube,scale,legend,letters (default "
                                       "cube,scale,legend)")
                                ->delimiter(',')
                                ->check(CLI::IsMember({"cube", "scale", "legend", "letters", "none"}).description(""));
    overlays->each([&flags](const std::string&) { flags.overlays_given = true; });
    std::vector<std::string> grounds;
    for (const GroundRow& row : kGrounds) grounds.emplace_back(row.key);
    add_option_taking<std::string>(
        command, "--background", "GROUND",
        [&flags](const std::string& key) { flags.ground = std::ranges::find(kGrounds, key, &GroundRow::key)->ground; },
        "What is behind the tree: dark (default), grey, white or transparent")
        ->check(CLI::IsMember(grounds).description(""))
        ->excludes(command.get_option("--transparent"));
    add_option(command, "--text-size", "X", flags.text_size,
               "Size of words, scale bar and cube: pixels a point (default 1)")
        ->check(CLI::Range(kLeastTextSize, kMostTextSize).description(""));
    CLI::Option* sheet =
        command.add_flag("--sheet", flags.sheet,
                         "Four views on one sheet: anterior, left, posterior, superior; with --compare "
                         "side-by-side a table of views and surfaces");
    add_option(
        command, "--turntable", "N", flags.turntable,
        "Turn once around the tree in N pictures: o.png becomes o_001.png and so on; o.mp4 is a video, for which "
        "ffmpeg is needed")
        ->check(CLI::Range(2, kMostTurntable).description(""))
        ->excludes(sheet);
    add_option(command, "--rate", "N", flags.frames_a_second, "Pictures per second of a video (default 30)")
        ->check(CLI::Range(1, 120).description(""));
}

} // namespace ramus::app
