#include "app/commands/inputs.h"

#include "app/commands/progress.h"
#include "app/session/numbers.h"
#include "app/session/session_file.h"
#include "app/session/systems.h"
#include "app/session/tree_edits.h"
#include "app/storage/opening_files.h"
#include "core/io/standard_input.h"
#include "core/io/volumes/volume_file.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <utility>

namespace ramus::app {

Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags) {
    return load_tree(file, flags, flags.read);
}

Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags, const io::ReadOptions& reading) {
    auto tree = with_progress("reading", [&](Job& job) {
        return read_tree_or_mask(file, reading, static_cast<double>(flags.surface.memory_bytes), job);
    });
    if (!tree) return tree;
    // Many repairs of one file must not hide other messages.
    constexpr std::size_t kShown = 5;
    const std::vector<std::string> repairs = sentences(*tree, tree::Note::Kind::kRepaired);
    const std::size_t shown = flags.verbose ? repairs.size() : std::min(kShown, repairs.size());
    for (std::size_t i = 0; i < shown; ++i) std::cerr << "ramus: repaired: " << repairs[i] << '\n';
    if (shown < repairs.size())
        std::cerr << "ramus: repaired: " << grouped(repairs.size() - shown) << " more places (ramus info lists them)\n";
    for (const tree::Note& note : tree->notes) {
        // Prints suspicions about the whole tree only; `ramus info` lists those about single points.
        if (note.kind == tree::Note::Kind::kSuspect && note.topic == "units")
            std::cerr << "ramus: " << note.text << '\n';
        else if (note.kind == tree::Note::Kind::kAssumed)
            say(flags, "assumed: " + note.text);
    }
    say(flags, io::input_name(file) + ": " + counted(tree->points.size(), "point", "points") + ", " +
                   counted(tree->segment_count(), "segment", "segments") + ", " +
                   counted(tree->branches.size(), "branch", "branches"));
    return tree;
}

void say(const SurfaceFlags& flags, const std::string& line) {
    if (flags.verbose) std::cerr << "ramus: " << line << '\n';
}

Result<volume::Volume> load_volume(const std::string& file, const SurfaceFlags& flags,
                                   std::optional<double> threshold) {
    auto read = with_progress("reading", [&](Job& job) {
        return io::read_volume(
            file, {static_cast<double>(flags.surface.memory_bytes), flags.read.unit, flags.read.part, threshold}, job);
    });
    if (!read) return read;
    say(flags, io::input_name(file) + ": " + read->type + ", " + std::to_string(read->size.x) + " x " +
                   std::to_string(read->size.y) + " x " + std::to_string(read->size.z) + " voxels");
    for (const std::string& note : read->notes) say(flags, io::input_name(file) + ": " + note);
    return read;
}

void warn_about(const std::string& file, const volume::Volume& volume) {
    for (const std::string& suspicion : volume.suspicions)
        std::cerr << "ramus: " << io::input_name(file) << ": " << suspicion << '\n';
}

Result<std::vector<std::uint8_t>> branches_of(const tree::VesselTree& tree, const Marks& marks,
                                              const std::vector<std::string>& systems, const std::string& where) {
    std::vector<std::uint8_t> chosen(tree.branches.size(), systems.empty() ? 1 : 0);
    for (const std::string& word : systems) {
        const auto system = find_system(systems_of(tree, marks), word);
        if (!system) return fail(system.error().what, where, system.error().hint);
        for (const int branch : branches_in_system(tree, *system)) chosen[static_cast<std::size_t>(branch)] = 1;
    }
    if (std::ranges::find(chosen, 1) == chosen.end())
        return fail("the systems that --system names have no branches", where);
    return chosen;
}

namespace {

// Hides all branches of other systems. Branches that the session hides stay hidden.
Result<void> show_only(Marks& marks, const tree::VesselTree& tree, const std::vector<std::string>& systems,
                       const std::string& where) {
    RAMUS_TRY(chosen, branches_of(tree, marks, systems, where));
    const auto others = branches_where(chosen.size(), [&](std::size_t id) { return chosen[id] == 0; });
    set_state(marks, others, tree::BranchState::kHidden);
    return {};
}

} // namespace

Result<OpenedSession> open_session(const std::string& tree_file, const std::string& session_file,
                                   const SurfaceFlags& flags, Alone alone) {
    SavedSession saved;
    if (session_file.empty()) {
        saved.session.marks.options = flags.surface;
        saved.session.marks.reading = flags.read;
    } else {
        RAMUS_TRY(read, read_session(session_file));
        saved = std::move(read);
        saved.session.marks.options = flags.over(saved.session.marks.options);
        saved.session.marks.reading = flags.over(saved.session.marks.reading);
    }
    OpenedSession opened{std::move(saved.session), nullptr, nullptr, saved.has_camera};
    if (!tree_file.empty()) opened.session.tree.path = std::filesystem::absolute(tree_file).lexically_normal();
    if (opened.session.tree.path.empty()) {
        if (alone == Alone::kRefused)
            return fail("this session has no tree, and this command needs one", session_file,
                        "also give the file of a tree");
        if (auto fits = check_against(opened.session, {}, {}, session_file); !fits) return tl::unexpected(fits.error());
        return opened;
    }
    auto tree = load_tree(tree_file.empty() ? opened.session.tree.path.string() : tree_file, flags,
                          opened.session.marks.reading);
    if (!tree) return tl::unexpected(tree.error());
    RAMUS_TRY(checksum, checksum_of(opened.session.tree.path));
    opened.base = std::make_shared<const tree::VesselTree>(std::move(*tree));
    RAMUS_TRY(edited, with_edits(opened.base, opened.session, checksum, session_file));
    opened.tree = edited;
    if (auto fits = check_against(opened.session, *opened.tree, checksum, session_file); !fits)
        return tl::unexpected(fits.error());
    opened.session.tree.checksum = checksum;
    if (session_file.empty()) opened.session.marks.colour_by = first_colouring(ColourBy::kNothing, *opened.tree);
    if (auto shown = show_only(opened.session.marks, *opened.tree, flags.systems, opened.session.tree.path.string());
        !shown)
        return tl::unexpected(shown.error());
    return opened;
}

} // namespace ramus::app
