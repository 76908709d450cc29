#include "app/actions/script.h"
#include "app/assets/assets.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;

namespace {

class TestHost final : public PictureHost, public Clipboard {
public:
    [[nodiscard]] glm::ivec2 picture_size() const override { return {400, 300}; }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override { return nullptr; }
    Result<void> write_picture(const std::filesystem::path&) override { return {}; }
    void camera_leapt() override { ++moves; }
    void copy_text(const std::string& text) override { clipboard = text; }
    [[nodiscard]] Result<std::string> pasted_text() const override { return clipboard; }
    std::string clipboard;
    int moves = 0;
};

struct CameraTextStage {
    Document document;
    TestHost host;
    Assets assets;
    ActionContext context{.document = document, .picture = host, .assets = assets, .clipboard = &host};
    Result<void> run(std::string_view text) {
        const auto lines = parse_script(text, "c");
        return lines ? run_script(context, *lines, "c") : tl::unexpected(lines.error());
    }
    [[nodiscard]] const render::Camera& camera() const { return document.session().camera; }
};

render::Camera odd_camera() {
    render::Camera camera;
    camera.position = {0.1, -500.0 / 3.0, 7e-5};
    camera.focal_point = {1.0, 2.0, 3.0};
    camera.view_angle = 17.25;
    camera.orthographic = true;
    camera.scale = 33.3;
    return camera;
}

} // namespace

TEST_CASE("a camera is copied to the clipboard and back without loss") {
    CameraTextStage stage;
    stage.document.set_camera(odd_camera());
    REQUIRE(stage.run("camera-copy"));
    CHECK(nlohmann::json::parse(stage.host.clipboard) == render::to_json(odd_camera()));
    stage.document.set_camera({});
    REQUIRE(stage.run("camera-paste"));
    CHECK(stage.camera() == odd_camera());
    CHECK(stage.host.moves == 1);
    CHECK_FALSE(stage.document.can_undo());
}

TEST_CASE("a copied camera can be used as a line of a commands file and as a camera file") {
    const TemporaryFolder folder;
    CameraTextStage stage;
    stage.document.set_camera(odd_camera());
    REQUIRE(stage.run("camera-copy"));
    stage.document.set_camera({});
    REQUIRE(stage.run("camera " + stage.host.clipboard + " # as it was copied"));
    CHECK(stage.camera() == odd_camera());
    stage.document.set_camera({});
    const auto file = folder.path() / "camera.json";
    std::ofstream(file) << stage.host.clipboard << '\n';
    REQUIRE(stage.run("camera " + file.string()));
    CHECK(stage.camera() == odd_camera());
    const auto braces = parse_script(R"(camera {"a": "}\"{", "b": {"c": 1}} x)", "c");
    REQUIRE(braces);
    CHECK(braces->front().words == std::vector<std::string>{"camera", R"({"a": "}\"{", "b": {"c": 1}})", "x"});
}

TEST_CASE("text that is not a camera is refused, and the camera stays") {
    CameraTextStage stage;
    stage.document.set_camera(odd_camera());
    const auto refusal = [&](const std::string& line) {
        const auto done = stage.run(line);
        REQUIRE_FALSE(done);
        CHECK(stage.camera() == odd_camera());
        CHECK(stage.host.moves == 0);
        return done.error().message();
    };
    CHECK(refusal("camera").find("camera takes JSON") != std::string::npos);
    CHECK(refusal("camera {\"position\": [0, 0, 1]").find("a brace is not closed") != std::string::npos);
    CHECK(refusal("camera {\"position\": [0, 0]}").find("position") != std::string::npos);
    CHECK(refusal("camera {\"mood\": 1}").find("mood") != std::string::npos);
    CHECK(refusal("camera /nowhere/camera.json").find("/nowhere/camera.json") != std::string::npos);
    for (const char* text : {"hello", "{}{}", "[1, 2]", "{\"view_angle\": 400}"}) {
        stage.host.clipboard = text;
        CHECK(refusal("camera-paste").find("clipboard") != std::string::npos);
    }
}
