// The studio's state: the open project, its meshes, the last fit and its morphs. A caller of the library like any
// other; knows nothing of HTTP. Every function may be called from any thread.
#pragma once

#include "files.h"
#include "jobs.h"
#include "meshes.h"
#include "project.h"
#include "projects.h"
#include "suggest.h"

#include "meshtween/morph/keys.h"

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
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

// A file as the page sends it.
struct NamedBytes {
    std::string name, bytes;
};

class Session {
public:
    // Opens the project, a new one where its file does not exist; `opened` are files that the user named, which are the
    // source and the target where there are two. What cannot be opened is told in the notes of state(). Projects that
    // begin later get folders of their own in `shelf`. Throws Error(file) for a project that cannot be understood, or
    // is open elsewhere; Error(argument) for one that is of other models than those named.
    Session(const std::filesystem::path& project_file, const std::vector<std::filesystem::path>& opened, Events& events,
            const std::filesystem::path& shelf);
    ~Session();

    Json state() const; // everything that the page draws, without the buffers

    // The document is what a person makes: {models, markers, symmetry, timing, options}; a part that is missing stays
    // as it is. Saved before it returns. Models that differ from the open ones are opened: {source: {path, hash} or
    // null, target: ...}, files that are in reach. `number` is the project that the document is of, by its number in
    // state(): Error(argument) where another one is open by now.
    void set_document(const Json& document, std::optional<int> number = {});
    void set_history(std::string_view history); // the page's own text, kept beside the project
    std::string history() const;
    void set_picture(std::string_view png);

    // A model that might become one side of the project: kept in its folder, read, and compared with the markers. The
    // document says whether it does. {model, name, vertices, triangles, carried: [{id, at}, ...]}
    Json add_model(Side side, std::string_view name, const std::string& bytes);
    Json examine_again(Side side); // the same, of the open file, which has changed on disk
    std::string model_bytes(Side side) const;
    std::string fitted_bytes() const; // of the file with the last fit

    // Each leaves the open project as it is and goes on with another.
    void open_sample(const std::string& name, bool with_markers);
    void new_project();
    void open_project(const std::string& id);
    // Makes a project of the shelf from a project's JSON and the files that it refers to, and returns its id. Opens
    // nothing. Models that are not among the files must be in reach.
    std::string add_project(const std::vector<NamedBytes>& files);

    Json projects() const;                                    // recent ones, the open one marked
    std::string project_picture(const std::string& id) const; // PNG
    Json project_json() const;
    Json kept_states() const;                          // earlier states of this project
    Json kept_document(const std::string& name) const; // one of them, as a document

    std::string mesh_buffer(Side side, const std::string& what) const; // positions normals triangles colors uvs
    std::string fitted_buffer(const std::string& what) const;          // also distance stretch trust
    std::string live_positions() const;                                // of the running fit, in the result's frame
    std::string path_buffer(const std::string& key, std::size_t node, const std::string& what) const;
    Json changes() const; // {"source": changed on disk, "target": ...}

    // {markers: [{name, source, target}, ...], notes, ask_side}; changes nothing. One file, or one a side; `side` says
    // what a file of one side is of.
    Json import_markers(const std::vector<NamedBytes>& files, std::optional<Side> side) const;
    Json export_markers(const std::string& format) const; // {files: [{name, text}, ...], notes}; "pp", "mrk.json", ...
    Json marker_warnings() const; // sentences about markers that lie off their model, as import tells them
    Json guesses(Side from, const Json& points) const; // [[x, y, z], ...] on the other side
    Json suggestions() const;

    // Each starts a job and returns at once; throws Error(argument) where one is running or something is missing.
    void start_fit(const Json& options);
    void start_path(const Json& request);   // {options, timing}
    void start_export(const Json& request); // {names: ["morph.glb", ...], options, timing, frames}
    void cancel();
    void wait(); // until the job has ended

    std::filesystem::path exported(const std::string& name) const; // a file written by an export
    std::filesystem::path file() const;                            // the open project's

private:
    struct Open {
        std::shared_ptr<const OpenMesh> source, target;

        std::shared_ptr<const OpenMesh>& on(Side side) { return side == Side::source ? source : target; }
        const std::shared_ptr<const OpenMesh>& on(Side side) const { return side == Side::source ? source : target; }
        std::string mark() const { return source && target ? source->hash + target->hash : std::string(); }
    };
    // A project that is open.
    struct Work {
        std::filesystem::path file;
        Access access;
        std::unique_ptr<ProjectLock> lock;
        Project project;
        Open open;
        std::shared_ptr<const Fitted> fitted; // the last fit; shown where it is of the open meshes
        std::vector<std::string> notes;

        Work(const std::filesystem::path& project_file, const std::set<std::filesystem::path>& opened);
        std::shared_ptr<const Fitted> fit() const { return fitted && fitted->of == open.mark() ? fitted : nullptr; }
    };
    std::unique_ptr<Work> loaded(const std::filesystem::path& file);
    void open_models(Work& work);
    void bring_fit(Work& work) const; // where the saved fit is of the open meshes
    void enter(std::unique_ptr<Work> work);
    void begin(const std::filesystem::path& place, const Project& project); // writes it and goes on with it
    void need_rest() const;                                       // throws Error(argument) where a job is running
    bool is_empty() const;                                        // the open project holds nothing
    std::filesystem::path place_for_new(const std::string& name); // the open project's own, where that is empty
    std::shared_ptr<const OpenMesh> open_known(const MeshFile& file, const Access& access);
    void remember(std::shared_ptr<const OpenMesh> mesh);
    bool in_shelf(const std::filesystem::path& file) const;
    void find_models(Project& project, const std::filesystem::path& folder) const;
    std::filesystem::path model_in_reach(const std::string& hash) const;

    Open both() const;                              // throws Error(argument) where one is missing
    std::shared_ptr<const Fitted> need_fit() const; // throws Error(argument) where there is none
    void save_locked(bool keep = false);            // `keep`: what was there before becomes a kept state
    Pose known_pose(const Open& open) const;        // worked out once a pair of meshes
    Json run_fit(const Open& open, const std::vector<PlacedMarker>& markers, FitOptions options,
                 const Progress& progress);
    std::function<void(const Points&)> show_live();

    Events& events_;
    std::filesystem::path shelf_;
    mutable std::mutex editing_;             // over whole changes of the project: they come one after the other
    mutable std::mutex mutex_;               // over all below but jobs_
    std::set<std::filesystem::path> opened_; // named on the command line
    std::unique_ptr<Work> work_;
    int number_ = 0;                                    // of the open project, counted by opening
    std::deque<std::shared_ptr<const OpenMesh>> known_; // read lately: examined models, and those that undo brings back
    std::map<std::string, std::shared_ptr<const PlayedPath>> paths_; // by the hash of what was asked
    std::shared_ptr<const Points> live_;
    Frame live_frame_;
    mutable std::mutex pose_mutex_; // over these two
    mutable Pose pose_;
    mutable std::string pose_of_; // the hashes of the meshes that it is of
    Jobs jobs_;                   // last: ends first
};

// Where a model's markers lie on another one: at the closest place of its surface, or nowhere where that is further
// away than 3 % of its diagonal. [{id, at}, ...], `at` null for nowhere; markers without a place on the side are left
// out.
Json carried(const std::vector<PlacedMarker>& markers, Side side, const OpenMesh& to);

} // namespace meshtween::studio
