#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcsim {

/// The whole file. @throws InputError: missing, a folder, unreadable
std::string read_text_file(const std::filesystem::path& file);

/// Writes a file so that it is either the old one or the whole new one: the text goes to a temporary name
/// in the same folder, is flushed, and is renamed. Folders on the way are made.
/// @throws InputError when the folder cannot be written or the disk is full; the old file is untouched
void write_file_atomically(const std::filesystem::path& file, std::string_view text);
/// The same, the text being written by `write`.
void write_file_atomically(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// Several files as one: all are written to temporary names before the first is renamed.
void write_files_atomically(const std::vector<std::pair<std::filesystem::path, std::string>>& files);

/// For writers that insist on a file name of their own (libharu, libpng): they write to `temporary()`,
/// then `commit()` renames it. Without commit the temporary is removed.
class AtomicFile {
public:
    explicit AtomicFile(std::filesystem::path file);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    const std::filesystem::path& temporary() const { return temporary_; }
    void commit();   ///< @throws InputError

private:
    std::filesystem::path file_, temporary_;
    bool committed_ = false;
};

}  // namespace arcsim
