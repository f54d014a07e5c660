#include <cstdio>

#include "formwork/cli/session.hpp"
#include "formwork/study/compare_shapes.hpp"

namespace formwork {

namespace {

void compare(const std::string& a, const std::string& b, std::optional<double> tolerance, Session& session) {
    const std::vector<FileComparison> files = compare_results(a, b);
    double worst = 0;
    if (!session.quiet) std::printf("%-28s %12s %12s %12s   (m)\n", "file", "rms", "max", "Hausdorff");
    for (const FileComparison& f : files) {
        if (!session.quiet)
            std::printf("%-28s %12.4g %12.4g %12.4g%s\n", f.name.c_str(), f.rms, f.max, f.hausdorff, f.same_mesh ? "" : "   different meshes: nearest points");
        worst = std::max(worst, f.max);
    }
    if (tolerance && worst > *tolerance) {
        std::printf("difference %.4g m exceeds the tolerance %.4g m\n", worst, *tolerance);
        session.exit_code = 1;
    }
}

}  // namespace

void add_compare_command(CLI::App& app, Session& session) {
    CLI::App* command = add_command(app, session, "compare", "Compare two OBJ files, or two output folders of ours or of ArcSim",
                                    "  formwork compare out/a out/b --tolerance 1e-6     file by file; m; exit code 1 beyond the tolerance\n"
                                    "  formwork compare a.obj b.obj");
    auto a = std::make_shared<std::string>(), b = std::make_shared<std::string>();
    auto tolerance = std::make_shared<std::optional<double>>();
    command->add_option("A", *a, "OBJ file or folder")->required()->type_name("");
    command->add_option("B", *b, "OBJ file or folder")->required()->type_name("");
    command->add_option("--tolerance", *tolerance, "Largest allowed difference of any vertex, m")->type_name("M");
    command->callback([a, b, tolerance, &session] { compare(*a, *b, *tolerance, session); });
}

}  // namespace formwork
