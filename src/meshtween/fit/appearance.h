// What a surface looks like at each of its points: vertex colours, materials, their pictures.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/image.h"

#include <memory>
#include <string>
#include <vector>

namespace meshtween {

// The colour of a surface that has none of its own, linear RGB: clay.
inline const Eigen::Vector3f plain_color(0.70F, 0.625F, 0.555F);

class Appearance {
public:
    // Refers to the mesh. Reads the pictures of its materials; one that cannot be read is left out and told in
    // `problems`.
    explicit Appearance(const Mesh& mesh);
    // The same with the pictures of another mesh that has the same file, which are read already.
    Appearance(const Mesh& mesh, const Appearance& alike);

    bool has_pictures() const { return pictures_ > 0; }
    bool has_colors() const { return mesh_->colors.rows() > 0; }
    // Anything to be seen: pictures, colours, or materials that are not all white.
    bool any() const { return has_pictures() || has_colors() || tinted_; }
    const std::vector<std::string>& problems() const { return problems_; } // a sentence each

    // The colour at a triangle's point with these shares of the corners, linear RGB. Pictures repeat beyond 0..1 and
    // are bilinear. In glTF, picture, material and vertex colour multiply; elsewhere a picture goes before colours.
    Eigen::Vector3f at(int triangle, const Eigen::Vector3f& shares) const;

private:
    Eigen::Vector3f vertex_color(int triangle, const Eigen::Vector3f& shares) const;
    Eigen::Vector3f picture_color(const Image& image, int triangle, const Eigen::Vector3f& shares) const;

    const Mesh* mesh_;
    std::vector<std::shared_ptr<const Image>> images_; // beside the file's; null where no material needs it
    std::vector<int> materials_;                       // a triangle: its material, or -1; empty where there is none
    std::vector<std::string> problems_;
    int pictures_ = 0;        // that some triangle shows
    bool tinted_ = false;     // some triangle's material is not white
    bool multiplied_ = false; // as glTF has it
};

} // namespace meshtween
