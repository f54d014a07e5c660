#include "formwork/report/base64.hpp"

namespace formwork {

std::string base64(std::string_view bytes) {
    constexpr char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    const auto at = [&](size_t i) -> std::uint32_t {
        return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
    };
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const std::uint32_t three = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
        out += digit[three >> 18];
        out += digit[three >> 12 & 63];
        out += i + 1 < bytes.size() ? digit[three >> 6 & 63] : '=';
        out += i + 2 < bytes.size() ? digit[three & 63] : '=';
    }
    return out;
}

}  // namespace formwork
