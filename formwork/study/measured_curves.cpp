#include "formwork/study/measured_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"

namespace formwork {

std::vector<MeasuredCurve> read_measured_curves(const std::filesystem::path& file) {
    std::istringstream text(arcsim::read_text_file(file));
    std::vector<MeasuredCurve> curves;
    bool has_header = false, has_time = false;
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
            has_time = (line + ",").rfind("angle_deg,displacement_mm,force_N,time_s,", 0) == 0;
            continue;
        }
        double value[4] = {};
        const int wanted = has_time ? 4 : 3;
        const char* at = line.c_str();
        for (int k = 0; k < wanted; ++k) {
            char* end = nullptr;
            value[k] = std::strtod(at, &end);
            const bool separated = k < wanted - 1 ? *end == ',' : *end == ',' || *end == '\0';
            if (end == at || !separated || !std::isfinite(value[k]))
                fail(std::string("expected ") + (has_time ? "four" : "three") + " numbers, got \"" + line + "\".");
            at = end + 1;
        }
        auto curve = std::find_if(curves.begin(), curves.end(), [&](const MeasuredCurve& c) { return c.angle_deg == value[0]; });
        if (curve == curves.end()) curve = curves.insert(curves.end(), MeasuredCurve{value[0], {}, {}, {}});
        if (!curve->displacement_mm.empty() && value[1] < curve->displacement_mm.back())
            fail("the displacement goes back; cut the curve where the strip breaks.");
        if (value[1] < 0) fail("a displacement below 0.");
        curve->displacement_mm.push_back(value[1]);
        curve->force_N.push_back(value[2]);
        if (!has_time) continue;
        if (!curve->time_s.empty() && value[3] < curve->time_s.back()) fail("the time goes back.");
        curve->time_s.push_back(value[3]);
    }
    if (curves.empty()) throw arcsim::InputError(file.string() + ": holds no curve. Give angle_deg,displacement_mm,force_N.");
    return curves;
}

}  // namespace formwork
