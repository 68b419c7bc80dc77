#include "files.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view forbidden_signs = "\"*:<>?|";
constexpr std::size_t longest_name = 120; // bytes; file systems end at 255

// The bytes of the letter that a text begins with; 0 where it is no UTF-8.
std::size_t letter_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xF0 && first < 0xF5 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 0;
    if (first >= 0xF5) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
    const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
    const bool no_letter = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F); // surrogates, beyond
    return overlong || no_letter ? 0 : length;
}

// Cut between letters; the ending, which tells the format, stays.
std::string shortened(std::string name) {
    if (name.size() <= longest_name) return name;
    std::string ending = fs::path(name).extension().string();
    if (ending.size() > 12) ending.clear();
    std::size_t end = longest_name - ending.size();
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
    return name.substr(0, end) + ending;
}

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

std::string plain_name(std::string_view name) {
    name = name.substr(name.find_last_of("/\\") + 1); // npos + 1 is 0
    std::string plain;
    while (!name.empty()) {
        const std::size_t length = letter_length(name);
        const auto first = static_cast<unsigned char>(name[0]);
        const bool forbidden =
            length == 0 || first < 0x20 || first == 0x7F || forbidden_signs.find(name[0]) != std::string_view::npos;
        if (forbidden)
            plain += '_';
        else
            plain += name.substr(0, length);
        name.remove_prefix(std::max<std::size_t>(length, 1));
    }
    plain.erase(0, std::min(plain.find_first_not_of(". "), plain.size()));
    plain.erase(plain.find_last_not_of(". ") + 1);
    if (plain.empty()) throw Error(ErrorKind::argument, "a file needs a name");
    return shortened(std::move(plain));
}

Access::Access(const fs::path& folder) : folder_(made(folder)) {}

void Access::open(const fs::path& file) {
    opened_.insert(fs::weakly_canonical(file));
}

bool Access::holds(const fs::path& file) const {
    return inside(fs::weakly_canonical(file), folder_);
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
    const fs::path wanted = fs::weakly_canonical(folder_ / subfolder);
    if (wanted != folder_ && !inside(wanted, folder_)) // before anything is made there
        throw Error(ErrorKind::file,
                    fmt::format("{} leads out of the project's folder", (folder_ / subfolder).string()));
    const fs::path place = made(wanted);
    const fs::path file = place / plain_name(name);
    if (fs::is_symlink(file) || !inside(fs::weakly_canonical(file), folder_))
        throw Error(ErrorKind::file, fmt::format("{} is a link; it is not written through", file.string()));
    return file;
}

} // namespace meshtween::studio
