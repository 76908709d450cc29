#include "app/picture/video_file.h"

#include "core/io/input_file.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

namespace ramus::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kVideoProgram = "ffmpeg";
constexpr const char* kVideoName = "video.mp4";

} // namespace

bool is_video(const fs::path& path) { return io::lower_case(path.extension().string()) == ".mp4"; }

bool can_make_videos() { return !find_program(kVideoProgram).empty(); }

Result<VideoFile> VideoFile::create(const fs::path& target, glm::ivec2 size, int frames_a_second) {
    if (!can_make_videos())
        return fail(kNoVideos, target.string(), "apt install ffmpeg, or write pictures: give the name .png");
    if (auto possible = io::check_output(target); !possible) return tl::unexpected(possible.error());
    RAMUS_TRY(scratch, ScratchFolder::create());
    const std::string sides = std::to_string(size.x) + "x" + std::to_string(size.y);
    RAMUS_TRY(ffmpeg, ChildProgram::start({kVideoProgram, "-nostdin",
                                           "-loglevel",   "error",
                                           "-f",          "rawvideo",
                                           "-pix_fmt",    "rgba",
                                           "-s",          sides,
                                           "-r",          std::to_string(frames_a_second),
                                           "-i",          "pipe:0",
                                           "-vf",         "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                           "-c:v",        "libx264",
                                           "-crf",        "18",
                                           "-pix_fmt",    "yuv420p",
                                           "-movflags",   "+faststart",
                                           "-y",          (scratch.path() / kVideoName).string()}));
    return VideoFile(target, size, std::move(scratch), std::move(ffmpeg));
}

Result<void> VideoFile::add(const render::Image& image) {
    if (glm::ivec2(image.width, image.height) != size_) return fail("pictures of a video have one size");
    const auto* const bytes = reinterpret_cast<const char*>(image.rgba.data()); // matches ffmpeg's arguments
    if (ffmpeg_.write({bytes, image.rgba.size()})) return {};
    Job job;
    auto ended = ffmpeg_.wait(job); // ffmpeg says why
    return ended ? fail("ffmpeg ended before the last picture", target_.string())
                 : fail("ffmpeg: " + ended.error().what, target_.string());
}

Result<void> VideoFile::commit(Job& job) {
    if (auto ended = ffmpeg_.wait(job); !ended)
        return job.cancelled() ? ended : fail("ffmpeg: " + ended.error().what, target_.string());
    return io::write_copy(scratch_.path() / kVideoName, target_);
}

} // namespace ramus::app
