// Which columns of a table of markers hold what: by the header's names, in any order, else by their number.
#pragma once

#include "meshtween/io/cells.h"
#include "meshtween/io/space.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace meshtween {

struct PlaceColumns {
    std::string name;                  // "source" of source_x, "" of x, "1" of 1.X
    std::array<std::size_t, 3> axes{}; // the columns of x, y and z
    std::size_t index = 0;             // the column of a vertex's number, where `indexed`
    bool indexed = false;
};

struct MarkerColumns {
    std::optional<std::size_t> name, defined; // defined: Slicer's 0 and 1
    std::vector<PlaceColumns> places;         // one or two; more where a row is a specimen
    Space space = Space::unknown;             // columns named r a s or l p s
    std::size_t width = 0;                    // so many cells a row needs
    std::vector<std::string> notes;
};

// Nothing where the header names no places; `header` is not empty.
std::optional<MarkerColumns> columns_by_name(const std::vector<std::string>& header);

// By the number of cells of a row, the first of them a name or not; nothing where no layout has so many.
std::optional<MarkerColumns> columns_by_count(std::size_t cells, bool named);

} // namespace meshtween
