#include "meshtween/io/output.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ostream>
#include <streambuf>
#include <utility>
#include <vector>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

[[noreturn]] void cannot(const char* verb, const fs::path& path, std::string_view why) {
    throw Error(ErrorKind::file, fmt::format("cannot {} {}: {}", verb, path.string(), why));
}

std::string remedy(int error, const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    switch (error) {
    case ENOENT:
    case ENOTDIR:
        return fmt::format("there is no folder {}; create it first", folder.string());
    case EACCES:
    case EPERM:
    case EROFS:
        return fmt::format("no permission to write in {} ({}); choose another folder", folder.string(),
                           std::strerror(error));
    case ENOSPC:
    case EDQUOT:
        return "the disk is full; free some space or choose another folder";
    case ENAMETOOLONG:
        return "the name is too long";
    default:
        return std::strerror(error);
    }
}

// A descriptor as a stream that keeps the reason for its first failure, which std::ofstream loses.
class DescriptorBuffer : public std::streambuf {
public:
    explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor), buffer_(1 << 18) { rewind(); }
    int error() const { return error_; }

protected:
    int_type overflow(int_type c) override {
        if (!drain()) return traits_type::eof();
        if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
        return traits_type::not_eof(c);
    }
    std::streamsize xsputn(const char* data, std::streamsize size) override {
        if (size <= epptr() - pptr()) return std::streambuf::xsputn(data, size);
        return drain() && put(data, static_cast<std::size_t>(size)) ? size : 0;
    }
    int sync() override { return drain() ? 0 : -1; }

private:
    void rewind() { setp(buffer_.data(), buffer_.data() + buffer_.size()); }
    bool drain() {
        const bool done = put(pbase(), static_cast<std::size_t>(pptr() - pbase()));
        rewind();
        return done;
    }
    bool put(const char* data, std::size_t size) {
        while (size > 0 && error_ == 0) {
            const ssize_t written = ::write(descriptor_, data, size);
            if (written < 0) {
                if (errno != EINTR) error_ = errno;
                continue;
            }
            data += written;
            size -= static_cast<std::size_t>(written);
        }
        return error_ == 0;
    }

    int descriptor_, error_ = 0;
    std::vector<char> buffer_;
};

struct Descriptor {
    int number = -1;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
    int close() { return ::close(std::exchange(number, -1)) == 0 ? 0 : errno; }
};

// Removes the file unless it was renamed.
struct Temporary {
    fs::path path;
    ~Temporary() {
        if (!path.empty()) ::unlink(path.c_str());
    }
};

// Runs `write` into the descriptor and returns the first error number, 0 where all reached the disk.
int fill(Descriptor& file, const std::function<void(std::ostream&)>& write) {
    DescriptorBuffer buffer(file.number);
    std::ostream stream(&buffer);
    write(stream);
    stream.flush();
    if (buffer.error() != 0) return buffer.error();
    if (!stream) return EIO;
    // EINVAL: a pipe or a terminal, which has nothing to sync.
    if (::fsync(file.number) != 0 && errno != EINVAL && errno != EROFS) return errno;
    return file.close();
}

// A device or a pipe (/dev/stdout) must not be renamed over.
void write_straight(const fs::path& path, const std::function<void(std::ostream&)>& write) {
    Descriptor file{::open(path.c_str(), O_WRONLY | O_CLOEXEC)};
    if (file.number < 0) cannot("write", path, remedy(errno, path));
    if (const int error = fill(file, write); error != 0) cannot("write", path, remedy(error, path));
}

} // namespace

void write_whole(const fs::path& path, const std::function<void(std::ostream&)>& write) {
    static std::atomic<unsigned> counter{0};
    std::error_code ignored;
    fs::path destination = path;
    if (fs::is_symlink(path, ignored)) destination = fs::weakly_canonical(path, ignored); // write through a link
    if (destination.empty() || !destination.has_filename()) cannot("write", path, "a file name is needed");
    const fs::file_status status = fs::status(destination, ignored);
    if (fs::is_directory(status)) cannot("write", path, "it is a folder; give a file name in it");
    if (fs::exists(status) && !fs::is_regular_file(status)) return write_straight(destination, write);

    const fs::path beside =
        destination.parent_path() / fmt::format(".meshtween-{}-{}.part", ::getpid(), counter.fetch_add(1));
    Descriptor file{::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)};
    if (file.number < 0) cannot("write", path, remedy(errno, path));
    Temporary temporary{beside};
    if (const int error = fill(file, write); error != 0) cannot("write", path, remedy(error, path));
    if (::rename(beside.c_str(), destination.c_str()) != 0) cannot("write", path, remedy(errno, path));
    temporary.path.clear();
}

void write_whole(const fs::path& path, std::string_view contents) {
    write_whole(path, [contents](std::ostream& stream) {
        stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    });
}

std::string read_whole(const fs::path& path) {
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.number < 0) {
        if (errno == ENOENT || errno == ENOTDIR) cannot("read", path, "there is no such file");
        cannot("read", path, errno == EACCES ? "no permission to read it" : std::strerror(errno));
    }
    struct stat status {};
    if (::fstat(file.number, &status) != 0) cannot("read", path, std::strerror(errno));
    if (S_ISDIR(status.st_mode)) cannot("read", path, "it is a folder; name a file in it");

    std::string bytes(static_cast<std::size_t>(status.st_size) + 1, '\0'); // one more, to see the end
    std::size_t size = 0;
    while (true) {
        const ssize_t got = ::read(file.number, bytes.data() + size, bytes.size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) cannot("read", path, std::strerror(errno));
        if (got == 0) break;
        size += static_cast<std::size_t>(got);
        if (size == bytes.size()) bytes.resize(2 * size);
    }
    bytes.resize(size);
    return bytes;
}

} // namespace meshtween
