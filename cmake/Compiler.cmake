# What the compiler warns of, and what it builds in to find faults. Apart from CMakeLists.txt so that the tests of the
# checks (tests/checks) compile their faults just as the repository is compiled.
include_guard()

option(DERMIS_FUZZ "Build the libFuzzer targets (needs clang)" OFF)
option(DERMIS_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)

# Two warnings of GCC 12 are wrong for std::string concatenation (GCC bug 105651); clang's build finds the real ones.
set(DERMIS_WARNINGS -Wall -Wextra -Wshadow -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND DERMIS_WARNINGS -Wno-restrict -Wno-array-bounds)
endif()

if(DERMIS_SANITIZE)
    add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
endif()
if(DERMIS_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link)  # libFuzzer sees the libraries' branches, not the target's only
endif()
