// Where projects lie: a folder each, in the shelf, with their last states and a picture beside the project's file.
#pragma once

#include "project.h"

#include <filesystem>
#include <string>

namespace meshtween::studio {

// Files that belong to a project's file.
std::filesystem::path fitted_file(const std::filesystem::path& project);  // the last fit's mesh
std::filesystem::path history_file(const std::filesystem::path& project); // what can be undone
std::filesystem::path picture_file(const std::filesystem::path& project);

// One studio a project: two would overwrite each other's work. The lock ends with the process, however that ends.
class ProjectLock {
public:
    explicit ProjectLock(const std::filesystem::path& project); // throws Error(file) where another studio has it
    ~ProjectLock();
    ProjectLock(const ProjectLock&) = delete;
    ProjectLock& operator=(const ProjectLock&) = delete;

private:
    int descriptor_ = -1;
};

// A new folder of the shelf, named after what the project is of.
std::filesystem::path fresh_folder(const std::filesystem::path& shelf, const std::string& name);

// The project of the shelf with that id, which is its folder's name. Throws Error(argument) where there is none.
std::filesystem::path project_with(const std::filesystem::path& shelf, const std::string& id);

// [{id, source, target, markers, complete, fitted, saved, picture}, ...], the last saved first; those without models
// and markers are left out.
Json recent_projects(const std::filesystem::path& shelf);

// The project of the shelf that is of these two models, the last saved where there are several; else the place of a
// new one.
std::filesystem::path project_of(const std::filesystem::path& shelf, const std::filesystem::path& source,
                                 const std::filesystem::path& target);

// A file of the shelf's projects with these bytes, or an empty path.
std::filesystem::path model_with(const std::filesystem::path& shelf, const std::string& hash);

// The last ten states of a project: many of the last minutes, few of the days before. keep_state() is called before the
// project's file is written anew.
void keep_state(const std::filesystem::path& project);
Json kept_states(const std::filesystem::path& project);                            // [{name, saved, markers}, ...]
Project kept_state(const std::filesystem::path& project, const std::string& name); // throws Error(argument)

} // namespace meshtween::studio
