// Formats as their programs write them: MeshLab's picked points (meshlab, edit_pickpoints/pickedPoints.cpp); 3D
// Slicer's markups (vtkMRMLMarkupsFiducialStorageNode, markups-schema-v1.0.3); Landmark's pts and dta (Wiley and
// others, Evolutionary morphing, 2005); NTSYS and tps (Rohlf, The tps series of software, 2015); morphologika
// (O'Higgins and Jones, 2006), with NA for missing as geomorph reads it; Amira's landmark sets.
#include "meshtween/io/marker_write.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/place_on_triangle.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/output.h"
#include "meshtween/io/space.h"
#include "meshtween/io/text_out.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

// One side as it is written.
struct Side {
    std::vector<Landmark> points;
    const Mesh* mesh = nullptr;
    std::string specimen;
    LandmarkNumbers numbers = {};
};
using Sides = std::span<const Side>;

struct Format {
    std::string_view ending;
    bool both_sides, names, missing; // what it holds
    void (*write)(Sides, TextOut&);
};

std::string quoted(std::string name, char separator) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    if (name.find_first_of("\",;\t# ") == std::string::npos && name.find(separator) == std::string::npos) return name;
    std::string result = "\"";
    for (const char c : name) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + '"';
}

// A name as one word, for formats cut at blanks.
std::string one_word(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
    return name.empty() ? "_" : name;
}

std::string xml(std::string_view text) {
    std::string result;
    for (const char c : text) switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        case '\n':
            result += "&#10;";
            break;
        case '\r':
            result += "&#13;";
            break;
        case '\t':
            result += "&#9;";
            break;
        default:
            result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
        }
    return result;
}

void put_table(Sides sides, TextOut& out, char separator) {
    out.put("name");
    const bool two = sides.size() == 2;
    for (std::size_t side = 0; side < sides.size(); ++side)
        for (const char axis : {'x', 'y', 'z'}) out.put("{}{}{}", separator, two ? (side == 0 ? "s" : "t") : "", axis);
    const LandmarkNumbers& numbers = sides[0].numbers;
    if (!numbers.values.empty()) out.put("{}{}", separator, numbers.name);
    out.put("\n");
    for (std::size_t i = 0; i < sides[0].points.size(); ++i) {
        out.put("{}", quoted(sides[0].points[i].name, separator));
        for (const Side& side : sides)
            for (int k = 0; k < 3; ++k)
                if (const auto& place = side.points[i].position)
                    out.put("{}{}", separator, (*place)[k]);
                else
                    out.put("{}", separator);
        if (!numbers.values.empty()) out.put("{}{}", separator, numbers.values[i]);
        out.put("\n");
    }
}

void put_csv(Sides sides, TextOut& out) {
    put_table(sides, out, ',');
}
void put_tsv(Sides sides, TextOut& out) {
    put_table(sides, out, '\t');
}

void put_picked_points(Sides sides, TextOut& out) {
    out.put("<!DOCTYPE PickedPoints>\n<PickedPoints>\n");
    for (const Landmark& point : sides[0].points) {
        const Point p = point.position.value_or(Point(0, 0, 0));
        out.put(" <point x=\"{}\" y=\"{}\" z=\"{}\" name=\"{}\" active=\"{}\"/>\n", p[0], p[1], p[2], xml(point.name),
                point.position ? 1 : 0);
    }
    out.put("</PickedPoints>\n");
}

std::string_view system_of(const Side& side) {
    const Space space = side.mesh != nullptr ? space_of(*side.mesh) : Space::unknown;
    return name_of(space == Space::unknown ? Space::lps : space);
}

void put_fcsv(Sides sides, TextOut& out) {
    out.put("# Markups fiducial file version = 5.6\n# CoordinateSystem = {}\n"
            "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n",
            system_of(sides[0]));
    int number = 0;
    for (const Landmark& point : sides[0].points) {
        constexpr int defined = 2, missing = 3; // vtkMRMLMarkupsNode::ControlPoint's PositionStatus
        const Point p = point.position.value_or(Point(0, 0, 0));
        out.put("{},{},{},{},0,0,0,1,1,1,0,{},,,{},0\n", ++number, p[0], p[1], p[2], quoted(point.name, ','),
                point.position ? defined : missing);
    }
}

void put_markups(Sides sides, TextOut& out) {
    using Json = nlohmann::ordered_json;
    Json points = Json::array();
    for (const Landmark& point : sides[0].points) {
        Json entry{{"id", std::to_string(points.size() + 1)}, {"label", point.name}};
        if (const auto& p = point.position) entry["position"] = {(*p)[0], (*p)[1], (*p)[2]};
        entry["positionStatus"] = point.position ? "defined" : "missing";
        points.push_back(std::move(entry));
    }
    const Json file{{"@schema", "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/"
                                "Resources/Schema/markups-schema-v1.0.3.json#"},
                    {"markups", Json::array({{{"type", "Fiducial"},
                                              {"coordinateSystem", system_of(sides[0])},
                                              {"controlPoints", std::move(points)}}})}};
    out.put("{}\n", file.dump(1, ' ', false, Json::error_handler_t::replace));
}

// The closest point of the mesh. Few ask, so every triangle is looked at.
SurfacePoint on_surface(const Mesh& mesh, const Point& point) {
    SurfacePoint best;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        const auto corner = [&](int k) -> Point { return mesh.positions.row(mesh.triangles(t, k)); };
        const auto place = place_on_triangle(point, corner(0), corner(1), corner(2));
        if (place.squared_distance >= least) continue;
        least = place.squared_distance;
        best = {static_cast<int>(t), {1 - place.v - place.w, place.v, place.w}};
    }
    return best;
}

void put_wrap(Sides sides, TextOut& out) {
    std::vector<Point> there;
    for (const Landmark& point : sides[0].points)
        if (point.position) there.push_back(*point.position);
    std::vector<SurfacePoint> places(there.size());
    parallel_for(
        std::ssize(there),
        [&](std::ptrdiff_t i) {
            places[static_cast<std::size_t>(i)] = on_surface(*sides[0].mesh, there[static_cast<std::size_t>(i)]);
        },
        1);
    out.put("[");
    for (std::size_t i = 0; i < places.size(); ++i)
        out.put("{}\n [{}, {}, {}]", i == 0 ? "" : ",", places[i].triangle, places[i].barycentric[0],
                places[i].barycentric[1]);
    out.put("\n]\n");
}

void put_points(const Side& side, TextOut& out, std::string_view missing) {
    for (const Landmark& point : side.points)
        if (const auto& p = point.position)
            out.put("{} {} {}\n", (*p)[0], (*p)[1], (*p)[2]);
        else
            out.put("{0} {0} {0}\n", missing);
}

void put_pts(Sides sides, TextOut& out) {
    out.put("Version 1.0\n{}\n", sides[0].points.size());
    for (const Landmark& point : sides[0].points) {
        const Point p = point.position.value_or(Point(9999, 9999, 9999));
        out.put("{} {} {} {}\n", one_word(point.name), p[0], p[1], p[2]);
    }
}

void put_dta(Sides sides, TextOut& out) {
    const auto has_missing = [](const Side& side) {
        return std::any_of(side.points.begin(), side.points.end(), [](const Landmark& p) { return !p.position; });
    };
    out.put("'landmarks\n\n1 {}L {} {} 9999 DIM=3\n\n", sides.size(), 3 * sides[0].points.size(),
            std::any_of(sides.begin(), sides.end(), has_missing) ? 1 : 0);
    for (const Side& side : sides) out.put("{}\n", one_word(side.specimen));
    for (const Side& side : sides) {
        out.put("\n");
        put_points(side, out, "9999");
    }
}

void put_tps(Sides sides, TextOut& out) {
    for (const Side& side : sides) {
        out.put("LM3={}\n", side.points.size());
        put_points(side, out, "NA");
        out.put("ID={}\n", side.specimen);
    }
}

void put_morphologika(Sides sides, TextOut& out) {
    out.put("[individuals]\n{}\n[landmarks]\n{}\n[dimensions]\n3\n[names]\n", sides.size(), sides[0].points.size());
    for (const Side& side : sides) out.put("{}\n", one_word(side.specimen));
    out.put("[rawpoints]\n");
    for (const Side& side : sides) {
        out.put("'{}\n", one_word(side.specimen));
        put_points(side, out, "NA");
    }
}

void put_amira(Sides sides, TextOut& out) {
    out.put("# AmiraMesh 3D ASCII 2.0\n\ndefine Markers {}\n\nParameters {{\n    ContentType \"LandmarkSet\",\n"
            "    NumSets {}\n}}\n\nMarkers {{ float[3] Coordinates }} @1\n{}\n# Data section follows\n",
            sides[0].points.size(), sides.size(), sides.size() == 2 ? "Markers { float[3] Coordinates2 } @2\n" : "");
    for (std::size_t i = 0; i < sides.size(); ++i) {
        out.put("@{}\n", i + 1);
        put_points(sides[i], out, "NaN");
        out.put("\n");
    }
}

// A longer ending before a shorter one that ends it.
constexpr std::array formats{
    Format{".mrk.json", false, true, true, put_markups},
    Format{".json", false, false, false, put_wrap},
    Format{".csv", true, true, true, put_csv},
    Format{".tsv", true, true, true, put_tsv},
    Format{".pp", false, true, true, put_picked_points},
    Format{".fcsv", false, true, true, put_fcsv},
    Format{".pts", false, true, true, put_pts},
    Format{".dta", true, false, true, put_dta},
    Format{".tps", true, false, true, put_tps},
    Format{".txt", true, false, true, put_morphologika},
    Format{".landmarkascii", true, false, true, put_amira},
};

const Format* found(const fs::path& path) {
    std::string name = path.filename().string();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* format = std::find_if(formats.begin(), formats.end(), [&](const Format& f) {
        return name.size() > f.ending.size() && name.ends_with(f.ending);
    });
    return format == formats.end() ? nullptr : format;
}

const Format& format_of(const fs::path& path) {
    if (const Format* format = found(path)) return *format;
    throw Error(ErrorKind::argument, fmt::format("{}: no landmark format that is written here ends so; use one of .csv "
                                                 ".tsv .pp .fcsv .mrk.json .json .pts .dta .tps .txt .landmarkAscii",
                                                 path.string()));
}

std::string specimen_name(const Mesh* mesh, const char* otherwise) {
    if (mesh == nullptr || !mesh->file || mesh->file->path.empty()) return otherwise;
    return mesh->file->path.stem().string();
}

std::vector<std::string> write_sides(const std::vector<Side>& sides, const fs::path& path) {
    const Format& format = format_of(path);
    if (sides.size() == 2 && !format.both_sides)
        throw Error(ErrorKind::argument,
                    fmt::format("{}: this format holds one side of the markers; write a file a side", path.string()));
    if (format.write == put_wrap && (sides[0].mesh == nullptr || sides[0].mesh->triangles.rows() == 0))
        throw Error(ErrorKind::argument,
                    fmt::format("{}: Wrap's points lie on triangles; this needs the mesh", path.string()));
    write_whole(path, [&](std::ostream& stream) {
        TextOut out(stream);
        format.write(sides, out);
    });
    std::vector<std::string> notes;
    const auto is_missing = [](const Landmark& p) { return !p.position; };
    const auto missing = std::count_if(sides[0].points.begin(), sides[0].points.end(), is_missing);
    if (!format.names)
        notes.push_back(fmt::format("{}: this format holds no names; the landmarks go by their order", path.string()));
    if (!format.missing && missing > 0)
        notes.push_back(
            fmt::format("{}: this format cannot hold missing points; {} are left out", path.string(), missing));
    return notes;
}

Side side_of(std::span<const PartialPair> pairs, std::optional<Point> PartialPair::*which, const Mesh* mesh,
             const char* otherwise) {
    Side side{{}, mesh, specimen_name(mesh, otherwise), {}};
    for (const PartialPair& pair : pairs) side.points.push_back({pair.name, pair.*which});
    return side;
}

} // namespace

bool is_marker_format(const fs::path& path) {
    return found(path) != nullptr;
}

bool holds_both_sides(const fs::path& path) {
    return format_of(path).both_sides;
}

bool holds_names(const fs::path& path) {
    return format_of(path).names;
}

std::vector<std::string> write_landmarks(std::span<const Landmark> landmarks, const fs::path& path, const Mesh* mesh,
                                         const LandmarkNumbers& numbers) {
    return write_sides({{{landmarks.begin(), landmarks.end()}, mesh, specimen_name(mesh, "landmarks"), numbers}}, path);
}

std::vector<std::string> write_markers(std::span<const PartialPair> pairs, const fs::path& path, const Mesh* source,
                                       const Mesh* target) {
    return write_sides({side_of(pairs, &PartialPair::source, source, "source"),
                        side_of(pairs, &PartialPair::target, target, "target")},
                       path);
}

std::vector<std::string> write_markers(std::span<const PartialPair> pairs, const fs::path& source_path,
                                       const fs::path& target_path, const Mesh* source, const Mesh* target) {
    std::vector<PartialPair> kept(pairs.begin(), pairs.end());
    std::vector<std::string> notes;
    if (!format_of(source_path).missing || !format_of(target_path).missing) {
        const auto gone = std::erase_if(kept, [](const PartialPair& p) { return !p.source || !p.target; });
        if (gone > 0)
            notes.push_back(
                fmt::format("{}: this format cannot hold missing points; {} pairs that lack a side are left out",
                            source_path.string(), gone));
    }
    for (std::string& note : write_sides({side_of(kept, &PartialPair::source, source, "source")}, source_path))
        notes.push_back(std::move(note));
    for (std::string& note : write_sides({side_of(kept, &PartialPair::target, target, "target")}, target_path))
        notes.push_back(std::move(note));
    return notes;
}

void write_marker_csv(std::span<const PartialPair> pairs, const fs::path& path) {
    const std::vector<Side> sides{side_of(pairs, &PartialPair::source, nullptr, ""),
                                  side_of(pairs, &PartialPair::target, nullptr, "")};
    write_whole(path, [&](std::ostream& stream) {
        TextOut out(stream);
        put_csv(sides, out);
    });
}

} // namespace meshtween
