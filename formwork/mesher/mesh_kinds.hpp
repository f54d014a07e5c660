#pragma once

#include "arcsim/base/archive.hpp"
#include "arcsim/mesh/cloth_mesh.hpp"
#include "arcsim/mesh/surface.hpp"

namespace formwork {

using arcsim::ClothMesh;
using arcsim::Surface;

// Meshes of `formwork mesh`. Sizes in metres; `edge` is the wanted edge length. z is up; bags have their
// bottom at z = 0 unless said otherwise; faces are counter-clockwise seen from outside (flat ones: from above).
// @throws InputError when a size does not fit the others

struct DiskSize {
    double radius = 0.1, edge = 0.01;
};
template <class Archive>
void visit(Archive& a, DiskSize& p) {
    a.optional("radius", p.radius, "m", arcsim::positive, "Radius.");
    a.optional("edge", p.edge, "m", arcsim::positive, "Wanted edge length.");
}
Surface make_disk(const DiskSize&);                 // flat, z = 0, centre at the origin

struct StripSize {
    double length = 0.04, width = 0.02, edge = 0.002;
};
template <class Archive>
void visit(Archive& a, StripSize& p) {
    a.optional("length", p.length, "m", arcsim::positive, "Along x.");
    a.optional("width", p.width, "m", arcsim::positive, "Along y.");
    a.optional("edge", p.edge, "m", arcsim::positive, "Wanted edge length.");
}
Surface make_strip(const StripSize&);               // flat, z = 0, from the origin along x; length along x

struct SockSize {
    double radius = 0.1, height = 0.3, edge = 0.01;
};
template <class Archive>
void visit(Archive& a, SockSize& p) {
    a.optional("radius", p.radius, "m", arcsim::positive, "Radius.");
    a.optional("height", p.height, "m", arcsim::positive, "Height of the wall.");
    a.optional("edge", p.edge, "m", arcsim::positive, "Wanted edge length.");
}
Surface make_sock(const SockSize&);                 // cylinder with a flat disk bottom, open top

struct SphereSize {
    double radius = 0.1, edge = 0.01;
    double opening = 0;                             // radius of the hole at the top; 0: closed
};
template <class Archive>
void visit(Archive& a, SphereSize& p) {
    a.optional("radius", p.radius, "m", arcsim::positive, "Radius.");
    a.optional("edge", p.edge, "m", arcsim::positive, "Wanted edge length.");
    a.optional("opening", p.opening, "m", arcsim::non_negative, "Radius of the hole at the top; 0: closed.");
}
Surface make_sphere(const SphereSize&);             // lowest point at z = 0

struct ColumnSize {
    double height = 0.3;
    double bottom_radius = 0.038, top_radius = 0.052;   // of the circle that the section is a superellipse of
    double exponent = 3;                            // of the superellipse: 2 circle, 4 nearly a square
    double aspect = 1;                              // second half axis over the first
    double twist_deg = 60;                          // of the top against the bottom
    double fillet = 0.012;                          // radius of the edge between bottom and wall
    double edge = 0.0042;
};
template <class Archive>
void visit(Archive& a, ColumnSize& p) {
    a.optional("height", p.height, "m", arcsim::positive, "Height.");
    a.optional("bottom_radius", p.bottom_radius, "m", arcsim::positive, "Half width of the section at the bottom.");
    a.optional("top_radius", p.top_radius, "m", arcsim::positive, "Half width of the section at the rim.");
    a.optional("exponent", p.exponent, "", arcsim::between(1, 20), "Of the superellipse: 2 circle, 4 nearly a square.");
    a.optional("aspect", p.aspect, "", arcsim::between(0.2, 5), "Second half width over the first.");
    a.optional("twist_deg", p.twist_deg, "degrees", arcsim::any_number, "Turn of the rim against the bottom.");
    a.optional("fillet", p.fillet, "m", arcsim::positive, "Radius of the edge between bottom and wall.");
    a.optional("edge", p.edge, "m", arcsim::positive, "Wanted edge length.");
}
Surface make_column(const ColumnSize&);             // closed bottom, open top

struct VaseSize {
    double height = 0.2;
    double foot_radius = 0.028, belly_radius = 0.055, neck_radius = 0.026, lip_radius = 0.036;
    double belly_height = 0.36, neck_height = 0.82; // of the height
    double edge = 0.004;
};
template <class Archive>
void visit(Archive& a, VaseSize& p) {
    a.optional("height", p.height, "m", arcsim::positive, "Height.");
    a.optional("foot_radius", p.foot_radius, "m", arcsim::positive, "Radius of the foot.");
    a.optional("belly_radius", p.belly_radius, "m", arcsim::positive, "Largest radius.");
    a.optional("neck_radius", p.neck_radius, "m", arcsim::positive, "Smallest radius above the belly.");
    a.optional("lip_radius", p.lip_radius, "m", arcsim::positive, "Radius of the open rim.");
    a.optional("belly_height", p.belly_height, "", arcsim::between(0, 1), "Where the belly is, part of the height.");
    a.optional("neck_height", p.neck_height, "", arcsim::between(0, 1), "Where the neck is, part of the height.");
    a.optional("edge", p.edge, "m", arcsim::positive, "Wanted edge length.");
}
Surface make_vase(const VaseSize&);                 // closed foot, belly, neck, open lip

struct PillowSize {
    double width = 0.16, height = 0.16;             // of the body, m
    double spout_width = 0.06, spout_height = 0.04;
    double edge = 0.004;
    double bulge = 0.006;                           // half thickness of the start shape in space
};
template <class Archive>
void visit(Archive& a, PillowSize& p) {
    a.optional("width", p.width, "m", arcsim::positive, "Of the body.");
    a.optional("height", p.height, "m", arcsim::positive, "Of the body.");
    a.optional("spout_width", p.spout_width, "m", arcsim::positive, "Of the spout, flat.");
    a.optional("spout_height", p.spout_height, "m", arcsim::positive, "Of the spout.");
    a.optional("edge", p.edge, "m", arcsim::positive, "Wanted edge length.");
    a.optional("bulge", p.bulge, "m", arcsim::positive, "Half thickness of the start shape.");
}
/// Two equal flat panels sewn at the edge, hanging from a spout that is open at the top (z = height +
/// spout_height). Verts hold the flat rest shape in metres, the back panel mirrored and beside the front
/// one; nodes hold a shallow bulge with the spout's rim open as a lens. Groups "front" and "back".
ClothMesh make_pillow(const PillowSize&);

}  // namespace formwork
