// Sewn bags under refinement of one fixed layout: `scripts/study_seams`.
//
//   study_seams SCENE FOLDER REFINEMENTS [VARIANT]   FOLDER holds the scene's finished stages up to panels; VARIANT: one
//                                                   of those below alone, or "default": the first, from one start
//
// Every refinement cuts each flat face into four alike, so that the bag stays the same polyhedron and only the
// unknowns become finer. One CSV line per run: seam model, start, size, and what the bag answers.
#include <cstdio>
#include <map>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/scene/formwork_scene.hpp"
#include "formwork/sew/sew.hpp"
#include "formwork/stages/segmentation_file.hpp"
#include "formwork/stages/summary.hpp"

using namespace formwork;

namespace {

struct CutBag {
    Segmentation s;                  // its nodes are its own source
    std::vector<FlatTriangle> flat;
    std::vector<Vector3d> inflated;  // per node
    std::vector<char> held;          // per degree of freedom
};

/// From here on the cut mesh is the input mesh: a refined node need not lie in any face of the file's.
void become_source(Segmentation& s) {
    s.source.assign(s.mesh.x.size(), {});
    s.source_face.clear();
    for (int f = 0; f < s.mesh.n_faces(); ++f) {
        s.source_face.push_back(f);
        for (int k = 0; k < 3; ++k) {
            SurfacePoint& p = s.source[s.mesh.faces[f][k]];
            p.face = f;
            p.barycentric = {0, 0, 0};
            p.barycentric[k] = 1;
        }
    }
}

CutBag refined(const CutBag& coarse) {
    CutBag fine;
    fine.s.n_panels = coarse.s.n_panels;
    fine.s.mesh.x = coarse.s.mesh.x;
    fine.inflated = coarse.inflated;
    fine.held = coarse.held;
    std::map<std::pair<int, int>, int> faces_at;   // of each edge: held rims stay held, edges between held nodes do not
    for (const Triangle& t : coarse.s.mesh.faces)
        for (int k = 0; k < 3; ++k) ++faces_at[std::minmax(t[k], t[(k + 1) % 3])];
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
        const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(fine.s.mesh.x.size()));
        if (is_new) {
            fine.s.mesh.x.push_back(0.5 * (coarse.s.mesh.x[a] + coarse.s.mesh.x[b]));
            fine.inflated.push_back(0.5 * (coarse.inflated[a] + coarse.inflated[b]));
            for (int axis = 0; axis < 3; ++axis)
                fine.held.push_back(faces_at.at(std::minmax(a, b)) == 1 && coarse.held[3 * a + axis] && coarse.held[3 * b + axis]);
        }
        return at->second;
    };
    for (int f = 0; f < coarse.s.mesh.n_faces(); ++f) {
        const Triangle& t = coarse.s.mesh.faces[f];
        const FlatTriangle& u = coarse.flat[f];
        int m[3];
        Vector2d v[3];
        for (int k = 0; k < 3; ++k) m[k] = middle(t[k], t[(k + 1) % 3]), v[k] = 0.5 * (u[k] + u[(k + 1) % 3]);
        const std::array<Triangle, 4> faces{{{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, {m[0], m[1], m[2]}}};
        const std::array<FlatTriangle, 4> flat{{{u[0], v[0], v[2]}, {v[0], u[1], v[1]}, {v[2], v[1], u[2]}, {v[0], v[1], v[2]}}};
        for (int k = 0; k < 4; ++k) {
            fine.s.mesh.faces.push_back(faces[k]);
            fine.flat.push_back(flat[k]);
            fine.s.panel.push_back(coarse.s.panel[f]);
        }
    }
    for (Seam seam : coarse.s.seams) {
        std::vector<int> nodes{seam.nodes.front()};
        for (size_t k = 0; k + 1 < seam.nodes.size(); ++k) {
            nodes.push_back(middles.at(std::minmax(seam.nodes[k], seam.nodes[k + 1])));
            nodes.push_back(seam.nodes[k + 1]);
        }
        seam.nodes = nodes;
        fine.s.seams.push_back(seam);
    }
    become_source(fine.s);
    return fine;
}

/// Panels whose vertices belong to one face each: all that a sewn bag reads of them.
std::vector<FlatPanel> loose_panels(const CutBag& bag) {
    std::vector<FlatPanel> panels(bag.s.n_panels);
    for (int f = 0; f < bag.s.mesh.n_faces(); ++f) {
        FlatPanel& p = panels[bag.s.panel[f]];
        const int first = static_cast<int>(p.node.size());
        p.face.push_back(f);
        p.faces.push_back({first, first + 1, first + 2});
        for (int k = 0; k < 3; ++k) p.node.push_back(bag.s.mesh.faces[f][k]), p.u.push_back(bag.flat[f][k]);
    }
    return panels;
}

double largest_difference(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
    double d = 0;
    for (size_t i = 0; i < a.size(); ++i) d = std::max(d, (a[i] - b[i]).norm());
    return d;
}

double edge_length(const SewnBag& bag) {
    double sum = 0;
    for (const SeamEdge& e : bag.edges) sum += e.length;
    return bag.edges.empty() ? 0 : sum / static_cast<double>(bag.edges.size());
}

int n_shorter(const SewResult& r) {
    int n = 0;
    for (const SeamSpring& s : r.bag.springs) n += s.L > 0 && (r.equilibrium.x[s.j] - r.equilibrium.x[s.i]).norm() < s.L * (1 - 1e-9);
    return n;
}

void study(const std::string& scene_file, const std::string& folder, int refinements, const std::string& only) {
    const FormworkScene scene = read_scene(scene_file, {});
    const BagMesh mesh = load_bag_mesh(scene);
    const std::filesystem::path dir = folder;
    CutBag bag;
    bag.s = as_cut(read_segmentation(dir / "segment"), dir / "panels");
    bag.flat = flat_from_panels(bag.s, read_panels(dir / "panels/sewn_rest.obj", bag.s).panels);
    bag.inflated = carry_to_cut_mesh(bag.s, mesh.surface.faces, arcsim::read_obj(dir / "inflate/inflated.obj").x);
    bag.held = fixed_on_cut_mesh(bag.s, mesh.surface.faces, held_dofs(scene, mesh));
    become_source(bag.s);
    const arcsim::JsonValue summary = read_summary(dir);
    const auto figure = [&](const char* key) { return summary.find("inflate")->find(key)->number; };

    SewParams base = *scene.formwork.sew;
    base.compare.clear();
    const double EA = base.kappa(1) * edge_length([&] {
                          SewnBag b;
                          b.edges = seam_edges(bag.s);
                          return b;
                      }());
    struct Variant {
        const char* name;
        bool by_EA;
        ThreadCompression compression;
        SeamModel seams;
    };
    const Variant variants[] = {{"kappa slack", false, ThreadCompression::slack, SeamModel::shared},
                                {"kappa full", false, ThreadCompression::full, SeamModel::shared},
                                {"EA slack", true, ThreadCompression::slack, SeamModel::shared},
                                {"EA full", true, ThreadCompression::full, SeamModel::shared},
                                {"kappa slack stitch", false, ThreadCompression::slack, SeamModel::stitch}};
    std::printf("variant,refinement,start,faces,seam_edges,shorter_edges,EA_N,iterations,residual,depth_mm,volume_ml,mean_abs_shear,"
                "fabric_mean_abs_shear,rotated_45_mean_abs_shear,rotated_45_fabric_mean_abs_shear,max_force_N,max_push_N,gap_mm,starts_apart_mm,weight_error,cpu_s\n");
    for (int level = 0; level <= refinements; ++level) {
        if (level > 0) bag = refined(bag);
        const std::vector<FlatPanel> panels = loose_panels(bag);
        const SewInput input{bag.s, panels, bag.s.mesh.faces, bag.inflated, bag.held, scene.formwork.up, scene.plaster(),
                             figure("fill_level_m"), figure("volume_m3"), {}};
        for (const Variant& v : variants) {
            SewParams p = base;
            p.thread_compression = v.compression;
            p.seams = v.seams;
            if (v.by_EA) p.seam_EA = EA;
            std::vector<Vector3d> first;
            for (SewStart start : {SewStart::inflated, SewStart::rest}) {
                p.start = start;
                const bool is_default = &v == variants && start == SewStart::inflated;
                if (only == "default" ? !is_default : !only.empty() && only != v.name) continue;
                p.compare = is_default ? std::vector<std::string>{"rotated_45"} : std::vector<std::string>{};
                std::printf("%s,%d,%s,", v.name, level, start == SewStart::rest ? "rest" : "inflated");
                try {
                    const SewResult r = sew_bag(input, p);
                    const EquilibriumResult& e = r.equilibrium;
                    if (first.empty()) first = e.x;
                    double fabric = 0;
                    for (const FlatTriangle& u : r.bag.flat)
                        fabric += 0.5 * ((u[1] - u[0]).x() * (u[2] - u[0]).y() - (u[1] - u[0]).y() * (u[2] - u[0]).x());
                    const double weight = 9.81 * (scene.plaster().density * e.volume_m3 + p.density * fabric);
                    std::printf("%d,%zu,%d,%.4g,%d,%.2g,%.5f,%.4f,%.6f,%.6f,%.6f,%.6f,%.4f,%.4f,%.5f,%.3g,%.2g,%.2f\n", e.faces, r.bag.edges.size(),
                                n_shorter(r), p.kappa(edge_length(r.bag)) * edge_length(r.bag), e.iterations, e.residual, 1e3 * e.depth_m,
                                1e6 * e.volume_m3, r.weave.abs_shear.mean, r.weave.fabric_abs_shear.mean,
                                is_default ? r.compare[0].mean_abs_shear : 0.0, is_default ? r.compare[0].fabric_mean_abs_shear : 0.0,
                                r.seam_max_force_N,
                                r.seam_max_compression_N, 1e3 * r.seam_gap_max_m, 1e3 * largest_difference(first, e.x),
                                std::abs(e.support_force_N[2] / weight - 1), e.cpu_s);
                } catch (const arcsim::NumericalError& error) {
                    std::printf("failed: %s\n", error.what());
                }
                std::fflush(stdout);
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4 && argc != 5) {
        std::fprintf(stderr, "usage: study_seams SCENE FOLDER REFINEMENTS [VARIANT]\n");
        return 2;
    }
    try {
        study(argv[1], argv[2], std::atoi(argv[3]), argc == 5 ? argv[4] : "");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "study_seams: %s\n", error.what());
        return 2;
    }
}
