// A web page anywhere can send requests to 127.0.0.1, and a name that it owns can be made to point there (DNS
// rebinding). The token keeps out whoever was not told the address; Host keeps out rebound names; Origin and
// Sec-Fetch-Site keep out foreign pages even where the token has leaked.
#include "guard.h"

#include <fmt/format.h>

#include <random>

namespace meshtween::studio {
namespace {

// Takes the same time wherever the first difference is.
bool same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

} // namespace

std::string Guard::address() const {
    return fmt::format("http://127.0.0.1:{}/{}/", port, token);
}

std::string Guard::admitted_path(const Asked& asked) const {
    const std::string by_number = fmt::format("127.0.0.1:{}", port), by_name = fmt::format("localhost:{}", port);
    if (asked.host != by_number && asked.host != by_name) return {};
    if (!asked.origin.empty() && asked.origin != "http://" + asked.host) return {};
    if (!asked.fetch_site.empty() && asked.fetch_site != "same-origin" && asked.fetch_site != "none") return {};
    const std::string_view path = asked.path;
    if (path.empty() || path.front() != '/') return {};
    const std::size_t end = path.find('/', 1);
    if (end == std::string_view::npos || token.empty() || !same_secret(path.substr(1, end - 1), token)) return {};
    return std::string(path.substr(end));
}

std::string random_token() {
    std::random_device device; // the operating system's own source
    std::string token;
    for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
    return token;
}

} // namespace meshtween::studio
