// What the page is told, and the document that it sends.
#include "session.h"

#include "options.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

namespace meshtween::studio {
namespace {

Json document_of(const Project& project, const std::filesystem::path& folder) {
    return {{"models", {{"source", to_json(project.source, folder)}, {"target", to_json(project.target, folder)}}},
            {"markers", to_json(project.markers)},
            {"symmetry", project.symmetry},
            {"timing", project.timing},
            {"options", project.options}};
}

// The parts of the document that are there, into the project; all but the models.
void take_document(const Json& document, Project& project) {
    if (!document.is_object()) throw Error(ErrorKind::argument, "the document must be an object");
    std::vector<PlacedMarker> markers = markers_from_json(document.value("markers", Json::array()));
    refuse_doubled_names(markers);
    const Json symmetry = document.value("symmetry", Json::object());
    const Json timing = document.value("timing", Json::object());
    const Json options = document.value("options", Json::object());
    if (!symmetry.is_object() || !timing.is_object() || !options.is_object())
        throw Error(ErrorKind::argument, "symmetry, timing and options must be objects");
    fit_options(options.value("fit", Json::object()));
    path_options(options.value("morph", Json::object()));
    project.markers = std::move(markers);
    project.symmetry = symmetry;
    project.timing = timing;
    project.options = options;
}

} // namespace

Session::~Session() = default;

void Session::save_locked(bool keep) {
    const std::string text =
        to_json(work_->project, work_->access.folder()).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (std::filesystem::is_regular_file(work_->file) && read_whole(work_->file) == text) return;
    if (keep) keep_state(work_->file);
    write_whole(work_->file, text);
}

Json Session::project_json() const {
    const std::lock_guard lock(mutex_);
    return to_json(work_->project, work_->access.folder());
}

Json Session::state() const {
    const std::lock_guard lock(mutex_);
    const Open& open = work_->open;
    const auto fitted = work_->fit();
    Json paths = Json::array();
    for (const auto& [key, path] : paths_) paths.push_back(told(key, *path));
    Json offered = Json::array();
    for (const SampleInfo& info : samples())
        offered.push_back({{"name", info.name}, {"description", info.description}});
    Json state{
        {"project",
         {{"number", number_},
          {"id", in_shelf(work_->file) ? work_->access.folder().filename().string() : ""},
          {"file", work_->file.string()},
          {"folder", work_->access.folder().string()}}},
        {"document", document_of(work_->project, work_->access.folder())},
        {"meshes",
         {{"source", open.source ? to_json(*open.source) : Json()},
          {"target", open.target ? to_json(*open.target) : Json()}}},
        {"fit", fitted ? fitted->summary : Json()},
        {"fit_is_of_these_markers", fitted && fitted->summary.value("mark", "") == mark_of(work_->project.markers)},
        {"paths", paths},
        {"job", jobs_.status()},
        {"schema", {{"fit", fit_schema()}, {"morph", morph_schema()}}},
        {"samples", offered},
        {"mesh_formats", readable_extensions()},
        {"notes", work_->notes}};
    if (open.source && open.target) state["result_frame"] = to_json(frame_of(open.source->mesh, open.target->mesh));
    return state;
}

Session::Open Session::both() const {
    const std::lock_guard lock(mutex_);
    if (!work_->open.source || !work_->open.target)
        throw Error(ErrorKind::argument, "open a source and a target first");
    return work_->open;
}

std::shared_ptr<const Fitted> Session::need_fit() const {
    const std::lock_guard lock(mutex_);
    const auto fitted = work_->fit();
    if (!fitted) throw Error(ErrorKind::argument, "there is no fit yet; place three markers at least and fit");
    return fitted;
}

void Session::need_rest() const {
    if (jobs_.running()) throw Error(ErrorKind::argument, "a job is running; cancel it first");
}

void Session::set_document(const Json& document, std::optional<int> number) {
    const std::lock_guard editing(editing_);
    Project next;
    Open open;
    const Work* work = nullptr;
    {
        const std::lock_guard lock(mutex_);
        if (number && *number != number_)
            throw Error(ErrorKind::argument, "another project is open by now; this one was saved before it was left");
        next = work_->project;
        open = work_->open;
        work = work_.get(); // stays: projects change under editing_
    }
    take_document(document, next);
    bool models_differ = false;
    for (const Side side : {Side::source, Side::target}) {
        if (!document.contains("models") || !document["models"].is_object()) continue;
        const MeshFile file =
            file_from_json(document["models"].value(std::string(name_of(side)), Json()), work->access.folder());
        if (file.path == next.file(side).path && file.hash == next.file(side).hash) continue;
        need_rest();
        open.on(side) = file.path.empty() ? nullptr : open_known(file, work->access);
        if (const auto& left = next.file(side).path; !left.empty() && !work->access.holds(left))
            next.named.insert(left);
        next.file(side) = file;
        models_differ = true;
    }
    {
        const std::lock_guard lock(mutex_);
        next.fit = work_->project.fit; // a fit may have ended meanwhile
        work_->project = std::move(next);
        if (models_differ) {
            for (const Side side : {Side::source, Side::target})
                if (work_->open.on(side) && work_->open.on(side) != open.on(side)) remember(work_->open.on(side));
            work_->open = open;
            work_->notes.clear();
            paths_.clear();
            bring_fit(*work_);
        }
        save_locked(true);
    }
    if (models_differ) events_.publish("state", {{"why", "models"}});
}

void Session::set_history(std::string_view history) {
    const std::lock_guard lock(mutex_);
    write_whole(history_file(work_->file), history);
}

std::string Session::history() const {
    const std::lock_guard lock(mutex_);
    const auto file = history_file(work_->file);
    return std::filesystem::is_regular_file(file) ? read_whole(work_->access.checked(file)) : std::string("null");
}

void Session::set_picture(std::string_view png) {
    if (!png.starts_with("\x89PNG")) throw Error(ErrorKind::argument, "a picture must be a PNG");
    const std::lock_guard lock(mutex_);
    write_whole(picture_file(work_->file), png);
}

Json Session::kept_states() const {
    const std::lock_guard lock(mutex_);
    return studio::kept_states(work_->file);
}

Json Session::kept_document(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    return document_of(kept_state(work_->file, name), work_->access.folder());
}

std::filesystem::path Session::file() const {
    const std::lock_guard lock(mutex_);
    return work_->file;
}

Json Session::changes() const {
    Open open;
    {
        const std::lock_guard lock(mutex_);
        open = work_->open;
    }
    return {{"source", open.source && changed_on_disk(*open.source)},
            {"target", open.target && changed_on_disk(*open.target)}};
}

} // namespace meshtween::studio
