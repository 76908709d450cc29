#include "app/workspace/context_reader.h"

#include <filesystem>
#include <utility>

namespace ramus::app {

void ContextReader::read(const ContextSource& source, std::vector<std::string> arguments) {
    asked_.push_back({source, std::move(arguments)});
}

std::optional<std::vector<std::string>> ContextReader::take_ready() {
    if (ready_.empty()) return {};
    std::vector<std::string> arguments = std::move(ready_.front());
    ready_.pop_front();
    return arguments;
}

std::optional<Error> ContextReader::take_error() {
    if (errors_.empty()) return {};
    Error error = std::move(errors_.front());
    errors_.pop_front();
    return error;
}

void ContextReader::start(const ContextSource& source, std::optional<std::vector<std::string>> arguments,
                          const Assets& assets) {
    current_ = source;
    const auto known = assets.context_shapes.find(source);
    std::optional<Loaded<ContextShape>> before;
    if (known != assets.context_shapes.end()) before = known->second;
    worker_.start("Reading " + std::filesystem::path(source.file).filename().string(),
                  [this, source, before, arguments = std::move(arguments)](Job& job, const Worker::Post& post) {
                      auto shape = read_context_shape(source, before ? &*before : nullptr, job);
                      if (job.cancelled()) return;
                      post([this, read = Read{source, arguments, std::move(shape)}] { read_.push_back(read); });
                  });
}

bool ContextReader::update(const std::vector<ContextItem>& context, Assets& assets) {
    worker_.drain();
    for (Read& read : read_) {
        if (read.arguments)
            ready_.push_back(std::move(*read.arguments)); // the command says what is wrong
        else if (!read.shape.value)
            errors_.push_back(read.shape.value.error());
        assets.put(read.source, std::move(read.shape));
        came_ = true;
    }
    read_.clear();
    if (const std::string failure = worker_.take_failure(); !failure.empty()) {
        errors_.push_back({"the file could not be read: " + failure, current_.file, ""});
        given_up_.insert(current_);
        came_ = true;
    }
    if (!worker_.busy() && !asked_.empty()) {
        const Asked next = std::move(asked_.front());
        asked_.pop_front();
        start(next.source, next.arguments, assets);
    }
    for (const ContextItem& item : context) {
        if (worker_.busy()) break;
        const ContextSource source = source_of(item);
        if (item.visible && !given_up_.contains(source) && !assets.context_shapes.contains(source))
            start(source, std::nullopt, assets);
    }
    working_ = worker_.busy();
    return std::exchange(came_, false);
}

void ContextReader::cancel() {
    if (worker_.busy()) given_up_.insert(current_);
    worker_.cancel();
    asked_.clear();
    came_ = true;
}

void ContextReader::forget() {
    worker_.cancel();
    asked_.clear();
    read_.clear();
    ready_.clear();
    errors_.clear();
    given_up_.clear();
}

} // namespace ramus::app
