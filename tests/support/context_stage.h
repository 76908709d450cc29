// A tree that forks, and files to show next to it: balls and a mask of two blocks.
#pragma once

#include "app/picture/compose.h"
#include "app/storage/opening_files.h"
#include "app/workspace/workspace.h"
#include "core/io/meshes/mesh_file.h"
#include "tests/support/command_stage.h"
#include "tests/support/icosphere.h"
#include "tests/support/nifti_file.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <string>
#include <vector>

namespace ramus::test {

inline constexpr const char* kContextTree =
    "# id type x y z radius parent (mm, RAS)\n1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n";

struct ContextStage {
    TemporaryFolder folder;
    std::filesystem::path tree = folder.write("fork.swc", kContextTree);
    CommandStage commands{io::read_tree(tree).value()};
    [[nodiscard]] std::string ball(const std::string& name, glm::dvec3 centre = {0, 0, 15}, int level = 3) const {
        auto mesh = icosphere(level, centre, 12.0);
        mesh.radii.resize(mesh.positions.size(), 1.0F);
        mesh.branches.resize(mesh.positions.size(), 0);
        io::MeshNames nothing; // is said of it
        nothing.claims = {tree::SaidBy::kNobody, tree::SaidBy::kNobody};
        REQUIRE(io::write_mesh(mesh, folder.path() / name, nothing));
        return (folder.path() / name).string();
    }
    // Two blocks: label 1 from x = 0 to 4 mm, label 2 from 10 to 18.
    [[nodiscard]] std::string mask(const std::string& name) const {
        NiftiFile file;
        file.dim = {3, 10, 4, 6, 1, 1, 1, 1};
        file.rows = {2, 0, 0, 1, 0, 1, 0, 0, 0, 0, 3, 0}; // voxels of 2 x 1 x 3 mm, the first one's middle at x = 1
        std::vector<std::uint8_t> values;
        for (int k = 0; k < 6; ++k)
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 10; ++i) values.push_back(i < 2 ? 1 : i >= 5 && i < 9 ? 2 : 0);
        file.put(values);
        return write_plain(folder.path() / name, file.bytes()).string();
    }
    [[nodiscard]] const std::vector<app::ContextItem>& context() const { return commands.marks().context; }
    std::vector<render::ContextMesh> drawn() {
        return app::compose(commands.document.session(), commands.current_assets(), nullptr, {}).context;
    }
};

inline std::vector<render::ContextMesh> drawn(app::Workspace& workspace) {
    return app::compose(workspace.document().session(), workspace.current_assets(), nullptr, {}).context;
}

} // namespace ramus::test
