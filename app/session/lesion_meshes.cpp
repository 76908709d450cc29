#include "app/session/lesion_meshes.h"

#include "core/io/mesh_reader.h"

#include <map>
#include <mutex>
#include <system_error>

namespace ramus::app {

Result<std::shared_ptr<const LesionMesh>> lesion_mesh(const std::filesystem::path& path) {
    struct Known {
        std::filesystem::file_time_type written;
        std::uintmax_t bytes = 0;
        Result<std::shared_ptr<const LesionMesh>> mesh;
    };
    static std::mutex mutex;
    static std::map<std::filesystem::path, Known> known;

    std::error_code error;
    const auto written = std::filesystem::last_write_time(path, error);
    const auto bytes = error ? std::uintmax_t{0} : std::filesystem::file_size(path, error);
    const std::lock_guard lock(mutex);
    if (error) {
        known.erase(path);
        return fail("the lesion cannot be read: " + error.message(), path.string(), "check the name and the folder");
    }
    const auto found = known.find(path);
    if (found != known.end() && found->second.written == written && found->second.bytes == bytes)
        return found->second.mesh;
    Known now{written, bytes, std::shared_ptr<const LesionMesh>()};
    if (auto mesh = io::read_mesh(path)) {
        auto distance = std::make_shared<const measure::MeshDistance>(*mesh);
        now.mesh = std::make_shared<const LesionMesh>(LesionMesh{std::move(*mesh), std::move(distance)});
    } else {
        now.mesh = tl::unexpected(mesh.error());
    }
    return known.insert_or_assign(path, std::move(now)).first->second.mesh;
}

} // namespace ramus::app
