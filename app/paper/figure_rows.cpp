#include "app/paper/figure_rows.h"

#include "app/paper/figures.h"

#include <algorithm>
#include <cstddef>

namespace ramus::app::paper {

namespace {

constexpr std::string_view kArtificialTrees =
    "That figures 1 to 3 have such artificial trees is recorded; which of them is figure 1 and which is figure 2 is "
    "not, nor are their sizes. Light, colours and views are not the paper's.";
constexpr std::string_view kParallelVessels =
    "Distance and radii are the paper's; the length of the vessels, light, colours and views are not.";
constexpr std::string_view kOtherTree =
    "The paper shows vessels of patients of its authors, which are not reproduced; here is the first tree that was "
    "given, or one that ramus grows.";

constexpr std::string_view kCones =
    "Another tree than the paper's. Each segment is a closed cone with 16 sides, which lie up to 2 % of the radius "
    "within a round one. Distances are to the nearest wall, even to one inside of another cone; so they are smaller "
    "beyond free ends and at branchings than those to the outer wall.";

std::vector<FigureRow> artificial_rows() {
    return {
        {"1",
         "Bulging at branchings",
         "Joints of three branches (Y and T) and of four (trifurcation) under width coefficients 1 and 5, and how "
         "high the surface stands over the joint.",
         "The larger the width coefficient, the less a convolution surface bulges where vessels branch. Over the "
         "joint of N equal branches in a plane the height is sqrt(1 + log2(N / 2) / width) radii, by equations 7 to "
         "10.",
         kArtificialTrees,
         {"figure_01.png"},
         bulging},
        {"2",
         "Unwanted blending of an S-shaped pair",
         "Two S-shaped vessels, 3 mm apart everywhere and of radius 1.07 mm, which are not connected.",
         "Vessels that only pass each other blend in a convolution surface; a larger width coefficient keeps them "
         "apart for longer.",
         kArtificialTrees,
         {"figure_02.png"},
         unwanted_blending},
        {"3",
         "Two parallel vessels merge",
         "Two straight vessels, 3 mm apart, of growing radius, and the radius from which on they have one surface.",
         "They merge at a radius of 1.37 mm (width 5) and of 1.07 mm (width 1): with gaps of 9 % and of 29 % of "
         "their distance.",
         kParallelVessels,
         {"figure_03.png", "figure_03_merging.svg"},
         merging},
        {"4",
         "Bounding volumes",
         "The volumes in which segments are evaluated: boxes, the paper's cylinders, and where the fading kernel of "
         "ramus is not 0; each as geometry, and as the cells of a grid that it covers, with counts.",
         "Cylindrical bounding volumes (CBV) of 1.5 radii leave out more cells than boxes do.",
         "The paper's figure is a drawing; here the volumes are computed. ramus lets the kernel fade from 1.4 to "
         "1.7 radii where the paper cuts it off at 1.5, because the cut shows as noise of the surface.",
         {"figure_04.png", "figure_04_fade.svg", "figure_04_cells.csv"},
         bounding_volumes},
    };
}

std::vector<FigureRow> method_rows() {
    return {
        {"5",
         "The three methods",
         "One tree as isosurface of its mask, as truncated cones and as convolution surface.",
         "Isosurfaces show the steps of voxels, truncated cones show creases at branchings, convolution surfaces "
         "are smooth.",
         kOtherTree,
         {"figure_05.png"},
         methods},
        {"6",
         "Smoothing of the skeleton",
         "A vessel whose centerline runs from voxel to voxel: without smoothing, after one and four passes of the "
         "binomial filter, and as it was before it became voxels.",
         "A binomial filter over centerline and radii removes the steps of voxels (section III).",
         "An artificial vessel in place of a patient's. ramus applies the filter by arc length; on points that are "
         "adjacent voxels it is nearly the paper's.",
         {"figure_06.png"},
         smoothing},
        {"7",
         "Pruning",
         "A vessel of voxels with short spurs, as thinning leaves them, before and after pruning.",
         "Short side branches that thinning leaves on a skeleton are removed (after Hahn et al. 2001).",
         "An artificial vessel in place of a patient's. Pruning is off by default in ramus.",
         {"figure_07.png"},
         pruning},
        {"8",
         "Deviation from truncated cones",
         "The convolution surface in colours of its distance from truncated cones, and the histogram of distances.",
         "For livers 0.09 mm in the mean and 1.07 mm at most (Table I).",
         kCones,
         {"figure_08.png", "figure_08_histogram.svg"},
         deviation_from_cones},
        {"9",
         "Deviation from the isosurface",
         "The convolution surface in colours of its distance from the isosurface of the mask, and the histogram of "
         "distances.",
         "For livers 0.37 mm in the mean; 91.26 % of the distances are below half the diagonal of a voxel (Table I).",
         kOtherTree,
         {"figure_09.png", "figure_09_histogram.svg"},
         deviation_from_isosurface},
        {"10",
         "Distances of several trees",
         "Box plots of the distances of figures 8 and 9, a row for each tree.",
         "Distances over ten trees (section VII-B).",
         kOtherTree,
         {"figure_10_to_cones.svg", "figure_10_to_isosurface.svg"},
         box_plots_of_trees},
    };
}

std::vector<FigureRow> clinical_rows() {
    return {
        {"11",
         "Pictures of the user study",
         "Three branchings, each seen alike by each of the three methods.",
         "Raters judged pictures of the three methods from the same view (section VIII).",
         kOtherTree,
         {"figure_11.png"},
         study_pictures},
        {"12",
         "A clinical example: a lesion in a liver",
         "Vessels by their distance from a round lesion, whole with the organ, and close to the lesion.",
         "Convolution surfaces are used to plan operations of the liver.",
         "The paper shows a patient. Here the lesion is a sphere that was put next to a vessel of the first tree.",
         {"figure_12.png"},
         lesion_in_liver},
        {"13",
         "A clinical example: branches in focus",
         "A branch with all that depends on it, highlighted, and with all others as glass.",
         "The vessels of interest are shown within the others.",
         "The paper shows a patient. Which branch is in focus is chosen by a rule: the one on which about a third "
         "of all depend.",
         {"figure_13.png"},
         branches_in_focus},
    };
}

std::vector<FigureRow> table_rows() {
    return {
        {"I",
         "Distances to truncated cones and to the isosurface",
         "Mean, standard deviation (sigma) and largest distance, and the share above half the diagonal of a voxel "
         "(VoxDiag2), for each tree and averaged.",
         "Averages over ten trees; for livers: to cones 0.09 mm in the mean, 1.07 mm at most; to the isosurface "
         "0.37 mm in the mean, 91.26 % below VoxDiag2.",
         "Other trees: the averages are not the paper's. Grown trees have masks without noise. Figure 8 says how "
         "distances to truncated cones are measured.",
         {"table_1_to_cones.csv", "table_1_to_isosurface.csv"},
         table_of_distances},
        {"II",
         "Criteria of the user study",
         "The four criteria by which raters score pictures in a study of ramus.",
         "Raters scored isosurface, truncated cones and convolution surface by four criteria.",
         "The scores of the paper are those of its raters, and are not reproduced: a study needs people.",
         {"table_2_criteria.csv"},
         table_of_criteria},
        {"III",
         "Times",
         "Seconds of each step, with the points of the tree and the triangles of the surface.",
         "Times of the steps of the method for several trees.",
         "Another machine, other trees, other numbers of triangles.",
         {"table_3.csv"},
         table_of_times},
    };
}

} // namespace

const std::vector<FigureRow>& figure_rows() {
    static const std::vector<FigureRow> all = [] {
        std::vector<FigureRow> rows;
        for (auto& part : {artificial_rows(), method_rows(), clinical_rows(), table_rows()})
            rows.insert(rows.end(), part.begin(), part.end());
        return rows;
    }();
    return all;
}

std::optional<std::vector<const FigureRow*>> rows_in(std::string_view list) {
    const std::vector<FigureRow>& rows = figure_rows();
    const auto place_of = [&](std::string_view number) {
        return static_cast<std::size_t>(std::ranges::find(rows, number, &FigureRow::number) - rows.begin());
    };
    std::vector<bool> wanted(rows.size(), false);
    while (true) {
        const std::size_t comma = list.find(',');
        const std::string_view word = list.substr(0, comma);
        const std::size_t dash = word.find('-');
        const std::size_t first = place_of(word.substr(0, dash));
        const std::size_t last = dash == std::string_view::npos ? first : place_of(word.substr(dash + 1));
        if (first >= rows.size() || last >= rows.size() || last < first) return std::nullopt;
        std::fill(wanted.begin() + static_cast<std::ptrdiff_t>(first),
                  wanted.begin() + static_cast<std::ptrdiff_t>(last) + 1, true);
        if (comma == std::string_view::npos) break;
        list.remove_prefix(comma + 1);
    }
    std::vector<const FigureRow*> chosen;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (wanted[i]) chosen.push_back(&rows[i]);
    return chosen;
}

std::string all_numbers() {
    const std::vector<FigureRow>& rows = figure_rows();
    const auto table = std::ranges::find_if(rows, &FigureRow::is_table);
    return std::string(rows.front().number) + "-" + std::string((table - 1)->number) + ", " +
           std::string(table->number) + "-" + std::string(rows.back().number);
}

} // namespace ramus::app::paper
