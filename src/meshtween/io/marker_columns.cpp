#include "meshtween/io/marker_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace meshtween {
namespace {

// In lower case, without a unit in brackets, every run of other signs as one blank: "X [mm]" is "x", "LM 1_X" "lm 1 x".
std::string plain(std::string_view header) {
    std::string result;
    for (const char c : header.substr(0, header.find_first_of("[("))) {
        const auto u = static_cast<unsigned char>(c);
        if (std::isalnum(u) != 0 || u >= 0x80)
            result += static_cast<char>(std::tolower(u));
        else if (!result.empty() && result.back() != ' ')
            result += ' ';
    }
    while (!result.empty() && result.back() == ' ') result.pop_back();
    if (result.size() > 3 && (result.ends_with(" mm") || result.ends_with(" cm"))) result.resize(result.size() - 3);
    return result;
}

struct AxisName {
    int axis = 0;
    std::string of; // the rest of the name
};

// "source x", "x source", "sx", "posx", "x1": the axis and what it belongs to.
std::optional<AxisName> axis_in(const std::string& name) {
    const auto axis_of = [](char c) { return c == 'x' ? 0 : c == 'y' ? 1 : c == 'z' ? 2 : -1; };
    if (name.empty()) return std::nullopt;
    if (const int axis = axis_of(name.back()); axis >= 0) {
        std::string of = name.substr(0, name.size() - 1);
        if (of.ends_with(' ')) of.pop_back();
        return AxisName{axis, of};
    }
    if (const int axis = axis_of(name.front()); axis >= 0) {
        std::string of = name.substr(1);
        if (of.starts_with(' ')) of.erase(0, 1);
        return AxisName{axis, of};
    }
    return std::nullopt;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_source(std::string_view word) {
    return is_one_of(word, {"s", "src", "source", "from", "moving", "template"});
}

bool is_target(std::string_view word) {
    return is_one_of(word, {"t", "tgt", "dst", "target", "to", "fixed", "destination"});
}

// The columns named x, y and z of each place, in the order of the header.
std::vector<PlaceColumns> places_in(const std::vector<std::string>& names) {
    std::vector<std::string> order;
    std::map<std::string, std::array<std::optional<std::size_t>, 3>> found;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto axis = axis_in(names[i]);
        if (!axis) continue;
        const auto k = static_cast<std::size_t>(axis->axis);
        const bool again = found.count(axis->of) != 0 && found[axis->of][k]; // x y z x y z
        const std::string of = axis->of + (again ? " 2" : "");
        auto [entry, fresh] = found.try_emplace(of);
        if (fresh) order.push_back(of);
        if (!entry->second[k]) entry->second[k] = i;
    }
    std::vector<PlaceColumns> places;
    for (const std::string& name : order)
        if (const auto& c = found[name]; c[0] && c[1] && c[2]) places.push_back({name, {*c[0], *c[1], *c[2]}});
    return places;
}

// Three columns of one letter each, as 3D Slicer names them in the tables that it exports.
std::optional<PlaceColumns> anatomical(const std::vector<std::string>& names, std::string_view letters) {
    PlaceColumns place;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto at = std::find(names.begin(), names.end(), letters.substr(k, 1));
        if (at == names.end()) return std::nullopt;
        place.axes[k] = static_cast<std::size_t>(at - names.begin());
    }
    return place;
}

void keep_sides(MarkerColumns& columns) {
    std::vector<PlaceColumns>& places = columns.places;
    const auto find = [&](const auto& wanted) {
        return std::find_if(places.begin(), places.end(), [&](const PlaceColumns& p) { return wanted(p.name); });
    };
    const auto source = find(is_source), target = find(is_target), bare = find([](const auto&n) { return n.empty(); });
    if (source != places.end() && target != places.end()) {
        places = {*source, *target};
    } else if (bare != places.end() && places.size() == 2 && target == places.end() && is_number(places[1].name)) {
        return; // x y z x.1 y.1 z.1
    } else if (bare != places.end()) {
        places = target != places.end() ? std::vector{*bare, *target} : std::vector{*bare};
    } else if (places.size() == 2) {
        if (target == places.begin() || source == places.begin() + 1) std::swap(places[0], places[1]);
        if (source == places.end() && target == places.end())
            columns.notes.push_back(fmt::format("its columns of '{}' are taken as the source's, those of '{}' as the "
                                                "target's",
                                                places[0].name, places[1].name));
    }
}

std::optional<std::size_t> name_column(const std::vector<std::string>& names, const MarkerColumns& columns) {
    const auto taken = [&](std::size_t i) {
        return std::any_of(columns.places.begin(), columns.places.end(), [&](const PlaceColumns& p) {
            return std::find(p.axes.begin(), p.axes.end(), i) != p.axes.end();
        });
    };
    for (const auto& wanted :
         {std::vector<std::string>{"name", "names", "label", "landmark name", "point name", "marker name"},
          {"landmark", "landmarks", "marker", "point", "lm", "labels", "sample name"},
          {"id"},
          {"", "row names", "rownames", "unnamed 0", "index", "nr", "no", "number"}})
        for (std::size_t i = 0; i < names.size(); ++i)
            if (!taken(i) && std::find(wanted.begin(), wanted.end(), names[i]) != wanted.end()) return i;
    if (!taken(0)) return 0;
    return std::nullopt;
}

void note_unused(MarkerColumns& columns, const std::vector<std::string>& header,
                 const std::vector<std::string>& names) {
    std::vector<std::string> unused;
    for (std::size_t i = 0; i < header.size(); ++i) {
        const bool used = std::any_of(columns.places.begin(), columns.places.end(), [&](const PlaceColumns& p) {
            return std::find(p.axes.begin(), p.axes.end(), i) != p.axes.end();
        });
        if (!used && columns.name != i && columns.defined != i && !names[i].empty()) unused.push_back(header[i]);
    }
    if (!unused.empty()) columns.notes.push_back(fmt::format("columns that are not used: {}", fmt::join(unused, ", ")));
}

} // namespace

std::optional<MarkerColumns> columns_by_name(const std::vector<std::string>& header) {
    std::vector<std::string> names;
    std::transform(header.begin(), header.end(), std::back_inserter(names),
                   [](const auto& cell) { return plain(cell); });
    MarkerColumns columns;
    columns.places = places_in(names);
    if (columns.places.empty())
        for (const auto& [letters, space] : {std::pair("ras", Space::ras), std::pair("lps", Space::lps)})
            if (const auto place = anatomical(names, letters); place && columns.places.empty())
                columns.places = {*place}, columns.space = space;
    if (columns.places.empty()) return std::nullopt;
    keep_sides(columns);
    columns.name = name_column(names, columns);
    if (const auto at = std::find(names.begin(), names.end(), "defined"); at != names.end())
        columns.defined = static_cast<std::size_t>(at - names.begin());
    for (const PlaceColumns& place : columns.places)
        columns.width = std::max(columns.width, *std::max_element(place.axes.begin(), place.axes.end()) + 1);
    if (columns.name) columns.width = std::max(columns.width, *columns.name + 1);
    note_unused(columns, header, names);
    return columns;
}

std::optional<MarkerColumns> columns_by_count(std::size_t cells, bool named) {
    std::size_t name = 0, sides = 0, each = 0;
    switch (cells) {
    case 7:
        name = 1, sides = 2, each = 3;
        break;
    case 6:
        name = 0, sides = 2, each = 3;
        break;
    case 4:
        name = 1, sides = 1, each = 3;
        break;
    case 3:
        name = named ? 1 : 0, sides = named ? 2 : 1, each = named ? 1 : 3;
        break;
    case 2:
        name = named ? 1 : 0, sides = named ? 1 : 2, each = 1;
        break;
    case 1:
        name = 0, sides = 1, each = 1;
        break;
    default:
        return std::nullopt;
    }
    MarkerColumns columns;
    if (name == 1) columns.name = 0;
    for (std::size_t side = 0; side < sides; ++side) {
        const std::size_t first = name + side * each;
        PlaceColumns place;
        if (each == 3)
            place.axes = {first, first + 1, first + 2};
        else
            place.index = first, place.indexed = true;
        columns.places.push_back(place);
    }
    columns.width = cells;
    return columns;
}

} // namespace meshtween
