#include "result_files.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace {

namespace fs = std::filesystem;
using meshtween::Error, meshtween::ErrorKind;

bool is_called(const CLI::Option& option, std::string_view name) {
    const std::vector<std::string>& names = option.get_lnames();
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool names_an_output(const CLI::Option& option) {
    return is_called(option, "output"); // some take a folder or a pattern: `load_outputs` looks at those
}

bool names_a_result(const CLI::Option& option) {
    static constexpr std::array<std::string_view, 6> results{"report", "map",        "weights",
                                                             "refine", "values-out", "points-out"};
    return names_an_output(option) ||
           std::any_of(results.begin(), results.end(), [&](std::string_view name) { return is_called(option, name); });
}

void require_place(const CLI::Option& option, const fs::path& file) {
    const fs::path folder = file.parent_path();
    if (!folder.empty() && !fs::is_directory(folder))
        throw Error(ErrorKind::file, fmt::format("{} {}: there is no folder {}; create it first", option.get_name(),
                                                 file.string(), folder.string()));
    if (fs::is_directory(file))
        throw Error(ErrorKind::file,
                    fmt::format("{} {} is a folder; name a file in it", option.get_name(), file.string()));
}

} // namespace

void check_result_files(const CLI::App& verb) {
    const auto each = [&](bool results, const auto& visit) {
        for (const CLI::Option* option : verb.get_options())
            if (names_a_result(*option) == results)
                for (const std::string& file : option->results()) visit(*option, file);
    };
    each(true, [&](const CLI::Option& result, const std::string& written) {
        if (!names_an_output(result)) require_place(result, written);
        std::error_code ignored;
        if (!fs::is_regular_file(written, ignored)) return;
        each(false, [&](const CLI::Option&, const std::string& read) {
            if (fs::is_regular_file(read, ignored) && fs::equivalent(written, read, ignored))
                throw Error(ErrorKind::argument,
                            fmt::format("{} {} would take the place of a file that is read, {}; name another file",
                                        result.get_name(), written, read));
        });
    });
}
