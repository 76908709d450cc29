#include "core/io/trees/tree_file.h"

#include "core/io/inflate.h"
#include "core/io/input_file.h"
#include "core/io/output_file.h"
#include "core/io/recognise.h"
#include "core/io/standard_input.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/amira.h"
#include "core/io/trees/branch_table.h"
#include "core/io/trees/csv_pair.h"
#include "core/io/trees/graphml.h"
#include "core/io/trees/gxl.h"
#include "core/io/trees/hdf5_morphology.h"
#include "core/io/trees/slicer.h"
#include "core/io/trees/swc.h"
#include "core/io/trees/tree_json.h"
#include "core/io/trees/tubetk.h"
#include "core/io/trees/vmv.h"
#include "core/io/trees/voreen.h"
#include "core/io/trees/vtk.h"

#include <system_error>

namespace ramus::io {

namespace {

tl::unexpected<Error> no_tree(const Recognised& found, const std::filesystem::path& path) {
    if (found.volume != nullptr)
        return fail("this is a volume, where a vessel tree is needed", path.string(),
                    "ramus mesh --method iso makes the surface of a mask");
    if (found.mesh != nullptr)
        return fail("this is a surface mesh, not a tree", input_name(path),
                    "a tree needs centerlines; as a surface, --context of ramus render shows it");
    const std::string type = path.extension().string();
    return fail(type.empty() ? "its format is not recognised, neither from its first bytes nor from its name"
                             : "files of type '" + type + "' cannot be read",
                input_name(path), "use " + readable_tree_extensions());
}

Result<tree::VesselTree> parse(const TreeFormat& format, const TreeInput& input) {
    auto imported = format.parse(input);
    auto tree = imported ? tree_of(std::move(*imported), input.options) : tl::unexpected(std::move(imported).error());
    if (!tree && tree.error().where.empty()) tree.error().where = input.name; // an error of the whole file
    return tree;
}

Result<tree::VesselTree> read_any(const std::filesystem::path& path, const ReadOptions& options) {
    const std::string name = input_name(path);
    // Checked before gigabytes are read for nothing.
    if (const Recognised begins = recognised(path); begins && begins.tree == nullptr) {
        std::error_code error;
        const bool is_folder = std::filesystem::is_directory(path, error);
        if (auto possible = check_input(path); !possible && !is_folder) return tl::unexpected(possible.error());
        return no_tree(begins, path);
    }
    if (std::error_code error; std::filesystem::is_directory(path, error))
        return fail("this folder holds no DICOM image, no TIFF file and no Zarr array", name, "name a file in it");
    // An error of the file is more useful than an error of its name.
    RAMUS_TRY(text, read_file(path));
    if (text.empty()) return fail("the file is empty", name, "choose another file");
    if (is_gzip(text)) { // independent of the name
        RAMUS_TRY(plain, inflated(text, inflation_limit(text.size()), name));
        text = std::move(plain);
    }
    const Recognised found = recognised(text, path);
    return found.tree != nullptr
               ? parse(*found.tree, {text, name, options, is_standard_input(path) ? std::filesystem::path() : path})
               : no_tree(found, path);
}

const TreeFormat* written_format(const std::filesystem::path& file) {
    const TreeFormat* format = format_by_name(tree_formats(), file);
    return format != nullptr && is_written(*format) ? format : nullptr;
}

std::vector<TreeFormat> joined(std::vector<TreeFormat> formats, const std::vector<TreeFormat>& more) {
    formats.insert(formats.end(), more.begin(), more.end());
    return formats;
}

std::vector<TreeFormat> formats_of_curves_and_graphs() {
    return {
        {{.name = "VMV",
          .extensions = {".vmv"},
          .has_signature = is_vmv,
          .certainty = Certainty::kHeader,
          .help = "Vertices and strands of VessMorphoVis, as text."},
         parse_vmv,
         write_vmv},
        {{.name = "Amira SpatialGraph",
          .extensions = {".am"},
          .has_signature = is_amira,
          .help = "Vertices, edges and their points, as text or binary."},
         parse_amira},
        {{.name = "Voreen vessel graph",
          .extensions = {".vvg"},
          .has_signature = is_voreen,
          .certainty = Certainty::kHeader,
          .help = "Nodes and edges with the voxels of their skeletons, as JSON."},
         parse_voreen},
        {{.name = "3D Slicer markups",
          .extensions = {".mrk.json"},
          .has_signature = is_markups,
          .certainty = Certainty::kHeader,
          .help = "Curves with a measurement of their radius, as Extract Centerline makes them."},
         parse_markups,
         [](const auto& tree, const auto& file, const auto& comments) {
             return write_markups(tree, file, comments, Orientation::lps());
         },
         WritesData::kOfPoints,
         write_markups},
    };
}

std::vector<TreeFormat> formats_of_nodes_and_edges() {
    return {
        {{.name = "CSV pair",
          .extensions = {".csv"},
          .has_signature = is_csv_pair,
          .certainty = Certainty::kLikeness,
          .help = "A table of nodes and one of edges beside it, as VesselVio and VesselGraph write them."},
         parse_csv_pair,
         write_csv_pair,
         WritesData::kAll},
        {{.name = "GraphML",
          .extensions = {".graphml"},
          .has_signature = is_graphml,
          .certainty = Certainty::kHeader,
          .help = "Nodes with positions and edges with radii, as VesselVio writes them."},
         parse_graphml,
         write_graphml,
         WritesData::kAll},
        {{.name = "GXL",
          .extensions = {".gxl", ".xml"},
          .has_signature = is_gxl,
          .certainty = Certainty::kHeader,
          .help = "Synthetic trees of VascuSynth and OpenCCO."},
         parse_gxl},
    };
}

} // namespace

const std::vector<TreeFormat>& tree_formats() {
    static const std::vector<TreeFormat> table = {
        {{.name = "SWC",
          .extensions = {".swc"},
          .has_signature = is_swc,
          .certainty = Certainty::kLikeness,
          .help = "One point a line: id, type, x, y, z, radius, parent."},
         parse_swc,
         write_swc},
        {{.name = "ramus JSON",
          .extensions = {".json"},
          .has_signature = is_tree_json,
          .certainty = Certainty::kHeader,
          .help = "Points, branches, labels and repairs of any network, without loss."},
         parse_tree_json,
         write_tree_json,
         WritesData::kAll},
        {{.name = "VTK PolyData",
          .extensions = {".vtp"},
          .has_signature = is_vtk_poly_data,
          .certainty = Certainty::kHeader,
          .help = "Centerlines of VMTK, Slicer, SimVascular: polylines with an array of radii."},
         parse_vtk_xml,
         [](const auto& tree, const auto& file, const auto& comments) {
             return write_vtp(tree, file, comments, Orientation::ras());
         },
         WritesData::kAll,
         write_vtp},
        {{.name = "VTK unstructured grid",
          .extensions = {".vtu"},
          .has_signature = is_vtk_unstructured_grid,
          .certainty = Certainty::kHeader,
          .help = "Cells that are lines, with an array of radii."},
         parse_vtk_xml},
        {{.name = "Legacy VTK",
          .extensions = {".vtk"},
          .has_signature = is_vtk_legacy,
          .help = "Centerlines as text or binary: lines with an array of radii."},
         parse_vtk_legacy},
        {{.name = "TubeTK",
          .extensions = {".tre"},
          .has_signature = is_tre,
          .certainty = Certainty::kHeader,
          .help = "Tubes of ITK and TubeTK, with parents, arteries and veins."},
         parse_tre},
        {{.name = "HDF5 morphology",
          .extensions = {".h5", ".hdf5"},
          .has_signature = is_hdf5,
          .help = "Tables of points with diameters, sections and their connections."},
         parse_hdf5_morphology},
    };
    static const std::vector<TreeFormat> all =
        joined(joined(table, formats_of_curves_and_graphs()), formats_of_nodes_and_edges());
    return all;
}

std::string readable_tree_extensions() { return listed(readable_extensions(tree_formats())); }
std::string writable_tree_extensions() { return listed(writable_extensions(tree_formats())); }

bool names_tree(const std::filesystem::path& path) {
    const TreeFormat* format = format_by_name(tree_formats(), without_gz(path));
    return format != nullptr && is_read(*format);
}

Result<tree::VesselTree> read_tree(const std::filesystem::path& path, const ReadOptions& options) {
    auto tree = read_any(path, options);
    if (tree && tree->source.empty()) tree->source = std::filesystem::path(input_name(path)).filename().string();
    if (tree)
        if (auto good = join_branch_table(*tree, options); !good) return tl::unexpected(good.error());
    return tree;
}

Result<tree::VesselTree> parse_tree(std::string_view text, const std::string& name, const ReadOptions& options) {
    std::string plain;
    if (is_gzip(text)) {
        RAMUS_TRY(bytes, inflated(text, inflation_limit(text.size()), name));
        plain = std::move(bytes);
        text = plain;
    }
    const Recognised found = recognised(text, name);
    return found.tree != nullptr ? parse(*found.tree, {text, name, options, {}}) : no_tree(found, name);
}

Result<void> check_tree_output(const std::filesystem::path& file, const std::optional<Orientation>& axes) {
    const TreeFormat* format = written_format(file);
    if (format == nullptr)
        return fail("no tree format has the extension \"" + file.extension().string() + "\"", file.string(),
                    "use " + writable_tree_extensions());
    if (axes && *axes != Orientation::ras() && format->write_in == nullptr)
        return fail("files of this format cannot say that their axes are " + axes->letters(), file.string(),
                    "use .vtp or .mrk.json, or RAS");
    return check_output(file);
}

std::string data_left_out(const tree::VesselTree& tree, const std::filesystem::path& file) {
    const TreeFormat* format = written_format(file);
    if (format == nullptr || format->writes_data == WritesData::kAll) return {};
    std::string names;
    const auto add = [&](const tree::DataArrays& arrays) {
        for (const tree::DataArray& array : arrays) names += (names.empty() ? "" : ", ") + array.name;
    };
    if (format->writes_data == WritesData::kNone) add(tree.point_data);
    add(tree.branch_data);
    if (names.empty()) return {};
    std::vector<std::string_view> others;
    for (const TreeFormat& other : tree_formats())
        if (other.writes_data == WritesData::kAll) others.push_back(other.extensions.front());
    return file.filename().string() + " has no place for the tree's data, left out: " + names + "; " + listed(others) +
           " keep them";
}

Result<void> write_tree(const tree::VesselTree& tree, const std::filesystem::path& file,
                        const std::vector<std::string>& comments, const std::optional<Orientation>& axes) {
    if (auto possible = check_tree_output(file, axes); !possible) return possible;
    const TreeFormat& format = *written_format(file);
    if (!axes || format.write_in == nullptr) return format.write(tree, file, comments);
    if (auto known = check_axes(*axes, tree.claims, file.string()); !known) return known;
    return format.write_in(tree, file, comments, *axes);
}

} // namespace ramus::io
