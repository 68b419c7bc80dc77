// The studio's state: the project, the meshes that are open, the last fit and its morphs. A caller of the library like
// any other; knows nothing of HTTP. Every function may be called from any thread.
#pragma once

#include "files.h"
#include "jobs.h"
#include "meshes.h"
#include "project.h"
#include "suggest.h"

#include "meshtween/morph/keys.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace meshtween::studio {

// A path as the page plays it: few control meshes, their weights made by the page from the knots.
struct PlayedPath {
    std::string asked; // the request that it answers
    Frame frame;
    Curve curve;
    std::vector<std::string> normals; // of the control meshes, as the page draws them
    RepairReport repair;
};
Json told(const std::string& key,
          const PlayedPath& path); // {key, asked, meshes, degree, knots, deviation, bent, cuts_left, frame}

class Session {
public:
    // Reads the project where its file exists, and opens its meshes; `opened` are files that the user named, which
    // become source and target where there are two. What cannot be opened is told in the notes of state(). Throws
    // Error(file) for a project file that cannot be understood.
    Session(const std::filesystem::path& project_file, const std::vector<std::filesystem::path>& opened,
            Events& events);
    ~Session();

    Json state() const; // everything that the page draws, without the buffers

    void open(Side side, const std::filesystem::path& file);                      // and saves
    void open_upload(Side side, std::string_view name, const std::string& bytes); // kept in the project's folder
    void open_sample(const std::string& name, bool with_markers);
    void reload(Side side);                  // after a change on disk
    void set_document(const Json& document); // {markers, symmetry, timing, options}; saved before it returns
    void open_project(const Json& project);  // an uploaded one: its meshes must be in reach
    void clear();                            // a new project in the same file

    Json project_json() const;
    std::string mesh_buffer(Side side, const std::string& what) const; // positions normals triangles colors uvs
    std::string fitted_buffer(const std::string& what) const;          // also distance stretch trust
    std::string live_positions() const;                                // of the running fit, in the result's frame
    std::string path_buffer(const std::string& key, std::size_t node, const std::string& what) const;
    Json changes() const; // {"source": changed on disk, "target": ...}

    Json import_markers(std::string_view name, const std::string& bytes, std::string_view second_name,
                        const std::string& second_bytes) const; // {pairs, notes}; changes nothing
    std::string export_markers(const std::string& extension) const;
    Json guesses(Side from, const Json& points) const; // [[x, y, z], ...] on the other side
    Json suggestions() const;

    // Each starts a job and returns at once; throws Error(argument) where one is running or something is missing.
    void start_fit(const Json& options);
    void start_path(const Json& request);   // {options, timing}
    void start_export(const Json& request); // {names: ["morph.glb", ...], options, timing, frames}
    void cancel();
    void wait(); // until the job has ended

    std::filesystem::path exported(const std::string& name) const; // a file written by an export

private:
    struct Open {
        std::shared_ptr<const OpenMesh> source, target;
    };
    Open both() const;                              // throws Error(argument) where one is missing
    std::shared_ptr<const Fitted> need_fit() const; // throws Error(argument) where there is none
    void save_locked() const;
    void restore();
    void set_mesh(Side side, std::shared_ptr<const OpenMesh> mesh);
    void drop_fit_locked();
    std::shared_ptr<const OpenMesh>& slot(Side side) { return side == Side::source ? open_.source : open_.target; }
    std::filesystem::path fitted_file() const;
    Pose known_pose(const Open& open) const; // worked out once a pair of meshes
    Json run_fit(const Open& open, const std::vector<PlacedMarker>& markers, FitOptions options,
                 const Progress& progress);
    std::function<void(const Points&)> show_live();

    std::filesystem::path file_;
    Events& events_;
    mutable std::mutex mutex_; // over all below but jobs_
    Access access_;
    Project project_;
    Open open_;
    std::shared_ptr<const Fitted> fitted_;
    std::map<std::string, std::shared_ptr<const PlayedPath>> paths_; // by the hash of what was asked
    std::shared_ptr<const Points> live_;
    Frame live_frame_;
    mutable std::mutex pose_mutex_; // over these two
    mutable Pose pose_;
    mutable std::string pose_of_; // the hashes of the meshes that it is of
    std::vector<std::string> notes_;
    Jobs jobs_; // last: ends first
};

} // namespace meshtween::studio
