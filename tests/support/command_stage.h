// A document in the hands of a commands file, as tests drive it: run lines, look at the marks, read what was said.
#pragma once

#include "app/actions/script.h"
#include "app/assets/assets.h"

#include <doctest/doctest.h>
#include <memory>
#include <string>
#include <vector>

namespace ramus::test {

class TestPicture final : public app::PictureHost {
public:
    [[nodiscard]] glm::ivec2 picture_size() const override { return {400, 300}; }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override { return nullptr; }
    Result<void> write_picture(const std::filesystem::path&) override { return {}; }
    Result<render::Image> draw_picture(const render::Camera& camera, glm::ivec2 size) override {
        cameras.push_back(camera);
        return render::Image(size.x / 10, size.y / 10);
    }
    std::vector<render::Camera> cameras;
};

struct CommandStage {
    explicit CommandStage(tree::VesselTree tree, app::Session session = {}) {
        document.open(std::make_shared<const tree::VesselTree>(std::move(tree)), std::move(session));
    }
    app::Document document;
    TestPicture host;
    app::Assets assets;
    std::string said; // last
    app::ActionContext context{.document = document,
                               .picture = host,
                               .assets = assets,
                               .tell = [this](const std::string& sentence) { said = sentence; }};

    Result<void> run(const std::string& text) {
        const auto lines = app::parse_script(text, "c.txt");
        return lines ? app::run_script(context, *lines, "c.txt") : tl::unexpected(lines.error());
    }
    std::string good(const std::string& text) { // what was said
        said.clear();
        const auto done = run(text);
        REQUIRE_MESSAGE(done, (done ? "" : done.error().message()));
        return said;
    }
    std::string bad(const std::string& text) { // why not; nothing changes
        const app::Marks before = document.marks();
        const auto done = run(text);
        REQUIRE_FALSE_MESSAGE(done, text);
        CHECK(document.marks() == before);
        return done.error().message();
    }
    [[nodiscard]] const app::Marks& marks() const { return document.marks(); }
    // What belongs to the document as it is now.
    const app::Assets& current_assets() {
        app::complete_lesions(assets, document);
        return assets;
    }
    std::shared_ptr<const app::Plan> plan() { return current_assets().plan; }
};

} // namespace ramus::test
