#include "studio.h"

#include "server.h"

#include "meshtween/core/error.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

// The project that the last run without meshes, or with them, worked on.
fs::path last_project_note() {
    return state_folder() / "last";
}

fs::path choose_project(const StudioOptions& options) {
    if (!options.project.empty()) return options.project;
    if (options.meshes.size() == 2) return project_of(options.meshes[0], options.meshes[1]);
    if (fs::exists(last_project_note())) {
        const fs::path last = read_whole(last_project_note());
        if (fs::exists(last)) return last;
    }
    return state_folder() / "new" / "project.json";
}

// One studio a project: two would overwrite each other's work. The lock ends with the process, however that ends.
class ProjectLock {
public:
    explicit ProjectLock(const fs::path& project) {
        const fs::path file = project.parent_path() / fmt::format(".{}.lock", project.filename().string());
        descriptor_ = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
        if (descriptor_ < 0)
            throw Error(ErrorKind::file, fmt::format("{}: cannot write here", project.parent_path().string()));
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
            throw Error(ErrorKind::file, fmt::format("{} is open in another studio; close that one, or name another "
                                                     "project with --project",
                                                     project.string()));
    }
    ~ProjectLock() { ::close(descriptor_); }
    ProjectLock(const ProjectLock&) = delete;
    ProjectLock& operator=(const ProjectLock&) = delete;

private:
    int descriptor_ = -1;
};

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
    const fs::path project = fs::absolute(choose_project(options));
    std::error_code failure;
    fs::create_directories(project.parent_path(), failure);
    const ProjectLock lock(project);
    Events events;
    Session session(project, options.meshes, events);
    if (const Json state = session.state();
        !options.meshes.empty() && (state["meshes"]["source"].is_null() || state["meshes"]["target"].is_null()))
        throw Error(ErrorKind::file,
                    state["notes"].empty() ? "the meshes could not be opened" : state["notes"][0].get<std::string>());
    if (options.project.empty()) write_whole(last_project_note(), project.string());
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
