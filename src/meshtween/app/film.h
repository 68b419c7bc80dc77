// Pictures of one shape that moves, all from one camera.
#pragma once

#include "meshtween/app/drawing.h"

#include <optional>

namespace meshtween {

// A film's stage: where the camera stands so that all of the motion is in the picture.
class Film {
public:
    // `examples`: positions during the motion, enough of them that it goes nowhere else, of one mesh. Throws
    // Error(argument) for none and for a size out of range.
    // Refers to the mesh and to `other`, the same triangles with another look, to which frames may fade; or none.
    Film(const Mesh& mesh, const std::vector<Points>& examples, int size = 420, const Mesh* other = nullptr);

    // The picture of the mesh at these positions: `size` pixels on the longer side.
    Image frame(const Points& positions, double faded = 0) const;

private:
    Shape placed(const Points& positions, const Triangles& triangles) const;

    Point origin_{0, 0, 0}; // the middle of the motion; each shape stands on the ground
    Layout layout_;
    const Mesh* mesh_;
    Appearance look_;
    std::optional<Appearance> other_;
};

// An animated PNG that repeats for ever, through write_whole. All frames of one size; throws Error(argument) for none.
void write_animated_png(const std::vector<Image>& frames, double seconds_per_frame, const std::filesystem::path& path);

} // namespace meshtween
