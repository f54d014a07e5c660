#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

/// A folder for the files that one test writes. It goes with the test, unless the environment
/// variable FORMWORK_TEST_OUTPUT names a folder to keep them in, for looking at and for other
/// readers.
class OutputFolder {
public:
    explicit OutputFolder(const std::string& name) {
        const char* kept = std::getenv("FORMWORK_TEST_OUTPUT");
        keep_ = kept != nullptr;
        path_ = keep_ ? std::filesystem::path(kept) / name
                      : std::filesystem::temp_directory_path() /
                            ("formwork-" + name + "-" + std::to_string(::getpid()));
        std::filesystem::create_directories(path_);
    }
    ~OutputFolder() {
        std::error_code ignored;
        if (!keep_) std::filesystem::remove_all(path_, ignored);
    }
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    std::filesystem::path operator/(const std::string& file) const { return path_ / file; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    bool keep_ = false;
};
