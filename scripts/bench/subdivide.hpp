#pragma once

#include <array>
#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"
#include "formwork/segment/direction_data.hpp"

/// Every face into four by the edges' middles; children take the parent's direction.
inline void subdivide(arcsim::Surface& s, std::vector<formwork::DirectionData>& data) {
    const arcsim::Topology t = arcsim::build_topology(s);
    arcsim::Surface finer;
    finer.x = s.x;
    for (const arcsim::Edge& e : t.edges) finer.x.push_back((s.x[e.node[0]] + s.x[e.node[1]]) / 2);
    std::vector<formwork::DirectionData> finer_data;
    for (int f = 0; f < s.n_faces(); ++f) {
        const auto& v = s.faces[f];
        std::array<int, 3> m;   // on the edge opposite corner k
        for (int k = 0; k < 3; ++k) m[k] = s.n_nodes() + t.face_edges[f][k];
        const arcsim::Vector3d d = arcsim::face_frame(s, f).direction(data[f].theta);
        for (const arcsim::Triangle& child : {arcsim::Triangle{v[0], m[2], m[1]}, arcsim::Triangle{m[2], v[1], m[0]},
                                              arcsim::Triangle{m[1], m[0], v[2]}, arcsim::Triangle{m[0], m[1], m[2]}}) {
            finer.faces.push_back(child);
            finer_data.push_back(data[f]);
            finer_data.back().theta = arcsim::face_frame(finer, finer.n_faces() - 1).angle(d);
        }
    }
    s = std::move(finer);
    data = std::move(finer_data);
}
