// Going from one project to another. What is open is never written over: each project has a folder of its own.
#include "session.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/io/json_limits.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <algorithm>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

Project read_project(const fs::path& file, const fs::path& folder) {
    if (!fs::exists(file)) return {};
    try {
        return project_from_json(json_or_discarded<Json>(read_whole(file)), folder);
    } catch (const Error& error) {
        throw Error(ErrorKind::file,
                    fmt::format("{}: {}; move it away or name another with --project", file.string(), error.what()));
    }
}

// The models that the user named, in a project that is theirs: with nothing in it, or of these models wherever they
// lie.
void name_models(Project& project, const std::vector<fs::path>& opened, const fs::path& file) {
    if (opened.size() != 2) return;
    for (const Side side : {Side::source, Side::target}) {
        const fs::path path = fs::absolute(opened[side == Side::source ? 0 : 1]).lexically_normal();
        MeshFile& known = project.file(side);
        const bool same = known.path.empty() || fs::weakly_canonical(known.path) == fs::weakly_canonical(path) ||
                          known.hash == hash_of(path);
        if (!same)
            throw Error(
                ErrorKind::argument,
                fmt::format("{}: its {} is {}, not {}; leave the models out to open it, or name another project "
                            "with --project",
                            file.string(), name_of(side), known.path.filename().string(), path.filename().string()));
        known.path = path;
    }
}

std::vector<PlacedMarker> markers_of(const Sample& made) {
    std::vector<PlacedMarker> markers;
    for (std::size_t i = 0; i < made.marker_names.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        markers.push_back({fmt::format("m{}", i + 1), made.marker_names[i], Point(made.marker_source.row(row)),
                           Point(made.marker_target.row(row)), false, ""});
    }
    return markers;
}

// A file's place in a project's folder: a few folders deep, of plain names.
fs::path plain_place(const fs::path& name) {
    fs::path place;
    int depth = 0;
    for (const fs::path& part : name) {
        if (++depth > 3 || part == ".." || part.is_absolute())
            throw Error(ErrorKind::argument,
                        fmt::format("\"{}\" is no name of a file in a project", name.string().substr(0, 80)));
        place /= plain_name(part.string());
    }
    return place;
}

} // namespace

Session::Work::Work(const fs::path& project_file, const std::set<fs::path>& opened)
    : file(fs::absolute(project_file)), access(file.parent_path()) {
    file = access.folder() / file.filename();
    lock = std::make_unique<ProjectLock>(file);
    for (const fs::path& one : opened) access.open(one);
}

Session::Session(const fs::path& project_file, const std::vector<fs::path>& opened, Events& events,
                 const fs::path& shelf)
    : events_(events), shelf_(fs::weakly_canonical(shelf)), jobs_(events) {
    for (const fs::path& one : opened) opened_.insert(fs::weakly_canonical(one));
    auto work = std::make_unique<Work>(project_file, opened_);
    work->project = read_project(work->file, work->access.folder());
    name_models(work->project, opened, work->file);
    open_models(*work);
    work_ = std::move(work);
    save_locked();
}

bool Session::in_shelf(const fs::path& file) const {
    return file.parent_path().parent_path() == shelf_;
}

std::unique_ptr<Session::Work> Session::loaded(const fs::path& file) {
    auto work = std::make_unique<Work>(file, opened_);
    work->project = read_project(work->file, work->access.folder());
    open_models(*work);
    return work;
}

// What has changed or gone is told, never fatal.
void Session::open_models(Work& work) {
    // A project of the shelf was written by this program: its meshes were opened by the user before.
    if (in_shelf(work.file)) {
        for (const fs::path& file : {work.project.source.path, work.project.target.path})
            if (!file.empty()) work.access.open(file);
        for (const fs::path& file : work.project.named) work.access.open(file);
    }
    for (const Side side : {Side::source, Side::target}) {
        MeshFile& file = work.project.file(side);
        if (file.path.empty()) continue;
        try {
            const fs::path real = work.access.checked(file.path);
            if (!fs::exists(real))
                throw Error(ErrorKind::file, fmt::format("the {} is gone: {}", name_of(side), file.path.string()));
            work.open.on(side) = open_mesh(real);
            if (!file.hash.empty() && file.hash != work.open.on(side)->hash)
                work.notes.push_back(fmt::format("{} has changed since the project was saved; look at its markers",
                                                 file.path.filename().string()));
            else if (work.project.fit.is_object() && !work.project.fit.contains("of") && work.open.target)
                work.project.fit["of"] = work.open.mark(); // written before fits told of which models they are
            file.hash = work.open.on(side)->hash;
        } catch (const Error& error) {
            work.notes.push_back(error.what());
        }
    }
    bring_fit(work);
}

void Session::bring_fit(Work& work) const {
    const Json& summary = work.project.fit;
    const Open& open = work.open;
    if (work.fit() || !open.source || !open.target || !summary.is_object() || !summary.contains("guards") ||
        summary.value("of", "") != open.mark() || !fs::exists(fitted_file(work.file)))
        return;
    try {
        Mesh saved = read_mesh(work.access.checked(fitted_file(work.file)));
        if (saved.positions.rows() != open.source->mesh.positions.rows()) return;
        auto fitted = std::make_shared<Fitted>(shown(*open.source, *open.target, std::move(saved.positions)));
        fitted->summary = summary;
        work.fitted = fitted;
    } catch (const Error& error) {
        work.notes.push_back(error.what());
    }
}

void Session::enter(std::unique_ptr<Work> work) {
    std::unique_ptr<Work> left;
    {
        const std::lock_guard lock(mutex_);
        left = std::move(work_);
        work_ = std::move(work);
        ++number_;
        known_.clear();
        paths_.clear();
        live_ = nullptr;
        save_locked();
        if (in_shelf(work_->file)) write_whole(shelf_ / "last", work_->file.string());
    }
    events_.publish("state", {{"why", "project"}});
}

bool Session::is_empty() const {
    const std::lock_guard lock(mutex_);
    const Project& project = work_->project;
    return project.source.path.empty() && project.target.path.empty() && project.markers.empty() &&
           studio::kept_states(work_->file).empty();
}

fs::path Session::place_for_new(const std::string& name) {
    return is_empty() ? file() : fresh_folder(shelf_, name) / "project.json";
}

void Session::open_sample(const std::string& name, bool with_markers) {
    const std::lock_guard editing(editing_);
    need_rest();
    const Sample made = sample(name);
    const fs::path place = place_for_new(made.name);
    const Access access(place.parent_path());
    Project project;
    project.source.path = access.place_for("models", made.name + "_source.ply");
    project.target.path = access.place_for("models", made.name + "_target.ply");
    write_mesh(made.source, project.source.path);
    write_mesh(made.target, project.target.path);
    project.source.hash = hash_of(project.source.path);
    project.target.hash = hash_of(project.target.path);
    if (with_markers) project.markers = markers_of(made);
    begin(place, project);
}

void Session::new_project() {
    const std::lock_guard editing(editing_);
    need_rest();
    if (!is_empty()) begin(fresh_folder(shelf_, "new") / "project.json", {});
}

// Writes a project and goes on with it.
void Session::begin(const fs::path& place, const Project& project) {
    {
        const std::lock_guard lock(mutex_);
        if (place == work_->file) work_->lock.reset(); // taken again at once
    }
    write_whole(place, to_json(project, place.parent_path()).dump(2) + "\n");
    enter(loaded(place));
}

void Session::open_project(const std::string& id) {
    const std::lock_guard editing(editing_);
    need_rest();
    const fs::path wanted = project_with(shelf_, id);
    if (fs::weakly_canonical(wanted) != file()) enter(loaded(wanted));
}

std::string Session::add_project(const std::vector<NamedBytes>& files) {
    const std::lock_guard editing(editing_);
    const auto described =
        std::find_if(files.begin(), files.end(), [](const NamedBytes& one) { return one.name == "project.json"; });
    if (described == files.end())
        throw Error(ErrorKind::argument, "this is no meshtween project: it has no project.json");
    const fs::path nowhere = "/"; // to learn the models' names, before there is a folder
    const Project first = project_from_json(json_or_discarded<Json>(described->bytes), nowhere);
    const std::string name = first.source.path.empty()
                                 ? "project"
                                 : first.source.path.stem().string() + "-" + first.target.path.stem().string();
    const fs::path folder = fs::canonical(fresh_folder(shelf_, name));
    try {
        const Access access(folder);
        for (const NamedBytes& file : files) {
            const fs::path place = plain_place(file.name);
            write_whole(access.place_for(place.parent_path().string(), place.filename().string()), file.bytes);
        }
        Project project = project_from_json(json_or_discarded<Json>(described->bytes), folder);
        find_models(project, folder);
        write_whole(folder / "project.json", to_json(project, folder).dump(2) + "\n");
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
        throw;
    }
    return folder.filename().string();
}

// A file with these bytes that was opened before, or an empty path.
fs::path Session::model_in_reach(const std::string& hash) const {
    {
        const std::lock_guard lock(mutex_);
        for (const Side side : {Side::source, Side::target})
            if (const auto& mesh = work_->open.on(side); mesh && mesh->hash == hash && !changed_on_disk(*mesh))
                return mesh->path;
    }
    return model_with(shelf_, hash);
}

// The models of a project that came from elsewhere: those that came with it, else those that were opened before,
// whatever their path was. They are read here, so that a project that cannot be worked with does not begin.
void Session::find_models(Project& project, const fs::path& folder) const {
    const Access access(folder);
    project.named.clear();
    for (const Side side : {Side::source, Side::target}) {
        MeshFile& file = project.file(side);
        if (file.path.empty()) continue;
        const std::string name = file.path.filename().string();
        fs::path there = file.path;
        if (access.holds(there)) there = folder / plain_place(there.lexically_relative(folder)); // as it was written
        if (!access.holds(there) || !fs::is_regular_file(there)) {
            const bool named = opened_.contains(fs::weakly_canonical(there)) && fs::is_regular_file(there);
            if (!named) there = model_in_reach(file.hash);
            if (there.empty())
                throw Error(
                    ErrorKind::file,
                    fmt::format("the project's {} is {}; open that file first, then the project", name_of(side), name));
            if (Access(shelf_).holds(there)) { // another project's own copy
                const fs::path copy = access.place_for("models/" + file.hash, name);
                fs::copy_file(there, copy, fs::copy_options::skip_existing);
                there = copy;
            }
        }
        file = {there, open_as(there, name)->hash};
    }
}

Json Session::projects() const {
    const fs::path now = file();
    Json list = recent_projects(shelf_);
    for (Json& one : list) one["open"] = shelf_ / one["id"].get<std::string>() / "project.json" == now;
    return list;
}

std::string Session::project_picture(const std::string& id) const {
    const fs::path picture = picture_file(project_with(shelf_, id));
    if (!fs::is_regular_file(picture) || fs::is_symlink(picture))
        throw Error(ErrorKind::argument, "that project has no picture");
    return read_whole(picture);
}

} // namespace meshtween::studio
