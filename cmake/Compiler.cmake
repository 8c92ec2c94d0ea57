# What the compiler warns of, and what it builds in to find faults. Apart from CMakeLists.txt so that the tests of the
# checks (tests/checks) compile their faults just as the repository is compiled.
include_guard()

option(DERMIS_FUZZ "Build the libFuzzer targets (needs clang)" OFF)
option(DERMIS_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(DERMIS_WARNINGS_ONLY "Every file is read for its warnings, no code is made: a seventh of the time (needs clang)" OFF)

# Four warnings of GCC 12 are wrong for std::string concatenation (GCC bug 105651); clang's build finds the real ones.
set(DERMIS_WARNINGS -Wall -Wextra -Wshadow -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND DERMIS_WARNINGS -Wno-restrict -Wno-array-bounds -Wno-stringop-overread -Wno-stringop-overflow)
endif()

# Clang writes into a precompiled header when its sources were changed, and refuses it when that differs. A compiler
# cache may hand out the one of an earlier clone in the same folder: ninja says when to make it again, not the time.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
endif()

# windows.h: without macros that replace C++'s names.
if(WIN32)
    add_compile_definitions(NOMINMAX WIN32_LEAN_AND_MEAN)
endif()

if(DERMIS_SANITIZE)
    add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
endif()
if(DERMIS_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link)  # libFuzzer sees the libraries' branches, not the target's only
    # Four checks of nearly every access take a third of the time to compile; the preset sanitize has them.
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr)
endif()
if(DERMIS_WARNINGS_ONLY)
    # Object files are not written, so an archive or a program is an empty file: ninja asks only that the command succeeds.
    add_compile_options(-fsyntax-only)
    set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)  # clang 19 refuses to make one without making code
    foreach(made CXX_ARCHIVE_CREATE CXX_LINK_EXECUTABLE CXX_CREATE_SHARED_MODULE)
        set(CMAKE_${made} "<CMAKE_COMMAND> -E touch <TARGET>")
    endforeach()
    set(CMAKE_CXX_ARCHIVE_FINISH "")
endif()
