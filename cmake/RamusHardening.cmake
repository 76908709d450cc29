# What a compiler and a linker can do so that a defect is not somebody's way in: overrun stacks and buffers end the
# program, calls and returns go where they should (on processors that look), and the tables of the linker cannot be
# written. tests/install/hardened_test.py looks whether each program has it. Sanitizers watch all this, and more, by
# themselves.

# Libraries are looked for where the system has them, and nowhere else. CMake would add the folders of libraries that it
# was told, and, worse, an empty entry, which is the folder that the program is started in.
set(CMAKE_SKIP_RPATH ON)

include(CheckPIESupported)
check_pie_supported() # without it, CMake compiles for position independence and does not link for it

if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize=")
  add_compile_options(-fstack-protector-strong -fstack-clash-protection)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    add_compile_options(-fcf-protection)
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
    add_compile_options(-mbranch-protection=standard)
  endif()
  # Takes an optimizer, which knows the sizes of things. Some compilers define it themselves, to less.
  add_compile_options("$<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=3>")
  add_link_options(-Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)
endif()
