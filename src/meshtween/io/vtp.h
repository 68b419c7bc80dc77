// The newer of VTK's formats, .vtp: an XML file whose arrays are text, letters of base64 or raw bytes behind the XML.
#pragma once

#include "meshtween/io/vtk.h"

#include <pugixml.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

// How arrays become bytes.
struct VtpEncoding {
    bool big_endian = false;
    bool compressed = false;     // by zlib, in blocks
    std::size_t header_size = 4; // bytes of each number before the data
};

struct VtpFile {
    std::filesystem::path path;
    pugi::xml_document xml;    // AppendedData without what comes behind its underscore
    std::string_view appended; // that
    bool appended_base64 = false;
    VtpEncoding encoding;
    std::vector<pugi::xml_node> pieces;
    mutable std::uint64_t read = 0; // bytes of the appended data so far, as they are stored
};

// Throws Error(file): no XML, another kind of data, a compression that is not read. `bytes` must stay.
void open_vtp(VtpFile& file, std::string_view bytes, const std::filesystem::path& path);

VtkType vtp_type(pugi::xml_node array);
VtkType vtp_type_named(std::string_view name);
int vtp_components(pugi::xml_node array);
pugi::xml_node vtp_array(pugi::xml_node parent, const char* name);

// The text of this name in the file's field data; empty where there is none. Throws Error(file) as above.
std::string vtp_field_text(std::string_view bytes, const std::filesystem::path& path, const char* name);

// An array's numbers. Throws Error(file): damaged, or other than `expected` where that is not any_count; what is
// compressed is inflated only where its header promises as many.
constexpr std::size_t any_count = static_cast<std::size_t>(-1);
std::vector<double> vtp_numbers(const VtpFile& file, pugi::xml_node array, std::string_view what, std::size_t expected);

// The same as the file holds them: text, letters or bytes.
std::string vtp_encoded(const std::string& little_endian_bytes, VtkType type, const VtpEncoding& encoding, bool base64);

} // namespace meshtween
