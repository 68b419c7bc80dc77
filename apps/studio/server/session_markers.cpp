// Markers from and to files, guesses and suggestions.
#include "session.h"
#include "suggest.h"

#include "meshtween/core/error.h"
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
    fs::path path(std::string_view name) const { return folder_ / plain_name(name); }

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

} // namespace

Json Session::import_markers(std::string_view name, const std::string& bytes, std::string_view second_name,
                             const std::string& second_bytes) const {
    const Open open = both();
    const Moment moment;
    const fs::path file = moment.path(name);
    write_whole(file, bytes);
    MarkerPairs read;
    try {
        if (second_name.empty()) {
            read = read_marker_pairs(file, open.source->mesh, open.target->mesh);
        } else {
            const fs::path second = moment.path("target-" + plain_name(second_name));
            write_whole(second, second_bytes);
            read = read_marker_pairs(file, second, open.source->mesh, open.target->mesh);
        }
    } catch (const Error& error) {
        throw Error(error.kind(), without(error.what(), file.parent_path().string() + "/"));
    }
    Json pairs = Json::array(), notes = Json::array();
    for (const MarkerPair& pair : read.pairs)
        pairs.push_back({{"name", pair.name}, {"source", list(pair.source)}, {"target", list(pair.target)}});
    for (const std::string& note : read.notes) notes.push_back(without(note, file.parent_path().string() + "/"));
    return {{"pairs", pairs}, {"notes", notes}};
}

std::string Session::export_markers(const std::string& extension) const {
    std::vector<MarkerPair> pairs;
    {
        const std::lock_guard lock(mutex_);
        pairs = complete_pairs(project_.markers);
    }
    const Moment moment;
    const fs::path file = moment.path("markers." + plain_name(extension));
    write_marker_pairs(pairs, file);
    return read_whole(file);
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
        pairs = complete_pairs(project_.markers);
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
        markers = project_.markers;
        fit = fitted_ ? fitted_->summary : Json();
    }
    return next_places(*open.source, markers, fit);
}

} // namespace meshtween::studio
