// A legacy VTK file word by word and block by block, as text or as big-endian numbers.
#pragma once

#include "meshtween/io/vtk.h"

#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

struct VtkDamage { // said as Error(file) for the shape, as a note for what comes after it
    std::string what;
};

std::string upper_case(std::string_view word);
std::string decoded_vtk_name(std::string_view name); // names are written with %20 for a blank
VtkType vtk_type_named(std::string_view word);       // throws VtkDamage

// Numbers of three a point: bytes begin .. end of the file; nothing where begin is 0.
struct VtkBlock {
    std::size_t begin = 0, end = 0;
    VtkType type = VtkType::unknown;
    std::string_view type_name; // in the file
};

class VtkWords {
public:
    explicit VtkWords(std::string_view bytes) : bytes_(bytes) {}

    std::string_view next_word();
    std::string_view rest_of_line(); // the next line begins behind it
    std::uint64_t count(std::string_view what);
    std::string place() const; // of the last word, for messages

    // The numbers from here on; `values` is null where nobody needs them. What is no number becomes one that is not
    // finite.
    VtkBlock numbers(std::string_view type_name, std::uint64_t total, std::string_view what,
                     std::vector<double>* values);

    // a times b, where the file can hold so many.
    std::uint64_t product(std::uint64_t a, std::uint64_t b, std::string_view what) const;

    std::size_t at() const { return at_; }
    void go(std::size_t at) { at_ = word_ = at; }
    void go_back() { at_ = word_; } // to the begin of the last word
    bool at_end() const { return at_ >= bytes_.size(); }
    bool follows(std::string_view text) const { return bytes_.substr(at_, text.size()) == text; }

    bool ascii = true;

private:
    void require_room(VtkType type, std::uint64_t numbers, std::string_view what) const;
    std::size_t bytes_a_number(VtkType type, std::string_view name, std::uint64_t numbers) const;
    void skip_strings(std::uint64_t numbers);
    void words_as_numbers(std::uint64_t total, std::string_view what, std::vector<double>* values);
    void bytes_as_numbers(VtkType type, std::size_t size, std::uint64_t total, std::string_view what,
                          std::vector<double>* values);

    std::string_view bytes_;
    std::size_t at_ = 0, word_ = 0;
};

} // namespace meshtween
