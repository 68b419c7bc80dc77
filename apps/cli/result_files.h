// The files that a verb is asked to write, looked at before any work begins.
#pragma once

#include <CLI/CLI.hpp>

// Throws Error where an option of the verb names a file to write that cannot be written, since its folder is missing or
// it is a folder itself, or that would take the place of a file that the verb reads, also by another path.
void check_result_files(const CLI::App& verb);
