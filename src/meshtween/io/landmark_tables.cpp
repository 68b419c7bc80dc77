// Landmark files of geometric morphometrics, which hold one specimen or several: tps and NTSYS (Rohlf, The tps series
// of software, Hystrix 2015), of which Landmark Editor's dta is one; morphologika (O'Higgins and Jones, Tools for
// statistical shape analysis, 2006); Amira's and Avizo's landmark sets.
#include "meshtween/io/cells.h"
#include "meshtween/io/marker_files.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

// Three words of the line, cut at blanks and commas: a point, or none where all three are NA or `missing`.
MarkerPlace point_of(const std::vector<std::string>& words, const Text& text, std::optional<double> missing) {
    if (words.size() != 3)
        text.fail(words.size() == 2
                      ? "a point of two coordinates; these landmarks are flat, of a picture, and cannot lie on a mesh"
                      : fmt::format("a point has three coordinates, this row {}; the file is truncated or damaged",
                                    words.size()));
    if (std::all_of(words.begin(), words.end(), [](const std::string& word) { return is_missing(word); })) return {};
    Point point;
    for (std::size_t k = 0; k < 3; ++k)
        point[static_cast<Eigen::Index>(k)] = text.finite_from(words[k], std::string(1, "xyz"[k]));
    if (missing && (point.array() == *missing).all()) return {};
    return point;
}

MarkerRow row_of(const Text& text, std::string_view line, std::optional<double> missing) {
    return {"", fmt::format("line {}", text.line_number()), {point_of(cells_of(line), text, missing)}};
}

// Several specimens stay so; one alone is the file's rows.
MarkerFile of_specimens(std::vector<Specimen> specimens, const fs::path& path) {
    if (specimens.empty()) bad_file(path, "holds no landmarks");
    MarkerFile file;
    file.sides = 1;
    if (specimens.size() == 1)
        file.rows = std::move(specimens[0].rows);
    else
        file.specimens = std::move(specimens);
    return file;
}

void require_count(const Text& text, std::string_view what, long long promised, std::size_t held) {
    if (promised != static_cast<long long>(held))
        text.fail(
            fmt::format("{} promises {} landmarks but holds {}; it is truncated or damaged", what, promised, held));
}

// The next line that is not empty; false at the end.
bool next_full_line(Text& text) {
    while (text.next_line())
        if (!text.peek().empty()) return true;
    return false;
}

long long count_in(const Text& text, std::string_view word, std::string_view what) {
    constexpr long long most = 100'000'000;
    const long long count = text.integer_from(word, what);
    if (count < 1 || count > most) text.fail(fmt::format("{} is {}, which cannot be", what, count));
    return count;
}

} // namespace

MarkerFile read_tps(std::string_view bytes, const fs::path& path) {
    std::vector<Specimen> specimens;
    std::vector<double> scales;
    std::size_t curves = 0;
    Text text(bytes, path);
    long long promised = 0, passing = 0;
    while (next_full_line(text)) {
        const std::string line = trimmed(text.line());
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos) {
            if (passing > 0) {
                --passing; // points of a curve
            } else {
                if (specimens.empty()) text.fail("a tps file begins with LM= or LM3=");
                specimens.back().rows.push_back(row_of(text, line, std::nullopt));
                if (std::ssize(specimens.back().rows) > promised)
                    text.fail(fmt::format("the specimen promises {} landmarks but holds more; the file is damaged",
                                          promised));
            }
            continue;
        }
        const std::string key = lower(trimmed(line.substr(0, equals))), value = trimmed(line.substr(equals + 1));
        if (key == "lm" || key == "lm3") {
            if (!specimens.empty()) require_count(text, "the specimen before", promised, specimens.back().rows.size());
            promised = count_in(text, value, key == "lm" ? "LM" : "LM3");
            specimens.emplace_back();
            scales.push_back(1);
        } else if (specimens.empty()) {
            text.fail("a tps file begins with LM= or LM3=");
        } else if (key == "id") {
            specimens.back().id = value;
        } else if (key == "image" && specimens.back().id.empty()) {
            specimens.back().id = fs::path(value).stem().string();
        } else if (key == "scale") {
            scales.back() = text.finite_from(value, "SCALE");
            if (!(scales.back() > 0)) text.fail(fmt::format("SCALE is {}; it should be above 0", shown(value)));
        } else if (key == "points" || key == "points3") {
            passing = count_in(text, value, "POINTS");
            ++curves;
        }
    }
    if (!specimens.empty()) require_count(text, "the specimen", promised, specimens.back().rows.size());
    for (std::size_t i = 0; i < specimens.size(); ++i)
        for (MarkerRow& row : specimens[i].rows)
            if (auto* point = std::get_if<Point>(&row.places[0])) *point *= scales[i];
    const bool scaled = std::any_of(scales.begin(), scales.end(), [](double s) { return s != 1; });
    MarkerFile file = of_specimens(std::move(specimens), path);
    if (scaled) file.notes.push_back("its coordinates are multiplied by its SCALE");
    if (curves > 0) file.notes.push_back(fmt::format("{} curves are passed over; landmarks alone are read", curves));
    return file;
}

namespace {

// "1 2L 36 1 9999 DIM=3": a matrix, its rows (L, B, E: with names, before all, at the rows' beginnings or ends), its
// columns, whether some are missing, their number.
struct NtsHeader {
    long long rows = 0, columns = 0;
    char names = ' ';
    bool column_names = false;
    std::optional<double> missing;
};

NtsHeader nts_header(const Text& text, const std::vector<std::string>& words) {
    if (words.size() < 4 || words[0] != "1")
        text.fail("should be the matrix's line, such as 1 2L 36 1 9999 DIM=3; this is no NTSYS or Landmark file");
    if (words[1].empty() || words[2].empty())
        text.fail("says no numbers of specimens and coordinates; the file is damaged");
    NtsHeader header;
    const auto without_letter = [](std::string word) {
        if (!word.empty() && std::isalpha(static_cast<unsigned char>(word.back())) != 0) word.pop_back();
        return word;
    };
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(words[1].back())));
    if (letter == 'L' || letter == 'B' || letter == 'E') header.names = letter;
    header.column_names = std::isalpha(static_cast<unsigned char>(words[2].back())) != 0;
    header.rows = count_in(text, without_letter(words[1]), "the number of specimens");
    header.columns = count_in(text, without_letter(words[2]), "the number of coordinates");
    if (words[3] == "1" && words.size() > 4) header.missing = text.finite_from(words[4], "the missing value");
    if (words[3] != "0" && words[3] != "1") text.fail("the fourth word says whether values are missing: 0 or 1");
    const std::string last = lower(words.back());
    if (last.starts_with("dim=") && last != "dim=3")
        text.fail(
            fmt::format("{}: its landmarks have not three coordinates and cannot lie on a mesh", shown(words.back())));
    if (header.columns % 3 != 0) text.fail(fmt::format("{} coordinates are not three a landmark", header.columns));
    return header;
}

// The names before the matrix: a line each, or all of them in lines of words.
std::vector<std::string> nts_names(Text& text, long long count) {
    std::vector<std::string> lines, words;
    while (static_cast<long long>(words.size()) < count && static_cast<long long>(lines.size()) < count) {
        if (!next_full_line(text)) text.fail(fmt::format("{} names are promised; the file is truncated", count));
        lines.push_back(trimmed(text.line()));
        for (const std::string& word : cells_of(lines.back(), ' ')) words.push_back(word);
    }
    return static_cast<long long>(lines.size()) == count ? lines : words;
}

} // namespace

MarkerFile read_nts(std::string_view bytes, const fs::path& path) {
    Text text(bytes, path);
    do {
        if (!next_full_line(text)) bad_file(path, "holds no matrix; it is truncated or of another format");
    } while (text.peek().front() == '\'' || text.peek().front() == '"');
    const NtsHeader header = nts_header(text, cells_of(text.line(), ' '));
    std::vector<std::string> names;
    if (header.names == 'L') names = nts_names(text, header.rows);
    if (header.column_names) nts_names(text, header.columns);
    std::vector<Specimen> specimens;
    std::vector<std::string> words;
    std::vector<long> lines;
    const auto per_row = static_cast<std::size_t>(header.columns);
    std::size_t in_row = 0;
    bool named = false; // this row, at its beginning
    while (next_full_line(text)) {
        std::string line(text.line());
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
        for (std::string& cell : cells_of(line, ' ')) {
            const bool at_end = header.names == 'E' && in_row == per_row;
            if (at_end || (header.names == 'B' && in_row == 0 && !named)) {
                names.push_back(std::move(cell));
                named = !at_end;
                if (at_end) in_row = 0;
                continue;
            }
            words.push_back(std::move(cell));
            lines.push_back(text.line_number());
            if (++in_row == per_row && header.names != 'E') in_row = 0, named = false;
        }
    }
    const std::size_t promised = static_cast<std::size_t>(header.rows) * per_row;
    if (words.size() != promised)
        bad_file(path,
                 fmt::format("promises {} specimens of {} coordinates, which are {}, but holds {}; it is truncated or "
                             "damaged",
                             header.rows, header.columns, promised, words.size()));
    for (std::size_t i = 0; i < words.size(); i += 3) {
        if (i % per_row == 0) specimens.push_back({i / per_row < names.size() ? names[i / per_row] : "", {}});
        const Text at({}, path, lines[i] + 1);
        specimens.back().rows.push_back({"",
                                         fmt::format("line {}", lines[i]),
                                         {point_of({words[i], words[i + 1], words[i + 2]}, at, header.missing)}});
    }
    return of_specimens(std::move(specimens), path);
}

MarkerFile read_morphologika(std::string_view bytes, const fs::path& path) {
    Text text(bytes, path);
    std::string section;
    long long individuals = 0, landmarks = 0;
    std::vector<std::string> names;
    std::vector<MarkerRow> rows;
    while (next_full_line(text)) {
        const std::string line = trimmed(text.line());
        if (line.front() == '[') {
            section = lower(line.substr(1, line.find(']') - 1));
        } else if (section == "individuals") {
            individuals = count_in(text, line, "the number of individuals");
        } else if (section == "landmarks") {
            landmarks = count_in(text, line, "the number of landmarks");
        } else if (section == "dimensions") {
            if (line != "3")
                text.fail(fmt::format("its landmarks have {} coordinates and cannot lie on a mesh", shown(line)));
        } else if (section == "names") {
            names.push_back(line);
        } else if (section == "rawpoints" && line.front() != '\'') {
            rows.push_back(row_of(text, line, 9999));
        }
    }
    if (individuals == 0 || landmarks == 0)
        bad_file(path, "lacks [individuals] or [landmarks]; it is truncated or of another format");
    if (std::ssize(rows) != individuals * landmarks)
        bad_file(path,
                 fmt::format("promises {} individuals of {} landmarks, which are {}, but holds {}; it is truncated "
                             "or damaged",
                             individuals, landmarks, individuals * landmarks, rows.size()));
    std::vector<Specimen> specimens(static_cast<std::size_t>(individuals));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Specimen& specimen = specimens[i / static_cast<std::size_t>(landmarks)];
        if (specimen.rows.empty() && i / static_cast<std::size_t>(landmarks) < names.size())
            specimen.id = names[i / static_cast<std::size_t>(landmarks)];
        specimen.rows.push_back(std::move(rows[i]));
    }
    return of_specimens(std::move(specimens), path);
}

MarkerFile read_amira(std::string_view bytes, const fs::path& path) {
    if (bytes.substr(0, bytes.find('\n')).find("BINARY") != std::string_view::npos)
        bad_file(path, "binary landmark sets are not read; save it as ASCII (.landmarkAscii)");
    Text text(bytes, path);
    long long count = -1;
    std::vector<std::string> labels; // of the coordinates: "@1", and "@2" for a second set
    std::vector<std::vector<MarkerRow>> sets;
    std::string current;
    while (next_full_line(text)) {
        const std::string line = trimmed(text.line());
        if (line.front() == '#') continue;
        if (line.front() == '@') {
            current = line;
            if (std::find(labels.begin(), labels.end(), current) != labels.end()) sets.emplace_back();
        } else if (!current.empty()) {
            if (std::find(labels.begin(), labels.end(), current) == labels.end()) continue; // types, orientations
            sets.back().push_back(row_of(text, line, std::nullopt));
        } else if (lower(line).starts_with("define markers")) {
            count = count_in(text, trimmed(line.substr(14)), "the number of markers");
        } else if (line.starts_with("Markers") && line.find("Coordinates") != std::string::npos) {
            const std::size_t at = line.find('@');
            if (at == std::string::npos || line.find("[3]") == std::string::npos)
                text.fail("markers should be float[3] Coordinates with an @ and a number");
            labels.push_back(trimmed(line.substr(at)));
        }
    }
    if (count < 0 || labels.empty()) bad_file(path, "defines no Markers with Coordinates; it is no landmark set");
    if (labels.size() > 2) bad_file(path, fmt::format("holds {} sets; one or two are read", labels.size()));
    if (sets.size() != labels.size()) bad_file(path, "lacks the data of a set; it is truncated");
    for (const auto& set : sets)
        if (std::ssize(set) != count)
            bad_file(path,
                     fmt::format("promises {} landmarks but holds {}; it is truncated or damaged", count, set.size()));
    MarkerFile file{std::move(sets[0]), sets.size(), {}, Space::unknown, {}};
    for (std::size_t i = 0; file.sides == 2 && i < file.rows.size(); ++i)
        file.rows[i].places.push_back(sets[1][i].places[0]);
    return file;
}

} // namespace meshtween
