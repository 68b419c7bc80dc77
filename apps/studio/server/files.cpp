#include "files.h"

#include "project.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

bool inside(const fs::path& file, const fs::path& folder) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end() && rest != file.end();
}

fs::path made(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure && !fs::is_directory(folder))
        throw Error(ErrorKind::file,
                    fmt::format("{}: cannot make this folder: {}", folder.string(), failure.message()));
    return fs::canonical(folder);
}

} // namespace

fs::path state_folder() {
    if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/')
        return fs::path(state) / "meshtween" / "studio";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
        return fs::path(home) / ".local" / "state" / "meshtween" / "studio";
    throw Error(ErrorKind::file,
                "there is no home folder to keep projects in; set XDG_STATE_HOME or use --project FILE");
}

fs::path project_of(const fs::path& source, const fs::path& target) {
    const std::string names = plain_name(source.stem().string()) + "-" + plain_name(target.stem().string());
    const std::string key = fs::weakly_canonical(source).string() + "\n" + fs::weakly_canonical(target).string();
    return state_folder() / (names.substr(0, 80) + "-" + hash_of_bytes(key).substr(0, 8)) / "project.json";
}

std::string plain_name(std::string_view name) {
    name = name.substr(name.find_last_of("/\\") + 1); // npos + 1 is 0
    std::string plain;
    for (const char c : name.substr(0, 120)) {
        const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                          c == '-' || c == '_' || c == '#';
        plain += kept ? c : '_';
    }
    plain.erase(0, std::min(plain.find_first_not_of('.'), plain.size()));
    if (plain.empty()) throw Error(ErrorKind::argument, "a file needs a name");
    return plain;
}

Access::Access(const fs::path& folder) : folder_(made(folder)) {}

void Access::open(const fs::path& file) {
    opened_.insert(fs::weakly_canonical(file));
}

fs::path Access::checked(const fs::path& file) const {
    const fs::path real = fs::weakly_canonical(file);
    if (!opened_.contains(real) && !inside(real, folder_))
        throw Error(ErrorKind::file,
                    fmt::format("{} lies outside the project's folder and was not opened; name it on the command line: "
                                "meshtween studio SOURCE TARGET",
                                file.string()));
    return real;
}

fs::path Access::place_for(std::string_view subfolder, std::string_view name) const {
    const fs::path place = made(folder_ / subfolder);
    if (!inside(place, folder_))
        throw Error(ErrorKind::file,
                    fmt::format("{} leads out of the project's folder", (folder_ / subfolder).string()));
    const fs::path file = place / plain_name(name);
    if (fs::is_symlink(file) || !inside(fs::weakly_canonical(file), folder_))
        throw Error(ErrorKind::file, fmt::format("{} is a link; it is not written through", file.string()));
    return file;
}

} // namespace meshtween::studio
