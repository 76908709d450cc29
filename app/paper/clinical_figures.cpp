#include "app/assets/assets.h"
#include "app/paper/figures.h"
#include "app/picture/close_ups.h"
#include "app/picture/compose.h"
#include "app/picture/lesion_outlines.h"
#include "app/ratings/rating_study.h"
#include "app/session/numbers.h"
#include "app/workspace/surface_maker.h"
#include "core/base/words.h"
#include "core/measure/lesion_distance.h"
#include "core/volume/isosurface.h"
#include "render/scene/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <utility>

namespace ramus::app::paper {

namespace {

constexpr glm::ivec2 kSceneSize(820, 620);

// A session's picture on white, without the window.
struct Scene {
    Document document;
    Assets assets;

    [[nodiscard]] Result<void> open(const ComparedTree& tree, Marks marks, const render::Camera& camera, Job& job) {
        Session session;
        session.marks = std::move(marks);
        session.marks.options = paper_options();
        session.camera = camera;
        document.open(tree.input.tree, std::move(session));
        return complete(assets, document, job);
    }
    [[nodiscard]] render::Frame frame(const ComparedTree& tree, const std::string& caption) const {
        Viewing viewing;
        viewing.size = kSceneSize;
        viewing.ground = Ground::kWhite;
        render::Frame frame = compose(document.session(), assets, tree.surface.paged, viewing);
        frame.pixel_ratio = kPlateRatio;
        frame.overlays.caption = caption;
        frame.overlays.orientation_cube = true;
        return frame;
    }
};

// The organ that a grown tree fills.
Result<std::shared_ptr<const mesh::TriangleMesh>> organ_around(const ComparedTree& tree, Job& job) {
    constexpr double kStep = 2.5, kMargin = 30.0; // mm
    const render::Box box = render::bounds_of(*tree.input.tree);
    const glm::dvec3 corner = box.lower - kMargin;
    const glm::ivec3 size(glm::ceil((box.upper - box.lower + 2.0 * kMargin) / kStep));
    std::vector<glm::ivec3> cells;
    std::vector<tree::Point> points;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                cells.emplace_back(i, j, k);
                points.push_back({corner + kStep * glm::dvec3(cells.back()), 0.0});
            }
    const std::vector<double> depths = tree::organ_depths_mm(*tree.input.grown, points);
    volume::BitMask inside(size);
    for (std::size_t n = 0; n < cells.size(); ++n)
        if (depths[n] > 0.0) inside.set(cells[n]);
    const glm::dmat4 to_patient = glm::scale(glm::translate(glm::dmat4(1.0), corner), glm::dvec3(kStep));
    RAMUS_TRY(mesh, volume::mask_surface(inside, to_patient, {.steps = volume::VoxelSteps::kSmoothed}, job));
    return std::make_shared<const mesh::TriangleMesh>(std::move(mesh));
}

// A round lesion next to a vessel of middling width: seen from the front at its side, within the organ if there is one,
// and no nearer to any vessel than a third of its radius. On the side on which it is nearest, and away from the middle
// of the tree if it is as near on several.
Lesion lesion_next_to_vessel(const InputTree& input) {
    constexpr int kSides = 24;
    const std::vector<CloseUp> places = close_ups_of(*input.tree);
    const CloseUp& place = places[places.size() / 4];
    const render::Box box = render::bounds_of(*input.tree);
    const double radius = 0.075 * box.radius(), gap = radius / 3.0, step = 0.05 * radius;
    Lesion best;
    double least = std::numeric_limits<double>::infinity();
    for (int side = 0; side < kSides; ++side) {
        const double turn = glm::radians(360.0 * side / kSides);
        const glm::dvec3 way(std::cos(turn), 0.0, std::sin(turn));
        const double outward = step * glm::dot(way, place.position - box.centre()) / box.radius();
        for (double offset = radius + place.radius + gap; offset - outward < least; offset += step) {
            const glm::dvec3 middle = place.position + offset * way;
            const std::array sphere{middle.x, middle.y, middle.z, radius};
            if (input.grown && tree::organ_depths_mm(*input.grown, {{middle, 0.0}}).front() < radius) break;
            if (std::ranges::min(measure::wall_distances(*input.tree, {{sphere}, {}})) < gap) continue;
            least = offset - outward;
            best.sphere = sphere;
        }
    }
    return best;
}

std::string lesion_command(const Lesion& lesion) {
    return "lesion " + joined(lesion.sphere, ",", [](double number) { return in_digits(number); });
}

// The branch on which nearest to a third of all others depend.
int third_of(const TreeFacts& facts) {
    const auto count = static_cast<double>(facts.branches.size());
    int best = 0;
    double least = count;
    for (int branch = 0; branch < facts.dependency.branch_count(); ++branch) {
        const double off = std::abs(static_cast<double>(facts.dependency.dependents(branch).size()) - count / 3.0);
        if (off < least) least = off, best = branch;
    }
    return best;
}

} // namespace

Result<Figure> study_pictures(Workbench& bench, Job& job) {
    constexpr glm::ivec2 kPanel(560, 440);
    RAMUS_TRY(tree, bench.first(job));
    RAMUS_TRY(artist, bench.artist());
    Figure figure{.options = {"ramus study TREE -o FOLDER --mask MASK --blend paper --centerline lines"}};
    const std::vector<NamedSurface> surfaces = surfaces_of(*tree);
    const std::vector<glm::vec3> positions = surfaces.back().paged->positions();
    const render::Camera whole = render::camera_for(positions, render::View::kAnterior, kPanel, true);
    const render::Frame context = frame_of(surfaces.back().paged, whole, kPanel, "");
    if (const auto drawn = artist->renderer().draw(context); !drawn) return tl::unexpected(drawn.error());
    Plate plate{.columns = surfaces.size()};
    for (const CloseUp& place : choose_close_ups(artist->renderer(), context, close_ups_of(*tree->input.tree)))
        for (const NamedSurface& surface : surfaces) {
            plate.panels.push_back({frame_of(surface.paged, close_to(place, whole), kPanel, surface.title)});
            show_claims(plate.panels.back().frame, tree->input.tree->claims);
        }
    return bench.with_picture(std::move(figure), "figure_11.png",
                              "A wide, a middling and a thin branching of the tree " + tree->input.name +
                                  ", each seen alike by each method, in parallel projection. " + isosurface_text(*tree),
                              plate, job);
}

Result<Figure> lesion_in_liver(Workbench& bench, Job& job) {
    RAMUS_TRY(tree, bench.first(job));
    Marks marks;
    add_lesion(marks, lesion_next_to_vessel(tree->input));
    Figure figure{.options = {"ramus render TREE --commands FILE with " + lesion_command(marks.lesions.front()) +
                              "; colour-by lesion; shortest-distances on"}};
    marks.colour_by = ColourBy::kLesion;
    marks.shortest_distances = true;
    std::vector<Paged> all{tree->surface.paged};
    std::shared_ptr<const mesh::TriangleMesh> organ;
    if (tree->input.grown) {
        RAMUS_TRY(made, organ_around(*tree, job));
        organ = std::move(made);
        all.push_back(paged(*organ, *tree->input.tree));
    }
    const render::Camera camera = camera_on(all, kSceneSize, {.left = 0.24});
    Scene scene;
    if (auto opened = scene.open(*tree, marks, camera, job); !opened) return tl::unexpected(opened.error());
    const Lengths lengths(tree->input.tree->claims);
    render::Frame whole = scene.frame(*tree, "");
    if (organ) {
        whole.context.push_back({std::move(organ), nullptr, glm::vec3(0.79F, 0.51F, 0.41F), 0.12F});
        outline_lesions(whole, scene.assets, scene.document.marks());
    }
    const auto& sphere = marks.lesions.front().sphere;
    render::Frame close = scene.frame(*tree, "");
    close.camera = magnified(camera, {sphere[0], sphere[1], sphere[2]}, 6.5 * sphere[3]);
    close.overlays.legend = {};
    return bench.with_picture(std::move(figure), "figure_12.png",
                              "A round lesion (" + lengths.text(2.0 * sphere[3]) +
                                  " across) that was put next to a vessel of the tree " + tree->input.name +
                                  "; vessels in the colours of their distance from it, and the shortest distance" +
                                  (tree->input.grown ? ". The organ is the one in which the tree was grown." : "."),
                              {.columns = 2, .panels = {{std::move(whole), {}, 1}, {std::move(close)}}}, job);
}

Result<Figure> branches_in_focus(Workbench& bench, Job& job) {
    RAMUS_TRY(tree, bench.first(job));
    const render::Camera camera = camera_on({tree->surface.paged}, kSceneSize);
    const TreeFacts facts = facts_of(*tree->input.tree);
    const int branch = third_of(facts);
    Figure figure{.options = {"ramus render TREE --commands FILE with select-subtree " + std::to_string(branch) +
                              "; highlight, or defocus-others"}};
    const auto inside = facts.dependency.with_dependents(branch);
    const std::vector<int> focus(inside.begin(), inside.end());
    const std::vector<int> others = branches_where(facts.branches.size(), [&](std::size_t id) {
        return std::ranges::find(focus, static_cast<int>(id)) == focus.end();
    });
    Plate plate{.columns = 2};
    for (const bool glass : {false, true}) {
        Marks marks;
        set_state(marks, glass ? others : focus,
                  glass ? tree::BranchState::kDefocused : tree::BranchState::kHighlighted);
        Scene scene;
        if (auto opened = scene.open(*tree, marks, camera, job); !opened) return tl::unexpected(opened.error());
        plate.panels.push_back({scene.frame(*tree, glass ? "Others defocused (glass)" : "Highlighted")});
    }
    return bench.with_picture(std::move(figure), "figure_13.png",
                              "A branch of the tree " + tree->input.name + " with all that depends on it, " +
                                  counted(focus.size(), "branch", "branches") + " of " +
                                  grouped(facts.branches.size()) + ".",
                              plate, job);
}

Result<Figure> table_of_criteria(Workbench& /*bench*/, Job& /*job*/) {
    Figure figure{.options = {"ramus study TREE -o FOLDER --mask MASK --raters 12",
                              "ramus ratings FOLDER/key.json ANSWERS/*.json --csv FILE"}};
    Table table{
        "Criteria", {{"criterion", "Criterion"}, {"question", "Question"}, {"lowest", "1"}, {"highest", "5"}}, {}};
    for (const Criterion& criterion : kCriteria)
        table.rows.push_back({std::string(criterion.name), std::string(criterion.question), std::string(criterion.low),
                              std::string(criterion.high)});
    figure.tables.push_back({"table_2_criteria.csv", std::move(table),
                             "The four criteria of the paper, in words of our own. They are what every study of ramus "
                             "asks for; there is nothing to set. Scores come from people: the commands below make the "
                             "sheets for them and the table of their answers."});
    return figure;
}

} // namespace ramus::app::paper
