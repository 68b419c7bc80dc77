#include "meshtween/app/outputs.h"

#include "meshtween/app/fading.h"
#include "meshtween/app/film.h"
#include "meshtween/app/path_plot.h"
#include "meshtween/app/usd_morph.h"
#include "meshtween/core/error.h"
#include "meshtween/fit/faded_look.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace meshtween {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension;
}

bool is_mesh_extension(const std::string& extension) {
    const auto& known = mesh_extensions();
    return std::find(known.begin(), known.end(), extension) != known.end();
}

Mesh with_positions(const Mesh& mesh, Points positions) {
    Mesh moved = mesh;
    moved.positions = std::move(positions);
    return moved;
}

// Every frame of a sequence says the same: once is enough.
void note(Written& written, const std::vector<std::string>& notes, bool first = true) {
    if (first) written.notes.insert(written.notes.end(), notes.begin(), notes.end());
}

// The shape at a place of the path, with its look there.
Mesh shown_at(const Playable& playable, double u) {
    const Mesh mesh = with_positions(playable.mesh, playable.path.at(u));
    return playable.other ? faded_look(mesh, *playable.other, u) : mesh;
}

bool pictures_fade(const Playable& playable) {
    return playable.other && (shows_materials(playable.mesh) || shows_materials(*playable.other));
}

std::string played(const Playable& playable, const WeightKeys& keys) {
    const auto dressed = [&](const Mesh& mesh) { return morph_glb(mesh, playable.path, keys, playable.play.title); };
    if (!playable.other) return dressed(playable.mesh);
    Mesh from = playable.mesh, to = *playable.other;
    const bool pictures = pictures_fade(playable);
    if (!pictures)
        for (Mesh* mesh : {&from, &to})
            if (mesh->colors.rows() == 0) mesh->colors = plain_colors(mesh->positions.rows());
    return fading_glb(dressed(from), dressed(to), shares_of_u(playable.path),
                      pictures ? Fading::cover : Fading::colors);
}

Film film_of(const Playable& playable) {
    constexpr int steps = 8; // from key to key
    const std::vector<double>& keys = playable.path.keys;
    std::vector<Points> examples;
    for (std::size_t p = 0; p + 1 < keys.size(); ++p)
        for (int i = p == 0 ? 0 : 1; i <= steps; ++i)
            examples.push_back(playable.path.at(keys[p] + (keys[p + 1] - keys[p]) * i / steps));
    return {playable.mesh, examples, 420, playable.other.get()};
}

void write_sequence(const Playable& playable, const std::filesystem::path& pattern, const Progress& progress,
                    Written& written) {
    const std::vector<double> times = frame_times(playable.frames, playable.order);
    std::optional<Film> film;
    if (lower_extension(pattern) == ".png") film = film_of(playable);
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!keep_going(progress, double(i) / double(times.size()), "writing frames")) {
            written.cancelled = true;
            return;
        }
        const auto path = numbered(pattern, static_cast<int>(i));
        const double u = ease(playable.play.ease, times[i]);
        if (film)
            write_png(film->frame(playable.path.at(u), u), path);
        else
            note(written, write_mesh(shown_at(playable, u), path, playable.writing), i == 0);
        written.files.push_back(path);
    }
    if (!film && pictures_fade(playable))
        written.notes.push_back(pattern.string() + ": a picture cannot fade from file to file; before the middle the "
                                                   "frames have the first look, then the second");
}

// It repeats for ever: there and back, unless the path is closed or shall jump. False where it was cancelled.
bool write_film(const Playable& playable, const std::filesystem::path& path, const Progress& progress) {
    const bool back = playable.order == FrameOrder::there && playable.play.ping_pong;
    const std::vector<double> times = frame_times(playable.frames, back ? FrameOrder::and_back : playable.order);
    const Film film = film_of(playable);
    std::vector<Image> images;
    for (const double time : times) {
        if (!keep_going(progress, double(images.size()) / double(times.size()), "drawing")) return false;
        const double u = ease(playable.play.ease, time);
        images.push_back(film.frame(playable.path.at(u), u));
    }
    write_animated_png(images, playable.play.seconds / std::max(1, playable.frames - 1), path);
    return true;
}

// False where it was cancelled; then nothing is written.
bool write_tiles(const std::vector<Tile>& tiles, const std::filesystem::path& path, const Progress& progress) {
    const Image image = contact_sheet(tiles, {}, part_of(progress, 0, 0.9));
    if (!keep_going(progress, 0.9, "writing")) return false;
    write_png(image, path);
    return true;
}

bool write_sheet(const Playable& playable, const std::filesystem::path& path, const Progress& progress) {
    std::vector<Tile> tiles = playable.before;
    const std::vector<double>& keys = playable.path.keys;
    const int parts = keys.size() == 2 ? 4 : 2; // tiles from key to key
    for (std::size_t p = 0; p + 1 < keys.size(); ++p)
        for (int i = p == 0 ? 0 : 1; i <= parts; ++i) {
            const double u = keys[p] + (keys[p + 1] - keys[p]) * i / parts;
            if (playable.ends_before && (u == 0 || u == 1)) continue;
            tiles.push_back({fmt::format("u = {:.2f}", u),
                             with_positions(playable.mesh, playable.path.at(u)),
                             {},
                             playable.other,
                             u});
        }
    return write_tiles(tiles, path, progress);
}

void write_plot(const Playable& playable, const std::filesystem::path& path, const Progress& progress,
                Written& written) {
    PathQuality quality = playable.quality;
    if (quality.frames.empty())
        quality = path_quality(
            playable.mesh, [&](double u) { return playable.path.at(u); }, {.keys = playable.path.keys}, progress);
    written.cancelled = quality.cancelled;
    if (!written.cancelled) write_whole(path, path_plot({{playable.play.title, quality}}));
}

// The name of a sequence for that of one mesh; what printf would fill in becomes #s.
std::string as_sequence(const std::filesystem::path& path) {
    std::string stem = path.stem().string();
    if (const auto at = stem.find('%'); at != std::string::npos)
        stem.replace(at, std::min(stem.find('d', at), stem.size() - 1) - at + 1, "####");
    else
        stem += "_####";
    return stem + path.extension().string();
}

} // namespace

void check_playable(const std::vector<Output>& outputs) {
    for (const Output& out : outputs)
        if (out.kind == OutputKind::mesh)
            throw Error(ErrorKind::argument,
                        fmt::format("-o {} is one mesh: give --at U to say which, or write a sequence, such as {}",
                                    out.path.string(), as_sequence(out.path)));
}

void check_still(const std::vector<Output>& outputs) {
    for (const auto& [kind, path] : outputs)
        if (kind == OutputKind::html || kind == OutputKind::sequence || kind == OutputKind::plot ||
            kind == OutputKind::film)
            throw Error(ErrorKind::argument, fmt::format("-o {} shows a whole morph, but here is one shape; use .obj, "
                                                         ".ply, .stl, .off, .glb, .gltf, .vtk, .vtp, .usda or .png",
                                                         path.string()));
}

bool any_played(const std::vector<Output>& outputs) {
    return std::any_of(outputs.begin(), outputs.end(), [](const Output& out) {
        return out.kind == OutputKind::glb || out.kind == OutputKind::html || out.kind == OutputKind::usd;
    });
}

Output output(const std::string& name) {
    const std::filesystem::path path(name);
    const std::string extension = lower_extension(path);
    const auto folder = path.parent_path();
    if (path.filename().empty() || path.filename() == "." || std::filesystem::is_directory(path))
        throw Error(ErrorKind::argument, fmt::format("-o {} is a folder; name a file in it, such as {}", name,
                                                     (path / "morph.glb").string()));
    if (!folder.empty() && !std::filesystem::is_directory(folder))
        throw Error(ErrorKind::file, fmt::format("{}: there is no folder {}; create it first", name, folder.string()));
    const bool counted = path.filename().string().find('#') != std::string::npos;
    if (is_mesh_extension(extension)) check_writable(path);
    if (counted && (is_mesh_extension(extension) || extension == ".png")) return {OutputKind::sequence, path};
    if (extension == ".glb") return {OutputKind::glb, path};
    if (extension == ".usda") return {OutputKind::usd, path};
    if (extension == ".html") return {OutputKind::html, path};
    if (extension == ".png") return {OutputKind::sheet, path};
    if (extension == ".apng") return {OutputKind::film, path};
    if (extension == ".svg") return {OutputKind::plot, path};
    if (is_mesh_extension(extension)) return {OutputKind::mesh, path};
    throw Error(ErrorKind::argument,
                fmt::format("-o {}: cannot tell what to write from \"{}\"; use .glb, .usda, .html, .png, "
                            ".apng, .svg, .obj, .ply, .stl, .off, .gltf, .vtk, .vtp, "
                            "or frame_####.obj for a numbered sequence",
                            name, extension));
}

std::filesystem::path numbered(const std::filesystem::path& pattern, int number) {
    std::string file = pattern.filename().string();
    const std::size_t first = file.find('#');
    if (first == std::string::npos) return pattern;
    const std::size_t last = std::min(file.find_first_not_of('#', first), file.size());
    file.replace(first, last - first, fmt::format("{:0{}}", number, last - first));
    return pattern.parent_path() / file;
}

std::vector<double> frame_times(int frames, FrameOrder order) {
    std::vector<double> times;
    const int steps = order == FrameOrder::around ? frames : frames - 1;
    for (int i = 0; i < frames; ++i) times.push_back(steps > 0 ? double(i) / steps : 0.5);
    if (order == FrameOrder::and_back)
        for (int i = frames - 2; i > 0; --i) times.push_back(times[static_cast<std::size_t>(i)]);
    return times;
}

Written write_outputs(const Playable& playable, const std::vector<Output>& outputs, const Progress& progress) {
    check_playable(outputs);
    Written written;
    WeightKeys keys;
    if (any_played(outputs)) keys = playable.keys ? *playable.keys : weight_keys(playable.path, playable.play);
    std::string glb;
    if (std::any_of(outputs.begin(), outputs.end(),
                    [](const Output& out) { return out.kind == OutputKind::glb || out.kind == OutputKind::html; }))
        glb = played(playable, keys);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto& [kind, path] = outputs[i];
        const double count = double(outputs.size());
        const Progress part = part_of(progress, double(i) / count, double(i + 1) / count);
        if (!keep_going(part, 0, "writing")) written.cancelled = true;
        if (written.cancelled) break;
        if (kind == OutputKind::glb) write_whole(path, glb);
        if (kind == OutputKind::html) write_whole(path, morph_html(glb, playable.play));
        if (kind == OutputKind::usd) {
            note(written, write_morph_usd(playable.mesh, playable.path, keys, path, playable.writing));
            if (playable.other)
                note(written,
                     {fmt::format("{}: shows the first look alone; .glb and .html fade to the other", path.string())});
        }
        if (kind == OutputKind::glb || kind == OutputKind::html || kind == OutputKind::usd)
            note(written, left_behind(playable.mesh, path, true));
        if (kind == OutputKind::sheet) written.cancelled = !write_sheet(playable, path, part);
        if (kind == OutputKind::film) written.cancelled = !write_film(playable, path, part);
        if (kind == OutputKind::plot) write_plot(playable, path, part, written);
        if (kind == OutputKind::sequence)
            write_sequence(playable, path, part, written);
        else if (!written.cancelled)
            written.files.push_back(path);
    }
    return written;
}

Written write_still(const Mesh& mesh, const std::string& caption, const std::vector<Tile>& before,
                    const std::vector<Output>& outputs, const Progress& progress, const WriteOptions& writing) {
    check_still(outputs);
    Written written;
    for (const auto& [kind, path] : outputs) {
        if (kind == OutputKind::sheet) {
            std::vector<Tile> tiles = before;
            tiles.push_back({caption, mesh, {}});
            if (!write_tiles(tiles, path, progress)) {
                written.cancelled = true;
                break;
            }
        } else {
            note(written, write_mesh(mesh, path, writing));
        }
        written.files.push_back(path);
    }
    return written;
}

} // namespace meshtween
