#include "app/session/session_file.h"

#include "app/session/checksum.h"
#include "app/session/json_text.h"
#include "app/session/json_values.h"
#include "app/session/marks_json.h"
#include "app/session/marks_table.h"
#include "app/session/session_limits.h"
#include "app/session/slices_json.h"
#include "core/io/input_file.h"
#include "core/io/json_text.h"
#include "core/io/output_file.h"
#include "core/io/standard_input.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <vector>

namespace ramus::app {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace session_json;

json to_json(const Session& session, const fs::path& folder) {
    json tree; // null: objects are shown without a tree
    if (!session.tree.path.empty() || !has_objects_alone(session.marks))
        tree = {{"path", written_path(session.tree.path, folder).string()}, {"checksum", session.tree.checksum}};
    json value{{"version", kSessionVersion}, {"tree", tree}, {"camera", render::to_json(session.camera)}};
    if (json slices = slices_json(session.slices); !slices.is_null()) value["slices"] = std::move(slices);
    value["options"] = json::object();
    for (const MarksRow& row : marks_table())
        for (const MarksEntry& entry : row.entries)
            if (json written = entry.write(session.marks, folder); !written.is_null())
                (row.place == MarksPlace::kOptions ? value["options"] : value)[entry.key] = std::move(written);
    return value;
}

namespace {

TreeFile tree_file(const json& value, const fs::path& folder) {
    expect_only(value, "tree", {"path", "checksum"});
    if (!value.contains("path")) throw Refusal{"tree has no path"};
    TreeFile file{(folder / text(value["path"], "path of the tree")).lexically_normal(), {}};
    if (value.contains("checksum")) file.checksum = text(value["checksum"], "checksum");
    return file;
}

std::vector<fs::path> named_files(const Session& session) {
    std::vector<fs::path> files{session.tree.path};
    for (const MarksRow& row : marks_table())
        if (row.add_files != nullptr) row.add_files(session.marks, files);
    return files;
}

// The keys of the table and those in `known`.
std::vector<std::string_view> keys_of(MarksPlace place, std::vector<std::string_view> known) {
    for (const MarksRow& row : marks_table())
        for (const MarksEntry& entry : row.entries)
            if (row.place == place) known.push_back(entry.key);
    return known;
}

void read_entries(const json& object, MarksPlace place, const fs::path& folder, Marks& marks) {
    for (const MarksRow& row : marks_table())
        for (const MarksEntry& entry : row.entries)
            if (row.place == place && object.contains(entry.key))
                entry.read(object[entry.key], folder, marks);
            else if (row.place == place && entry.absent)
                entry.absent(marks);
}

// A session may come from another person; a pipe or device in it could block forever. Missing files are reported on
// reading.
void check_named_files(const Session& session) {
    for (const fs::path& file : named_files(session)) {
        std::error_code error;
        const fs::file_status status = fs::status(file, error);
        if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
            throw Refusal{"it names " + file.string() + ", which is no regular file"};
    }
}

} // namespace

Result<SavedSession> session_from_json(const json& value, const fs::path& folder, const std::string& where) {
    try {
        expect_only(value, "the session",
                    keys_of(MarksPlace::kSession, {"version", "tree", "camera", "slices", "options"}));
        if (!value.contains("version")) throw Refusal{"no version: this is not a session file"};
        if (integer(value["version"], "version", 0, 1'000'000) != kSessionVersion)
            throw Refusal{"version " + value["version"].dump() + " is not known to this ramus"};
        SavedSession saved;
        Session& session = saved.session;
        if (!value.contains("tree")) throw Refusal{"no tree"};
        if (!value["tree"].is_null()) session.tree = tree_file(value["tree"], folder);
        read_entries(value, MarksPlace::kSession, folder, session.marks);
        if (value.contains("options")) {
            expect_only(value["options"], "options", keys_of(MarksPlace::kOptions, {}));
            read_entries(value["options"], MarksPlace::kOptions, folder, session.marks);
        }
        number_objects(session.marks);
        if (const auto few = check_counts(session.marks); !few) throw Refusal{few.error().what};
        if (value["tree"].is_null() && !has_objects_alone(session.marks)) throw Refusal{"it shows nothing"};
        check_named_files(session);
        if (value.contains("slices")) session.slices = slices_in(value["slices"]);
        if (value.contains("camera")) {
            RAMUS_TRY(camera, render::camera_from_json(value["camera"], where));
            session.camera = camera;
            saved.has_camera = true;
        }
        return saved;
    } catch (const Refusal& refusal) {
        return fail(refusal.what, where, "save the session again from the window");
    }
}

Result<SavedSession> read_session(const fs::path& path) {
    RAMUS_TRY(text, io::read_file(path, kMostSessionBytes, io::InputKind::kSession));
    auto parsed = io::parsed_json(text, path.string());
    if (!parsed) {
        parsed.error().hint = "give a session file saved by ramus";
        return tl::unexpected(parsed.error());
    }
    const json value = std::move(*parsed);
    auto saved = session_from_json(value, fs::absolute(path).parent_path(), path.string());
    if (saved) // some are read late or never, but the session needs them
        for (const fs::path& file : named_files(saved->session)) io::note_input(file);
    return saved;
}

Result<void> write_session(const Session& session, const fs::path& path) {
    if (io::is_standard_input(session.tree.path))
        return fail("the tree came through standard input, and a session needs a file that it can open again",
                    path.string(), "write the tree to a file, and open that");
    const auto text = json_text(to_json(session, fs::absolute(path).parent_path()), path.string());
    return text ? io::write_file(path, *text, io::InputKind::kSession) : tl::unexpected(text.error());
}

namespace {

// For a folder of images: names and sizes of its files, to avoid reading it completely twice.
std::string contents_of(const fs::path& folder) {
    std::vector<std::string> files;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
        std::error_code ignored;
        files.push_back(entry.path().lexically_relative(folder).string() + ' ' +
                        std::to_string(entry.is_regular_file(ignored) ? entry.file_size(ignored) : 0) + '\n');
    }
    std::ranges::sort(files);
    return std::accumulate(files.begin(), files.end(), std::string());
}

} // namespace

Result<std::string> checksum_of(const fs::path& path) {
    std::error_code error;
    std::unique_ptr<std::istream> bytes;
    if (fs::is_directory(path, error))
        bytes = std::make_unique<std::istringstream>(contents_of(path));
    else
        bytes = std::make_unique<std::ifstream>(path, std::ios::binary);
    std::istream& stream = *bytes;
    Checksum checksum;
    std::array<char, 1 << 16> block{};
    while (stream) {
        stream.read(block.data(), block.size());
        checksum.add({block.data(), static_cast<std::size_t>(stream.gcount())});
    }
    if (!stream.eof()) return fail("the file cannot be read", path.string(), "check the name and its permissions");
    return checksum.text();
}

Result<void> check_checksum(const Session& session, const std::string& checksum, const std::string& where) {
    if (!session.tree.checksum.empty() && session.tree.checksum != checksum)
        return fail(session.tree.path.filename().string() + " has changed since the session was saved", where,
                    "open the tree itself, or remove \"checksum\" from the session");
    return {};
}

Result<void> check_against(const Session& session, const tree::VesselTree& tree, const std::string& checksum,
                           const std::string& where) {
    if (auto same = check_checksum(session, checksum, where); !same) return same;
    const Marks& marks = session.marks;
    if (!marks.systems.empty() && marks.systems.size() != tree.systems.size())
        return fail("the session names " + std::to_string(marks.systems.size()) + " systems of a tree of " +
                        std::to_string(tree.systems.size()),
                    where, "the session belongs to another tree");
    int largest = -1;
    for (const MarksRow& row : marks_table())
        if (row.largest_branch != nullptr) largest = std::max(largest, row.largest_branch(marks));
    if (largest >= static_cast<int>(tree.branches.size()))
        return fail("there is no branch " + std::to_string(largest) + " in a tree of " +
                        std::to_string(tree.branches.size()),
                    where, "the session belongs to another tree");
    return {};
}

} // namespace ramus::app
