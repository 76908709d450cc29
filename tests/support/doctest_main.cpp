// The main function of every test program.
#include "core/base/own_process.h"

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

int main(int argument_count, char** arguments) {
#ifdef __SANITIZE_ADDRESS__
    // A fork beside other threads leaves the child an allocator of the sanitizer that one of them holds locked.
    ramus::start_fork_server();
#endif
    doctest::Context context(argument_count, arguments);
    return context.run();
}
