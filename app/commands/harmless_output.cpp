#include "app/commands/harmless_output.h"

#include "core/base/printable.h"

#include <iostream>
#include <streambuf>
#include <string>

namespace ramus::app {

// Passes on whole lines, so that no multi-byte character is divided. A flush passes on the incomplete line.
class HarmlessOutput::Stream final : public std::streambuf {
public:
    explicit Stream(std::ostream& stream) : stream_(stream), behind_(stream.rdbuf(this)) {}
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream() override {
        Stream::sync();
        stream_.rdbuf(behind_);
    }

private:
    int_type overflow(int_type character) override {
        if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
        const char one = traits_type::to_char_type(character);
        return xsputn(&one, 1) == 1 ? character : traits_type::eof();
    }
    std::streamsize xsputn(const char* text, std::streamsize count) override {
        line_.append(text, static_cast<std::size_t>(count));
        const std::size_t end = line_.rfind('\n');
        if (end == std::string::npos) return count;
        const bool handed_on = hand_on(std::string_view(line_).substr(0, end + 1));
        line_.erase(0, end + 1);
        return handed_on ? count : 0;
    }
    int sync() override {
        const bool handed_on = hand_on(line_);
        line_.clear();
        return handed_on && behind_->pubsync() == 0 ? 0 : -1;
    }
    bool hand_on(std::string_view text) {
        const std::string harmless = printable_lines(text);
        const auto count = static_cast<std::streamsize>(harmless.size());
        return behind_->sputn(harmless.data(), count) == count;
    }

    std::ostream& stream_;
    std::streambuf* behind_;
    std::string line_;
};

HarmlessOutput::HarmlessOutput()
    : output_(std::make_unique<Stream>(std::cout)), errors_(std::make_unique<Stream>(std::cerr)) {}
HarmlessOutput::~HarmlessOutput() = default;

} // namespace ramus::app
