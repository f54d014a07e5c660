#include "arcsim/base/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>

#include "arcsim/base/error.hpp"

namespace arcsim {

namespace fs = std::filesystem;

std::string read_text_file(const fs::path& file) {
    std::error_code error;
    if (fs::is_directory(file, error)) throw InputError(file.string() + ": is a folder, not a file.");
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw InputError(file.string() + ": cannot be read (" + std::strerror(errno) + "). Check the name and the working directory.");
    std::ostringstream text;
    text << in.rdbuf();
    if (in.bad()) throw InputError(file.string() + ": reading failed (" + std::strerror(errno) + ").");
    return text.str();
}

AtomicFile::AtomicFile(fs::path file) : file_(std::move(file)) {
    static std::atomic<int> counter{0};   // two writers of one process never share a temporary
    std::error_code error;
    if (file_.has_parent_path()) fs::create_directories(file_.parent_path(), error);
    if (error)
        throw InputError(file_.parent_path().string() + ": cannot make this folder (" + error.message() + "). Choose another with -o.");
    temporary_ = file_;
    temporary_ += "." + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    if (!committed_) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    const auto fail = [&] {
        throw InputError(file_.string() + ": cannot be written (" + std::strerror(errno) +
                         "). Check free space and permissions, or choose another folder with -o.");
    };
    const int descriptor = ::open(temporary_.c_str(), O_RDONLY);
    if (descriptor < 0) fail();
    const bool flushed = ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
    ::close(descriptor);
    if (!flushed || std::rename(temporary_.c_str(), file_.c_str()) != 0) fail();
    committed_ = true;
}

namespace {

void write_temporary(const AtomicFile& target, const fs::path& file, const std::function<void(std::ostream&)>& write) {
    std::ofstream out(target.temporary(), std::ios::binary);
    if (out) write(out);
    out.flush();
    if (!out)
        throw InputError(file.string() + ": cannot be written (" + std::strerror(errno) +
                         "). Check free space and permissions, or choose another folder with -o.");
}

}  // namespace

void write_file_atomically(const fs::path& file, const std::function<void(std::ostream&)>& write) {
    AtomicFile target(file);
    write_temporary(target, file, write);
    target.commit();
}

void write_files_atomically(const std::vector<std::pair<fs::path, std::string>>& files) {
    std::vector<std::unique_ptr<AtomicFile>> targets;
    for (const auto& [file, text] : files) {
        targets.push_back(std::make_unique<AtomicFile>(file));
        write_temporary(*targets.back(), file, [&, &content = text](std::ostream& out) { out << content; });
    }
    for (const auto& target : targets) target->commit();
}

void write_file_atomically(const fs::path& file, std::string_view text) {
    write_file_atomically(file, [&](std::ostream& out) { out.write(text.data(), static_cast<std::streamsize>(text.size())); });
}

}  // namespace arcsim
