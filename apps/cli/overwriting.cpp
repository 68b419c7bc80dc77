#include "overwriting.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace {

namespace fs = std::filesystem;

bool names_a_result(const CLI::Option& option) {
    static constexpr std::array<std::string_view, 7> results{"output", "report",     "map",       "weights",
                                                             "refine", "values-out", "points-out"};
    return std::any_of(results.begin(), results.end(), [&](std::string_view name) {
        return std::find(option.get_lnames().begin(), option.get_lnames().end(), name) != option.get_lnames().end();
    });
}

} // namespace

void refuse_overwriting(const CLI::App& verb) {
    const auto each = [&](bool results, const auto& visit) {
        for (const CLI::Option* option : verb.get_options())
            if (names_a_result(*option) == results)
                for (const std::string& file : option->results()) visit(*option, file);
    };
    each(true, [&](const CLI::Option& result, const std::string& written) {
        std::error_code ignored;
        if (!fs::is_regular_file(written, ignored)) return;
        each(false, [&](const CLI::Option&, const std::string& read) {
            if (fs::is_regular_file(read, ignored) && fs::equivalent(written, read, ignored))
                throw meshtween::Error(
                    meshtween::ErrorKind::argument,
                    fmt::format("{} {} would take the place of a file that is read, {}; name another "
                                "file",
                                result.get_name(), written, read));
        });
    });
}
