// A document in the hands of a commands file, as tests drive it: run lines, look at the marks, read what was said.
#pragma once

#include "app/actions/script.h"
#include "app/assets/assets.h"

#include <doctest/doctest.h>
#include <memory>
#include <string>
#include <vector>

namespace ramus::test {

using Ids = std::vector<int>; // of branches

class TestPicture : public app::PictureHost {
public:
    [[nodiscard]] glm::ivec2 picture_size() const override { return size; }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override { return mesh; }
    Result<void> write_picture(const std::filesystem::path& path) override {
        pictures.push_back(path);
        return {};
    }
    Result<render::Image> draw_picture(const app::Session& session, glm::ivec2 drawn,
                                       const app::FigureOptions& options) override {
        cameras.push_back(session.camera);
        drawn_marks.push_back(session.marks);
        sizes.push_back(drawn);
        looks.push_back(options);
        return render::Image(drawn.x / 10, drawn.y / 10);
    }
    Result<void> write_figure(const app::FigureRequest& request, Job& /*job*/) override {
        figures.push_back(request);
        return {};
    }
    void camera_leapt() override { ++leaps; }

    glm::ivec2 size{400, 300};
    std::shared_ptr<const render::PagedMesh> mesh;
    // What was asked of it.
    std::vector<std::filesystem::path> pictures;
    std::vector<app::FigureRequest> figures;
    std::vector<render::Camera> cameras; // of pictures, with their sizes and looks
    std::vector<app::Marks> drawn_marks;
    std::vector<glm::ivec2> sizes;
    std::vector<app::FigureOptions> looks;
    int leaps = 0;
};

struct CommandStage {
    explicit CommandStage(std::shared_ptr<const tree::VesselTree> tree, app::Session session = {}) {
        document.open(std::move(tree), std::move(session));
    }
    explicit CommandStage(tree::VesselTree tree, app::Session session = {})
        : CommandStage(std::make_shared<const tree::VesselTree>(std::move(tree)), std::move(session)) {}
    app::Document document;
    TestPicture host;
    app::Assets assets;
    std::string said; // last
    app::ActionContext context{.document = document,
                               .picture = host,
                               .assets = assets,
                               .tell = [this](const std::string& sentence) { said = sentence; }};

    Result<void> run(std::string_view text) {
        const auto lines = app::parse_script(text, "c.txt");
        return lines ? app::run_script(context, *lines, "c.txt") : tl::unexpected(lines.error());
    }
    std::string good(std::string_view text) { // what was said
        said.clear();
        const auto done = run(text);
        REQUIRE_MESSAGE(done, (done ? "" : done.error().message()));
        return said;
    }
    std::string bad(std::string_view text) { // why not; a command that fails changes nothing
        const app::Marks before = document.marks();
        const auto done = run(text);
        REQUIRE_FALSE_MESSAGE(done, text);
        if (text.find('\n') == std::string_view::npos) CHECK(document.marks() == before);
        return done.error().message();
    }
    [[nodiscard]] const Ids& selection() const { return document.marks().selection; }
    [[nodiscard]] Ids in(tree::BranchState state) const { return branches_in_state(document.marks(), state); }
    [[nodiscard]] std::string last_step() const { return document.step_name(document.position() - 1); }
    [[nodiscard]] const app::Marks& marks() const { return document.marks(); }
    // What belongs to the document as it is now.
    const app::Assets& current_assets() {
        app::complete_lesions(assets, document);
        return assets;
    }
    std::shared_ptr<const app::Plan> plan() { return current_assets().plan; }
};

} // namespace ramus::test
