// Which files the studio may touch: those that its user opened, and what lies in the project's folder.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace meshtween::studio {

// $XDG_STATE_HOME/meshtween/studio, by default ~/.local/state/meshtween/studio. Throws Error(file) without a home.
std::filesystem::path state_folder();

// A file's name without folders. It keeps its letters, of any script, and its spaces; what some system forbids in names
// (control characters, " * : < > ? |) and bytes that are no UTF-8 become underscores. It does not start with a dot or a
// space, ends with neither, and of a very long one the ending stays. Throws Error(argument) where nothing is left.
std::string plain_name(std::string_view name);

class Access {
public:
    explicit Access(const std::filesystem::path& folder); // the project's; made where it does not exist
    void open(const std::filesystem::path& file);         // the user named it
    const std::filesystem::path& folder() const { return folder_; }

    bool holds(const std::filesystem::path& file) const; // whether it lies in the folder

    // The file with all links resolved. Throws Error(file) where it is neither opened nor in the folder.
    std::filesystem::path checked(const std::filesystem::path& file) const;
    // A file in a sub-folder of the project's folder, to be written: the sub-folder is made; throws as checked() does
    // where it, or the file itself, is a link out of the folder.
    std::filesystem::path place_for(std::string_view subfolder, std::string_view name) const;

private:
    std::filesystem::path folder_; // links resolved
    std::set<std::filesystem::path> opened_;
};

} // namespace meshtween::studio
