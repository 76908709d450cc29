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
                      if (!job.cancelled()) post([this, shape = std::move(shape)] { read_ = shape; });
                  });
}

bool ContextReader::update(const std::vector<ContextItem>& context, Assets& assets) {
    worker_.drain();
    if (auto read = std::exchange(read_, std::nullopt)) {
        if (!read->value) errors_.push_back(read->value.error());
        assets.put(current_, std::move(*read));
        came_ = true;
    }
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
    errors_.clear();
    given_up_.clear();
    read_.reset();
}

} // namespace ramus::app
