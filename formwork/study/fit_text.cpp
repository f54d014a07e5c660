#include <sstream>

#include "formwork/study/fit.hpp"

namespace formwork {

std::string fit_csv(const FitResult& r) {
    std::ostringstream out;
    out.precision(8);
    out << "entry,value_N_per_m,deviation_N_per_m,determined,influence,at_bound,start_N_per_m,why\n";
    for (const FittedEntry& e : r.entries)
        out << e.name << ',' << e.value << ',' << e.deviation << ',' << (e.determined ? "yes" : "no") << ',' << e.influence << ','
            << (e.at_bound ? "yes" : "no") << ',' << e.start << ',' << e.why << '\n';
    return out.str();
}

std::string fitted_material_text(const FitResult& r, double density) {
    std::ostringstream out;
    out.precision(8);
    out << "// Estimated from tensile tests. Rows: unstrained, then fully strained at 0, 22.5, 45, 67.5, 90 degrees to the warp;\n"
           "// columns k_uu, k_uv, k_vv, k_ss. The data do not determine:";
    for (const FittedEntry& e : r.entries)
        if (!e.determined) out << " [" << e.name << "]";
    out << "\n{\n  \"density\": " << density << ",   // kg/m², not estimated\n  \"stretching\": [   // N/m\n";
    for (int row = 0; row < 6; ++row) {
        out << "    [";
        for (int k = 0; k < 4; ++k) out << r.entries[4 * row + k].value << (k < 3 ? ", " : "]");
        out << (row < 5 ? ",\n" : "\n");
    }
    out << "  ],\n  \"bending\": [[1e-6, 1e-6, 1e-6, 1e-6, 1e-6], [1e-6, 1e-6, 1e-6, 1e-6, 1e-6], [1e-6, 1e-6, 1e-6, 1e-6, 1e-6]]\n}\n";
    return out.str();
}

}  // namespace formwork
