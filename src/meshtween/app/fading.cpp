// glTF 2.0 specification (Khronos, 2021): 3.7.2.2 morph targets, of COLOR_0 too; 3.9.4 alpha coverage; 4 the GLB
// container.
#include "meshtween/app/fading.h"

#include "meshtween/core/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <string_view>
#include <vector>

namespace meshtween {
namespace {

using nlohmann::json;
using Rgba = std::array<float, 4>;

constexpr int array_buffer = 34962, type_uint8 = 5121, type_float = 5126; // the specification's numbers

struct Glb {
    json root;
    std::string bin;
};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

Glb parsed(const std::string& glb) {
    const std::size_t text = word_at(glb, 12);
    return {json::parse(std::string_view(glb).substr(20, text)), glb.substr(28 + text)};
}

std::string packed(Glb glb) {
    glb.bin.resize((glb.bin.size() + 3) / 4 * 4, '\0');
    glb.root["buffers"] = json::array({{{"byteLength", glb.bin.size()}}});
    std::string text = glb.root.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + glb.bin.size();
    if (total > 0xffffffffU)
        throw Error(ErrorKind::argument, "the fading morph does not fit into one GLB, which ends at 4 GiB");
    std::string result = "glTF";
    const auto number = [&](std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        result.append(reinterpret_cast<const char*>(&word), sizeof word);
    };
    number(2);
    number(total);
    number(text.size());
    result += "JSON" + text;
    number(glb.bin.size());
    result.append("BIN\0", 4);
    return result + glb.bin;
}

std::string_view bytes_of(const Glb& glb, const json& view) {
    return std::string_view(glb.bin).substr(view.value("byteOffset", std::size_t(0)),
                                            view["byteLength"].get<std::size_t>());
}

int add_view(Glb& glb, std::string_view bytes, json view) {
    glb.bin.resize((glb.bin.size() + 3) / 4 * 4, '\0');
    view["buffer"] = 0;
    view["byteOffset"] = glb.bin.size();
    view["byteLength"] = bytes.size();
    glb.bin += bytes;
    glb.root["bufferViews"].push_back(std::move(view));
    return static_cast<int>(glb.root["bufferViews"].size()) - 1;
}

int add_accessor(Glb& glb, std::string_view bytes, int component, std::size_t count) {
    json accessor = {{"bufferView", add_view(glb, bytes, {{"target", array_buffer}})},
                     {"componentType", component},
                     {"count", count},
                     {"type", "VEC4"}};
    if (component == type_uint8) accessor["normalized"] = true;
    glb.root["accessors"].push_back(std::move(accessor));
    return static_cast<int>(glb.root["accessors"].size()) - 1;
}

int add_colors(Glb& glb, const std::vector<Rgba>& colors) {
    return add_accessor(glb, {reinterpret_cast<const char*>(colors.data()), colors.size() * sizeof(Rgba)}, type_float,
                        colors.size());
}

// One colour for all vertices, in bytes.
int add_even_color(Glb& glb, const std::array<std::uint8_t, 4>& color, std::size_t count) {
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) bytes.append(reinterpret_cast<const char*>(color.data()), 4);
    return add_accessor(glb, bytes, type_uint8, count);
}

// Of our own writer: four floats a vertex.
std::vector<Rgba> colors_of(const Glb& glb, const json& accessor) {
    std::vector<Rgba> colors(accessor["count"].get<std::size_t>());
    const auto bytes = bytes_of(glb, glb.root["bufferViews"][accessor["bufferView"].get<std::size_t>()]);
    if (accessor["componentType"] != type_float || accessor["type"] != "VEC4" ||
        bytes.size() < colors.size() * sizeof(Rgba))
        throw Error(ErrorKind::argument, "vertex colours that fade must be four floats each");
    std::memcpy(colors.data(), bytes.data(), colors.size() * sizeof(Rgba));
    return colors;
}

json& part(json& root, const char* name, const json& index) {
    return root[name][index.get<std::size_t>()];
}

// Both files have the same parts, each with vertex colours.
bool colors_match(const Glb& a, const Glb& b) {
    const auto shape = [](const Glb& glb) {
        std::vector<std::vector<std::size_t>> counts;
        for (const json& mesh : glb.root["meshes"]) {
            counts.emplace_back();
            for (const json& p : mesh["primitives"]) {
                if (!p["attributes"].contains("COLOR_0")) return std::vector<std::vector<std::size_t>>{};
                const auto index = p["attributes"]["COLOR_0"].get<std::size_t>();
                counts.back().push_back(glb.root["accessors"][index]["count"].get<std::size_t>());
            }
        }
        return counts;
    };
    return !shape(a).empty() && shape(a) == shape(b);
}

// Each vertex colour's way to the other's, as a morph target.
void fade_colors(Glb& glb, Glb& other, std::span<const double> share) {
    std::map<int, std::vector<int>> known; // a colour accessor: those of the targets
    for (std::size_t m = 0; m < glb.root["meshes"].size(); ++m)
        for (std::size_t p = 0; p < glb.root["meshes"][m]["primitives"].size(); ++p) {
            json &mine = glb.root["meshes"][m]["primitives"][p], &its = other.root["meshes"][m]["primitives"][p];
            const int base = mine["attributes"]["COLOR_0"];
            if (!known.contains(base)) {
                const auto from = colors_of(glb, part(glb.root, "accessors", base));
                const auto to = colors_of(other, part(other.root, "accessors", its["attributes"]["COLOR_0"]));
                for (std::size_t k = 1; k < share.size(); ++k) {
                    std::vector<Rgba> way(from.size());
                    for (std::size_t i = 0; i < from.size() && i < to.size(); ++i)
                        for (std::size_t c = 0; c < 4; ++c)
                            way[i][c] = static_cast<float>(share[k]) * (to[i][c] - from[i][c]);
                    known[base].push_back(add_colors(glb, way));
                }
            }
            for (std::size_t k = 0; k < mine["targets"].size(); ++k) mine["targets"][k]["COLOR_0"] = known[base][k];
        }
}

// Copies the parts of one file into another; tells the new number of each old one.
class Merge {
public:
    Merge(Glb& into, const Glb& from) : into_(into), from_(from) {
        for (std::size_t i = 0; i < into.root["bufferViews"].size(); ++i)
            known_views_.emplace(bytes_of(into, into.root["bufferViews"][i]).size(), static_cast<int>(i));
        for (const json& view : list("bufferViews")) views_.push_back(view_of(view));
        for (json accessor : list("accessors")) accessors_.push_back(accessor_of(std::move(accessor)));
        for (json image : list("images")) {
            if (image.contains("bufferView")) number(image, "bufferView", views_);
            images_.push_back(append("images", std::move(image)));
        }
        for (const json& sampler : list("samplers")) samplers_.push_back(append("samplers", sampler));
        for (json texture : list("textures")) {
            number(texture, "source", images_);
            number(texture, "sampler", samplers_);
            textures_.push_back(append("textures", std::move(texture)));
        }
    }

    json material(json m) const {
        for (const char* kind : {"normalTexture", "occlusionTexture", "emissiveTexture"})
            if (m.contains(kind)) number(m[kind], "index", textures_);
        if (m.contains("pbrMetallicRoughness"))
            for (const char* kind : {"baseColorTexture", "metallicRoughnessTexture"})
                if (m["pbrMetallicRoughness"].contains(kind))
                    number(m["pbrMetallicRoughness"][kind], "index", textures_);
        return m;
    }
    int accessor(const json& old) const { return accessors_[old.get<std::size_t>()]; }
    int append(const char* name, json value) const {
        into_.root[name].push_back(std::move(value));
        return static_cast<int>(into_.root[name].size()) - 1;
    }
    json list(const char* name) const { return from_.root.contains(name) ? from_.root[name] : json::array(); }

private:
    static void number(json& object, const char* key, const std::vector<int>& numbers) {
        if (object.contains(key)) object[key] = numbers[object[key].get<std::size_t>()];
    }
    int view_of(const json& view) {
        const std::string_view bytes = bytes_of(from_, view);
        const auto [first, last] = known_views_.equal_range(bytes.size());
        for (auto known = first; known != last; ++known) {
            const json& mine = into_.root["bufferViews"][static_cast<std::size_t>(known->second)];
            if (mine.value("target", 0) == view.value("target", 0) && bytes_of(into_, mine) == bytes)
                return known->second;
        }
        json copy = view;
        return add_view(into_, bytes, std::move(copy));
    }
    int accessor_of(json accessor) {
        number(accessor, "bufferView", views_);
        const json& all = into_.root["accessors"];
        const auto same = std::find(all.begin(), all.end(), accessor);
        return same != all.end() ? static_cast<int>(same - all.begin()) : append("accessors", std::move(accessor));
    }

    Glb& into_;
    const Glb& from_;
    std::multimap<std::size_t, int> known_views_; // by their length
    std::vector<int> views_, accessors_, images_, samplers_, textures_;
};

// A mesh's parts with opacity that follows the shares.
json covering(Glb& glb, const Glb& other, const Merge& merge, json mesh, const std::vector<int>& materials,
              std::span<const double> share) {
    for (json& p : mesh["primitives"]) {
        if (p.contains("indices")) p["indices"] = merge.accessor(p["indices"]);
        if (p.contains("material")) p["material"] = materials[p["material"].get<std::size_t>()];
        const json color = p["attributes"].contains("COLOR_0") ? p["attributes"]["COLOR_0"] : json();
        for (auto& [name, index] : p["attributes"].items()) index = merge.accessor(index);
        for (json& target : p["targets"])
            for (auto& [name, index] : target.items()) index = merge.accessor(index);
        const auto count = part(glb.root, "accessors", p["attributes"]["POSITION"])["count"].get<std::size_t>();
        if (color.is_null()) {
            p["attributes"]["COLOR_0"] = add_even_color(glb, {255, 255, 255, 0}, count);
        } else {
            std::vector<Rgba> colors = colors_of(other, other.root["accessors"][color.get<std::size_t>()]);
            for (Rgba& c : colors) c[3] = 0;
            p["attributes"]["COLOR_0"] = add_colors(glb, colors);
        }
        for (std::size_t k = 0; k < p["targets"].size(); ++k) {
            const auto alpha = static_cast<std::uint8_t>(std::lround(255 * std::clamp(share[k + 1], 0.0, 1.0)));
            p["targets"][k]["COLOR_0"] = add_even_color(glb, {0, 0, 0, alpha}, count);
        }
    }
    return mesh;
}

void cover(Glb& glb, const Glb& other, std::span<const double> share) {
    const Merge merge(glb, other);
    std::vector<int> materials, meshes;
    for (const json& m : merge.list("materials")) {
        json material = merge.material(m);
        material["alphaMode"] = "BLEND";
        materials.push_back(merge.append("materials", std::move(material)));
    }
    for (const json& m : merge.list("meshes"))
        meshes.push_back(merge.append("meshes", covering(glb, other, merge, m, materials, share)));
    const auto nodes = static_cast<int>(glb.root["nodes"].size());
    for (json node : merge.list("nodes")) {
        if (node.contains("mesh")) node["mesh"] = meshes[node["mesh"].get<std::size_t>()];
        for (json& child : node["children"]) child = child.get<int>() + nodes;
        if (node["children"].empty()) node.erase("children");
        node["name"] = node.value("name", "") + ", the other look";
        node["extras"]["cover"] = true;
        merge.append("nodes", std::move(node));
    }
    const json scenes = merge.list("scenes");
    for (const json& node : scenes[0]["nodes"]) glb.root["scenes"][0]["nodes"].push_back(node.get<int>() + nodes);
    for (const json& animation : merge.list("animations"))
        for (json channel : animation["channels"]) { // both files' samplers are the same
            channel["target"]["node"] = channel["target"]["node"].get<int>() + nodes;
            glb.root["animations"][0]["channels"].push_back(std::move(channel));
        }
}

} // namespace

std::string fading_glb(const std::string& from, const std::string& to, std::span<const double> share, Fading fading) {
    Glb glb = parsed(from), other = parsed(to);
    if (fading == Fading::colors && colors_match(glb, other))
        fade_colors(glb, other, share);
    else
        cover(glb, other, share);
    return packed(std::move(glb));
}

std::vector<double> shares_of_u(const Curve& curve) {
    const SplineBasis& basis = curve.basis;
    std::vector<double> shares;
    for (std::size_t k = 0; k < basis.size(); ++k) { // Greville's abscissae: the control values of u
        const auto first = basis.knots.begin() + static_cast<std::ptrdiff_t>(k) + 1;
        shares.push_back(std::accumulate(first, first + basis.degree, 0.0) / basis.degree);
    }
    return shares;
}

} // namespace meshtween
