// Lays a disk flat with CGAL's parameterisations, for scripts/compare_flattening; no part of the product.
//
//   flatten_with_cgal METHOD FILE.off > UV.txt     METHOD: arap | lscm; one line "u v" per vertex
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace smp = CGAL::Surface_mesh_parameterization;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    Mesh mesh;
    std::ifstream(argv[2]) >> mesh;
    const auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
    auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
    const smp::Error_code error = std::string(argv[1]) == "arap" ? smp::parameterize(mesh, smp::ARAP_parameterizer_3<Mesh>(), border, uv)
                                                                 : smp::parameterize(mesh, smp::LSCM_parameterizer_3<Mesh>(), border, uv);
    if (error != smp::OK) {
        std::fprintf(stderr, "%s\n", smp::get_error_message(error));
        return 1;
    }
    for (const Mesh::Vertex_index v : mesh.vertices()) std::printf("%.12g %.12g\n", uv[v].x(), uv[v].y());
}
