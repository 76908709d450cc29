// CastPass: lets the caster draw pictures, synchronously or on a worker thread. The shown picture stays valid meanwhile
// and answers picks. Uses GL only to send pictures.
#pragma once

#include "core/base/worker.h"
#include "render/caster/caster.h"
#include "render/renderer/passes/shade_pass.h"
#include "render/renderer/targets.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::render {

class CastPass {
public:
    // A finished picture, with its inputs.
    struct Made {
        Frame frame;
        std::vector<Layer> layers;
        ViewSetup view;
        std::uint64_t cones = 0;
        double seconds = 0.0; // elapsed time
    };

    // Draws the picture of the subject and shows it. `records`: of the branches, updated here. Drops a picture in
    // progress. Returns the number of cones.
    std::uint64_t draw(const Subject& subject, const ViewSetup& view, BranchRecords& records);
    // The same on the worker thread.
    void begin(const Subject& subject, const ViewSetup& view, BranchRecords& records);
    [[nodiscard]] bool busy() const { return work_ != nullptr; } // a picture is in progress
    // Waits at most `seconds` for the picture in progress; shows and returns it. Rethrows std::bad_alloc of the worker.
    [[nodiscard]] std::optional<Made> take(double seconds);
    void forget(); // drops the picture in progress

    void send_picture(const PictureTarget& to) const;
    void send_depths(const PictureTarget& picture, const ResolvedTarget& to) const; // for overlays with depth
    // Sends the ids at the picture's pixels as a texture. Throws OutOfGraphicsMemory.
    void send_ids(const PictureTarget& picture);
    [[nodiscard]] GLuint ids() const { return ids_texture_; }
    [[nodiscard]] const caster::Caster& caster() const { return casters_.at(shown_); }

private:
    struct Work;
    [[nodiscard]] static std::shared_ptr<Work> prepare(const Subject& subject, const ViewSetup& view,
                                                       BranchRecords& records);
    static void make(Work& work, caster::Caster& caster, const std::shared_ptr<const caster::FittedCones>& known);
    [[nodiscard]] caster::Caster& other() { return casters_.at(1 - shown_); }

    std::array<caster::Caster, 2> casters_; // one has the shown picture, the other draws the next
    std::size_t shown_ = 0;
    Texture ids_texture_; // R32UI, 4 bytes per pixel; created on first use
    glm::ivec2 ids_size_{0};
    std::shared_ptr<Work> work_;     // in progress; null: nothing
    std::unique_ptr<Worker> worker_; // null: none yet. Declared last, so that its thread ends first
};

} // namespace ramus::render
