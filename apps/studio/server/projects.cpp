#include "projects.h"

#include "files.h"

#include "meshtween/core/error.h"
#include "meshtween/io/json_limits.h"
#include "meshtween/io/output.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_states = 10, longest_list = 60;

// A project's file on the disk that can be understood.
struct Found {
    fs::path file;
    fs::file_time_type saved;
    Project project;
};

std::vector<Found> projects_in(const fs::path& shelf) {
    std::vector<Found> found;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(shelf, failure)) {
        const fs::path file = entry.path() / "project.json";
        if (!fs::is_regular_file(file, failure)) continue;
        try {
            const Json json = json_or_discarded<Json>(read_whole(file));
            found.push_back({file, fs::last_write_time(file), project_from_json(json, file.parent_path())});
        } catch (const std::exception&) { // not ours, or of a later version: not in the list
            continue;
        }
    }
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.saved > b.saved; });
    return found;
}

// Milliseconds since 1970.
long long moment_of(fs::file_time_type time) {
    const auto since = std::chrono::file_clock::to_sys(time).time_since_epoch();
    return std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
}

std::size_t complete_in(const std::vector<PlacedMarker>& markers) {
    return std::size_t(std::count_if(markers.begin(), markers.end(),
                                     [](const PlacedMarker& marker) { return marker.source && marker.target; }));
}

fs::path states_folder(const fs::path& project) {
    return fs::path(project).replace_extension(".backups");
}

// The kept states, the last first.
std::vector<std::pair<fs::path, fs::file_time_type>> states_of(const fs::path& project) {
    std::vector<std::pair<fs::path, fs::file_time_type>> states;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(states_folder(project), failure))
        if (entry.is_regular_file(failure) && entry.path().extension() == ".json")
            states.emplace_back(entry.path(), fs::last_write_time(entry.path(), failure));
    std::sort(states.begin(), states.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    return states;
}

// Removes the state that is missed least: the one whose neighbours are the closest in time, for its age.
void thin_out(const fs::path& project) {
    auto states = states_of(project);
    while (states.size() > most_states) {
        std::size_t least = 1;
        double least_cost = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i + 1 < states.size(); ++i) {
            const auto between = states[i - 1].second - states[i + 1].second;
            const auto age = fs::file_time_type::clock::now() - states[i].second;
            const double cost = double(between.count()) / std::max(1.0, double(age.count()));
            if (cost < least_cost) least = i, least_cost = cost;
        }
        std::error_code ignored;
        fs::remove(states[least].first, ignored);
        states.erase(states.begin() + std::ptrdiff_t(least));
    }
}

bool is_of(const Project& project, const fs::path& source, const fs::path& target) {
    const auto same = [](const fs::path& a, const fs::path& b) {
        return !a.empty() && fs::weakly_canonical(a) == fs::weakly_canonical(b);
    };
    return same(project.source.path, source) && same(project.target.path, target);
}

} // namespace

fs::path fitted_file(const fs::path& project) {
    return fs::path(project).replace_extension(".fitted.ply");
}

fs::path history_file(const fs::path& project) {
    return fs::path(project).replace_extension(".history.json");
}

fs::path picture_file(const fs::path& project) {
    return fs::path(project).replace_extension(".png");
}

ProjectLock::ProjectLock(const fs::path& project) {
    const fs::path file = project.parent_path() / fmt::format(".{}.lock", project.filename().string());
    descriptor_ = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor_ < 0)
        throw Error(ErrorKind::file, fmt::format("{}: cannot write here", project.parent_path().string()));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor_);
        throw Error(ErrorKind::file, fmt::format("{} is open in another studio; close that one, or name another "
                                                 "project with --project",
                                                 project.string()));
    }
}

ProjectLock::~ProjectLock() {
    ::close(descriptor_);
}

fs::path fresh_folder(const fs::path& shelf, const std::string& name) {
    const std::time_t now = std::time(nullptr);
    const std::string stem = fmt::format("{}-{:%Y%m%d-%H%M%S}", plain_name(name), fmt::localtime(now));
    std::error_code failure;
    fs::create_directories(shelf, failure);
    for (int i = 1; i < 1000; ++i) {
        const fs::path folder = shelf / (i == 1 ? stem : fmt::format("{}-{}", stem, i));
        if (fs::create_directory(folder, failure)) return folder;
        if (failure) break;
    }
    throw Error(ErrorKind::file, fmt::format("{}: cannot make a folder here", shelf.string()));
}

fs::path project_with(const fs::path& shelf, const std::string& id) {
    const bool plain = !id.empty() && id != "." && id != ".." && id.find_first_of("/\\") == std::string::npos;
    const fs::path file = shelf / id / "project.json";
    if (!plain || !fs::is_regular_file(file)) throw Error(ErrorKind::argument, "there is no such project any more");
    return file;
}

Json recent_projects(const fs::path& shelf) {
    Json list = Json::array();
    for (const auto& [file, saved, project] : projects_in(shelf)) {
        if (project.source.path.empty() && project.target.path.empty() && project.markers.empty()) continue;
        list.push_back({{"id", file.parent_path().filename().string()},
                        {"source", project.source.path.filename().string()},
                        {"target", project.target.path.filename().string()},
                        {"markers", project.markers.size()},
                        {"complete", complete_in(project.markers)},
                        {"fitted", project.fit.is_object()},
                        {"saved", moment_of(saved)},
                        {"picture", fs::is_regular_file(picture_file(file))}});
        if (list.size() >= longest_list) break;
    }
    return list;
}

fs::path project_of(const fs::path& shelf, const fs::path& source, const fs::path& target) {
    for (const Found& found : projects_in(shelf))
        if (is_of(found.project, source, target)) return found.file;
    const std::string names = plain_name(source.stem().string()) + "-" + plain_name(target.stem().string());
    return fresh_folder(shelf, names) / "project.json";
}

fs::path model_with(const fs::path& shelf, const std::string& hash) {
    if (hash.empty()) return {};
    for (const Found& found : projects_in(shelf))
        for (const MeshFile& file : {found.project.source, found.project.target})
            if (file.hash == hash && fs::is_regular_file(file.path) && hash_of(file.path) == hash) return file.path;
    return {};
}

void keep_state(const fs::path& project) {
    std::error_code failure;
    const auto saved = fs::last_write_time(project, failure);
    // A state that did not stand for a second was on the way to another, as while a marker is dragged.
    if (failure || fs::file_time_type::clock::now() - saved < std::chrono::seconds(1)) return;
    const fs::path folder = states_folder(project);
    fs::create_directory(folder, failure);
    const auto moment = moment_of(saved);
    const fs::path kept =
        folder / fmt::format("{:%Y%m%d-%H%M%S}-{:03}.json", fmt::gmtime(std::time_t(moment / 1000)), moment % 1000);
    fs::create_hard_link(project, kept, failure); // the project's file is never changed in place
    if (failure) fs::copy_file(project, kept, fs::copy_options::skip_existing, failure);
    thin_out(project);
}

Json kept_states(const fs::path& project) {
    Json list = Json::array();
    for (const auto& [file, saved] : states_of(project)) {
        const Json json = json_or_discarded<Json>(read_whole(file));
        if (!json.is_object() || !json.contains("markers")) continue;
        list.push_back(
            {{"name", file.filename().string()}, {"saved", moment_of(saved)}, {"markers", json["markers"].size()}});
    }
    return list;
}

Project kept_state(const fs::path& project, const std::string& name) {
    for (const auto& [file, saved] : states_of(project))
        if (file.filename() == name)
            return project_from_json(json_or_discarded<Json>(read_whole(file)), project.parent_path());
    throw Error(ErrorKind::argument, "that state is no longer kept");
}

} // namespace meshtween::studio
