#include "arcsim/scene/morph.hpp"

#include <algorithm>
#include <cmath>

#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "arcsim/scene/motion.hpp"

namespace arcsim {
namespace {

struct MorphParams {
    int cloth = 0;
    JsonValue targets = JsonValue::array();
    std::vector<MorphKey> spline;
};
void visit(Archive& a, MorphParams& p) {
    a.optional("cloth", p.cloth, "", non_negative, "Index of the cloth.");
    a.raw("targets", p.targets, "OBJ files with the nodes of the cloth.");
    a.list("spline", p.spline, "Keys in time.");
}

VectorXd nodes_of(const std::filesystem::path& file) {
    const ClothMesh mesh = read_obj(file);
    VectorXd x(3 * mesh.n_nodes());
    for (int i = 0; i < mesh.n_nodes(); ++i) x.segment<3>(3 * i) = mesh.x[i];
    return x;
}

/// How much of each key's value stands in that of `time`.
std::vector<double> weights_of(const std::vector<MorphKey>& keys, double time) {
    const int n = static_cast<int>(keys.size());
    std::vector<double> w(keys.size(), 0);
    const int after = static_cast<int>(std::upper_bound(keys.begin(), keys.end(), time, [](double t, const MorphKey& k) { return t < k.time; }) - keys.begin());
    if (after == 0 || after == n) {
        w[after == 0 ? 0 : n - 1] = 1;
        return w;
    }
    const double span = keys[after].time - keys[after - 1].time;
    const Hermite c = hermite((time - keys[after - 1].time) / span, span);
    w[after - 1] += c.value0;
    w[after] += c.value1;
    for (const auto& [key, rate] : {std::pair(after - 1, c.rate0), std::pair(after, c.rate1)}) {
        if (key == 0 || key + 1 == n) continue;
        const double slope = rate / (keys[key + 1].time - keys[key - 1].time);
        w[key + 1] += slope;
        w[key - 1] -= slope;
    }
    return w;
}

}  // namespace

void visit(Archive& a, MorphKey& k) {
    a.required("time", k.time, "s", any_number, "When the target is reached.");
    a.required("target", k.target, "", non_negative, "Index into targets.");
    a.required("stiffness", k.stiffness, "N/m", positive, "Of the spring at every node.");
}

double Morph::at(double time, VectorXd& shape) const {
    const std::vector<double> weight = weights_of(keys, time);
    shape.setZero(targets.front().size());
    double log_stiffness = 0;
    for (size_t k = 0; k < keys.size(); ++k) {
        if (weight[k] == 0) continue;
        shape += weight[k] * targets[keys[k].target];
        log_stiffness += weight[k] * std::log(keys[k].stiffness);
    }
    return std::exp(log_stiffness);
}

void Morph::add_springs(double time, std::vector<SpringForce::Target>& springs) const {
    VectorXd shape;
    const double stiffness = at(time, shape);
    for (int i = 0; i < shape.size() / 3; ++i) springs.push_back({i, stiffness, shape.segment<3>(3 * i)});
}

std::vector<Morph> read_morphs(const JsonNode& node, Warnings& warnings) {
    if (node.kind() == JsonKind::null) return {};
    std::vector<Morph> morphs;
    for (int i = 0; i < node.size(); ++i) {
        MorphParams p;
        read_params(node[i], p, warnings);
        if (p.spline.empty()) node[i].fail("a morph needs at least one key in \"spline\": [{\"time\": t, \"target\": 0, \"stiffness\": N/m}].");
        Morph morph;
        morph.cloth = p.cloth;
        morph.keys = p.spline;
        const JsonNode targets = node[i].at("targets");
        for (int t = 0; t < targets.size(); ++t) morph.targets.push_back(nodes_of(targets[t].file().path));
        for (size_t k = 0; k < morph.keys.size(); ++k) {
            const JsonNode key = node[i].at("spline")[static_cast<int>(k)];
            if (morph.keys[k].target >= static_cast<int>(morph.targets.size()))
                key.at("target").fail("target " + std::to_string(morph.keys[k].target) + " does not exist; there are " +
                                      std::to_string(morph.targets.size()) + ", counted from 0.");
            if (k > 0 && morph.keys[k].time <= morph.keys[k - 1].time)
                key.at("time").fail("expected a time after the key before it (" + format_number(morph.keys[k - 1].time) +
                                    " s), got " + format_number(morph.keys[k].time) + ".");
        }
        morphs.push_back(std::move(morph));
    }
    return morphs;
}

}  // namespace arcsim
