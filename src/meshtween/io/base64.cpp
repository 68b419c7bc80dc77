#include "meshtween/io/base64.h"

#include <algorithm>
#include <cstdint>

namespace meshtween {
namespace {

int digit_of(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

} // namespace

std::string to_base64(std::string_view bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) result += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return result;
}

std::optional<std::string> from_base64(std::string_view text, std::size_t most) {
    std::string result;
    result.reserve(std::min(most, text.size() / 4 * 3 + 3));
    std::uint32_t word = 0;
    int digits = 0, padding = 0;
    for (const char c : text) {
        if (result.size() >= most) break;
        if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
        const int digit = c == '=' ? 0 : digit_of(c);
        if (digit < 0) return std::nullopt;
        padding += c == '=';
        word = word << 6 | static_cast<std::uint32_t>(digit);
        if (++digits < 4) continue;
        for (int k = 0; k < 3 - std::min(padding, 2); ++k) result += static_cast<char>(word >> (16 - 8 * k) & 0xFF);
        word = 0;
        digits = padding = 0;
    }
    for (int k = 0; k + 1 < digits - padding; ++k) // text without its padding
        result += static_cast<char>(word << (6 * (4 - digits)) >> (16 - 8 * k) & 0xFF);
    if (result.size() > most) result.resize(most);
    return result;
}

} // namespace meshtween
