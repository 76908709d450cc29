#include "app/commands/run_chosen.h"

#include "app/commands/harmless_output.h"
#include "app/commands/picture_flags.h"
#include "app/commands/progress.h"
#include "app/commands/surface_flags.h"
#include "core/base/printable.h"
#include "core/io/standard_input.h"

#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

namespace ramus::app {

int complain(const std::string& message) {
    std::cerr << "ramus: " << printable(message) << '\n';
    return kFailed;
}

int run_caught(const std::function<int()>& program, const std::string& needs_less) {
    const HarmlessOutput harmless;
    try {
        return program();
    } catch (const std::bad_alloc&) {
        return complain("not enough memory; " + needs_less);
    } catch (const std::exception& error) {
        return complain(error.what());
    }
}

int run_chosen(const Action& chosen) {
    handle_interrupts(); // for commands only: the window handles closing itself
    if (reads_standard_input())
        if (const auto settled = io::settle_standard_input(); !settled) return complain(settled.error().message());
    const Result<int> status = chosen();
    if (!status) {
        Error error = status.error();
        if (error.where == io::kStandardInputPath) error.where = io::input_name(error.where);
        return complain(error.message());
    }
    // A full disk behind a redirection is detected here at the latest.
    if (!std::cout.flush() || std::fflush(stdout) != 0) return complain("standard output cannot be written");
    return *status;
}

} // namespace ramus::app
