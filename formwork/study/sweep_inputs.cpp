#include "formwork/study/sweep_inputs.hpp"

#include <cstdint>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/json_reader.hpp"

namespace formwork {
namespace {

using std::filesystem::path;

/// FNV-1a; not a matter of security.
class Hash {
public:
    void add(const std::string& text) {
        for (unsigned char c : text) h_ = (h_ ^ c) * 0x100000001b3u;
        h_ = (h_ ^ text.size()) * 0x100000001b3u;   // "ab","c" is not "a","bc"
    }
    std::string text() const { return std::to_string(h_); }

private:
    std::uint64_t h_ = 0xcbf29ce484222325u;
};

/// Adds the contents of the file that `name` names, if it names one: beside the scene first, then here.
void add_file(const std::string& name, const path& beside, Hash& hash) {
    if (name.empty() || name.size() > 4096) return;
    for (const path& file : {beside / name, path(name)}) {
        std::error_code none;
        if (!std::filesystem::is_regular_file(file, none)) continue;
        try {
            hash.add(arcsim::read_text_file(file));
        } catch (const arcsim::InputError&) {   // unreadable: the point itself will say so
        }
        return;
    }
}

void add_named_files(const arcsim::JsonValue& v, const path& beside, Hash& hash) {
    if (v.kind == arcsim::JsonKind::string) add_file(v.string, beside, hash);
    for (const arcsim::JsonValue& item : v.items) add_named_files(item, beside, hash);
    for (const auto& [key, member] : v.members) add_named_files(member, beside, hash);
}

}  // namespace

std::string fingerprint_inputs(const path& scene, const std::vector<std::string>& words) {
    Hash hash;
    hash.add(arcsim::read_text_file(scene));
    add_named_files(arcsim::read_json(scene).root, scene.parent_path(), hash);
    for (const std::string& word : words) {
        hash.add(word);
        add_file(word, scene.parent_path(), hash);
    }
    return hash.text();
}

}  // namespace formwork
