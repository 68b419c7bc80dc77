#include "look_run.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

using namespace meshtween;

namespace {

// How finely pictures and vertices show the same: where colours are so much denser, vertices lose some.
constexpr Eigen::Index much_denser = 2;

// x for x.obj; where x.png is an output itself, x_texture.
std::string picture_name(const std::vector<std::string>& outputs) {
    const std::filesystem::path first = outputs.front();
    const auto taken = std::filesystem::path(first).replace_extension(".png");
    const std::string stem = first.stem().string();
    return std::ranges::find(outputs, taken.string()) == outputs.end() ? stem : stem + "_texture";
}

} // namespace

void add_texture_flag(CLI::App& verb, LookFlags& flags) {
    verb.add_option("--texture-size", flags.texture_size,
                    "Pixels a side of the picture that is painted on the mesh's own texture coordinates, 16 to 8192 "
                    "[2048]; given, vertex colours become a picture too")
        ->check(CLI::Range(16, 8192))
        ->option_text("N");
}

void add_appearance_flag(CLI::App& verb, LookFlags& flags, const std::vector<std::string>& choices) {
    const bool both = choices.size() > 2;
    verb.add_option("--appearance", flags.appearance,
                    std::string("Whose colours and pictures the result shows: the source's own, or the target's "
                                "carried over to its texture coordinates") +
                        (both ? ", or the one fading to the other" : ""))
        ->check(CLI::IsMember(choices))
        ->option_text(both ? "source|target|both [source]" : "source|target [source]");
    add_texture_flag(verb, flags);
}

void require_look(const Mesh& mesh, const std::string& file) {
    const Appearance look(mesh);
    if (!look.problems().empty()) throw Error(ErrorKind::file, fmt::format("{}: {}", file, look.problems()[0]));
    if (!look.any())
        throw Error(ErrorKind::file,
                    fmt::format("{} has neither colours nor a texture to carry over; leave --appearance out", file));
}

bool has_look(const Mesh& mesh) {
    const Appearance look(mesh);
    return look.any() || !look.problems().empty();
}

Mesh run_look(const Mesh& receiver, const Mesh& giver, const LookNames& names, const LookFlags& flags,
              const Progress& progress, Console& console, Json& described) {
    LookOptions options;
    options.bake_colors = flags.texture_size > 0;
    if (flags.texture_size > 0) options.texture_size = flags.texture_size;
    options.picture_name = picture_name(names.outputs);
    CarriedLook look = carried_look(receiver, giver, names.giver, options, progress);
    stop_if_interrupted();
    if (look.cancelled) throw Interrupted{};
    const std::size_t pictures = look.mesh.file->images.size();
    if (!look.no_picture.empty())
        console.warn(
            fmt::format("{} {}: the look of {} became vertex colours", names.receiver, look.no_picture, names.giver));
    else if (pictures == 0 && receiver.texcoords.rows() > 0 &&
             giver.positions.rows() > much_denser * receiver.positions.rows())
        console.note(fmt::format("look: {} has more vertices than {}; --texture-size 2048 keeps their colours as a "
                                 "picture",
                                 names.giver, names.receiver));
    if (look.twice > 0.02)
        console.warn(fmt::format("{}: {:.0f} % of the surface lie on the picture where another part does already, and "
                                 "show that part's look",
                                 names.receiver, 100 * look.twice));
    if (look.unseen > 0.001)
        console.note(fmt::format(
            "look: {} does not show {:.1f} % of the surface; there it {}", names.giver, 100 * look.unseen,
            has_look(receiver) ? fmt::format("looks as {} does", names.receiver) : "takes the colours around"));
    if (pictures > 0)
        console.note(fmt::format("look: {} picture{} of {} x {} pixels", pictures, pictures == 1 ? "" : "s",
                                 options.texture_size, options.texture_size));
    described = {{"pictures", pictures},
                 {"picture_size", pictures > 0 ? options.texture_size : 0},
                 {"not_shown", look.unseen},
                 {"places_shared", look.twice}};
    return std::move(look.mesh);
}
