#include <catch2/catch.hpp>
#include <filesystem>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/paths.hpp"

TEST_CASE("every file of the fuzzers' corpus is read or refused") {
    for (const formwork::FuzzTarget& target : formwork::fuzz_targets()) {
        int files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(project_dir() + "/tests/fuzz/corpus/" + target.name)) {
            INFO(entry.path());
            ++files;
            try {
                target.run(arcsim::read_text_file(entry.path()));
            } catch (const arcsim::InputError&) {   // anything else ends the test
            }
        }
        CHECK(files > 0);
    }
}
