#pragma once
// Failing memory and threads, wherever they fail: in Dermis, in a library, in a Vulkan driver.

namespace dermis::cli {

/// From here on the program ends at once with one line on standard error, exit code 1 and without temporary
/// files when `new` gets no memory, when an exception is caught by nobody, and when a library aborts. A crash
/// (SIGSEGV and its like) writes a line and removes the files too; the signal then ends the program.
void end_on_failure();

}  // namespace dermis::cli
