// The long work: fit, path, export; and the buffers that show its results.
#include "options.h"
#include "session.h"
#include "timing.h"

#include "meshtween/app/outputs.h"
#include "meshtween/core/error.h"
#include "meshtween/fit/markers.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <chrono>

namespace meshtween::studio {
namespace {

constexpr CurveOptions played{1e-3, 17}; // of paths that are looked at
// Of files, as the command line makes them: nine tenths of the tolerance are the curve's, the rest is for playing it.
constexpr CurveOptions written_curve{curve_part * CurveOptions{}.tolerance, CurveOptions{}.max_nodes};

void start(Jobs& jobs, const std::string& kind, Jobs::Work work) {
    if (!jobs.start(kind, std::move(work)))
        throw Error(ErrorKind::argument, "another job is running; wait for it or cancel it");
}

std::string buffer(const Mesh& mesh, const Frame& frame, const std::string& what) {
    if (what == "positions") return position_bytes(mesh.positions, frame);
    if (what == "normals") return normal_bytes(mesh.positions, mesh.triangles);
    if (what == "triangles") return index_bytes(mesh.triangles);
    if (what == "colors") return color_bytes(mesh.colors);
    if (what == "uvs") return corner_uv_bytes(mesh);
    throw Error(ErrorKind::argument, "there is no such buffer");
}

// How a path is to be made.
struct PathWanted {
    KeyOptions options;
    Json timing;
};

PathWanted path_wanted(const Json& request) {
    return {path_options(request.value("options", Json::object())), request.value("timing", Json())};
}

KeyPath path_between(const Mesh& source, const Fitted& fitted, PathWanted wanted, const CurveOptions& curve,
                     const Progress& progress) {
    wanted.options.timing = painted_timing(wanted.timing, source);
    wanted.options.curve = curve;
    return key_path(source, {source.positions, fitted.mesh.positions}, wanted.options, progress);
}

// All on one scale, on which the longest has length 1: the page shows the direction of their weighted sum.
std::vector<std::string> drawn_normals(const Curve& curve, const Triangles& triangles) {
    const std::vector<Points> normals = control_normals(curve, triangles);
    double longest = 1;
    for (const Points& n : normals)
        if (n.rows() > 0) longest = std::max(longest, n.rowwise().norm().maxCoeff());
    std::vector<std::string> result;
    for (const Points& n : normals) result.push_back(direction_bytes(n / longest));
    return result;
}

} // namespace

Json told(const std::string& key, const PlayedPath& path) {
    return {{"key", key},
            {"asked", path.asked},
            {"meshes", path.curve.nodes.size()},
            {"degree", path.curve.basis.degree},
            {"knots", path.curve.basis.knots},
            {"deviation", path.curve.deviation},
            {"bent", path.repair.contacts},
            {"cuts_left", path.repair.left},
            {"frame", to_json(path.frame)}};
}

void Session::start_fit(const Json& values) {
    const std::lock_guard editing(editing_);
    const FitOptions options = fit_options(values);
    const Open open = both();
    std::vector<PlacedMarker> markers;
    {
        const std::lock_guard lock(mutex_);
        markers = work_->project.markers;
    }
    const std::size_t complete = complete_pairs(markers).size();
    if (options.method == FitMethod::paper && complete < 3)
        throw Error(ErrorKind::argument,
                    fmt::format("{} marker{} on both models; the paper's fit needs 3 at least, 30 to 50 serve well",
                                complete, complete == 1 ? " is" : "s are"));
    start(jobs_, "fit", [this, open, markers, options](const Progress& progress) {
        return run_fit(open, markers, options, progress);
    });
}

// Lets the page see the mesh move: a copy a few times a second, fetched by the page when it is told of it.
std::function<void(const Points&)> Session::show_live() {
    return [this, last = std::chrono::steady_clock::time_point()](const Points& positions) mutable {
        const auto now = std::chrono::steady_clock::now();
        if (now - last < std::chrono::milliseconds(200)) return;
        last = now;
        {
            const std::lock_guard lock(mutex_);
            live_ = std::make_shared<const Points>(positions);
        }
        events_.publish("live", nullptr);
    };
}

Json Session::run_fit(const Open& open, const std::vector<PlacedMarker>& markers, FitOptions options,
                      const Progress& progress) {
    keep_going(progress, 0, "placing the markers");
    options.watch = show_live();
    {
        const std::lock_guard lock(mutex_);
        live_ = nullptr;
        live_frame_ = frame_of(open.source->mesh, open.target->mesh);
    }
    const FitResult result =
        fit(open.source->mesh, open.target->mesh, place_markers(complete_pairs(markers), open.source->mesh), options,
            part_of(progress, 0, 0.8));
    if (result.end == FitEnd::cancelled || !keep_going(progress, 0.8, "measuring")) return nullptr;
    auto fitted =
        std::make_shared<Fitted>(examined(*open.source, *open.target, result, markers, part_of(progress, 0.8, 0.95)));
    if (!keep_going(progress, 0.95, "saving")) return nullptr;
    write_mesh(fitted->mesh, fitted_file(file()));
    Json summary = fitted->summary;
    {
        const std::lock_guard lock(mutex_);
        work_->fitted = std::move(fitted);
        paths_.clear();
        work_->project.fit = summary;
        save_locked();
    }
    return summary;
}

void Session::start_path(const Json& request) {
    if (!request.is_object()) throw Error(ErrorKind::argument, "a path needs its options");
    const PathWanted wanted = path_wanted(request);
    const std::lock_guard editing(editing_);
    const Open open = both();
    const auto fitted = need_fit();
    const std::string asked = request.dump(), key = hash_of_bytes(asked);
    start(jobs_, "morph", [this, open, fitted, wanted, asked, key](const Progress& progress) -> Json {
        KeyPath found = path_between(open.source->mesh, *fitted, wanted, played, progress);
        if (found.curve.cancelled || !keep_going(progress, 1, "finding the path")) return nullptr;
        auto path = std::make_shared<PlayedPath>();
        path->asked = asked;
        path->frame = frame_of(open.source->mesh, open.target->mesh);
        path->curve = std::move(found.curve);
        path->normals = drawn_normals(path->curve, open.source->mesh.triangles);
        path->repair = found.repair;
        const std::lock_guard lock(mutex_);
        if (work_->fit() != fitted) throw Error(ErrorKind::computation, "the fit changed meanwhile; ask again");
        paths_[key] = path;
        return told(key, *path);
    });
}

void Session::start_export(const Json& request) {
    if (!request.is_object() || !request.contains("names") || !request["names"].is_array() || request["names"].empty())
        throw Error(ErrorKind::argument, "an export needs names of files");
    const PathWanted wanted = path_wanted(request);
    const Json frames_value = request.value("frames", Json(11));
    const int frames = frames_value.is_number_integer() ? frames_value.get<int>() : 0;
    if (frames < 2 || frames > 100000) throw Error(ErrorKind::argument, "frames must lie between 2 and 100000");
    const std::lock_guard editing(editing_);
    const Open open = both();
    const auto fitted = need_fit();
    std::vector<MarkerPair> pairs;
    std::vector<Output> outputs;
    {
        const std::lock_guard lock(mutex_);
        pairs = complete_pairs(work_->project.markers);
        for (const Json& name : request["names"]) {
            if (!name.is_string()) throw Error(ErrorKind::argument, "names must be text");
            outputs.push_back(output(work_->access.place_for("exports", name.get<std::string>()).string()));
        }
    }
    start(jobs_, "export", [open, fitted, wanted, frames, pairs, outputs](const Progress& progress) -> Json {
        keep_going(progress, 0, "preparing");
        std::vector<Output> stills, plays;
        for (const Output& out : outputs) (out.kind == OutputKind::mesh ? stills : plays).push_back(out);
        Json files = Json::array();
        const auto tell = [&](const Written& written) {
            for (const auto& file : written.files) files.push_back(file.filename().string());
        };
        if (!stills.empty() && !keep_going(progress, 0, "writing the fitted mesh")) return nullptr;
        if (!stills.empty()) tell(write_still(fitted->mesh, "source's mesh on the target", {}, stills));
        if (!plays.empty()) {
            const Mesh& source = open.source->mesh;
            Playable playable;
            playable.path = path_between(source, *fitted, wanted, written_curve, part_of(progress, 0, 0.7)).curve;
            if (playable.path.cancelled) return nullptr;
            playable.mesh = source;
            playable.mesh.positions = playable.path.nodes.front();
            playable.frames = frames;
            playable.play.title = open.source->path.stem().string() + " to " + open.target->path.stem().string();
            playable.ends_before = true;
            playable.before = {{"source", source, side_of_pairs(pairs, Side::source)},
                               {"target", open.target->mesh, side_of_pairs(pairs, Side::target)},
                               {"source's mesh on the target", fitted->mesh, {}}};
            tell(write_outputs(playable, plays, part_of(progress, 0.7, 1)));
        }
        return {{"files", files}, {"folder", outputs.front().path.parent_path().string()}};
    });
}

void Session::cancel() {
    jobs_.cancel();
}

void Session::wait() {
    jobs_.wait();
}

std::filesystem::path Session::exported(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    const auto file = work_->access.checked(work_->access.place_for("exports", name));
    if (!std::filesystem::is_regular_file(file)) throw Error(ErrorKind::file, "there is no export " + plain_name(name));
    return file;
}

std::string Session::mesh_buffer(Side side, const std::string& what) const {
    std::shared_ptr<const OpenMesh> open;
    {
        const std::lock_guard lock(mutex_);
        open = work_->open.on(side);
    }
    if (!open) throw Error(ErrorKind::argument, fmt::format("no {} is open", name_of(side)));
    return buffer(open->mesh, open->frame, what);
}

std::string Session::fitted_buffer(const std::string& what) const {
    const auto fitted = need_fit();
    if (what == "distance") return value_bytes(fitted->distance);
    if (what == "stretch") return value_bytes(fitted->stretch);
    if (what == "trust")
        return value_bytes(Eigen::Map<const Eigen::VectorXd>(fitted->map.trust.data(), std::ssize(fitted->map.trust)));
    const Open open = both();
    return buffer(fitted->mesh, frame_of(open.source->mesh, open.target->mesh), what);
}

std::string Session::live_positions() const {
    std::shared_ptr<const Points> live;
    Frame frame;
    {
        const std::lock_guard lock(mutex_);
        live = live_;
        frame = live_frame_;
    }
    return live ? position_bytes(*live, frame) : std::string();
}

std::string Session::path_buffer(const std::string& key, std::size_t node, const std::string& what) const {
    std::shared_ptr<const PlayedPath> path;
    std::shared_ptr<const OpenMesh> source;
    {
        const std::lock_guard lock(mutex_);
        const auto found = paths_.find(key);
        if (found != paths_.end()) path = found->second;
        source = work_->open.source;
    }
    if (!path || !source || node >= path->curve.nodes.size())
        throw Error(ErrorKind::argument, "there is no such path; ask for it again");
    if (what == "positions") return position_bytes(path->curve.nodes[node], path->frame);
    if (what == "normals") return path->normals[node];
    throw Error(ErrorKind::argument, "there is no such buffer");
}

} // namespace meshtween::studio
