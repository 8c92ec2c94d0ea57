#!/usr/bin/env bash
# check_fails.sh CHECK SOURCE_DIR: each check of .ci/run and tools/full_check must fail on a fault made for it, in a folder of its own,
# and pass without. The faults are compiled with the presets that these use and cmake/Compiler.cmake. 77: skipped.
set -euo pipefail
check=$1
source_dir=$2
for tool in clang++ clang-format; do
    command -v $tool >/dev/null || { echo "no $tool here"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$check: $1"; exit 1; }

# project PRESET FLAGS NAME: a program NAME of $folder/fault.cpp in $folder/build-PRESET, its output in $folder/log.
project() {
    cat > "$folder/CMakePresets.json" <<END
{ "version": 6, "include": ["$source_dir/CMakePresets.json"] }
END
    cat > "$folder/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(fault LANGUAGES C CXX)
include("$source_dir/cmake/Compiler.cmake")
add_executable($3 fault.cpp)
target_compile_options($3 PRIVATE \${DERMIS_WARNINGS} $2)
target_link_options($3 PRIVATE $2)
END
    (cd "$folder" && cmake --preset "$1" && cmake --build "build-$1") > "$folder/log" 2>&1
}

case $check in
format)
    printf 'int  main( ){return 0 ;}\n' > "$folder/fault.cpp"
    "$source_dir/tools/check_format" "$folder/fault.cpp" > "$folder/log" && fail "passes a badly formatted file"
    grep -q "fault.cpp: not formatted" "$folder/log" || fail "does not name the file: $(cat "$folder/log")"
    "$source_dir/tools/check_format" --fix "$folder/fault.cpp"
    "$source_dir/tools/check_format" "$folder/fault.cpp" || fail "fails on a formatted file"
    ;;
warning)
    printf 'int main() {\n    int a = 0;\n    { int a = 1; (void)a; }\n    return a;\n}\n' > "$folder/fault.cpp"
    project warnings "" fault && fail "passes what clang warns of"
    grep -q "Wshadow" "$folder/log" || fail "fails for another reason: $(tail -5 "$folder/log")"
    printf 'int main() {}\n' > "$folder/fault.cpp"
    project warnings "" fault || fail "fails on a sound file: $(tail -5 "$folder/log")"
    ;;
leak)
    # Through a volatile pointer: the compiler must not leave the allocation out.
    printf 'int* volatile lost;\nint main(int count, char**) {\n    lost = new int(count);\n    lost = nullptr;\n}\n' > "$folder/fault.cpp"
    project clang "" fault || fail "does not build: $(tail -5 "$folder/log")"
    "$folder/build-clang/fault" 2> "$folder/log" && fail "passes a leak"
    grep -q "LeakSanitizer: detected memory leaks" "$folder/log" || fail "no leak found: $(head -5 "$folder/log")"
    ;;
fuzz)
    cat > "$folder/fault.cpp" <<'END'
#include <cstddef>
#include <cstdint>
#include <cstdlib>
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size > 0 && data[0] == '!') std::abort();
    return 0;
}
END
    project clang -fsanitize=fuzzer fault_fuzz || fail "does not build: $(tail -5 "$folder/log")"
    DERMIS_FUZZ_TARGETS=$folder/build-clang "$source_dir/tools/fuzz" 20 > "$folder/log" && fail "passes a crash"
    grep -q "fault: FAILED" "$folder/log" || fail "fails for another reason: $(cat "$folder/log")"
    ls "$folder"/build-clang/findings/fault-crash-* >/dev/null || fail "does not keep the input"
    ;;
*)
    fail "no such check"
    ;;
esac
