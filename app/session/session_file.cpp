#include "app/session/session_file.h"

#include "app/session/colour_text.h"
#include "app/session/json_text.h"
#include "core/io/output_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace ramus::app {

namespace fs = std::filesystem;
using nlohmann::json;
using render::BranchState;

namespace {

// All that a file lists: normal branches are the rest.
constexpr std::array kListedStates{BranchState::kHighlighted, BranchState::kDefocused, BranchState::kHidden};

// One place throws and one place catches: nesting Results through every member would hide the format.
struct Refusal {
    std::string what;
};

void expect_only(const json& object, const std::string& name, std::initializer_list<std::string_view> known) {
    if (!object.is_object()) throw Refusal{name + " is not an object"};
    for (const auto& [key, value] : object.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw Refusal{"unknown name \"" + key + "\" in " + name};
}

double number(const json& value, const std::string& name, double least, double most) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) throw Refusal{name + " is not a number"};
    const auto found = value.get<double>();
    if (found < least || found > most) throw Refusal{name + " " + value.dump() + " is out of range"};
    return found;
}

int integer(const json& value, const std::string& name, int least, int most) {
    if (!value.is_number_integer()) throw Refusal{name + " is not a whole number"};
    return static_cast<int>(number(value, name, least, most));
}

std::string text(const json& value, const std::string& name) {
    if (!value.is_string()) throw Refusal{name + " is not a text"};
    return value.get<std::string>();
}

// The list of this name; an empty one when there is none.
json list_in(const json& object, const std::string& name) {
    if (!object.contains(name)) return json::array();
    if (!object[name].is_array()) throw Refusal{name + " is not a list"};
    return object[name];
}

constexpr int kMostBranches = 100'000'000;

std::vector<int> ids(const json& value, const std::string& name) {
    if (!value.is_array()) throw Refusal{name + " is not a list"};
    std::vector<int> found;
    for (const json& id : value) found.push_back(integer(id, "branch id in " + name, 0, kMostBranches));
    return canonical(std::move(found));
}

json options_json(const Marks& marks) {
    const mesh::SurfaceOptions& options = marks.options;
    json value{{"method", options.method == mesh::Method::kTruncatedCones ? "cones" : "cs"},
               {"smooth", options.smooth_passes},
               {"prune", options.prune_ratio},
               {"width", options.width},
               {"detail", options.detail},
               {"colour_by", std::string(name_of(marks.colour_by))},
               {"colour_map", std::string(name_of(marks.colour_map))}};
    if (options.cell_mm > 0.0) value["cell"] = options.cell_mm;
    value["bands"] = marks.planning.bands_mm;
    value["reconstruct"] = marks.planning.reconstruct_mm;
    value["glass_opacity"] = marks.glass.opacity;
    value["glass_grey"] = marks.glass.grey;
    if (marks.skeleton) value["skeleton"] = true;
    value["depth_cues"] = json::array();
    for (const DepthCue cue : kDepthCues)
        if (marks.depth_cues.has(cue)) value["depth_cues"].push_back(std::string(name_of(cue)));
    return value;
}

void read_options(const json& value, Marks& marks) {
    expect_only(value, "options",
                {"method", "smooth", "prune", "width", "detail", "cell", "colour_by", "colour_map", "bands",
                 "reconstruct", "glass_opacity", "glass_grey", "skeleton", "depth_cues"});
    mesh::SurfaceOptions& options = marks.options;
    if (value.contains("method")) {
        const std::string method = text(value["method"], "method");
        if (method != "cs" && method != "cones") throw Refusal{"unknown method \"" + method + "\""};
        options.method = method == "cones" ? mesh::Method::kTruncatedCones : mesh::Method::kConvolutionSurface;
    }
    if (value.contains("smooth")) options.smooth_passes = integer(value["smooth"], "smooth", 0, 100);
    if (value.contains("prune")) options.prune_ratio = number(value["prune"], "prune", 0.0, 1e300);
    if (value.contains("width")) options.width = number(value["width"], "width", 0.1, 100.0);
    if (value.contains("detail")) options.detail = integer(value["detail"], "detail", 4, 512);
    if (value.contains("cell")) options.cell_mm = number(value["cell"], "cell", 0.0, 1e300);
    if (value.contains("bands")) {
        if (!value["bands"].is_array()) throw Refusal{"bands is not a list"};
        marks.planning.bands_mm.clear();
        for (const json& band : value["bands"]) marks.planning.bands_mm.push_back(number(band, "band", 1e-6, 1e6));
        if (!std::ranges::is_sorted(marks.planning.bands_mm)) throw Refusal{"bands do not ascend"};
    }
    if (value.contains("reconstruct"))
        marks.planning.reconstruct_mm = number(value["reconstruct"], "reconstruct", 0.0, 1e6);
    if (value.contains("glass_opacity"))
        marks.glass.opacity = number(value["glass_opacity"], "glass_opacity", 0.0, 2.0);
    if (value.contains("glass_grey")) marks.glass.grey = number(value["glass_grey"], "glass_grey", 0.0, 1.0);
    if (value.contains("skeleton")) {
        if (!value["skeleton"].is_boolean()) throw Refusal{"skeleton is not true or false"};
        marks.skeleton = value["skeleton"].get<bool>();
    }
    if (value.contains("depth_cues")) {
        if (!value["depth_cues"].is_array()) throw Refusal{"depth_cues is not a list"};
        for (const DepthCue cue : kDepthCues) marks.depth_cues.set(cue, false);
        for (const json& one : value["depth_cues"]) {
            const std::string wanted = text(one, "depth cue");
            const auto found = std::ranges::find_if(kDepthCues, [&](DepthCue cue) { return name_of(cue) == wanted; });
            if (found == kDepthCues.end()) throw Refusal{"unknown depth cue \"" + wanted + "\""};
            marks.depth_cues.set(*found, true);
        }
    }
    if (value.contains("colour_by")) {
        const std::string wanted = text(value["colour_by"], "colour_by");
        const auto found =
            std::find_if(kColourings.begin(), kColourings.end(), [&](ColourBy c) { return name_of(c) == wanted; });
        if (found == kColourings.end()) throw Refusal{"unknown colour_by \"" + wanted + "\""};
        marks.colour_by = *found;
    }
    if (value.contains("colour_map")) {
        const std::string wanted = text(value["colour_map"], "colour_map");
        const auto found =
            std::find_if(kColourMaps.begin(), kColourMaps.end(), [&](ColourMap m) { return name_of(m) == wanted; });
        if (found == kColourMaps.end()) throw Refusal{"unknown colour_map \"" + wanted + "\""};
        marks.colour_map = *found;
    }
}

fs::path written_path(const fs::path& tree, const fs::path& folder) {
    if (tree.empty()) return {};
    const fs::path relative =
        fs::absolute(tree).lexically_normal().lexically_relative(fs::absolute(folder).lexically_normal());
    return relative.empty() || *relative.begin() == ".." ? fs::absolute(tree).lexically_normal() : relative;
}

json comparison_json(const Comparison& comparison, const fs::path& folder) {
    json surfaces = json::array();
    for (const SurfaceKind kind : comparison.surfaces) surfaces.push_back(std::string(name_of(kind)));
    json value{{"mode", std::string(name_of(comparison.mode))}, {"surfaces", surfaces}, {"blend", comparison.blend}};
    if (!comparison.mask.empty()) value["mask"] = written_path(comparison.mask, folder).string();
    if (!comparison.labels.empty()) value["labels"] = comparison.labels;
    return value;
}

Comparison comparison_in(const json& value, const fs::path& folder) {
    expect_only(value, "comparison", {"mode", "surfaces", "mask", "labels", "blend"});
    Comparison comparison;
    if (value.contains("mode")) {
        const std::string wanted = text(value["mode"], "mode of the comparison");
        const auto mode = comparison_mode_named(wanted);
        if (!mode) throw Refusal{"unknown comparison \"" + wanted + "\""};
        comparison.mode = *mode;
    }
    if (value.contains("surfaces")) {
        std::string list;
        for (const json& name : list_in(value, "surfaces"))
            list.append(list.empty() ? "" : ",").append(text(name, "surface of the comparison"));
        const auto surfaces = surface_list(list);
        if (!surfaces) throw Refusal{"surfaces is not a list of two or three of cs, cones, iso"};
        comparison.surfaces = *surfaces;
    }
    if (value.contains("mask"))
        comparison.mask = (folder / text(value["mask"], "path of the mask")).lexically_normal().string();
    std::string labels;
    for (const json& label : list_in(value, "labels")) labels.append(labels.empty() ? "" : ",").append(label.dump());
    if (!labels.empty()) {
        const auto found = label_list(labels);
        if (!found) throw Refusal{"labels is not a list of whole numbers other than 0"};
        comparison.labels = *found;
    }
    if (value.contains("blend")) comparison.blend = number(value["blend"], "blend", 0.0, 1.0);
    return comparison;
}

void read_states(const json& value, Marks& marks) {
    expect_only(value, "states", {"highlighted", "defocused", "hidden"});
    for (const BranchState state : kListedStates) {
        const std::string name(name_of(state));
        if (!value.contains(name)) continue;
        const std::vector<int> found = ids(value[name], name);
        for (const int id : found)
            if (state_of(marks, id) != BranchState::kNormal)
                throw Refusal{"branch " + std::to_string(id) + " has two states"};
        set_state(marks, found, state);
    }
}

constexpr std::array<std::pair<Measurement::Kind, const char*>, 4> kMeasurementNames{
    {{Measurement::Kind::kDistance, "distance"},
     {Measurement::Kind::kPath, "path"},
     {Measurement::Kind::kDiameter, "diameter"},
     {Measurement::Kind::kAngle, "angle"}}};

json measurement_json(const Measurement& m) {
    json value;
    for (const auto& [kind, name] : kMeasurementNames)
        if (kind == m.kind) value["kind"] = name;
    if (m.kind == Measurement::Kind::kDistance)
        for (const glm::dvec3& p : m.points) value["points"].push_back({p.x, p.y, p.z});
    else if (m.kind == Measurement::Kind::kPath)
        value["branches"] = m.branches;
    else
        value["branches"] = {m.branches[0]};
    if (m.kind == Measurement::Kind::kDiameter) value["fraction"] = m.fraction;
    return value;
}

Measurement measurement(const json& value) {
    expect_only(value, "a measurement", {"kind", "points", "branches", "fraction"});
    Measurement found;
    const std::string wanted = text(value.value("kind", json()), "kind of a measurement");
    const auto known =
        std::ranges::find(kMeasurementNames, wanted, [](const auto& k) { return std::string(k.second); });
    if (known == kMeasurementNames.end()) throw Refusal{"unknown measurement \"" + wanted + "\""};
    found.kind = known->first;
    const json points = value.value("points", json::array());
    const json branches = value.value("branches", json::array());
    const std::size_t wants_points = found.kind == Measurement::Kind::kDistance ? 2 : 0;
    const std::size_t wants_branches = found.kind == Measurement::Kind::kPath ? 2 : wants_points == 0 ? 1 : 0;
    if (!points.is_array() || points.size() != wants_points || !branches.is_array() ||
        branches.size() != wants_branches)
        throw Refusal{"a measurement of kind " + wanted + " has " + std::to_string(wants_points) + " points and " +
                      std::to_string(wants_branches) + " branches"};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].is_array() || points[i].size() != 3) throw Refusal{"a point is not [x, y, z]"};
        for (int k = 0; k < 3; ++k)
            found.points[i][k] = number(points[i][static_cast<std::size_t>(k)], "coordinate of a point", -1e9, 1e9);
    }
    for (std::size_t i = 0; i < branches.size(); ++i)
        found.branches[i] = integer(branches[i], "branch id of a measurement", 0, kMostBranches);
    if (value.contains("fraction")) found.fraction = number(value["fraction"], "fraction", 0.0, 1.0);
    return found;
}

void read_plans(const json& value, Marks& marks) {
    for (const json& lesion : list_in(value, "lesions")) {
        if (!lesion.is_array() || lesion.size() != 4) throw Refusal{"a lesion is not [x, y, z, radius]"};
        std::array<double, 4> sphere{};
        for (std::size_t i = 0; i < 4; ++i) sphere[i] = number(lesion[i], "lesion", i == 3 ? 0.0 : -1e9, 1e9);
        marks.lesions.push_back(sphere);
    }
    for (const json& found : list_in(value, "measurements")) marks.measurements.push_back(measurement(found));
    for (const json& cut : list_in(value, "cuts")) {
        if (!cut.is_array() || cut.size() != 2) throw Refusal{"a cut is not [branch id, fraction]"};
        marks.cuts.emplace_back(integer(cut[0], "branch id of a cut", 0, kMostBranches),
                                number(cut[1], "cut", 0.0, 1.0));
    }
    if (!value.contains("names")) return;
    if (!value["names"].is_object()) throw Refusal{"names is not an object"};
    for (const auto& [key, name] : value["names"].items()) {
        int id = -1;
        const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), id);
        if (error != std::errc{} || end != key.data() + key.size() || id < 0)
            throw Refusal{"\"" + key + "\" in names is not a branch id"};
        marks.names[id] = text(name, "name of branch " + key);
    }
}

json context_json(const ContextItem& item, const fs::path& folder) {
    json value{{"path", written_path(item.file, folder).string()},
               {"colour", colour_text(item.colour)},
               {"opacity", item.opacity},
               {"wireframe", item.wireframe},
               {"visible", item.visible}};
    if (item.label != 0) value["label"] = item.label;
    if (item.exact) value["exact"] = true;
    return value;
}

bool truth(const json& value, const std::string& name) {
    if (!value.is_boolean()) throw Refusal{name + " is not true or false"};
    return value.get<bool>();
}

ContextItem context_item(const json& value, const fs::path& folder) {
    expect_only(value, "context", {"path", "label", "colour", "opacity", "wireframe", "visible", "exact"});
    ContextItem item;
    if (!value.contains("path")) throw Refusal{"a context mesh has no path"};
    item.file = (folder / text(value["path"], "path of a context mesh")).lexically_normal().string();
    if (value.contains("label"))
        item.label = integer(value["label"], "label", std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
    if (value.contains("opacity")) item.opacity = number(value["opacity"], "opacity", 0.0, 1.0);
    if (value.contains("wireframe")) item.wireframe = truth(value["wireframe"], "wireframe");
    if (value.contains("exact")) item.exact = truth(value["exact"], "exact");
    if (value.contains("visible")) item.visible = truth(value["visible"], "visible");
    if (value.contains("colour")) {
        const auto colour = colour_in(text(value["colour"], "colour"));
        if (!colour) throw Refusal{"\"" + value["colour"].get<std::string>() + "\" is not a colour: #RRGGBB"};
        item.colour = *colour;
    }
    return item;
}

} // namespace

json to_json(const Session& session, const fs::path& folder) {
    json states = json::object();
    for (const BranchState state : kListedStates)
        states[std::string(name_of(state))] = branches_in_state(session.marks, state);
    json names = json::object();
    for (const auto& [id, name] : session.marks.names) names[std::to_string(id)] = name;
    json meshes = json::array();
    for (const std::string& mesh : session.marks.lesion_meshes) meshes.push_back(written_path(mesh, folder).string());
    json context = json::array();
    for (const ContextItem& item : session.marks.context) context.push_back(context_json(item, folder));
    json measurements = json::array();
    for (const Measurement& m : session.marks.measurements) measurements.push_back(measurement_json(m));
    json value{
        {"version", kSessionVersion},
        {"tree", {{"path", written_path(session.tree.path, folder).string()}, {"checksum", session.tree.checksum}}},
        {"selection", session.marks.selection},
        {"states", states},
        {"lesions", session.marks.lesions},
        {"lesion_meshes", meshes},
        {"context", context},
        {"measurements", measurements},
        {"cuts", session.marks.cuts},
        {"names", names},
        {"camera", render::to_json(session.camera)},
        {"options", options_json(session.marks)}};
    if (session.marks.comparison != Comparison{})
        value["comparison"] = comparison_json(session.marks.comparison, folder);
    return value;
}

Result<SavedSession> session_from_json(const json& value, const fs::path& folder, const std::string& where) {
    try {
        expect_only(value, "the session",
                    {"version", "tree", "selection", "states", "lesions", "lesion_meshes", "context", "cuts",
                     "measurements", "names", "comparison", "camera", "options"});
        if (!value.contains("version")) throw Refusal{"no version: this is not a session file"};
        if (integer(value["version"], "version", 0, 1'000'000) != kSessionVersion)
            throw Refusal{"version " + value["version"].dump() + " is not known to this ramus"};
        SavedSession saved;
        Session& session = saved.session;
        if (!value.contains("tree")) throw Refusal{"no tree"};
        expect_only(value["tree"], "tree", {"path", "checksum"});
        if (!value["tree"].contains("path")) throw Refusal{"tree has no path"};
        session.tree.path = (folder / text(value["tree"]["path"], "path of the tree")).lexically_normal();
        if (value["tree"].contains("checksum")) session.tree.checksum = text(value["tree"]["checksum"], "checksum");
        if (value.contains("selection")) session.marks.selection = ids(value["selection"], "selection");
        if (value.contains("states")) read_states(value["states"], session.marks);
        read_plans(value, session.marks);
        for (const json& mesh : list_in(value, "lesion_meshes"))
            session.marks.lesion_meshes.push_back(
                (folder / text(mesh, "path of a lesion")).lexically_normal().string());
        for (const json& item : list_in(value, "context")) session.marks.context.push_back(context_item(item, folder));
        if (value.contains("comparison")) session.marks.comparison = comparison_in(value["comparison"], folder);
        if (value.contains("options")) read_options(value["options"], session.marks);
        if (value.contains("camera")) {
            auto camera = render::camera_from_json(value["camera"], where);
            if (!camera) return tl::unexpected(camera.error());
            session.camera = *camera;
            saved.has_camera = true;
        }
        return saved;
    } catch (const Refusal& refusal) {
        return fail(refusal.what, where, "save the session again from the window");
    }
}

Result<SavedSession> read_session(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (fs::is_directory(path) || !stream)
        return fail("the session cannot be read", path.string(), "check the name and its permissions");
    const json value = json::parse(stream, nullptr, false);
    if (value.is_discarded()) return fail("this is not JSON", path.string(), "give a session file saved by ramus");
    return session_from_json(value, fs::absolute(path).parent_path(), path.string());
}

Result<void> write_session(const Session& session, const fs::path& path) {
    const auto text = json_text(to_json(session, fs::absolute(path).parent_path()), path.string());
    return text ? io::write_file(path, *text) : tl::unexpected(text.error());
}

Result<std::string> checksum_of(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    std::array<char, 1 << 16> block{};
    while (stream) {
        stream.read(block.data(), block.size());
        for (std::streamsize i = 0; i < stream.gcount(); ++i)
            hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 0x100000001b3ULL;
    }
    if (!stream.eof()) return fail("the file cannot be read", path.string(), "check the name and its permissions");
    constexpr const char* kDigits = "0123456789abcdef";
    std::string digits(16, '0');
    for (std::size_t i = 0; i < 16; ++i) digits[15 - i] = kDigits[(hash >> (4 * i)) & 15];
    return digits;
}

Result<void> check_against(const Session& session, const tree::VesselTree& tree, const std::string& checksum,
                           const std::string& where) {
    if (!session.tree.checksum.empty() && session.tree.checksum != checksum)
        return fail(session.tree.path.filename().string() + " has changed since the session was saved", where,
                    "open the tree itself, or remove \"checksum\" from the session");
    const Marks& marks = session.marks;
    int largest = static_cast<int>(marks.states.size()) - 1;
    if (!marks.selection.empty()) largest = std::max(largest, marks.selection.back());
    if (!marks.names.empty()) largest = std::max(largest, marks.names.rbegin()->first);
    for (const auto& cut : marks.cuts) largest = std::max(largest, cut.first);
    for (const Measurement& m : marks.measurements) largest = std::max({largest, m.branches[0], m.branches[1]});
    if (largest >= static_cast<int>(tree.branches.size()))
        return fail("there is no branch " + std::to_string(largest) + " in a tree of " +
                        std::to_string(tree.branches.size()),
                    where, "the session belongs to another tree");
    return {};
}

} // namespace ramus::app
