#include "meshtween/io/usd_text.h"

namespace meshtween {
namespace {

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

} // namespace

std::string usd_quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return result + '"';
}

std::string usd_name(const std::string& name, const std::string& otherwise) {
    std::string result;
    for (const char c : name) result += is_letter(c) || is_digit(c) ? c : '_';
    if (result.find_first_not_of('_') == std::string::npos) result = otherwise;
    return is_digit(result[0]) ? "_" + result : result;
}

std::string usd_unique(const std::string& name, std::set<std::string>& taken) {
    std::string result = name;
    for (int number = 2; !taken.insert(result).second; ++number) result = fmt::format("{}_{}", name, number);
    return result;
}

} // namespace meshtween
