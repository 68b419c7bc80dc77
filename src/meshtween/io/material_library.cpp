// After "MTL material format (Lightwave, OBJ)", Alias/Wavefront 1995, and the keywords for physically based materials
// that Blender and others write (Pr, Pm).
#include "meshtween/io/material_library.h"

#include "meshtween/io/companions.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

// Keywords are written in any case.
std::string lower(std::string_view word) {
    std::string result(word);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

bool names_picture(const std::string& keyword) {
    return keyword.substr(0, 4) == "map_" || keyword == "bump" || keyword == "disp" || keyword == "decal" ||
           keyword == "refl" || keyword == "norm";
}

bool is_number(std::string_view word) {
    double value = 0;
    return parse(word, value);
}

// The name behind the options of a statement such as map_Kd -s 1 1 1 -clamp on skin.png.
std::string_view picture_name(Text& text) {
    while (text.peek().substr(0, 1) == "-") {
        const std::string option = lower(text.word());
        if (option == "-o" || option == "-s" || option == "-t") {
            for (int i = 0; i < 3 && is_number(text.peek()); ++i) text.word();
        } else {
            text.word();
            if (option == "-mm") text.word();
        }
    }
    return text.rest();
}

class LibraryReader {
public:
    explicit LibraryReader(MeshFile& file) : file_(file) {
        for (std::size_t i = 0; i < file.materials.size(); ++i) named_.emplace(file.materials[i].name, i);
    }

    void read(const fs::path& library, std::vector<char>& known) {
        const std::string bytes = read_whole(library);
        library_ = library;
        material_ = nullptr;
        Text text(bytes, library_);
        while (text.next_line()) {
            const std::string keyword = lower(text.word());
            if (keyword == "newmtl") {
                const auto found = named_.find(std::string(text.rest()));
                material_ = found == named_.end() ? nullptr : &file_.materials[found->second];
                if (material_ == nullptr) continue;
                if (known[found->second] != 0) material_ = nullptr; // the first library that has it says what it is
                known[found->second] = 1;
            } else if (material_ != nullptr) {
                statement(keyword, text);
            }
        }
    }

private:
    void statement(const std::string& keyword, Text& text) {
        const auto number = [&](float& value) {
            double read = 0;
            if (parse(text.peek(), read) && std::isfinite(read)) value = static_cast<float>(read);
        };
        if (keyword == "kd") {
            for (std::size_t k = 0; k < 3; ++k) {
                number(material_->base_color[k]);
                text.word();
                if (k == 0 && text.peek().empty()) { // one number stands for all
                    material_->base_color[1] = material_->base_color[2] = material_->base_color[0];
                    break;
                }
            }
        } else if (keyword == "d") {
            if (text.peek() == "-halo") text.word();
            number(material_->base_color[3]);
        } else if (keyword == "tr") {
            float transparent = 1 - material_->base_color[3];
            number(transparent);
            material_->base_color[3] = 1 - transparent;
        } else if (keyword == "pr") {
            number(material_->roughness);
        } else if (keyword == "pm") {
            number(material_->metallic);
        } else if (keyword == "map_kd") {
            material_->base_color_image = image(picture_name(text));
        }
    }

    int image(std::string_view name) {
        const fs::path found = find_companion(library_.parent_path(), name);
        if (found.empty()) {
            file_.notes.push_back(fmt::format("there is no picture {}, which material {} names in {}", shown_name(name),
                                              shown_name(material_->name), library_.filename().string()));
            return -1;
        }
        const auto [image, fresh] = images_.try_emplace(found, static_cast<int>(file_.images.size()));
        if (fresh) file_.images.push_back({std::string(name), mime_of(found), {}, found});
        return image->second;
    }

    static std::string shown_name(std::string_view name) { return std::string(name.substr(0, 80)); }

    static std::string mime_of(const fs::path& path) {
        const std::string extension = lower(path.extension().string());
        if (extension == ".png") return "image/png";
        if (extension == ".jpg" || extension == ".jpeg") return "image/jpeg";
        return {};
    }

    MeshFile& file_;
    fs::path library_;
    std::unordered_map<std::string, std::size_t> named_;
    std::map<fs::path, int> images_;
    Material* material_ = nullptr;
};

} // namespace

std::vector<std::string_view> picture_names(std::string_view bytes) {
    std::vector<std::string_view> names;
    Text text(bytes, {});
    while (text.next_line()) {
        if (!names_picture(lower(text.word()))) continue;
        if (const std::string_view name = picture_name(text); !name.empty()) names.push_back(name);
    }
    return names;
}

std::vector<std::string_view> library_names(std::string_view statement, const fs::path& folder) {
    if (!find_companion(folder, statement).empty()) return {statement};
    std::vector<std::string_view> names;
    Text text(statement, {});
    if (text.next_line())
        while (!text.rest().empty()) names.push_back(text.word_between_blanks());
    const bool any = std::any_of(names.begin(), names.end(),
                                 [&](std::string_view name) { return !find_companion(folder, name).empty(); });
    return any ? names : std::vector{statement};
}

void read_libraries(MeshFile& file, const fs::path& folder) {
    std::vector<char> known(file.materials.size(), 0);
    bool missing = false;
    std::vector<std::string_view> names;
    for (const std::string& statement : file.material_libraries)
        for (const std::string_view name : library_names(statement, folder)) names.push_back(name);
    LibraryReader reader(file);
    std::set<fs::path> read; // however often and by what names a library is named
    for (const std::string_view name : names) {
        const fs::path library = find_companion(folder, name);
        if (library.empty()) {
            missing = true;
            file.notes.push_back(fmt::format("there is no material library {}: what its materials look like is not "
                                             "known",
                                             name));
            continue;
        }
        std::error_code ignored;
        if (!read.insert(fs::canonical(library, ignored)).second) continue;
        try {
            reader.read(library, known);
        } catch (const Error& error) {
            missing = true;
            file.notes.emplace_back(error.what());
        }
    }
    const auto unknown = static_cast<std::size_t>(std::count(known.begin(), known.end(), 0));
    if (unknown > 0 && !missing && !file.material_libraries.empty())
        file.notes.push_back(fmt::format(
            "{} described in no material library, such as {}",
            unknown == 1 ? "1 material is" : fmt::format("{} materials are", unknown),
            file.materials[static_cast<std::size_t>(std::find(known.begin(), known.end(), 0) - known.begin())].name));
}

std::string material_library(const MeshFile& file, const std::vector<std::string>& image_names) {
    std::string text(library_mark);
    text += '\n';
    for (const Material& material : file.materials) {
        const auto& color = material.base_color;
        text += fmt::format("\nnewmtl {}\nKd {} {} {}\nd {}\nPr {}\nPm {}\n", material.name, color[0], color[1],
                            color[2], color[3], material.roughness, material.metallic);
        if (material.base_color_image < 0) continue;
        const std::string& image = image_names[static_cast<std::size_t>(material.base_color_image)];
        if (!image.empty()) text += fmt::format("map_Kd {}\n", image);
    }
    return text;
}

} // namespace meshtween
