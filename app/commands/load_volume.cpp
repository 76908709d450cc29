#include "app/commands/load_volume.h"

#include "app/commands/interrupt.h"
#include "app/commands/load_tree.h"
#include "app/commands/progress_bar.h"
#include "core/io/volumes/volume_file.h"

namespace ramus::app {

Result<volume::Volume> load_volume(const std::string& file, const SurfaceFlags& flags) {
    Job job;
    auto read = [&] {
        const CancelOnInterrupt cancel(job);
        const ProgressBar bar("reading", job);
        return io::read_volume(file, {static_cast<double>(flags.surface.memory_bytes)}, job);
    }();
    if (job.cancelled()) return fail("cancelled");
    if (!read) return read;
    say(flags, file + ": " + read->type + ", " + std::to_string(read->size.x) + " x " + std::to_string(read->size.y) +
                   " x " + std::to_string(read->size.z) + " voxels");
    for (const std::string& note : read->notes) say(flags, file + ": " + note);
    return read;
}

} // namespace ramus::app
