// Models of the open project: those dropped, those read again, and what becomes of their markers.
#include "session.h"

#include "meshtween/core/error.h"
#include "meshtween/io/json_limits.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <algorithm>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

constexpr double reach = 0.03; // of the diagonal: markers as far as this are carried over
constexpr std::size_t most_known = 4;

// A .gltf may name other files, anywhere.
void refuse_references(const std::string& name, const std::string& bytes) {
    const auto gltf = json_or_discarded<nlohmann::json>(bytes);
    const auto refers = [&](const char* list) {
        if (!gltf.is_object() || !gltf.contains(list) || !gltf[list].is_array()) return false;
        return std::any_of(gltf[list].begin(), gltf[list].end(), [](const nlohmann::json& item) {
            if (!item.is_object() || !item.contains("uri")) return false;
            return !item["uri"].is_string() || !item["uri"].get<std::string>().starts_with("data:");
        });
    };
    if (refers("buffers") || refers("images"))
        throw Error(ErrorKind::file, name + " keeps its data in other files; save it as .glb, or open it from the "
                                            "command line: meshtween studio SOURCE TARGET");
}

Json examined_model(const OpenMesh& mesh, const std::vector<PlacedMarker>& markers, Side side, const fs::path& folder) {
    Json told = to_json(mesh);
    told["model"] = to_json(MeshFile{mesh.path, mesh.hash}, folder);
    told["carried"] = carried(markers, side, mesh);
    return told;
}

} // namespace

Json carried(const std::vector<PlacedMarker>& markers, Side side, const OpenMesh& to) {
    Json list = Json::array();
    for (const PlacedMarker& marker : markers) {
        const auto& at = marker.on(side);
        if (!at) continue;
        const ClosestPoint closest = to.index.closest(*at);
        const double distance = std::sqrt(closest.squared_distance) / to.frame.scale;
        const Point there = distance < 1e-9 ? *at : position(to.mesh.positions, to.mesh.triangles, closest.where);
        Json place;
        if (distance <= reach) place = {there[0], there[1], there[2]};
        list.push_back({{"id", marker.id}, {"at", place}});
    }
    return list;
}

void Session::remember(std::shared_ptr<const OpenMesh> mesh) {
    std::erase_if(known_, [&](const auto& one) { return one->path == mesh->path && one->hash == mesh->hash; });
    known_.push_front(std::move(mesh));
    if (known_.size() > most_known) known_.pop_back();
}

std::shared_ptr<const OpenMesh> Session::open_known(const MeshFile& file, const Access& access) {
    const fs::path real = access.checked(file.path);
    {
        const std::lock_guard lock(mutex_);
        for (const auto& known : known_)
            if (known->hash == file.hash && fs::weakly_canonical(known->path) == real) return known;
    }
    const std::string name = file.path.filename().string();
    if (!fs::is_regular_file(real))
        throw Error(ErrorKind::file, fmt::format("{} is gone: {}", name, file.path.parent_path().string()));
    auto mesh = open_mesh(real);
    if (!file.hash.empty() && mesh->hash != file.hash)
        throw Error(ErrorKind::file,
                    fmt::format("{} has changed on disk; what it was before is not there any more", name));
    return mesh;
}

Json Session::add_model(Side side, std::string_view name, const std::string& bytes) {
    const std::lock_guard editing(editing_);
    const std::string plain = plain_name(name);
    if (fs::path(plain).extension() == ".gltf") refuse_references(plain, bytes);
    // Files with other contents lie in other folders: what undo brings back is never written over.
    fs::path file;
    {
        const std::lock_guard lock(mutex_);
        file = work_->access.place_for("models/" + hash_of_bytes(bytes), plain);
    }
    const bool known = fs::exists(file);
    if (!known) write_whole(file, bytes);
    std::shared_ptr<const OpenMesh> mesh;
    try {
        mesh = open_as(file, plain);
    } catch (...) {
        std::error_code ignored;
        if (!known) fs::remove(file, ignored), fs::remove(file.parent_path(), ignored); // the folder where it is empty
        throw;
    }
    const std::lock_guard lock(mutex_);
    remember(mesh);
    return examined_model(*mesh, work_->project.markers, side, work_->access.folder());
}

Json Session::examine_again(Side side) {
    const std::lock_guard editing(editing_);
    std::shared_ptr<const OpenMesh> now;
    {
        const std::lock_guard lock(mutex_);
        now = work_->open.on(side);
    }
    if (!now) throw Error(ErrorKind::argument, fmt::format("no {} is open", name_of(side)));
    auto mesh = open_mesh(now->path);
    const std::lock_guard lock(mutex_);
    remember(mesh);
    return examined_model(*mesh, work_->project.markers, side, work_->access.folder());
}

std::string Session::model_bytes(Side side) const {
    fs::path file;
    {
        const std::lock_guard lock(mutex_);
        if (!work_->open.on(side)) throw Error(ErrorKind::argument, fmt::format("no {} is open", name_of(side)));
        file = work_->access.checked(work_->open.on(side)->path);
    }
    return read_whole(file);
}

std::string Session::fitted_bytes() const {
    need_fit();
    const std::lock_guard lock(mutex_);
    return read_whole(work_->access.checked(fitted_file(work_->file)));
}

} // namespace meshtween::studio
