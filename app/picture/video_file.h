// VideoFile: encodes pictures as H.264 in MP4 with ffmpeg, which must be installed. The file is complete or absent.
#pragma once

#include "core/base/child_program.h"
#include "core/base/scratch_folder.h"
#include "render/image/image.h"

#include <filesystem>

namespace ramus::app {

[[nodiscard]] bool is_video(const std::filesystem::path& path); // by its extension
// Whether ffmpeg is installed; checked at every call.
[[nodiscard]] bool can_make_videos();
inline constexpr const char* kNoVideos = "ffmpeg is not installed; it makes the videos";

class VideoFile {
public:
    // `size`: of the pictures. Odd sides get a row or column of black, since the format needs even ones.
    [[nodiscard]] static Result<VideoFile> create(const std::filesystem::path& target, glm::ivec2 size,
                                                  int frames_a_second);
    [[nodiscard]] Result<void> add(const render::Image& image); // opaque
    // Finishes the file and moves it to its place.
    [[nodiscard]] Result<void> commit(Job& job);

private:
    VideoFile(std::filesystem::path target, glm::ivec2 size, ScratchFolder scratch, ChildProgram ffmpeg)
        : target_(std::move(target)), size_(size), scratch_(std::move(scratch)), ffmpeg_(std::move(ffmpeg)) {}
    std::filesystem::path target_;
    glm::ivec2 size_;
    ScratchFolder scratch_;
    ChildProgram ffmpeg_;
};

} // namespace ramus::app
