#include "formwork/study/measured_curves.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"

namespace formwork {

std::vector<MeasuredCurve> read_measured_curves(const std::filesystem::path& file) {
    std::istringstream text(arcsim::read_text_file(file));
    std::vector<MeasuredCurve> curves;
    bool has_header = false;
    int number = 0;
    for (std::string line; std::getline(text, line);) {
        ++number;
        const auto fail = [&](const std::string& what) {
            throw arcsim::InputError(file.string() + ":" + std::to_string(number) + ": " + what);
        };
        std::erase_if(line, [](char c) { return c == '\r' || c == ' ' || c == '"'; });
        if (line.empty() || line[0] == '#') continue;
        if (!has_header) {
            if (line.rfind("angle_deg,displacement_mm,force_N", 0) != 0)
                fail("expected the header angle_deg,displacement_mm,force_N, got \"" + line + "\".");
            has_header = true;
            continue;
        }
        double value[3];
        const char* at = line.c_str();
        for (int k = 0; k < 3; ++k) {
            char* end = nullptr;
            value[k] = std::strtod(at, &end);
            const bool separated = k < 2 ? *end == ',' : *end == ',' || *end == '\0';
            if (end == at || !separated || !(value[k] == value[k])) fail("expected three numbers, got \"" + line + "\".");
            at = end + 1;
        }
        auto curve = std::find_if(curves.begin(), curves.end(), [&](const MeasuredCurve& c) { return c.angle_deg == value[0]; });
        if (curve == curves.end()) curve = curves.insert(curves.end(), MeasuredCurve{value[0], {}, {}});
        if (!curve->displacement_mm.empty() && value[1] < curve->displacement_mm.back())
            fail("the displacement goes back; cut the curve where the strip breaks.");
        if (value[1] < 0) fail("a displacement below 0.");
        curve->displacement_mm.push_back(value[1]);
        curve->force_N.push_back(value[2]);
    }
    if (curves.empty()) throw arcsim::InputError(file.string() + ": holds no curve. Give angle_deg,displacement_mm,force_N.");
    return curves;
}

}  // namespace formwork
