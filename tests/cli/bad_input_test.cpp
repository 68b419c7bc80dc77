// The table of bad input: what people really type and load, what they are told, and that nothing is left half-written.
#include "support/program.h"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>

namespace {

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const std::string four_markers = "name,sx,sy,sz,tx,ty,tz\na,0,0,0,0,0,0\nb,1,0,0,1,0,0\nc,0,1,0,0,1,0\nd,0,0,1,0,0,1\n";

// `#` in an argument stands for the test's folder, which holds the row's files and the good ones beside them.
struct Row {
    std::string name;
    std::vector<std::pair<std::string, std::string>> files; // name, contents
    std::vector<std::string> arguments;
    int status;
    std::vector<std::string> says; // words that standard error holds
};

std::ostream& operator<<(std::ostream& out, const Row& row) {
    return out << row.name;
}

std::vector<std::string> fit_with(const std::string& source, const std::string& markers = "#/markers.csv") {
    return {"fit", source, "#/good.obj", "--markers", markers, "-o", "#/out.obj"};
}

std::vector<std::string> and_then(std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::string binary_ply_header(const std::string& vertices) {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int "
           "vertex_indices\n"
           "end_header\n";
}

std::string with_line(std::string text, const std::string& line) {
    return text + line + "\n";
}

std::vector<std::string> tween_with(std::vector<std::string> options, const std::string& output = "#/f_#.obj") {
    options.insert(options.begin(), {"tween", "#/good.obj", "#/good.obj", "-o", output});
    return options;
}

const std::vector<Row> rows = {
    // Files that are no meshes.
    {"NoSuchFile", {}, fit_with("#/absent.obj"), 3, {"absent.obj", "no such file"}},
    {"AFolder", {}, fit_with("#"), 3, {"folder"}},
    {"AFolderNamedLikeAMesh", {{"d.obj/x", ""}}, fit_with("#/d.obj"), 3, {"d.obj", "folder"}},
    {"Empty", {{"a.obj", ""}}, fit_with("#/a.obj"), 3, {"a.obj", "empty"}},
    {"UnknownExtension", {{"a.blend", "x"}}, fit_with("#/a.blend"), 1, {".blend", ".obj"}},
    {"UsdIsNotRead", {{"a.usda", "#usda 1.0"}}, fit_with("#/a.usda"), 1, {"a.usda", "written but not read"}},
    {"GarbageFbx", {{"a.fbx", "x"}}, fit_with("#/a.fbx"), 3, {"a.fbx", "assimp"}},
    {"GarbageVtk", {{"a.vtk", "x"}}, fit_with("#/a.vtk"), 3, {"a.vtk", "begins with '# vtk DataFile Version'"}},
    {"VtkOfAVolume",
     {{"a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_GRID\n"}},
     fit_with("#/a.vtk"),
     3,
     {"a.vtk", "STRUCTURED_GRID", "Extract Surface"}},
    {"TruncatedVtp", {{"a.vtp", "<VTKFile type=\"PolyData\"><PolyData>"}}, fit_with("#/a.vtp"), 3, {"a.vtp", "line 1"}},
    {"BinaryGarbage",
     {{"a.ply", std::string("\x00\xff\x13\x37garbage\x00\x01", 13)}},
     fit_with("#/a.ply"),
     3,
     {"a.ply"}},
    {"GarbageObj", {{"a.obj", std::string("\x80\xff\x00\x01\x02\x03", 6)}}, fit_with("#/a.obj"), 3, {"a.obj"}},
    {"GarbageGlb", {{"a.glb", "glTF nonsense"}}, fit_with("#/a.glb"), 3, {"a.glb"}},
    {"OldGltf", {{"a.gltf", R"({"asset": {"version": "1.0"}})"}}, fit_with("#/a.gltf"), 3, {"a.gltf", "version 1.0"}},
    {"GltfOfGarbageDraco",
     {{"a.gltf",
       R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [
           {"attributes": {"POSITION": 0}, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0,
           "attributes": {"POSITION": 0}}}}]}], "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}],
           "bufferViews": [{"buffer": 0, "byteLength": 3}],
           "buffers": [{"byteLength": 3, "uri": "data:;base64,QUJD"}]})"}},
     fit_with("#/a.gltf"),
     3,
     {"a.gltf", "Draco"}},
    {"GltfThatNeedsWhatIsUnknown",
     {{"a.gltf", R"({"asset": {"version": "2.0"}, "extensionsRequired": ["VENDOR_packing"]})"}},
     fit_with("#/a.gltf"),
     3,
     {"a.gltf", "VENDOR_packing"}},
    {"TruncatedPly", {{"a.ply", binary_ply_header("4") + "123456"}}, fit_with("#/a.ply"), 3, {"a.ply"}},
    {"BillionVertices",
     {{"a.ply", binary_ply_header("1000000000") + "123456"}},
     fit_with("#/a.ply"),
     3,
     {"a.ply", "1000000000"}},
    {"BillionVerticesOff",
     {{"a.off", "OFF\n1000000000 1 0\n0 0 0\n"}},
     fit_with("#/a.off"),
     3,
     {"a.off", "1000000000"}},
    {"NotANumber", {{"a.obj", "v 0 nan 0\n" + tetrahedron}}, fit_with("#/a.obj"), 3, {"a.obj", "finite"}},
    {"Infinite", {{"a.obj", "v 0 inf 0\n" + tetrahedron}}, fit_with("#/a.obj"), 3, {"a.obj", "finite"}},
    {"IndexTooLarge", {{"a.obj", with_line(tetrahedron, "f 1 2 9")}}, fit_with("#/a.obj"), 3, {"a.obj", "9"}},
    {"IndexZero", {{"a.obj", with_line(tetrahedron, "f 0 1 2")}}, fit_with("#/a.obj"), 3, {"a.obj"}},
    {"StlOfAnotherSize",
     {{"a.stl", std::string(80, ' ') + std::string("\3\0\0\0", 4) + std::string(260, '\1')}},
     fit_with("#/a.stl"),
     3,
     {"a.stl", "promises 3 facets", "344"}},
    {"OffOfFewerFaces",
     {{"a.off", "OFF4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n"}},
     fit_with("#/a.off"),
     3,
     {"a.off", "face 2 of 4"}},
    {"StripsOfNoVertex",
     {{"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
                "3 0 1 5\n"}},
     fit_with("#/a.ply"),
     3,
     {"a.ply", "vertex 5"}},
    {"UnknownTextures", {}, and_then(fit_with("#/good.obj"), {"--textures", "embed"}), 1, {"--textures", "embed"}},
    {"IndexNegativeOff",
     {{"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n"}},
     fit_with("#/a.off"),
     3,
     {"a.off", "-2"}},
    {"NoFaces", {{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"}}, fit_with("#/a.obj"), 3, {"a.obj", "no faces"}},
    // Markers.
    {"NoMarkerFile", {}, fit_with("#/good.obj", "#/absent.csv"), 3, {"absent.csv"}},
    {"TwoMarkersForThePaper",
     {{"m.csv", "a,0,0,0,0,0,0\nb,1,0,0,1,0,0\n"}},
     and_then(fit_with("#/good.obj", "#/m.csv"), {"--fit", "paper"}),
     1,
     {"3 pairs", "2", "--fit surface"}},
    {"NoMarkersForThePaper",
     {},
     {"morph", "#/good.obj", "#/good.obj", "--fit", "paper", "-o", "#/f_#.obj"},
     1,
     {"3 pairs", "--fit surface"}},
    {"NoUsableMarkers",
     {{"m.csv", "name,sx,sy,sz,tx,ty,tz\na,0,0,0,,,\n"}},
     fit_with("#/good.obj", "#/m.csv"),
     3,
     {"m.csv", "no usable pair"}},
    {"PartsUnknown", {}, and_then(fit_with("#/good.obj"), {"--parts", "some"}), 1, {"--parts"}},
    {"LayerUnknown", {}, and_then(fit_with("#/good.obj"), {"--layer", "middle"}), 1, {"--layer"}},
    {"NegativeMarkerWeight", {}, and_then(fit_with("#/good.obj"), {"--marker-weight", "-1"}), 1, {"--marker-weight"}},
    {"MarkerWeightNaN", {}, and_then(fit_with("#/good.obj"), {"--marker-weight", "nan"}), 1, {"--marker-weight"}},
    {"MarkerWeightTooLarge", {}, and_then(fit_with("#/good.obj"), {"--marker-weight", "1e9"}), 1, {"10"}},
    {"NoSymmetryIsYesOrNo", {}, and_then(fit_with("#/good.obj"), {"--no-symmetry=perhaps"}), 1, {"--no-symmetry"}},
    {"MarkerNotANumber",
     {{"m.csv", four_markers + "e,x,0,0,1,0,0\n"}},
     fit_with("#/good.obj", "#/m.csv"),
     3,
     {"m.csv", "6"}},
    {"MarkerTooFewColumns",
     {{"m.csv", four_markers + "e,0,0,0\n"}},
     fit_with("#/good.obj", "#/m.csv"),
     3,
     {"m.csv", "6"}},
    {"MarkersOfAnotherModel",
     {{"m.csv", "a,10,0,0,0,0,0\nb,11,0,0,1,0,0\nc,10,1,0,0,1,0\n"}},
     fit_with("#/good.obj", "#/m.csv"),
     3,
     {"m.csv", "3 of 3 markers", "source"}},
    {"CoincidentMarkers",
     {{"m.csv", four_markers + "e,0,0,0,0.5,0.5,0\n"}},
     fit_with("#/good.obj", "#/m.csv"),
     3,
     {"'a'", "'e'", "one place"}},
    {"MarkersOnALine",
     {{"m.csv", "a,0,0,0,0,0,0\nb,0.5,0,0,0.5,0,0\nc,1,0,0,1,0,0\n"}},
     fit_with("#/good.obj", "#/m.csv"),
     2,
     {"line"}},
    {"UnequalNumbers",
     {{"s.pts", "0 0 0\n"}, {"s.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n"}, {"t.csv", "0,0,0\n1,0,0\n0,1,0\n"}},
     {"fit", "#/good.obj", "#/good.obj", "--markers", "#/s.csv", "#/t.csv", "-o", "#/out.obj"},
     3,
     {"4", "3"}},
    {"MarkersSystemUnknown",
     {},
     and_then(fit_with("#/good.obj"), {"--markers-system", "XYZ"}),
     1,
     {"--markers-system", "RAS"}},
    {"SpecimenTruncated",
     {{"m.tps", "LM3=4\n0 0 0\n1 0 0\nLM3=4\n"}},
     fit_with("#/good.obj", "#/m.tps"),
     3,
     {"m.tps", "promises 4 landmarks but holds 2"}},
    {"LandmarkSetGarbage",
     {{"m.landmarkAscii", "\x01\x02\x03"}},
     fit_with("#/good.obj", "#/m.landmarkAscii"),
     3,
     {"m.landmarkAscii", "no landmark set"}},
    {"MorphologikaOfPictures",
     {{"m.txt", "[individuals]\n2\n[landmarks]\n1\n[dimensions]\n2\n[rawpoints]\n0 0\n1 1\n"}},
     fit_with("#/good.obj", "#/m.txt"),
     3,
     {"m.txt", "2 coordinates"}},
    // Arguments.
    {"NoVerb", {}, {}, 1, {"subcommand"}},
    {"UnknownVerb", {}, {"morf"}, 1, {"morf", "did you mean morph?"}},
    {"UnknownOption", {}, {"check", "#/good.obj", "--nonsense"}, 1, {"--nonsense"}},
    {"MistypedOption",
     {},
     {"fit", "#/good.obj", "#/good.obj", "--marker=#/m.csv"},
     1,
     {"no option --marker;", "did you mean --markers?"}},
    {"NoFrames", {}, {"tween", "#/good.obj", "#/good.obj", "--frames", "0", "-o", "#/f_##.obj"}, 1, {"--frames"}},
    {"AtTwo", {}, {"tween", "#/good.obj", "#/good.obj", "--at", "2", "-o", "#/f.obj"}, 1, {"--at"}},
    {"AtNaN", {}, {"tween", "#/good.obj", "#/good.obj", "--at", "nan", "-o", "#/f.obj"}, 1, {"--at"}},
    {"UnknownMethod",
     {},
     {"tween", "#/good.obj", "#/good.obj", "--method", "magic", "-o", "#/f_#.obj"},
     1,
     {"--method"}},
    {"BadC1",
     {},
     {"tween", "#/good.obj", "#/good.obj", "--method", "dual", "--c1", "0.5", "-o", "#/f_#.obj"},
     1,
     {"C1"}},
    {"OneMeshOfAPath", {}, {"tween", "#/good.obj", "#/good.obj", "-o", "#/f.obj"}, 1, {"--at", "f_####.obj"}},
    {"APageOfOneShape", {}, {"tween", "#/good.obj", "#/good.obj", "--at", "0.5", "-o", "#/f.html"}, 1, {"f.html"}},
    {"OtherConnectivity",
     {{"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}},
     {"tween", "#/good.obj", "#/b.obj", "-o", "#/f_#.obj"},
     3,
     {"connectivity", "b.obj"}},
    {"ToleranceNought", {}, tween_with({"--tolerance", "0"}), 1, {"--tolerance", "0"}},
    {"ToleranceNaN", {}, tween_with({"--tolerance", "nan"}), 1, {"--tolerance", "nan"}},
    {"NoTargets", {}, tween_with({"--targets", "0"}), 1, {"--targets"}},
    {"TooFewTargets",
     {},
     {"tween", "#/good.obj", "#/good.obj", "#/good.obj", "--targets", "3", "-o", "#/f.glb"},
     1,
     {"--targets 3", "6"}},
    {"UnknownEase", {}, tween_with({"--ease", "bounce"}), 1, {"--ease", "bounce"}},
    {"NoSeconds", {}, tween_with({"--seconds", "0"}), 1, {"--seconds"}},
    {"LoopAndPingPong", {}, tween_with({"--loop", "--ping-pong"}), 1, {"--loop", "--ping-pong"}},
    {"OnceAndPingPong", {}, tween_with({"--once", "--ping-pong"}), 1, {"--once", "--ping-pong"}},
    {"OneMeshToTween", {}, {"tween", "#/good.obj", "-o", "#/f_#.obj"}, 1, {"MESH"}},
    {"TimesOfAnotherNumber", {}, tween_with({"--times", "0,0.5,1"}), 1, {"2 times", "3"}},
    {"TimesThatFall", {}, tween_with({"--times", "1,0"}), 1, {"rise"}},
    {"TimesNaN", {}, tween_with({"--times", "0,nan"}), 1, {"times"}},
    {"ThirdMeshOfOtherConnectivity",
     {{"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}},
     {"tween", "#/good.obj", "#/good.obj", "#/b.obj", "-o", "#/f_#.obj"},
     3,
     {"connectivity", "b.obj"}},
    {"OutputGivenTwice", {}, tween_with({"-o", "#/f.glb"}, "#/f.glb"), 1, {"f.glb", "twice"}},
    {"PrintfNumbers", {}, tween_with({}, "#/f_%04d.obj"), 1, {"f_####.obj"}},
    {"StudioWithoutItsFile", {}, {"studio", "#/nofile.ply", "#/none.obj", "--no-browser"}, 3, {"nofile.ply"}},
    {"AFilmOfOneShape", {}, tween_with({"--at", "0.5"}, "#/f.apng"), 1, {"f.apng"}},
    {"APlotOfOneShape", {}, tween_with({"--at", "0.5"}, "#/f.svg"), 1, {"f.svg"}},
    {"NoRegionsFile", {}, tween_with({"--regions", "#/absent.csv"}), 3, {"absent.csv"}},
    {"RegionsEmpty", {{"r.csv", "vertex,start,end\n"}}, tween_with({"--regions", "#/r.csv"}), 3, {"r.csv", "no row"}},
    {"RegionsOddRow", {{"r.csv", "0,1\n"}}, tween_with({"--regions", "#/r.csv"}), 3, {"r.csv", "line 1", "vertex"}},
    {"RegionsBackwards",
     {{"r.csv", "0,0.9,0.1\n"}},
     tween_with({"--regions", "#/r.csv"}),
     3,
     {"r.csv", "line 1", "0.9"}},
    {"RegionsNaN", {{"r.csv", "0,nan,1\n"}}, tween_with({"--regions", "#/r.csv"}), 3, {"r.csv", "line 1", "finite"}},
    {"RegionsNoSuchVertex", {{"r.csv", "4,0,1\n"}}, tween_with({"--regions", "#/r.csv"}), 3, {"r.csv", "vertex 4"}},
    {"RegionsOffTheMesh",
     {{"r.csv", "a,99,0,0,0,1\n"}},
     tween_with({"--regions", "#/r.csv"}),
     3,
     {"r.csv", "'a'", "off the mesh"}},
    {"RegionsUnpainted", {}, tween_with({"--regions", "#/good.obj"}), 3, {"good.obj", "no vertex colours"}},
    {"RegionsOfAnotherMesh",
     {{"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}},
     tween_with({"--regions", "#/b.obj"}),
     3,
     {"b.obj", "3 vertices"}},
    {"RegionSpanNought", {}, tween_with({"--region-span", "0"}), 1, {"--region-span"}},
    {"RegionWidthNegative", {}, tween_with({"--region-width", "-1"}), 1, {"--region-width"}},
    {"RepairReachNought", {}, tween_with({"--repair-reach", "0"}), 1, {"--repair-reach"}},
    {"RepairReachNaN", {}, tween_with({"--repair-reach", "nan"}), 1, {"--repair-reach"}},
    {"BlendOfOne", {}, {"blend", "#/good.obj", "-o", "#/f.obj"}, 1, {"MESH"}},
    {"BlendWeightsOfAnotherNumber",
     {},
     {"blend", "#/good.obj", "#/good.obj", "--weights", "1,1,1", "-o", "#/f.obj"},
     1,
     {"3 numbers", "2 meshes"}},
    {"BlendWeightsOfNoSum",
     {},
     {"blend", "#/good.obj", "#/good.obj", "--weights", "1,-1", "-o", "#/f.obj"},
     1,
     {"--weights", "above 0"}},
    {"BlendWeightsNaN",
     {},
     {"blend", "#/good.obj", "#/good.obj", "--weights", "nan,1", "-o", "#/f.obj"},
     1,
     {"--weights", "nan"}},
    {"BlendOfOtherConnectivity",
     {{"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}},
     {"blend", "#/good.obj", "#/b.obj", "-o", "#/f.obj"},
     3,
     {"connectivity", "b.obj"}},
    {"BlendAsASequence", {}, {"blend", "#/good.obj", "#/good.obj", "-o", "#/f_#.obj"}, 1, {"f_#.obj"}},
    {"AMorphAsGltf", {}, {"tween", "#/good.obj", "#/good.obj", "-o", "#/f.gltf"}, 1, {"one mesh", "--at"}},
    {"UnknownOutput", {}, {"tween", "#/good.obj", "#/good.obj", "-o", "#/f.mp4"}, 1, {".mp4", ".glb"}},
    {"OutputIsAFolder", {}, {"tween", "#/good.obj", "#/good.obj", "-o", "#"}, 1, {"folder"}},
    {"OutputFolderAbsent", {}, {"tween", "#/good.obj", "#/good.obj", "-o", "#/no/f_#.obj"}, 3, {"no folder"}},
    {"SubdividedTooOften", {}, {"sample", "bow", "--subdivide", "9", "-o", "#/s"}, 1, {"9 times", "0 to 4"}},
    {"UnknownSample", {}, {"sample", "nobody", "-o", "#/s"}, 1, {"nobody", "bow"}},
    {"TemplateWithTheMarkersOfTwo",
     {},
     {"morph", "#/good.obj", "#/good.obj", "--template", "#/good.obj", "--markers", "#/markers.csv", "-o", "#/f_#.obj"},
     1,
     {"--markers", "--template"}},
    {"MapIntoNoFolder", {}, and_then(fit_with("#/good.obj"), {"--map", "#/no/map.csv"}), 3, {"--map", "no folder"}},
    {"MapIsAFolder", {}, and_then(fit_with("#/good.obj"), {"--map", "#"}), 3, {"--map", "folder"}},
    {"WeightsIntoNoFolder",
     {},
     and_then(fit_with("#/good.obj"), {"--weights", "#/no/w.csv"}),
     3,
     {"--weights", "no folder"}},
    {"MapOfTwoFits",
     {},
     {"morph", "#/good.obj", "#/good.obj", "--template", "#/good.obj", "--map", "#/map.csv", "-o", "#/f_#.obj"},
     1,
     {"--map", "--template"}},
    {"RefineIntoNoFolder",
     {},
     and_then(fit_with("#/good.obj"), {"--refine", "#/no/r.ply"}),
     3,
     {"--refine", "no folder"}},
    {"RefineIntoNoMesh", {}, and_then(fit_with("#/good.obj"), {"--refine", "#/r.csv"}), 1, {"--refine", ".ply"}},
    {"RefineIntoStl", {}, and_then(fit_with("#/good.obj"), {"--refine", "#/r.stl"}), 1, {"--refine", "order"}},
    {"RefineOfTwoFits",
     {},
     {"morph", "#/good.obj", "#/good.obj", "--template", "#/good.obj", "--refine", "#/r.ply", "-o", "#/f_#.obj"},
     1,
     {"--refine", "--template"}},
    {"TransferOfNothing", {}, {"transfer", "#/good.obj", "#/good.obj"}, 1, {"-o", "--values", "--points"}},
    {"TransferWithoutColours",
     {},
     {"transfer", "#/good.obj", "#/good.obj", "-o", "#/out.ply"},
     3,
     {"good.obj", "neither colours"}},
    {"TransferPictureTooLarge",
     {},
     {"transfer", "#/good.obj", "#/good.obj", "-o", "#/out.ply", "--texture-size", "8193"},
     1,
     {"--texture-size", "8192"}},
    {"FitLikeAPlainTarget",
     {},
     and_then(fit_with("#/good.obj"), {"--appearance", "target"}),
     3,
     {"good.obj", "neither colours"}},
    {"TheTargetAsResult",
     {{"t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}},
     {"fit", "#/good.obj", "#/t.obj", "-o", "#/./t.obj"},
     1,
     {"t.obj", "file that is read", "another file"}},
    {"ALookThatDoesNotComeBack",
     {},
     {"morph", "#/good.obj", "#/good.obj", "--appearance", "both", "--loop", "-o", "#/x.glb"},
     1,
     {"--appearance both", "--loop"}},
    {"FitLikeBoth", {}, and_then(fit_with("#/good.obj"), {"--appearance", "both"}), 1, {"--appearance", "target"}},
    {"TransferUnknownWay",
     {},
     {"transfer", "#/good.obj", "#/good.obj", "--to", "moon", "-o", "#/out.ply"},
     1,
     {"--to", "template"}},
    {"TransferOtherTemplate",
     {{"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}},
     {"transfer", "#/good.obj", "#/good.obj", "--template", "#/b.obj", "--points", "#/markers.csv", "--points-out",
      "#/p.csv"},
     3,
     {"b.obj", "connectivity"}},
    {"TransferPointsIntoNoFormat",
     {{"p.csv", "a,0,0,0\n"}},
     {"transfer", "#/good.obj", "#/good.obj", "--points", "#/p.csv", "--points-out", "#/p.docx"},
     1,
     {"p.docx", ".landmarkAscii"}},
    {"TransferPointsOfAnotherModel",
     {{"p.csv", "a,10,0,0\nb,11,0,0\n"}},
     {"transfer", "#/good.obj", "#/good.obj", "--points", "#/p.csv", "--points-out", "#/out.csv"},
     3,
     {"p.csv", "2 of 2 points lie further from the mesh"}},
    {"TransferValuesWithoutAName",
     {{"v.csv", "1\n2\n3\n4\n"}},
     {"transfer", "#/good.obj", "#/good.obj", "--values", "#/v.csv"},
     1,
     {"--values-out"}},
    {"TransferTooFewValues",
     {{"v.csv", "w\n1\n2\n3\n"}},
     {"transfer", "#/good.obj", "#/good.obj", "--values", "#/v.csv", "--values-out", "#/w.csv"},
     3,
     {"v.csv", "3 rows", "4 vertices"}},
    {"TransferValuesNotANumber",
     {{"v.csv", "w\n1\n2\nx\n4\n"}},
     {"transfer", "#/good.obj", "#/good.obj", "--values", "#/v.csv", "--values-out", "#/w.csv"},
     3,
     {"v.csv", "line 4"}},
    {"TransferPointsOfBothSides",
     {},
     {"transfer", "#/good.obj", "#/good.obj", "--points", "#/markers.csv", "--points-out", "#/p.csv"},
     3,
     {"markers.csv", "both sides"}},
    {"RotateWithoutAnAxis",
     {{"r.csv", "a,0,0,0,turn\nb,1,0,0,hold\nc,0,1,0,hold\nd,0,0,1,hold\n"}},
     {"rotate", "#/good.obj", "--markers", "#/r.csv", "--axis", "0,0,0", "--centre", "0,0,0", "--angle", "30", "-o",
      "#/out.obj"},
     1,
     {"axis"}},
    {"RotateUnknownRole",
     {{"r.csv", "a,0,0,0,spin\nb,1,0,0,hold\nc,0,1,0,hold\n"}},
     {"rotate", "#/good.obj", "--markers", "#/r.csv", "--axis", "0,0,1", "--centre", "0,0,0", "--angle", "30", "-o",
      "#/out.obj"},
     3,
     {"r.csv", "spin"}},
    {"TruthOfAnotherLength",
     {{"t.csv", "x,y,z\n0,0,0\n"}},
     {"measure", "#/good.obj", "#/good.obj", "#/good.obj", "--truth", "#/t.csv"},
     1,
     {"truth"}},
};

void write(const std::filesystem::path& path, const std::string& contents) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << contents;
}

std::vector<std::string> in_folder(std::vector<std::string> arguments, const std::filesystem::path& folder) {
    for (std::string& a : arguments)
        if (a == "#" || a.starts_with("#/")) a.replace(0, 1, folder.string());
    return arguments;
}

class BadInput : public testing::TestWithParam<Row> {};

TEST_P(BadInput, IsToldAndLeavesNothing) {
    const Row& row = GetParam();
    const TemporaryFolder folder;
    write(folder / "good.obj", tetrahedron);
    write(folder / "markers.csv", four_markers);
    for (const auto& [name, contents] : row.files) write(folder / name, contents);
    const auto before = folder.files();
    const Ran ran = run_program(in_folder(row.arguments, folder.path()));
    EXPECT_EQ(ran.status, row.status) << ran.err;
    EXPECT_EQ(ran.out, "") << "results alone go to standard output";
    for (const std::string& word : row.says)
        EXPECT_NE(ran.err.find(word), std::string::npos) << word << " in: " << ran.err;
    EXPECT_EQ(folder.files(), before);
}

INSTANTIATE_TEST_SUITE_P(Table, BadInput, testing::ValuesIn(rows), [](const auto& row) { return row.param.name; });

// Unusual meshes that are told of, and still give a result.
class Unusual : public testing::TestWithParam<Row> {};

const std::vector<Row> unusual_rows = {
    {"RepeatedVertex", {{"a.obj", with_line(tetrahedron, "f 1 1 2")}}, fit_with("#/a.obj"), 0, {"a.obj", "face 4"}},
    {"NonManifoldEdge",
     {{"a.obj",
       "v 1 1 1\n" + with_line("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 4 3\nf 2 3 5\nf 3 4 5\nf 2 5 4\n", "f 2 3 1")}},
     fit_with("#/a.obj"),
     0,
     {"a.obj", "three"}},
    {"ZeroArea",
     {{"a.obj",
       with_line("v 0.5 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 4 3\nf 2 3 5\nf 3 4 5\nf 2 5 4\n", "f 1 2 3")}},
     fit_with("#/a.obj"),
     0,
     {"a.obj", "area"}},
    {"InsideOut",
     {{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n"}},
     fit_with("#/a.obj"),
     0,
     {"a.obj", "inside"}},
    {"MarkerFarFromTheMesh",
     {{"m.csv", four_markers + "far,0.2,0.2,-2,0.2,0.2,0\n"}},
     fit_with("#/good.obj", "#/m.csv"),
     0,
     {"far"}},
    {"NoMarkers", {}, {"fit", "#/good.obj", "#/good.obj", "-o", "#/out.obj"}, 0, {"no markers", "guess"}},
    {"ATemplateWithoutMarkers",
     {},
     {"morph", "#/good.obj", "#/good.obj", "--template", "#/good.obj", "-o", "#/out.obj", "--at", "0.5"},
     0,
     {"no markers", "guess"}},
    {"OneMarker", {{"m.csv", "a,0,0,0,0,0,0\n"}}, fit_with("#/good.obj", "#/m.csv"), 0, {"1 marker"}},
    {"TwoMarkers", {{"m.csv", "a,0,0,0,0,0,0\nb,1,0,0,1,0,0\n"}}, fit_with("#/good.obj", "#/m.csv"), 0, {"2 markers"}},
    {"MissingMarkerSide",
     {{"m.csv", four_markers + "gone,0,0,0.5,,,\n"}},
     fit_with("#/good.obj", "#/m.csv"),
     0,
     {"gone"}},
};

TEST_P(Unusual, IsToldAndDone) {
    const Row& row = GetParam();
    const TemporaryFolder folder;
    write(folder / "good.obj", tetrahedron);
    write(folder / "markers.csv", four_markers);
    for (const auto& [name, contents] : row.files) write(folder / name, contents);
    const Ran ran = run_program(in_folder(row.arguments, folder.path()));
    EXPECT_EQ(ran.status, 0) << ran.err;
    for (const std::string& word : row.says)
        EXPECT_NE(ran.err.find(word), std::string::npos) << word << " in: " << ran.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "out.obj"));
}

INSTANTIATE_TEST_SUITE_P(Table, Unusual, testing::ValuesIn(unusual_rows),
                         [](const auto& row) { return row.param.name; });

class NotWritable : public testing::Test {
protected:
    void SetUp() override {
        write(folder_ / "good.obj", tetrahedron);
        std::filesystem::create_directory(folder_ / "out");
    }
    std::vector<std::string> tween() const {
        const std::string good = (folder_ / "good.obj").string();
        return {"tween", good, good, "--method", "linear", "-o", (folder_ / "out" / "x.png").string()};
    }
    bool out_is_empty() const { return std::filesystem::is_empty(folder_ / "out"); }
    TemporaryFolder folder_;
};

TEST_F(NotWritable, NoPermission) {
    std::filesystem::permissions(folder_ / "out",
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    const Ran ran = run_program(tween(), [] {
        if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(97); // root may write anywhere
    });
    EXPECT_NE(ran.status, 0);
    EXPECT_TRUE(out_is_empty());
}

TEST_F(NotWritable, FileSizeLimit) { // stands for a full disk where nobody may mount one
    const Ran ran = run_program(tween(), [] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        setrlimit(RLIMIT_FSIZE, &limit);
    });
    EXPECT_EQ(ran.status, 3) << ran.err;
    EXPECT_NE(ran.err.find("x.png"), std::string::npos) << ran.err;
    EXPECT_TRUE(out_is_empty());
}

TEST_F(NotWritable, FullDisk) {
    const auto out = folder_ / "out";
    if (mount("tmpfs", out.c_str(), "tmpfs", 0, "size=4k") != 0) {
        std::printf("no right to mount a small disk here: FileSizeLimit stands for it\n");
        return;
    }
    const Ran ran = run_program(tween());
    const bool empty = out_is_empty();
    umount(out.c_str());
    EXPECT_EQ(ran.status, 3) << ran.err;
    EXPECT_NE(ran.err.find("space"), std::string::npos) << ran.err;
    EXPECT_TRUE(empty);
}

TEST(Interrupt, DuringTheFitLeavesNothing) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program({"sample", "bow", "-o", folder.path().string(), "--quiet"}).status, 0);
    const auto before = folder.files();
    const auto file = [&](const char* name) { return (folder / name).string(); };
    const Ran ran = run_program({"morph", file("bow_source.ply"), file("bow_target.ply"), "--markers",
                                 file("bow_markers.csv"), "--fit", "paper", "--rounds", "100000", "--threshold",
                                 "1e-300", "-o", file("x.glb"), "-o", file("x.png"), "--report", file("r.json")},
                                {}, 1.5);
    EXPECT_EQ(ran.status, 130) << ran.err;
    EXPECT_NE(ran.err.find("stopped"), std::string::npos) << ran.err;
    EXPECT_EQ(folder.files(), before);
}

} // namespace
