// CastPass: has the caster make pictures, at once or on a thread of its own. What is shown stays as it is meanwhile,
// and says what lies under its pixels. Beside sending pictures it uses no GL.
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
    // A picture that was made, and what it is of.
    struct Made {
        Frame frame;
        std::vector<Layer> layers;
        ViewSetup view;
        std::uint64_t cones = 0;
        double seconds = 0.0; // that it took, by the clock
    };

    // The picture of the subject, which is shown from now on. `records`: of the branches, made for this. Returns the
    // number of cones. What is on its way is dropped.
    std::uint64_t draw(const Subject& subject, const ViewSetup& view, BranchRecords& records);
    // The same on a thread of its own.
    void begin(const Subject& subject, const ViewSetup& view, BranchRecords& records);
    [[nodiscard]] bool busy() const { return work_ != nullptr; } // a picture is on its way
    // Waits for it, so many seconds at most: it is shown from now on. Throws std::bad_alloc where its making did.
    [[nodiscard]] std::optional<Made> take(double seconds);
    void forget(); // nobody wants what is on its way

    void send_picture(const PictureTarget& to) const;
    void send_depths(const PictureTarget& picture, const ResolvedTarget& to) const; // for what is drawn over it
    // Likewise: who is at its pixels, as a texture of ids. Throws OutOfGraphicsMemory.
    void send_ids(const PictureTarget& picture);
    [[nodiscard]] GLuint ids() const { return ids_texture_; }
    [[nodiscard]] const caster::Caster& caster() const { return casters_.at(shown_); }

private:
    struct Work;
    [[nodiscard]] static std::shared_ptr<Work> prepare(const Subject& subject, const ViewSetup& view,
                                                       BranchRecords& records);
    static void make(Work& work, caster::Caster& caster, const std::shared_ptr<const caster::FittedCones>& known);
    [[nodiscard]] caster::Caster& other() { return casters_.at(1 - shown_); }

    std::array<caster::Caster, 2> casters_; // what is shown is one's, what is made the other's
    std::size_t shown_ = 0;
    Texture ids_texture_; // R32UI, 4 bytes: made when it is needed
    glm::ivec2 ids_size_{0};
    std::shared_ptr<Work> work_;     // on its way; null: nothing is
    std::unique_ptr<Worker> worker_; // null: none yet. The last: its thread ends first
};

} // namespace ramus::render
