#include "meshtween/geometry/landmarks.h"

namespace meshtween {

Landmarks landmarks(const Field& body, const std::vector<LandmarkSpot>& places, double reach) {
    Landmarks marks;
    std::vector<Point> points;
    for (const LandmarkSpot& place : places) {
        const Point left = shoot(body, place.inside, place.direction, reach);
        marks.names.push_back(place.name + (place.pair ? "_L" : ""));
        points.push_back(left);
        if (!place.pair) continue;
        marks.names.push_back(place.name + "_R");
        points.push_back({-left[0], left[1], left[2]});
    }
    marks.points.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i) marks.points.row(static_cast<Eigen::Index>(i)) = points[i];
    return marks;
}

} // namespace meshtween
