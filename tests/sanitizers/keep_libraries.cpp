// Linked to the programs of a sanitized build, in the place of the C library's: a library that is loaded stays loaded.
// Mesa's driver is unloaded when the window closes, and what leaks are looked for by at the end goes with it: the data
// that still hold memory, so that it counts as lost, and the names by which leaks.txt knows whose a leak is.
#include <dlfcn.h>

extern "C" int dlclose(void* /*library*/) noexcept { return 0; }
