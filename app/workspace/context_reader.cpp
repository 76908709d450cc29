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

void ContextReader::start(const ContextSource& source, std::optional<std::vector<std::string>> arguments) {
    current_ = source;
    worker_.start("Reading " + std::filesystem::path(source.file).filename().string(),
                  [this, source, arguments = std::move(arguments)](Job& job, const Worker::Post& post) {
                      const auto shape = context_shape(source, job);
                      if (job.cancelled()) return;
                      post([this, arguments, shape] {
                          came_ = true;
                          if (arguments)
                              ready_.push_back(*arguments); // the command says what is wrong
                          else if (!shape)
                              errors_.push_back(shape.error());
                      });
                  });
}

bool ContextReader::update(const std::vector<ContextItem>& context) {
    worker_.drain();
    if (const std::string failure = worker_.take_failure(); !failure.empty()) {
        errors_.push_back({"the file could not be read: " + failure, current_.file, ""});
        given_up_.insert(current_);
        came_ = true;
    }
    if (!worker_.busy() && !asked_.empty()) {
        const Asked next = std::move(asked_.front());
        asked_.pop_front();
        start(next.source, next.arguments);
    }
    for (const ContextItem& item : context) {
        if (worker_.busy()) break;
        const ContextSource source = source_of(item);
        if (item.visible && !given_up_.contains(source) && !context_shape_read_before(source) &&
            !context_trouble(source))
            start(source, std::nullopt);
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
    ready_.clear();
    errors_.clear();
    given_up_.clear();
}

} // namespace ramus::app
