#include "session.h"

#include "options.h"
#include "suggest.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <algorithm>

namespace meshtween::studio {
namespace fs = std::filesystem;

Session::Session(const fs::path& project_file, const std::vector<fs::path>& opened, Events& events)
    : file_(fs::absolute(project_file)), events_(events), access_(file_.parent_path()), jobs_(events) {
    file_ = access_.folder() / file_.filename();
    for (const fs::path& file : opened) access_.open(file);
    if (fs::exists(file_)) {
        const Json json = Json::parse(read_whole(file_), nullptr, false);
        try {
            project_ = project_from_json(json, access_.folder());
        } catch (const Error& error) {
            throw Error(ErrorKind::file, fmt::format("{}: {}; move it away or name another with --project",
                                                     file_.string(), error.what()));
        }
        // A project in our own state folder was written by this program: its meshes were opened by the user before.
        if (access_.folder().parent_path() == fs::weakly_canonical(state_folder()))
            for (const Side side : {Side::source, Side::target})
                if (!project_.file(side).path.empty()) access_.open(project_.file(side).path);
    }
    if (opened.size() == 2) {
        project_.source.path = fs::absolute(opened[0]);
        project_.target.path = fs::absolute(opened[1]);
    }
    restore();
}

Session::~Session() = default;

// Opens what the project names. What has changed or gone is told, never fatal.
void Session::restore() {
    for (const Side side : {Side::source, Side::target}) {
        MeshFile& file = project_.file(side);
        if (file.path.empty()) continue;
        try {
            slot(side) = open_mesh(access_.checked(file.path));
            if (!file.hash.empty() && file.hash != slot(side)->hash) {
                notes_.push_back(fmt::format("{} has changed since the project was saved; look at its markers",
                                             file.path.filename().string()));
                project_.fit = nullptr;
            }
            file.hash = slot(side)->hash;
        } catch (const std::exception& error) {
            notes_.push_back(error.what());
        }
    }
    if (project_.fit.is_object() && project_.fit.contains("guards") && open_.source && open_.target &&
        fs::exists(fitted_file())) {
        try {
            Mesh saved = read_mesh(access_.checked(fitted_file()));
            if (saved.positions.rows() == open_.source->mesh.positions.rows()) {
                auto fitted = std::make_shared<Fitted>(shown(*open_.source, *open_.target, std::move(saved.positions)));
                fitted->summary = project_.fit;
                fitted_ = fitted;
            }
        } catch (const Error& error) {
            notes_.push_back(error.what());
        }
    }
    if (!fitted_) project_.fit = nullptr;
    save_locked();
}

fs::path Session::fitted_file() const {
    return fs::path(file_).replace_extension(".fitted.ply");
}

void Session::save_locked() const {
    write_whole(file_, to_json(project_, access_.folder()).dump(2) + "\n");
}

Json Session::project_json() const {
    const std::lock_guard lock(mutex_);
    return to_json(project_, access_.folder());
}

Json Session::state() const {
    const std::lock_guard lock(mutex_);
    Json paths = Json::array();
    for (const auto& [key, path] : paths_) paths.push_back(told(key, *path));
    Json offered = Json::array();
    for (const SampleInfo& info : samples())
        offered.push_back({{"name", info.name}, {"description", info.description}});
    Json state{{"project", {{"file", file_.string()}, {"folder", access_.folder().string()}}},
               {"document",
                {{"markers", to_json(project_.markers)},
                 {"symmetry", project_.symmetry},
                 {"timing", project_.timing},
                 {"options", project_.options}}},
               {"meshes",
                {{"source", open_.source ? to_json(*open_.source) : Json()},
                 {"target", open_.target ? to_json(*open_.target) : Json()}}},
               {"fit", fitted_ ? fitted_->summary : Json()},
               {"fit_is_of_these_markers", fitted_ && fitted_->summary.value("mark", "") == mark_of(project_.markers)},
               {"paths", paths},
               {"job", jobs_.status()},
               {"schema", {{"fit", fit_schema()}, {"morph", morph_schema()}}},
               {"samples", offered},
               {"mesh_formats", mesh_extensions()},
               {"notes", notes_}};
    if (open_.source && open_.target)
        state["result_frame"] = to_json(frame_of(open_.source->mesh.positions, open_.target->mesh.positions));
    return state;
}

Session::Open Session::both() const {
    const std::lock_guard lock(mutex_);
    if (!open_.source || !open_.target) throw Error(ErrorKind::argument, "open a source and a target first");
    return open_;
}

std::shared_ptr<const Fitted> Session::need_fit() const {
    const std::lock_guard lock(mutex_);
    if (!fitted_) throw Error(ErrorKind::argument, "there is no fit yet; place three markers at least and fit");
    return fitted_;
}

void Session::drop_fit_locked() {
    fitted_ = nullptr;
    paths_.clear();
    project_.fit = nullptr;
}

void Session::set_mesh(Side side, std::shared_ptr<const OpenMesh> mesh) {
    if (jobs_.running()) throw Error(ErrorKind::argument, "a job is running; cancel it first");
    {
        const std::lock_guard lock(mutex_);
        project_.file(side) = {mesh->path, mesh->hash};
        slot(side) = std::move(mesh);
        drop_fit_locked();
        notes_.clear();
        save_locked();
    }
    events_.publish("state", {{"why", "mesh"}});
}

void Session::open(Side side, const fs::path& file) {
    fs::path real;
    {
        const std::lock_guard lock(mutex_);
        real = access_.checked(file);
    }
    set_mesh(side, open_mesh(real));
}

void Session::open_upload(Side side, std::string_view name, const std::string& bytes) {
    const std::string plain = plain_name(name);
    if (fs::path(plain).extension() == ".gltf") { // it may name other files, anywhere
        const Json gltf = Json::parse(bytes, nullptr, false);
        const auto refers = [&](const char* list) {
            if (!gltf.is_object() || !gltf.contains(list) || !gltf[list].is_array()) return false;
            return std::any_of(gltf[list].begin(), gltf[list].end(), [](const Json& item) {
                if (!item.is_object() || !item.contains("uri")) return false;
                return !item["uri"].is_string() || !item["uri"].get<std::string>().starts_with("data:");
            });
        };
        if (refers("buffers") || refers("images"))
            throw Error(ErrorKind::file, plain + " keeps its data in other files; save it as .glb, or open it from the "
                                                 "command line: meshtween studio SOURCE TARGET");
    }
    fs::path file;
    {
        const std::lock_guard lock(mutex_);
        file = access_.place_for(fmt::format("models/{}", name_of(side)), plain);
    }
    const fs::path trial = file.parent_path() / ("new." + plain); // what cannot be read replaces nothing
    write_whole(trial, bytes);
    try {
        open_mesh(trial);
    } catch (const Error& error) {
        fs::remove(trial);
        std::string told = error.what();
        for (const std::string& part : {trial.string(), trial.filename().string()})
            if (const std::size_t at = told.find(part); at != std::string::npos) told.replace(at, part.size(), plain);
        throw Error(error.kind(), told);
    } catch (...) {
        std::error_code ignored;
        fs::remove(trial, ignored);
        throw;
    }
    fs::rename(trial, file);
    set_mesh(side, open_mesh(file));
}

void Session::open_sample(const std::string& name, bool with_markers) {
    const Sample made = sample(name);
    fs::path source, target;
    {
        const std::lock_guard lock(mutex_);
        source = access_.place_for("models", made.name + "_source.ply");
        target = access_.place_for("models", made.name + "_target.ply");
    }
    write_mesh(made.source, source);
    write_mesh(made.target, target);
    set_mesh(Side::source, open_mesh(source));
    set_mesh(Side::target, open_mesh(target));
    std::vector<PlacedMarker> markers;
    for (std::size_t i = 0; with_markers && i < made.marker_names.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        markers.push_back({fmt::format("m{}", i + 1), made.marker_names[i], Point(made.marker_source.row(row)),
                           Point(made.marker_target.row(row)), false, ""});
    }
    {
        const std::lock_guard lock(mutex_);
        project_.markers = std::move(markers);
        save_locked();
    }
    events_.publish("state", {{"why", "document"}});
}

void Session::reload(Side side) {
    const std::shared_ptr<const OpenMesh> now = side == Side::source ? both().source : both().target;
    set_mesh(side, open_mesh(now->path));
}

void Session::set_document(const Json& document) {
    if (!document.is_object()) throw Error(ErrorKind::argument, "the document must be an object");
    std::vector<PlacedMarker> markers = markers_from_json(document.value("markers", Json::array()));
    const Json symmetry = document.value("symmetry", Json::object());
    const Json timing = document.value("timing", Json::object());
    const Json options = document.value("options", Json::object());
    if (!symmetry.is_object() || !timing.is_object() || !options.is_object())
        throw Error(ErrorKind::argument, "symmetry, timing and options must be objects");
    fit_options(options.value("fit", Json::object()));
    path_options(options.value("morph", Json::object()));
    const std::lock_guard lock(mutex_);
    project_.markers = std::move(markers);
    project_.symmetry = symmetry;
    project_.timing = timing;
    project_.options = options;
    save_locked();
}

void Session::open_project(const Json& json) {
    if (jobs_.running()) throw Error(ErrorKind::argument, "a job is running; cancel it first");
    {
        const std::lock_guard lock(mutex_);
        Project project = project_from_json(json, access_.folder());
        for (const Side side : {Side::source, Side::target}) {
            MeshFile& file = project.file(side);
            if (file.path.empty()) continue;
            try {
                access_.checked(file.path);
            } catch (const Error&) { // the same file may be open under another path
                const auto& now = slot(side);
                if (!now || now->hash != file.hash)
                    throw Error(ErrorKind::file, fmt::format("the project's {} is {}; open that file first, then the "
                                                             "project",
                                                             name_of(side), file.path.filename().string()));
                file = project_.file(side);
            }
        }
        project_ = std::move(project);
        open_ = {};
        fitted_ = nullptr;
        paths_.clear();
        project_.fit = nullptr;
        notes_.clear();
        restore();
    }
    events_.publish("state", {{"why", "project"}});
}

void Session::clear() {
    if (jobs_.running()) throw Error(ErrorKind::argument, "a job is running; cancel it first");
    {
        const std::lock_guard lock(mutex_);
        project_ = {};
        open_ = {};
        drop_fit_locked();
        notes_.clear();
        save_locked();
    }
    events_.publish("state", {{"why", "project"}});
}

Json Session::changes() const {
    Open open;
    {
        const std::lock_guard lock(mutex_);
        open = open_;
    }
    return {{"source", open.source && changed_on_disk(*open.source)},
            {"target", open.target && changed_on_disk(*open.target)}};
}

} // namespace meshtween::studio
