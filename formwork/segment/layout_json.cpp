#include "formwork/segment/layout_json.hpp"

#include <map>
#include <set>

namespace formwork {

using arcsim::JsonValue;

namespace {

double length_of(const Segmentation& s, const Seam& seam) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < seam.nodes.size(); ++i)
        length += (s.mesh.x[seam.nodes[i + 1]] - s.mesh.x[seam.nodes[i]]).norm();
    return length;
}

JsonValue point(const arcsim::Vector3d& x) {
    JsonValue v = JsonValue::array();
    for (int k = 0; k < 3; ++k) v.add(x[k]);
    return v;
}

/// A panel's borders, chained end to end: it lies to the left of every step.
JsonValue outline_of(const Segmentation& s, int panel) {
    struct Step {
        int arc, direction, from, to;
    };
    std::vector<Step> steps;
    for (std::size_t i = 0; i < s.seams.size(); ++i)
        for (int side = 0; side < 2; ++side) {
            if (s.seams[i].panel[side] != panel) continue;
            const auto& nodes = s.seams[i].nodes;
            const int arc = static_cast<int>(i);
            if (side == 0)
                steps.push_back({arc, 1, nodes.front(), nodes.back()});
            else
                steps.push_back({arc, -1, nodes.back(), nodes.front()});
        }
    JsonValue outline = JsonValue::array();
    std::vector<char> used(steps.size(), 0);
    for (std::size_t first = 0; first < steps.size(); ++first) {
        if (used[first]) continue;
        for (std::size_t at = first; at < steps.size() && !used[at];) {
            used[at] = 1;
            JsonValue pair = JsonValue::array();
            pair.add(steps[at].arc);
            pair.add(steps[at].direction);
            outline.add(std::move(pair));
            std::size_t next = steps.size();
            for (std::size_t j = 0; j < steps.size(); ++j)
                if (!used[j] && steps[j].from == steps[at].to) {
                    next = j;
                    if (steps[j].arc != steps[at].arc) break;
                }
            at = next;
        }
    }
    return outline;
}

}  // namespace

JsonValue layout_json(const Segmentation& s) {
    std::map<int, std::vector<int>> at;   // node of the mesh -> arcs that end there
    for (std::size_t i = 0; i < s.seams.size(); ++i)
        if (!s.seams[i].is_loop())
            for (int v : {s.seams[i].nodes.front(), s.seams[i].nodes.back()}) at[v].push_back(static_cast<int>(i));
    std::map<int, int> number;
    JsonValue nodes = JsonValue::array(), arcs = JsonValue::array(), panels = JsonValue::array();
    for (const auto& [v, ends] : at) {
        number[v] = static_cast<int>(number.size());
        JsonValue node = JsonValue::object(), list = JsonValue::array();
        for (int i : ends) list.add(i);
        node.set("node", v);
        node.set("position", point(s.mesh.x[v]));
        node.set("arcs", std::move(list));
        nodes.add(std::move(node));
    }
    std::vector<std::set<int>> neighbours(s.n_panels);
    for (const Seam& seam : s.seams) {
        JsonValue arc = JsonValue::object(), sides = JsonValue::array();
        arc.set("kind", seam.is_rim() ? "rim" : seam.panel[0] == seam.panel[1] ? "dart" : "seam");
        arc.set("from", seam.is_loop() ? JsonValue() : JsonValue(number.at(seam.nodes.front())));
        arc.set("to", seam.is_loop() ? JsonValue() : JsonValue(number.at(seam.nodes.back())));
        for (int p : seam.panel) sides.add(p < 0 ? JsonValue() : JsonValue(p));
        arc.set("panels", std::move(sides));
        arc.set("length_m", length_of(s, seam));
        arcs.add(std::move(arc));
        if (seam.is_rim() || seam.panel[0] == seam.panel[1]) continue;
        neighbours[seam.panel[0]].insert(seam.panel[1]);
        neighbours[seam.panel[1]].insert(seam.panel[0]);
    }
    std::vector<double> area(s.n_panels, 0);
    for (int f = 0; f < s.mesh.n_faces(); ++f) area[s.panel[f]] += arcsim::face_area(s.mesh, f);
    for (int p = 0; p < s.n_panels; ++p) {
        JsonValue panel = JsonValue::object(), list = JsonValue::array();
        for (int q : neighbours[p]) list.add(q);
        panel.set("area_m2", area[p]);
        panel.set("outline", outline_of(s, p));
        panel.set("neighbours", std::move(list));
        panels.add(std::move(panel));
    }
    JsonValue layout = JsonValue::object();
    layout.set("nodes", std::move(nodes));
    layout.set("arcs", std::move(arcs));
    layout.set("panels", std::move(panels));
    return layout;
}

}  // namespace formwork
