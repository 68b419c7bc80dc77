// Which of a mesh's vertices are one vertex, by all that its file says.
#pragma once

#include "meshtween/geometry/weld.h"

namespace meshtween {

// weld() with the normals and further texture coordinates of the mesh's file.
Weld seams(const Mesh& mesh, const std::vector<const Points*>& shapes = {});

// The mesh where no vertices are one or nobody wants to know, else a welded copy. The mesh must outlive it.
struct WholeMesh {
    explicit WholeMesh(const Mesh& given, bool weld = true) : seams(weld ? meshtween::seams(given) : Weld()) {
        if (seams.any()) copy_ = welded(given, seams);
        mesh_ = seams.any() ? nullptr : &given;
    }
    const Mesh& mesh() const { return mesh_ != nullptr ? *mesh_ : copy_; }

    Weld seams;

private:
    const Mesh* mesh_ = nullptr;
    Mesh copy_;
};

} // namespace meshtween
