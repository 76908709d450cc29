#include "app/workspace/context_reader.h"

#include <filesystem>
#include <utility>

namespace ramus::app {

std::optional<Error> ContextReader::take_error() {
    if (errors_.empty()) return {};
    Error error = std::move(errors_.front());
    errors_.pop_front();
    return error;
}

void ContextReader::start(const ContextSource& source) {
    current_ = source;
    worker_.start("Reading " + std::filesystem::path(source.file).filename().string(),
                  [this, source](Job& job, const Worker::Post& post) {
                      auto shape = read_context_shape(source, nullptr, job);
                      if (job.cancelled()) return;
                      post([this, read = Read{source, std::move(shape)}] { read_.push_back(read); });
                  });
}

bool ContextReader::update(const std::vector<ContextItem>& context, Assets& assets) {
    worker_.drain();
    for (Read& read : read_) {
        if (!read.shape.value) errors_.push_back(read.shape.value.error());
        assets.put(read.source, std::move(read.shape));
        came_ = true;
    }
    read_.clear();
    if (const std::string failure = worker_.take_failure(); !failure.empty()) {
        errors_.push_back({"the file could not be read: " + failure, current_.file, ""});
        given_up_.insert(current_);
        came_ = true;
    }
    for (const ContextItem& item : context) {
        if (worker_.busy()) break;
        const ContextSource source = source_of(item);
        if (item.visible && !given_up_.contains(source) && !assets.context_shapes.contains(source)) start(source);
    }
    working_ = worker_.busy();
    return std::exchange(came_, false);
}

void ContextReader::cancel() {
    if (worker_.busy()) given_up_.insert(current_);
    worker_.cancel();
    came_ = true;
}

void ContextReader::forget() {
    worker_.cancel();
    read_.clear();
    errors_.clear();
    given_up_.clear();
}

} // namespace ramus::app
