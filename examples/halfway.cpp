// The shape halfway between two, in ten lines: halfway source.obj target.obj markers.csv halfway.obj
#include <meshtween/fit/fit.h>
#include <meshtween/fit/markers.h>
#include <meshtween/io/mesh_io.h>
#include <meshtween/morph/morph.h>

#include <iostream>

int main(int count, char** file) try {
    using namespace meshtween;
    if (count != 5) return 1;
    const Mesh source = read_mesh(file[1]), target = read_mesh(file[2]);
    const MarkerPairs markers = read_marker_pairs(file[3], source, target);
    const FitResult fitted = fit(source, target, place_markers(markers.pairs, source));
    Mesh halfway = source;
    halfway.positions = morph(source, fitted.positions).at(0.5);
    write_mesh(halfway, file[4]);
} catch (const std::exception& error) { // names the file or the marker, and the remedy
    std::cerr << error.what() << '\n';
    return 1;
}
