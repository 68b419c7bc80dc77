// Markers from and to files, guesses and suggestions.
#include "import.h"
#include "session.h"
#include "suggest.h"

#include "meshtween/core/error.h"
#include "meshtween/io/marker_distance.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

// A folder for a moment: the marker readers and writers of the library work on files.
class Moment {
public:
    Moment() {
        std::string name = (fs::temp_directory_path() / "meshtween-studio-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw Error(ErrorKind::file, fs::temp_directory_path().string() + ": cannot make a folder here");
        folder_ = name;
    }
    ~Moment() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    Moment(const Moment&) = delete;
    Moment& operator=(const Moment&) = delete;
    fs::path path(const std::string& folder, std::string_view name) const {
        fs::create_directory(folder_ / folder);
        return folder_ / folder / plain_name(name);
    }

private:
    fs::path folder_;
};

std::string without(std::string text, const std::string& part) {
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos;) text.erase(at, part.size());
    return text;
}

Json list(const Point& p) {
    return {p[0], p[1], p[2]};
}

Json list(const std::optional<Point>& p) {
    return p ? list(*p) : Json();
}

} // namespace

Json Session::import_markers(const std::vector<NamedBytes>& files, std::optional<Side> side) const {
    if (files.empty() || files.size() > 2) throw Error(ErrorKind::argument, "one file of markers or two are needed");
    const Open open = both();
    const Moment moment;
    std::vector<fs::path> paths{{}, {}};
    for (std::size_t i = 0; i < files.size(); ++i) {
        // A folder a file: the two may have one name.
        paths[i] = moment.path(std::to_string(i), files[i].name);
        write_whole(paths[i], files[i].bytes);
    }
    const auto plain = [&](std::string text) {
        for (const fs::path& path : paths)
            if (!path.empty()) text = without(std::move(text), path.parent_path().string() + "/");
        return text;
    };
    ImportedMarkers read;
    try {
        read = studio::import_markers(paths[0], paths[1], side, *open.source, *open.target);
    } catch (const Error& error) {
        throw Error(error.kind(), plain(error.what()));
    }
    Json markers = Json::array(), notes = Json::array();
    for (const PartialPair& one : read.markers)
        markers.push_back({{"name", one.name}, {"source", list(one.source)}, {"target", list(one.target)}});
    for (const std::string& note : read.notes) notes.push_back(plain(note));
    return {{"markers", markers}, {"notes", notes}, {"ask_side", read.ask_side}};
}

Json Session::export_markers(const std::string& format) const {
    Open open;
    std::vector<PartialPair> pairs;
    {
        const std::lock_guard lock(mutex_);
        open = work_->open;
        const auto& markers = work_->project.markers;
        for (std::size_t i = 0; i < markers.size(); ++i)
            if (markers[i].source || markers[i].target)
                pairs.push_back({markers[i].name.empty() ? std::to_string(i + 1) : markers[i].name, markers[i].source,
                                 markers[i].target});
    }
    const Mesh* source = open.source ? &open.source->mesh : nullptr;
    const Mesh* target = open.target ? &open.target->mesh : nullptr;
    const std::string ending = plain_name(format);
    const Moment moment;
    std::vector<fs::path> paths{moment.path("0", "markers." + ending)};
    std::vector<std::string> notes;
    if (holds_both_sides(paths[0])) {
        notes = write_markers(pairs, paths[0], source, target);
    } else {
        paths = {moment.path("0", "markers-source." + ending), moment.path("0", "markers-target." + ending)};
        notes = write_markers(pairs, paths[0], paths[1], source, target);
    }
    Json files = Json::array();
    for (const fs::path& path : paths)
        files.push_back({{"name", path.filename().string()}, {"text", read_whole(path)}});
    return {{"files", files}, {"notes", notes}};
}

Json Session::marker_warnings() const {
    Open open;
    std::vector<MarkerPair> pairs;
    {
        const std::lock_guard lock(mutex_);
        open = work_->open;
        pairs = complete_pairs(work_->project.markers);
    }
    if (!open.source || !open.target) return Json::array();
    return far_markers(pairs, open.source->mesh, open.target->mesh);
}

Pose Session::known_pose(const Open& open) const {
    const std::lock_guard lock(pose_mutex_);
    const std::string meshes = open.source->hash + open.target->hash;
    if (pose_of_ != meshes) {
        pose_ = pose_of(*open.source, *open.target);
        pose_of_ = meshes;
    }
    return pose_;
}

Json Session::guesses(Side from, const Json& points) const {
    const Open open = both();
    std::vector<MarkerPair> pairs;
    {
        const std::lock_guard lock(mutex_);
        pairs = complete_pairs(work_->project.markers);
    }
    if (!points.is_array() || points.size() > 5000)
        throw Error(ErrorKind::argument, "points must be a list of at most 5000");
    const Pose pose = pairs.size() < 3 ? known_pose(open) : Pose();
    Json answers = Json::array();
    for (const Json& point : points) {
        if (!point.is_array() || point.size() != 3 || !point[0].is_number() || !point[1].is_number() ||
            !point[2].is_number())
            throw Error(ErrorKind::argument, "a point is three numbers");
        const Point at(point[0].get<double>(), point[1].get<double>(), point[2].get<double>());
        if (!at.allFinite()) throw Error(ErrorKind::argument, "a point is three finite numbers");
        answers.push_back(list(guess(from == Side::source ? *open.target : *open.source, pose, pairs, from, at)));
    }
    return answers;
}

Json Session::suggestions() const {
    const Open open = both();
    std::vector<PlacedMarker> markers;
    Json fit;
    {
        const std::lock_guard lock(mutex_);
        markers = work_->project.markers;
        fit = work_->fit() ? work_->fit()->summary : Json();
    }
    return next_places(*open.source, markers, fit);
}

} // namespace meshtween::studio
