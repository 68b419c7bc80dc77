#include "meshtween/io/companions.h"

#include "meshtween/core/error.h"
#include "meshtween/io/material_library.h"
#include "meshtween/io/output.h"
#include "meshtween/io/patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

fs::path slashed(std::string_view name) {
    std::string text(name);
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool is_picture(const fs::path& path) {
    static constexpr std::array known{".png", ".jpg", ".jpeg", ".bmp", ".tga",  ".tif", ".tiff", ".gif", ".webp",
                                      ".exr", ".hdr", ".dds",  ".ktx", ".ktx2", ".psd", ".ppm",  ".pgm", ".basis",
                                      ".jpe", ".iff", ".sgi",  ".rgb", ".svg",  ".jp2", ".pcx"};
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(known.begin(), known.end(), extension) != known.end();
}

// A model from elsewhere must not carry off what it likes.
bool is_library(const fs::path& path) {
    const std::string extension = path.extension().string();
    return extension.size() == 4 && std::equal(extension.begin(), extension.end(), ".mtl", [](char a, char b) {
               return std::tolower(static_cast<unsigned char>(a)) == b;
           });
}

bool leads_out(const fs::path& relative) {
    return *relative.lexically_normal().begin() == "..";
}

// Where a copy goes below the new folder: as it is named, unless that leads out of the folder.
fs::path place_below(const fs::path& folder, std::string_view name, const fs::path& found) {
    const fs::path named = slashed(name);
    const bool below = named.is_relative() && !leads_out(named) && is_file(folder / named);
    return below ? named.lexically_normal() : found.filename();
}

void say(const Move& move, std::string text) {
    if (move.notes != nullptr) move.notes->push_back(std::move(text));
}

// Nothing is written where the same bytes lie already.
void place(const Move& move, const fs::path& destination, std::string_view bytes) {
    std::error_code ignored;
    if (fs::exists(destination, ignored)) {
        if (!is_file(destination) || fs::file_size(destination, ignored) != bytes.size() ||
            read_whole(destination) != bytes)
            say(move, fmt::format("{}: a different file of this name is there already; it is left as it is, and the "
                                  "mesh written beside it shows that one",
                                  destination.string()));
        return;
    }
    fs::create_directories(destination.parent_path());
    write_whole(destination, bytes);
}

bool same_folder(const Move& move) {
    std::error_code ignored;
    return move.to.empty() || fs::equivalent(move.from, move.to, ignored);
}

// The name to write; with Textures::copy what `bytes_of` gives for the found file and its copy lies there then.
template <typename Bytes>
std::string carry(const Move& move, std::string_view name, const Bytes& bytes_of) {
    const fs::path found = same_folder(move) ? fs::path() : find_companion(move.from, name);
    const fs::path named = slashed(name);
    if (found.empty() || !fs::is_directory(move.to) || (named.is_absolute() && found == named))
        return std::string(name); // or found from anywhere
    try {
        if (move.textures == Textures::refer)
            return fs::weakly_canonical(found).lexically_proximate(fs::weakly_canonical(move.to)).generic_string();
        const fs::path below = place_below(move.from, name, found);
        place(move, move.to / below, bytes_of(found, move.to / below));
        const bool led_out = named.is_relative() && leads_out(named) && is_file(move.from / named);
        return led_out ? below.generic_string() : std::string(name);
    } catch (const std::exception& error) { // a mesh without its pictures is better than none
        say(move, error.what());
        return std::string(name);
    }
}

std::string library_for(const Move& move, const fs::path& library, const fs::path& copy) {
    const std::string bytes = read_whole(library);
    std::ostringstream stream;
    Patch patch(bytes, stream);
    Move pictures = move;
    pictures.from = library.parent_path(), pictures.to = copy.parent_path();
    for (const std::string_view name : picture_names(bytes))
        if (const std::string carried = carry_picture(pictures, name); carried != name) patch.replace(name, carried);
    patch.finish();
    return stream.str();
}

} // namespace

fs::path find_companion(const fs::path& folder, std::string_view name) {
    if (name.empty() || name.find('\0') != std::string_view::npos) return {};
    const fs::path named = slashed(name);
    for (const fs::path& tried : {folder / fs::path(name), folder / named, folder / named.filename()})
        if (is_file(tried)) return tried;
    return {};
}

Move move_to(const fs::path& path, const fs::path& from, const WriteOptions& options, std::vector<std::string>& notes) {
    const auto folder = [](const fs::path& file) {
        return file.has_parent_path() ? file.parent_path() : fs::path(".");
    };
    std::error_code ignored;
    const bool file = !fs::exists(path, ignored) || is_file(path);
    return {folder(from), file ? folder(path) : fs::path(), options.textures, &notes};
}

std::string carry_picture(const Move& move, std::string_view name) {
    return carry(move, name, [&](const fs::path& found, const fs::path&) {
        if (!is_picture(found))
            throw Error(ErrorKind::file, fmt::format("{}: it is no picture by its name; it is not copied beside the "
                                                     "mesh",
                                                     found.string()));
        return read_whole(found);
    });
}

std::string carry_library(const Move& move, std::string_view name) {
    return carry(move, name, [&](const fs::path& found, const fs::path& copy) {
        if (!is_library(found))
            throw Error(ErrorKind::file, fmt::format("{}: it is no material library by its name; it is "
                                                     "not copied beside the mesh",
                                                     found.string()));
        return library_for(move, found, copy);
    });
}

std::string carry_image(const Move& move, const TextureImage& image, std::size_t number) {
    if (move.to.empty() || !fs::is_directory(move.to)) return {};
    try {
        if (!image.bytes.empty()) {
            fs::path name = slashed(image.name).filename();
            if (name.empty() || name.string().size() > 100) name = fmt::format("texture_{}", number);
            if (!is_picture(name)) name += image.mime == "image/jpeg" ? ".jpg" : ".png";
            return place_beside(move.to, name.string(), image.bytes);
        }
        if (image.path.empty()) return {};
        if (move.textures == Textures::refer)
            return fs::weakly_canonical(image.path).lexically_proximate(fs::weakly_canonical(move.to)).generic_string();
        return place_beside(move.to, image.path.filename().string(), read_whole(image.path));
    } catch (const std::exception& error) { // a mesh without its pictures is better than none
        say(move, error.what());
        return {};
    }
}

std::string place_beside(const fs::path& folder, const std::string& name, std::string_view bytes,
                         std::string_view ours) {
    const fs::path wanted(name);
    for (int number = 1;; ++number) {
        const std::string tried =
            number == 1 ? name : fmt::format("{}_{}{}", wanted.stem().string(), number, wanted.extension().string());
        const fs::path path = folder / tried;
        std::error_code ignored;
        if (fs::exists(path, ignored)) {
            const std::string there = is_file(path) ? read_whole(path) : std::string();
            if (there == bytes && is_file(path)) return tried;
            if (ours.empty() || there.substr(0, ours.size()) != ours) continue;
        }
        write_whole(path, bytes);
        return tried;
    }
}

} // namespace meshtween
