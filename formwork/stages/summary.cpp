#include "formwork/stages/summary.hpp"

#include <cstdint>

#include "arcsim/base/files.hpp"

namespace formwork {

using arcsim::JsonValue;

JsonValue read_summary(const std::filesystem::path& dir) {
    const std::filesystem::path file = dir / "summary.json";
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return JsonValue::object();
    return arcsim::read_json(file).root;
}

void write_summary(const std::filesystem::path& dir, const JsonValue& summary) {
    arcsim::write_file_atomically(dir / "summary.json", arcsim::to_text(summary));
}

std::string fingerprint(std::string_view bytes) {
    std::uint64_t h = 14695981039346656037ull;
    for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    std::string text(16, '0');
    for (int i = 15; i >= 0; --i, h >>= 4) text[i] = "0123456789abcdef"[h & 15];
    return text;
}

}  // namespace formwork
