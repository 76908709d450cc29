#include "app/session/lesion_meshes.h"

#include "core/io/mesh_reader.h"

#include <map>
#include <mutex>
#include <system_error>

namespace ramus::app {

namespace {

struct Known {
    std::filesystem::file_time_type written;
    std::uintmax_t bytes = 0;
    Result<std::shared_ptr<const LesionMesh>> mesh;
};

// Reading goes on outside of the lock: two threads that want the same mesh at once both read it.
struct Kept {
    std::mutex mutex;
    std::map<std::filesystem::path, Known> meshes;
};

Kept& kept() {
    static Kept all;
    return all;
}

} // namespace

Result<std::shared_ptr<const LesionMesh>> lesion_mesh(const std::filesystem::path& path) {
    std::error_code error;
    const auto written = std::filesystem::last_write_time(path, error);
    const auto bytes = error ? std::uintmax_t{0} : std::filesystem::file_size(path, error);
    {
        const std::lock_guard lock(kept().mutex);
        if (error) {
            kept().meshes.erase(path);
            return fail("the lesion cannot be read: " + error.message(), path.string(),
                        "check the name and the folder");
        }
        const auto found = kept().meshes.find(path);
        if (found != kept().meshes.end() && found->second.written == written && found->second.bytes == bytes)
            return found->second.mesh;
    }
    Known now{written, bytes, std::shared_ptr<const LesionMesh>()};
    if (auto mesh = io::read_mesh(path)) {
        auto distance = std::make_shared<const measure::MeshDistance>(*mesh);
        now.mesh = std::make_shared<const LesionMesh>(LesionMesh{std::move(*mesh), std::move(distance)});
    } else {
        now.mesh = tl::unexpected(mesh.error());
    }
    const std::lock_guard lock(kept().mutex);
    return kept().meshes.insert_or_assign(path, std::move(now)).first->second.mesh;
}

std::shared_ptr<const LesionMesh> lesion_mesh_read_before(const std::filesystem::path& path) {
    const std::lock_guard lock(kept().mutex);
    const auto found = kept().meshes.find(path);
    return found != kept().meshes.end() && found->second.mesh ? *found->second.mesh : nullptr;
}

} // namespace ramus::app
