// What the properties of a PLY file mean.
#pragma once

#include "meshtween/io/ply.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

namespace meshtween {

// What a vertex's property means. One name a meaning, as the writers in use have them.
enum Slot {
    slot_x,
    slot_y,
    slot_z,
    slot_nx,
    slot_ny,
    slot_nz,
    slot_red,
    slot_green,
    slot_blue,
    slot_alpha,
    slot_u,
    slot_v,
    slot_none
};

inline Slot slot_named(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Slot>, 23> names{{{"x", slot_x},
                                                                              {"y", slot_y},
                                                                              {"z", slot_z},
                                                                              {"nx", slot_nx},
                                                                              {"ny", slot_ny},
                                                                              {"nz", slot_nz},
                                                                              {"red", slot_red},
                                                                              {"green", slot_green},
                                                                              {"blue", slot_blue},
                                                                              {"alpha", slot_alpha},
                                                                              {"r", slot_red},
                                                                              {"g", slot_green},
                                                                              {"b", slot_blue},
                                                                              {"a", slot_alpha},
                                                                              {"diffuse_red", slot_red},
                                                                              {"diffuse_green", slot_green},
                                                                              {"diffuse_blue", slot_blue},
                                                                              {"s", slot_u},
                                                                              {"t", slot_v},
                                                                              {"u", slot_u},
                                                                              {"v", slot_v},
                                                                              {"texture_u", slot_u},
                                                                              {"texture_v", slot_v}}};
    for (const auto& [known, slot] : names)
        if (known == name) return slot;
    return slot_none;
}

inline bool is_corner_list(const PlyProperty& property) {
    return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// The meaning of an element's properties, and which of them make a whole.
struct Slots {
    std::vector<Slot> of;
    std::array<bool, slot_none + 1> has{};

    explicit Slots(const PlyElement& element) {
        for (const PlyProperty& property : element.properties) {
            of.push_back(property.is_list ? slot_none : slot_named(property.name));
            has[of.back()] = true;
        }
    }
    bool has_all(std::initializer_list<Slot> slots) const {
        return std::all_of(slots.begin(), slots.end(), [&](Slot slot) { return has[slot]; });
    }
};

} // namespace meshtween
