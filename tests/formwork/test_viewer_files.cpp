#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "arcsim/base/files.hpp"
#include "formwork/report/glb.hpp"
#include "formwork/report/pictures.hpp"
#include "formwork/report/surface_lines.hpp"
#include "formwork/report/vtu.hpp"
#include "tests/formwork/synthetic_bag.hpp"
#include "tests/output_folder.hpp"

using namespace formwork;

namespace {

std::uint32_t u32(const std::string& s, size_t at) {
    std::uint32_t v;
    std::memcpy(&v, s.data() + at, 4);
    return v;
}

}  // namespace

TEST_CASE("a GLB holds the surface in metres with y up, its colours and its seams") {
    const OutputFolder folder("viewer_files");
    const SyntheticBag bag = make_synthetic_bag(16, 8);
    const Segmentation& g = bag.segmentation;
    Paint paint;
    for (const int p : g.panel) paint.colour.push_back(panel_colours(g)[p]);
    write_glb(folder / "panels.glb", bag.sewn, paint, seam_lines(g, bag.sewn), {0, 0, 1}, "bag");
    const std::string file = arcsim::read_text_file(folder / "panels.glb");
    REQUIRE(file.substr(0, 4) == "glTF");
    CHECK(u32(file, 8) == file.size());
    const std::uint32_t n = u32(file, 12);
    const nlohmann::json root = nlohmann::json::parse(file.substr(20, n));
    const auto& primitive = root["meshes"][0]["primitives"][0];
    const auto& position = root["accessors"][primitive["attributes"]["POSITION"].get<int>()];
    CHECK(position["count"] == 3 * g.mesh.n_faces());
    double top = -1;
    for (const Vector3d& p : bag.sewn.x) top = std::max(top, p.z());
    CHECK(position["max"][1].get<double>() == Approx(top));
    CHECK(root["meshes"][0]["primitives"][1]["mode"] == 1);
    CHECK(root["buffers"][0]["byteLength"] == u32(file, 20 + n));
    CHECK_THROWS_AS(
        write_glb(folder / "x.glb", g.mesh, paint_classes({0}, {}, ""), {}, {0, 0, 1}, ""),
        std::invalid_argument);
}

TEST_CASE("a VTU holds nodes, faces and every part of the strain") {
    const OutputFolder folder("viewer_files");
    const SyntheticBag bag = make_synthetic_bag(16, 8);
    const Segmentation& g = bag.segmentation;
    std::vector<VtuArray> face = strain_arrays(bag.strain);
    face.push_back(integer_array("panel", g.panel));
    write_vtu(folder / "inflated.vtu", bag.inflated, {vector_array("rest", g.mesh.x)}, face);
    write_pvd(folder / "series.pvd", {{0.0, "inflated.vtu"}, {0.04, "inflated.vtu"}});
    const std::string file = arcsim::read_text_file(folder / "inflated.vtu");
    CHECK(file.find("NumberOfPoints=\"" + std::to_string(g.mesh.n_nodes()) + "\"") !=
          std::string::npos);
    for (const char* name :
         {"lambda1", "lambda2", "direction", "eps_uv", "tension1", "state", "panel", "rest"})
        CHECK(file.find(std::string("Name=\"") + name + "\"") != std::string::npos);
    CHECK(file.size() < 200.0 * g.mesh.n_faces());
    CHECK_THROWS_AS(write_vtu(folder / "x.vtu", g.mesh, {{"short", 1, {1.0}}}, {}),
                    std::invalid_argument);
}
