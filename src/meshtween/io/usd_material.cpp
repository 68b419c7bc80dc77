// UsdPreviewSurface specification, Pixar: diffuseColor from a colour or a UsdUVTexture that reads the set "st".
#include "meshtween/io/usd_material.h"

#include "meshtween/io/formats.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/output.h"
#include "meshtween/io/usd_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::equivalent(a, b, ignored);
}

// How the written file names a picture; empty where there is none to name.
std::string placed(const TextureImage& image, int number, const fs::path& path, const WriteOptions& options,
                   std::vector<std::string>& notes) {
    const fs::path folder = path.parent_path();
    if (!image.bytes.empty()) { // it lies in the mesh's file: a file of its own, beside the new one
        const fs::path beside =
            folder / fmt::format("{}_{}.{}", path.stem().string(), number, image.mime == "image/jpeg" ? "jpg" : "png");
        write_whole(beside, image.bytes);
        notes.push_back(fmt::format("{}: its texture is {}", path.string(), beside.string()));
        return "./" + beside.filename().string();
    }
    std::error_code missing;
    if (image.path.empty() || !fs::is_regular_file(image.path, missing)) {
        notes.push_back(fmt::format("{}: the texture {} was not found and is left out", path.string(),
                                    image.path.empty() ? image.name : image.path.string()));
        return {};
    }
    const fs::path beside = folder / image.path.filename();
    if (is_same_file(beside, image.path)) return "./" + beside.filename().string();
    if (options.textures == Textures::refer) return fs::absolute(image.path).lexically_normal().string();
    write_whole(beside, read_whole(image.path));
    notes.push_back(fmt::format("{}: copied the texture {} beside it", path.string(), image.path.string()));
    return "./" + beside.filename().string();
}

void put_texture(TextOut& out, const std::string& prim, const Material& material, const std::string& picture) {
    out.put("\n            def Shader \"Place\"\n            {{\n"
            "                uniform token info:id = \"UsdPrimvarReader_float2\"\n"
            "                string inputs:varname = \"st\"\n                float2 outputs:result\n            }}\n");
    out.put(
        "\n            def Shader \"Picture\"\n            {{\n"
        "                uniform token info:id = \"UsdUVTexture\"\n                asset inputs:file = @{}@\n"
        "                float2 inputs:st.connect = <{}/Place.outputs:result>\n"
        "                float4 inputs:scale = ({}, {}, {}, {})\n"
        "                token inputs:sourceColorSpace = \"sRGB\"\n                token inputs:wrapS = \"repeat\"\n"
        "                token inputs:wrapT = \"repeat\"\n                float3 outputs:rgb\n            }}\n",
        picture, prim, material.base_color[0], material.base_color[1], material.base_color[2], material.base_color[3]);
}

void put_material(TextOut& out, const std::string& name, const std::string& prim, const Material& material,
                  const std::string& picture) {
    out.put("\n        def Material \"{}\" (\n            displayName = {}\n        )\n        {{\n"
            "            token outputs:surface.connect = <{}/Surface.outputs:surface>\n",
            name, usd_quoted(material.name), prim);
    out.put("\n            def Shader \"Surface\"\n            {{\n"
            "                uniform token info:id = \"UsdPreviewSurface\"\n");
    if (picture.empty())
        out.put("                color3f inputs:diffuseColor = ({}, {}, {})\n", material.base_color[0],
                material.base_color[1], material.base_color[2]);
    else
        out.put("                color3f inputs:diffuseColor.connect = <{}/Picture.outputs:rgb>\n", prim);
    out.put("                float inputs:opacity = {}\n                float inputs:metallic = {}\n"
            "                float inputs:roughness = {}\n                token outputs:surface\n            }}\n",
            material.base_color[3], material.metallic, material.roughness);
    if (!picture.empty()) put_texture(out, prim, material, picture);
    out.put("        }}\n");
}

} // namespace

UsdMaterials usd_materials(const Mesh& mesh, const fs::path& path, const WriteOptions& options) {
    UsdMaterials result;
    if (!is_described(mesh) || mesh.file->materials.empty()) return result;
    const MeshFile& file = *mesh.file;
    std::vector<std::string> pictures(file.images.size());
    for (std::size_t i = 0; i < pictures.size() && mesh.texcoords.rows() > 0; ++i) {
        const auto shows = [&](const Material& m) { return m.base_color_image == static_cast<int>(i); };
        if (std::any_of(file.materials.begin(), file.materials.end(), shows))
            pictures[i] = placed(file.images[i], static_cast<int>(i), path, options, result.notes);
    }
    std::ostringstream stream;
    {
        TextOut out(stream);
        std::set<std::string> taken;
        out.put("\n    def Scope \"Materials\"\n    {{");
        for (const Material& material : file.materials) {
            const std::string name = usd_unique(usd_name(material.name, "material"), taken);
            result.paths.push_back("/Model/Materials/" + name);
            const auto image = static_cast<std::size_t>(material.base_color_image);
            put_material(out, name, result.paths.back(), material, image < pictures.size() ? pictures[image] : "");
        }
        out.put("    }}\n");
    }
    result.text = stream.str();
    return result;
}

} // namespace meshtween
