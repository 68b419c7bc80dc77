#include "studio.h"

#include "projects.h"
#include "server.h"

#include "meshtween/core/error.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

// Where projects that begin in the studio go: beside the named one where there is no home folder.
fs::path choose_shelf(const StudioOptions& options) {
    try {
        return state_folder();
    } catch (const Error&) {
        if (options.project.empty()) throw;
        return fs::absolute(options.project).parent_path() / "projects";
    }
}

fs::path choose_project(const StudioOptions& options, const fs::path& shelf) {
    if (!options.project.empty()) return options.project;
    if (options.meshes.size() == 2) return project_of(shelf, options.meshes[0], options.meshes[1]);
    if (fs::exists(shelf / "last")) {
        const fs::path last = read_whole(shelf / "last");
        if (fs::exists(last)) return last;
    }
    return shelf / "new" / "project.json";
}

void open_browser(const std::string& address) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
    const pid_t child = ::fork();
    if (child == 0) {
        if (::fork() == 0) { // a grandchild, so that nobody has to wait for it
            ::setsid();
            ::execlp("xdg-open", "xdg-open", address.c_str(), nullptr);
        }
        ::_exit(0);
    }
    if (child > 0) ::waitpid(child, nullptr, 0);
}

} // namespace

void run_studio(const StudioOptions& options) {
    for (const fs::path& mesh : options.meshes)
        if (!fs::is_regular_file(mesh))
            throw Error(ErrorKind::file, fmt::format("{}: there is no such file to open", mesh.string()));
    const fs::path shelf = choose_shelf(options);
    const fs::path project = fs::absolute(choose_project(options, shelf));
    std::error_code failure;
    fs::create_directories(project.parent_path(), failure);
    Events events;
    Session session(project, options.meshes, events, shelf);
    if (const Json state = session.state();
        !options.meshes.empty() && (state["meshes"]["source"].is_null() || state["meshes"]["target"].is_null()))
        throw Error(ErrorKind::file,
                    state["notes"].empty() ? "the meshes could not be opened" : state["notes"][0].get<std::string>());
    if (options.project.empty()) write_whole(shelf / "last", project.string());
    Server server(session, events, options.port, options.most_upload);
    std::thread serving([&] { server.listen(); });
    if (options.ready) options.ready(server.guard().address());
    if (options.browser) open_browser(server.guard().address());
    while (!options.stop_wanted || !options.stop_wanted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    session.cancel();
    server.stop();
    serving.join();
}

} // namespace meshtween::studio
