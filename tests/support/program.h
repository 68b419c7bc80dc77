// Runs the command-line program as a user would and tells what it said.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

struct Ran {
    int status = -1; // the exit status, or 128 + the signal that ended it
    std::string out, err;
};

// `prepare` runs in the child before the program starts (resource limits and the like). `interrupt_after`: seconds
// after which it gets SIGINT; negative: never.
Ran run_program(const std::vector<std::string>& arguments, const std::function<void()>& prepare = {},
                double interrupt_after = -1);

// A folder that exists while the object does.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }
    std::vector<std::string> files() const; // names, sorted

private:
    std::filesystem::path path_;
};
