// TreeLoader: reads a tree on a worker, and makes its first surface there. For one thread, its owner's, which takes
// what came after update(). Whatever the loader is asked for last counts; what it was at before is dropped.
#pragma once

#include "app/workspace/loaded_tree.h"
#include "core/base/worker.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace ramus::app {

class TreeLoader {
public:
    using Read = std::function<Result<LoadedTree>(Job&)>;
    struct Arrival {
        std::filesystem::path path; // as it was asked for: a session's own name
        LoadedTree tree;
    };

    explicit TreeLoader(std::function<void()> wake) : worker_(std::move(wake)) {}

    void start(const std::filesystem::path& path, Read read);
    void cancel();
    void update();

    // Each once.
    [[nodiscard]] std::optional<Arrival> take_arrival() { return std::exchange(arrival_, std::nullopt); }
    [[nodiscard]] std::optional<Error> take_error() { return std::exchange(error_, std::nullopt); }
    // Of what arrived last, once it is made; the loader is busy until then.
    [[nodiscard]] std::optional<ReadySurface> take_first_surface() { return std::exchange(first_, std::nullopt); }

    [[nodiscard]] const Worker& worker() const { return worker_; }
    [[nodiscard]] std::string take_failure() { return worker_.take_failure(); }

private:
    void work(const std::filesystem::path& path, const Read& read, Job& job, const Worker::Post& post);

    std::optional<Arrival> arrival_;
    std::optional<ReadySurface> first_;
    std::optional<Error> error_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
