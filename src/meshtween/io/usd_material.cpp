// UsdPreviewSurface specification, Pixar: diffuseColor from a colour or a UsdUVTexture that reads the set "st".
#include "meshtween/io/usd_material.h"

#include "meshtween/io/companions.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/text.h"
#include "meshtween/io/usd_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace meshtween {
namespace {
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

UsdMaterials usd_materials(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options) {
    UsdMaterials result;
    if (!is_described(mesh) || mesh.file->materials.empty()) return result;
    const MeshFile& file = *mesh.file;
    const Move move = move_to(path, file.path, options, result.notes);
    std::vector<std::string> pictures(file.images.size());
    for (std::size_t i = 0; i < pictures.size() && mesh.texcoords.rows() > 0; ++i) {
        const auto shows = [&](const Material& m) { return m.base_color_image == static_cast<int>(i); };
        if (!std::any_of(file.materials.begin(), file.materials.end(), shows)) continue;
        pictures[i] = carry_image(move, file.images[i], i);
        if (pictures[i].empty())
            result.notes.push_back(fmt::format("{}: the texture {} was not found and is left out", path.string(),
                                               shown(file.images[i].name)));
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
