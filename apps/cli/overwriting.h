// A result must not take the place of a file that it is made from.
#pragma once

#include <CLI/CLI.hpp>

// Throws Error(argument) where an option of the verb that names a file to write names one that the verb reads, also by
// another path.
void refuse_overwriting(const CLI::App& verb);
