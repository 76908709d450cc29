#include "core/io/recognise.h"

#include "core/io/meshes/mesh_file.h"
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/byte_stage.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

namespace ramus::io {

namespace {

// Calls visit(format, recognised) for all formats of trees and meshes that can be read, and for all formats of volumes.
template <class Visit> void for_each_known(const Visit& visit) {
    for (const TreeFormat& format : tree_formats())
        if (is_read(format)) visit(format, Recognised{&format, nullptr, nullptr, false});
    for (const VolumeFormat& format : volume_formats()) visit(format, Recognised{nullptr, &format, nullptr, false});
    for (const MeshFormat& format : mesh_formats())
        if (is_read(format)) visit(format, Recognised{nullptr, nullptr, &format, false});
}

// Adds the formats of `as` to `found` where it has none of that kind.
void add(Recognised& found, const Recognised& as) {
    if (found.tree == nullptr) found.tree = as.tree;
    if (found.volume == nullptr) found.volume = as.volume;
    if (found.mesh == nullptr) found.mesh = as.mesh;
}

Recognised by_content(std::string_view head, Certainty certainty) {
    Recognised found;
    decltype(FileFormat::has_signature) signature = nullptr;
    for_each_known([&](const FileFormat& format, const Recognised& as) {
        if (format.has_signature == nullptr || format.certainty != certainty) return;
        if (signature == nullptr && format.has_signature(head)) signature = format.has_signature;
        if (signature != nullptr && format.has_signature == signature) add(found, as), found.by_content = true;
    });
    return found;
}

// The longest extension wins: ".mrk.json" over ".json".
Recognised by_name(const std::filesystem::path& name) {
    const std::filesystem::path plain = without_gz(name);
    Recognised found;
    std::size_t longest = 0;
    for_each_known([&](const FileFormat& format, const Recognised& as) {
        const std::size_t length = extension_length(plain, format);
        if (length > longest) found = {}, longest = length;
        if (length > 0 && length == longest) add(found, as);
    });
    return found;
}

Recognised folder_at(const std::filesystem::path& path) {
    for (const VolumeFormat& format : volume_formats())
        if (format.is_folder != nullptr && format.is_folder(path)) return {nullptr, &format, nullptr, true};
    return {};
}

// The first bytes, uncompressed. Empty: the stage cannot be read.
std::string head_from(std::unique_ptr<ByteStage> stage) {
    std::string head(kHeadBytes, '\0');
    head.resize(stage->read(head.data(), head.size()).value_or(0));
    if (!head.starts_with("\x1f\x8b")) return head;
    stage = inflate_stage(std::move(head), std::move(stage));
    head.assign(kHeadBytes, '\0');
    head.resize(stage->read(head.data(), head.size()).value_or(0));
    return head;
}

} // namespace

std::string head_of(const std::filesystem::path& path) {
    auto stage = file_stage(path);
    return stage ? head_from(std::move(*stage)) : std::string();
}

Recognised recognised(std::string_view head, const std::filesystem::path& name) {
    head = head.substr(0, kHeadBytes);
    for (const Certainty certainty : {Certainty::kMark, Certainty::kHeader})
        if (const Recognised found = by_content(head, certainty)) return found;
    if (const Recognised found = by_name(name)) return found;
    return by_content(head, Certainty::kLikeness);
}

Recognised recognised_alone(std::string_view bytes) { return recognised(head_from(memory_stage(bytes)), {}); }

Recognised recognised(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) return folder_at(path);
    if (!std::filesystem::is_regular_file(path, error)) return by_name(path);
    return recognised(head_of(path), path);
}

std::vector<const FileFormat*> recognition_order() {
    std::vector<const FileFormat*> order;
    for (const Certainty certainty : {Certainty::kMark, Certainty::kHeader, Certainty::kLikeness})
        for_each_known([&](const FileFormat& format, const Recognised&) {
            if (format.certainty == certainty && format.has_signature != nullptr &&
                std::ranges::find(order, format.has_signature, &FileFormat::has_signature) == order.end())
                order.push_back(&format);
        });
    return order;
}

} // namespace ramus::io
