// Who may ask the studio's server anything at all.
#pragma once

#include <string>
#include <string_view>

namespace meshtween::studio {

// What a request says of where it comes from. Several headers of one name count as a wrong one.
struct Asked {
    std::string path;       // as sent, from its first slash
    std::string host;       // Host
    std::string origin;     // Origin; empty where there is none
    std::string fetch_site; // Sec-Fetch-Site; empty where there is none
};

// The secret in the address that the program prints, and the port it listens on.
struct Guard {
    std::string token;
    int port = 0;

    std::string address() const; // http://127.0.0.1:PORT/TOKEN/
    // The path without the token ("/api/state"), or empty where the request must be refused: no or a wrong token, a
    // Host that is not this machine's own name (a rebound name), an Origin that is not this page (a foreign page).
    std::string admitted_path(const Asked& asked) const;
};

std::string random_token(); // 32 hexadecimal digits from the operating system

} // namespace meshtween::studio
